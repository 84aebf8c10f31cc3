#include "grid.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <gdal_alg.h>
#include <gdal_utils.h>

#include "ground.h"

enum {
    FEWEST_CELLS = 8,
    CELL_SAMPLES = 16,           /* a side: no grid's cell needs more of the raster's cells */
    CACHE_BYTES = 64 * (1 << 20) /* of GDAL; its own choice is a share of the machine's memory */
};

/* Heights beyond these are marks for missing data: the lowest and the highest ground known on any
 * planet with room to spare.
 */
static const float lowest_m = -15000.0F;
static const float highest_m = 30000.0F;

/* A raster on its way to a grid. */
typedef struct {
    const char *path;
    GDALDatasetH dataset;
    GDALDatasetH wrapped[2]; /* what the dataset is a view of, and that again; or NULL */
    double transform[6];
    double bounds[4];           /* x min, y min, x max, y max of all of it */
    OGRSpatialReferenceH srs;   /* its own; borrowed; NULL if none */
    OGRSpatialReferenceH local; /* metres, if its own are not: the grid's; else NULL */
    double box[4];              /* of the grid */
    double native_m;            /* size of the raster's cells there */
    bool placed;
} source_t;

yb_grid_t *yb_grid_new(int columns, int rows, double cell_m)
{
    yb_grid_t *grid = calloc(1, sizeof(*grid));
    if (grid == NULL)
        return NULL;
    grid->height_m = calloc((size_t)columns * (size_t)rows, sizeof(float));
    if (grid->height_m == NULL) {
        free(grid);
        return NULL;
    }
    grid->columns = columns;
    grid->rows = rows;
    grid->cell_m = cell_m;
    grid->transform[1] = cell_m;
    grid->transform[3] = rows * cell_m;
    grid->transform[5] = -cell_m;
    return grid;
}

void yb_grid_free(yb_grid_t *grid)
{
    if (grid == NULL)
        return;
    CPLFree(grid->projection);
    free(grid->height_m);
    free(grid);
}

void yb_grid_measure(yb_grid_t *grid)
{
    size_t cells = (size_t)grid->columns * (size_t)grid->rows;
    double sum = 0;
    grid->low_m = grid->height_m[0];
    grid->high_m = grid->height_m[0];
    for (size_t i = 0; i < cells; i++) {
        float height = grid->height_m[i];
        grid->low_m = fminf(grid->low_m, height);
        grid->high_m = fmaxf(grid->high_m, height);
        sum += (double)height;
    }
    double mean = sum / (double)cells;
    double squares = 0;
    for (size_t i = 0; i < cells; i++) {
        double off = (double)grid->height_m[i] - mean;
        squares += off * off;
    }
    grid->std_m = sqrt(squares / (double)cells);
}

double yb_grid_height(const yb_grid_t *grid, double east_m, double north_m)
{
    double x = fmin(fmax(east_m / grid->cell_m, 0), grid->columns - 1);
    double y = fmin(fmax(grid->rows - 1 - north_m / grid->cell_m, 0), grid->rows - 1);
    int column = (int)fmin(x, grid->columns - 2);
    int row = (int)fmin(y, grid->rows - 2);
    double right = x - column;
    double down = y - row;
    const float *at = grid->height_m + (size_t)row * (size_t)grid->columns + column;
    double upper = (double)at[0] * (1 - right) + (double)at[1] * right;
    at += grid->columns;
    double lower = (double)at[0] * (1 - right) + (double)at[1] * right;
    return upper * (1 - down) + lower * down;
}

static void box_of_raster(source_t *source)
{
    const double *t = source->transform;
    double columns = GDALGetRasterXSize(source->dataset);
    double rows = GDALGetRasterYSize(source->dataset);
    for (int corner = 0; corner < 4; corner++) {
        double column = corner % 2 == 0 ? 0 : columns;
        double row = corner / 2 == 0 ? 0 : rows;
        double x = t[0] + t[1] * column + t[2] * row;
        double y = t[3] + t[4] * column + t[5] * row;
        double *b = source->bounds;
        b[0] = corner == 0 ? x : fmin(b[0], x);
        b[1] = corner == 0 ? y : fmin(b[1], y);
        b[2] = corner == 0 ? x : fmax(b[2], x);
        b[3] = corner == 0 ? y : fmax(b[3], y);
    }
}

/* Replaces the dataset by a virtual one, by the words of gdal_translate, which it frees. */
static bool source_view(source_t *source, char **words, yb_error_t *error)
{
    words = CSLAddString(words, "-of");
    words = CSLAddString(words, "VRT");
    GDALTranslateOptions *options = GDALTranslateOptionsNew(words, NULL);
    CSLDestroy(words);
    int wrong = 0;
    GDALDatasetH view = GDALTranslate("", source->dataset, options, &wrong);
    GDALTranslateOptionsFree(options);
    if (view == NULL)
        return yb_error_set(error, "cannot read %s: %s", source->path, CPLGetLastErrorMsg());
    source->wrapped[source->wrapped[0] != NULL ? 1 : 0] = source->dataset;
    source->dataset = view;
    return true;
}

/* A view of the first band, placed if the raster was not. */
static bool source_wrap(source_t *source, const double *corners, yb_error_t *error)
{
    char **words = CSLTokenizeString2("-b 1", " ", 0);
    if (corners != NULL) {
        words = CSLAddString(words, "-a_ullr");
        for (int i = 0; i < 4; i++)
            words = CSLAddString(words, CPLSPrintf("%.17g", corners[i]));
    }
    return source_view(source, words, error);
}

/* A view with fewer cells, evenly picked, if there are far more than the grid needs: a raster of
 * any size is read in short time, from its overviews where it has some.
 */
static bool source_thin(source_t *source, double cell_m, yb_error_t *error)
{
    int factor = (int)(cell_m / source->native_m / CELL_SAMPLES);
    if (factor < 2)
        return true;
    char **words = CSLTokenizeString2("-r nearest -outsize", " ", 0);
    words = CSLAddString(words,
                         CPLSPrintf("%d", 1 + (GDALGetRasterXSize(source->dataset) - 1) / factor));
    words = CSLAddString(words,
                         CPLSPrintf("%d", 1 + (GDALGetRasterYSize(source->dataset) - 1) / factor));
    source->native_m *= factor;
    return source_view(source, words, error);
}

/* Whether what the first band holds may be heights. */
static bool source_check(const source_t *source, yb_error_t *error)
{
    int bands = GDALGetRasterCount(source->dataset);
    int columns = GDALGetRasterXSize(source->dataset);
    int rows = GDALGetRasterYSize(source->dataset);
    if (bands == 0)
        return yb_error_set(error, "%s holds no raster band", source->path);
    GDALRasterBandH band = GDALGetRasterBand(source->dataset, 1);
    GDALColorInterp meaning = GDALGetRasterColorInterpretation(band);
    if (meaning == GCI_PaletteIndex || (meaning == GCI_RedBand && bands >= 3))
        return yb_error_set(error, "%s holds colours, not heights", source->path);
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band)) != 0)
        return yb_error_set(error, "%s holds complex numbers, not heights", source->path);
    if (columns < FEWEST_CELLS || rows < FEWEST_CELLS)
        return yb_error_set(error, "%s has only %d x %d cells: at least %d x %d are needed",
                            source->path, columns, rows, FEWEST_CELLS, FEWEST_CELLS);
    return true;
}

static bool source_open(source_t *source, double cell_m, yb_error_t *error)
{
    source->dataset = GDALOpenEx(source->path, GDAL_OF_RASTER | GDAL_OF_READONLY, NULL, NULL, NULL);
    if (source->dataset == NULL) {
        VSILFILE *file = VSIFOpenL(source->path, "rb");
        if (file == NULL)
            return yb_error_set(error, "cannot open %s: %s", source->path, strerror(errno));
        VSIFCloseL(file);
        return yb_error_set(error, "%s is no raster that GDAL can read", source->path);
    }
    if (!source_check(source, error))
        return false;
    int bands = GDALGetRasterCount(source->dataset);
    source->placed = GDALGetGeoTransform(source->dataset, source->transform) == CE_None;
    double columns = GDALGetRasterXSize(source->dataset) * cell_m;
    double rows = GDALGetRasterYSize(source->dataset) * cell_m;
    const double corners[4] = {0, rows, columns, 0};
    if ((!source->placed || bands > 1) &&
        !source_wrap(source, source->placed ? NULL : corners, error))
        return false;
    if (GDALGetGeoTransform(source->dataset, source->transform) != CE_None)
        return yb_error_set(error, "cannot place %s", source->path);
    source->srs = GDALGetSpatialRef(source->dataset);
    box_of_raster(source);
    return true;
}

/* Chooses the local projection through (x, y) of the raster's coordinates. */
static bool source_localise(source_t *source, double x, double y, yb_error_t *error)
{
    source->local = yb_ground_local(source->srs, x, y);
    double along[2] = {x + source->transform[1], y + source->transform[4]};
    double down[2] = {x + source->transform[2], y + source->transform[5]};
    if (source->local == NULL ||
        !yb_ground_transform(source->srs, source->local, &along[0], &along[1]) ||
        !yb_ground_transform(source->srs, source->local, &down[0], &down[1]))
        return yb_error_set(error, "cannot find metres for the coordinates of %s: %s", source->path,
                            CPLGetLastErrorMsg());
    source->native_m = sqrt(hypot(along[0], along[1]) * hypot(down[0], down[1]));
    return true;
}

static bool outside(const source_t *source, yb_error_t *error)
{
    const double *b = source->bounds;
    return yb_error_set(error,
                        "the window reaches out of %s, which covers x %.10g to %.10g, y %.10g to "
                        "%.10g",
                        source->path, b[0], b[2], b[1], b[3]);
}

/* False if a box in the raster's coordinates leaves it by more than half a cell. */
static bool box_covered(const source_t *source, const double box[4])
{
    double slack_x = fabs(source->transform[1]) * 0.501;
    double slack_y = fabs(source->transform[5]) * 0.501;
    const double *b = source->bounds;
    return box[0] >= b[0] - slack_x && box[1] >= b[1] - slack_y && box[2] <= b[2] + slack_x &&
           box[3] <= b[3] + slack_y;
}

/* Side of a cell, in the raster's own unit, turned or not. */
static double native_size(const source_t *source)
{
    const double *t = source->transform;
    return sqrt(hypot(t[1], t[4]) * hypot(t[2], t[5]));
}

static bool choose_center(source_t *source, const yb_window_t *window, yb_error_t *error)
{
    if (source->srs == NULL || OSRIsLocal(source->srs) != 0)
        return yb_error_set(error, "%s does not say where on earth it lies; use --window",
                            source->path);
    OGRSpatialReferenceH degrees = yb_ground_lon_lat();
    double x = window->lon_deg;
    double y = window->lat_deg;
    bool good = yb_ground_transform(degrees, source->srs, &x, &y);
    OSRDestroySpatialReference(degrees);
    if (!good)
        return yb_error_set(error, "the coordinates of %s do not reach longitude %g, latitude %g",
                            source->path, window->lon_deg, window->lat_deg);
    const double point[4] = {x, y, x, y};
    if (!box_covered(source, point))
        return yb_error_set(error, "longitude %g, latitude %g does not lie on %s", window->lon_deg,
                            window->lat_deg, source->path);
    if (yb_ground_in_metres(source->srs)) {
        source->native_m = native_size(source);
    } else {
        if (!source_localise(source, x, y, error))
            return false;
        x = 0;
        y = 0;
    }
    for (int side = 0; side < 4; side++)
        source->box[side] = (side % 2 == 0 ? x : y) + (side < 2 ? -0.5 : 0.5) * window->side_m;
    if (source->local == NULL && !box_covered(source, source->box))
        return outside(source, error);
    return true;
}

/* Where the grid lies and in which coordinates. */
static bool source_choose(source_t *source, const yb_window_t *window, yb_error_t *error)
{
    if (source->transform[2] != 0 || source->transform[4] != 0) {
        if (source->srs == NULL)
            return yb_error_set(error, "%s is rotated and has no projection", source->path);
    }
    if (window->kind == YB_WINDOW_CENTER)
        return choose_center(source, window, error);
    const double *box = window->kind == YB_WINDOW_BOX ? window->box : source->bounds;
    if (!box_covered(source, box))
        return outside(source, error);
    if (yb_ground_in_metres(source->srs)) {
        source->native_m = native_size(source);
        memcpy(source->box, box, sizeof(source->box));
        return true;
    }
    if (!source_localise(source, (box[0] + box[2]) / 2, (box[1] + box[3]) / 2, error))
        return false;
    if (!yb_ground_box_inside(source->srs, source->local, box, source->box))
        return yb_error_set(error,
                            "%s covers too much of the earth for one map: choose a part by "
                            "--window or --center",
                            source->path);
    return true;
}

/* What marks holes in a raster that does not say so itself; NULL: nothing does. */
static const char *hole_mark(const source_t *source)
{
    GDALRasterBandH band = GDALGetRasterBand(source->dataset, 1);
    int known = 0;
    (void)GDALGetRasterNoDataValue(band, &known);
    if (known != 0)
        return NULL;
    switch (GDALGetRasterDataType(band)) {
    case GDT_Float32:
    case GDT_Float64:
        return "nan";
    case GDT_Int16:
        return "-32768";
    default:
        return NULL;
    }
}

/* The window, resampled, as a dataset in memory. */
static GDALDatasetH source_resample(const source_t *source, const yb_grid_t *grid)
{
    char **words = CSLTokenizeString2("-of MEM -ot Float32 -dstnodata nan", " ", 0);
    const char *hole = hole_mark(source);
    if (hole != NULL) {
        words = CSLAddString(words, "-srcnodata");
        words = CSLAddString(words, hole);
    }
    words = CSLAddString(words, "-r");
    words = CSLAddString(words, grid->cell_m > 1.5 * source->native_m ? "average" : "bilinear");
    if (source->local != NULL) {
        words = CSLAddString(words, "-t_srs");
        words = CSLAddString(words, grid->projection);
    }
    const double *t = grid->transform;
    words = CSLAddString(words, "-te");
    words = CSLAddString(words, CPLSPrintf("%.17g", t[0]));
    words = CSLAddString(words, CPLSPrintf("%.17g", t[3] - grid->rows * grid->cell_m));
    words = CSLAddString(words, CPLSPrintf("%.17g", t[0] + grid->columns * grid->cell_m));
    words = CSLAddString(words, CPLSPrintf("%.17g", t[3]));
    words = CSLAddString(words, "-ts");
    words = CSLAddString(words, CPLSPrintf("%d", grid->columns));
    words = CSLAddString(words, CPLSPrintf("%d", grid->rows));
    GDALWarpAppOptions *options = GDALWarpAppOptionsNew(words, NULL);
    CSLDestroy(words);
    int wrong = 0;
    GDALDatasetH from = source->dataset;
    GDALDatasetH result = GDALWarp("", NULL, 1, &from, options, &wrong);
    GDALWarpAppOptionsFree(options);
    return result;
}

/* Marks what is no height as missing and fills it from around, if it is little enough. */
static bool fill_holes(const source_t *source, GDALDatasetH dataset, yb_grid_t *grid,
                       yb_error_t *error)
{
    size_t cells = (size_t)grid->columns * (size_t)grid->rows;
    size_t missing = 0;
    const float mark = -99999.0F;
    for (size_t i = 0; i < cells; i++) {
        float height = grid->height_m[i];
        if (!(height >= lowest_m && height <= highest_m)) {
            grid->height_m[i] = mark;
            missing++;
        }
    }
    grid->holes = (double)missing / (double)cells;
    if (missing == cells)
        return yb_error_set(error, "%s holds no height in the window: all is missing",
                            source->path);
    if (grid->holes > YB_GRID_MOST_HOLES)
        return yb_error_set(error,
                            "%.0f %% of the heights of %s are missing in the window; at most %.0f "
                            "%% can be filled: choose another window",
                            100 * grid->holes, source->path, 100 * YB_GRID_MOST_HOLES);
    if (missing == 0)
        return true;
    GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    char **options = CSLSetNameValue(NULL, "TEMP_FILE_DRIVER", "MEM");
    bool good = GDALSetRasterNoDataValue(band, (double)mark) == CE_None &&
                GDALRasterIO(band, GF_Write, 0, 0, grid->columns, grid->rows, grid->height_m,
                             grid->columns, grid->rows, GDT_Float32, 0, 0) == CE_None &&
                GDALFillNodata(band, NULL, grid->columns + grid->rows, 0, 0, options, NULL, NULL) ==
                    CE_None &&
                GDALRasterIO(band, GF_Read, 0, 0, grid->columns, grid->rows, grid->height_m,
                             grid->columns, grid->rows, GDT_Float32, 0, 0) == CE_None;
    CSLDestroy(options);
    for (size_t i = 0; i < cells && good; i++)
        good = grid->height_m[i] >= lowest_m;
    if (!good)
        return yb_error_set(error, "cannot fill the holes of %s: %s", source->path,
                            CPLGetLastErrorMsg());
    return true;
}

static yb_grid_t *grid_lay(const source_t *source, int most, yb_error_t *error)
{
    double width = source->box[2] - source->box[0];
    double depth = source->box[3] - source->box[1];
    double cell = source->native_m;
    if (fmax(width, depth) > (most + 0.25) * cell)
        cell = fmax(width, depth) / most;
    int columns = (int)lround(width / cell);
    int rows = (int)lround(depth / cell);
    if (columns < FEWEST_CELLS || rows < FEWEST_CELLS) {
        yb_error_set(error, "the window on %s has only %d x %d cells: at least %d x %d are needed",
                     source->path, columns, rows, FEWEST_CELLS, FEWEST_CELLS);
        return NULL;
    }
    yb_grid_t *grid = yb_grid_new(columns, rows, cell);
    if (grid == NULL) {
        yb_error_set(error, "%s: out of memory", source->path);
        return NULL;
    }
    grid->transform[0] = (source->box[0] + source->box[2] - columns * cell) / 2;
    grid->transform[3] = (source->box[1] + source->box[3] + rows * cell) / 2;
    OGRSpatialReferenceH srs = source->local != NULL ? source->local : source->srs;
    if (srs != NULL && OSRExportToWktEx(srs, &grid->projection, NULL) != OGRERR_NONE) {
        CPLFree(grid->projection);
        grid->projection = NULL;
    }
    grid->placed = source->placed;
    return grid;
}

static bool grid_fill(const source_t *source, yb_grid_t *grid, yb_error_t *error)
{
    GDALDatasetH dataset = source_resample(source, grid);
    if (dataset == NULL)
        return yb_error_set(error, "cannot read %s: %s", source->path, CPLGetLastErrorMsg());
    bool good =
        GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Read, 0, 0, grid->columns, grid->rows,
                     grid->height_m, grid->columns, grid->rows, GDT_Float32, 0, 0) == CE_None;
    if (!good)
        yb_error_set(error, "cannot read %s: %s", source->path, CPLGetLastErrorMsg());
    good = good && fill_holes(source, dataset, grid, error);
    GDALClose(dataset);
    if (!good)
        return false;
    yb_grid_measure(grid);
    if (!(grid->high_m > grid->low_m))
        return yb_error_set(error, "%s is flat: all heights of the window are %g m", source->path,
                            (double)grid->low_m);
    return true;
}

yb_grid_t *yb_grid_read(const char *path, const yb_window_t *window, int most, yb_error_t *error)
{
    source_t source = {.path = path};
    yb_grid_t *grid = NULL;
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
    if (CPLGetConfigOption("GDAL_CACHEMAX", NULL) == NULL)
        GDALSetCacheMax64(CACHE_BYTES);
    double cell_m = window->cell_m > 0 ? window->cell_m : YB_GRID_DEFAULT_CELL_M;
    if (source_open(&source, cell_m, error) && source_choose(&source, window, error))
        grid = grid_lay(&source, most, error);
    if (grid != NULL &&
        !(source_thin(&source, grid->cell_m, error) && grid_fill(&source, grid, error))) {
        yb_grid_free(grid);
        grid = NULL;
    }
    if (source.local != NULL)
        OSRDestroySpatialReference(source.local);
    if (source.dataset != NULL)
        GDALClose(source.dataset);
    for (int i = 1; i >= 0; i--)
        if (source.wrapped[i] != NULL)
            GDALClose(source.wrapped[i]);
    CPLPopErrorHandler();
    return grid;
}
