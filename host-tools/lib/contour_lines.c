#include "contour_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_alg.h>
#include <ogr_api.h>

#include "line_cut.h"

yb_lines_t *yb_lines_new(double width_m, double depth_m)
{
    yb_lines_t *lines = calloc(1, sizeof(*lines));
    if (lines != NULL) {
        lines->width_m = width_m;
        lines->depth_m = depth_m;
    }
    return lines;
}

void yb_lines_free(yb_lines_t *lines)
{
    if (lines == NULL)
        return;
    for (int i = 0; i < lines->count; i++)
        free(lines->line[i].place);
    free(lines->line);
    free(lines->origin.projection);
    free(lines->input_system);
    free(lines);
}

bool yb_lines_add(yb_lines_t *lines, double height_m, bool closed, const yb_place_t *place,
                  int count)
{
    if (lines->count == lines->room) {
        int room = lines->room == 0 ? 16 : 2 * lines->room;
        yb_line_t *line = realloc(lines->line, (size_t)room * sizeof(*line));
        if (line == NULL)
            return false;
        lines->line = line;
        lines->room = room;
    }
    yb_place_t *copy = malloc((size_t)count * sizeof(*copy));
    if (copy == NULL)
        return false;
    memcpy(copy, place, (size_t)count * sizeof(*copy));
    lines->line[lines->count++] =
        (yb_line_t){.height_m = height_m, .closed = closed, .count = count, .place = copy};
    return true;
}

double yb_lines_frame_way_m(const yb_lines_t *lines, yb_place_t at)
{
    double width = lines->width_m;
    double depth = lines->depth_m;
    if (at.y_m <= 0)
        return at.x_m;
    if (at.x_m >= width)
        return width + at.y_m;
    if (at.y_m >= depth)
        return 2 * width + depth - at.x_m;
    return 2 * (width + depth) - at.y_m;
}

int yb_lines_corners_back(const yb_lines_t *lines, const yb_line_t *line,
                          yb_place_t corner[YB_FRAME_CORNERS])
{
    double width = lines->width_m;
    double depth = lines->depth_m;
    const yb_place_t all[YB_FRAME_CORNERS] = {{0, 0}, {width, 0}, {width, depth}, {0, depth}};
    const double way[YB_FRAME_CORNERS] = {0, width, width + depth, 2 * width + depth};
    double round = 2 * (width + depth);
    double from = yb_lines_frame_way_m(lines, line->place[line->count - 1]);
    double to = yb_lines_frame_way_m(lines, line->place[0]);
    int count = 0;
    to += to < from ? round : 0;
    for (int i = 0; i < 2 * YB_FRAME_CORNERS; i++) {
        double at = way[i % YB_FRAME_CORNERS] + (i < YB_FRAME_CORNERS ? 0 : round);
        if (at > from && at < to && count < YB_FRAME_CORNERS)
            corner[count++] = all[i % YB_FRAME_CORNERS];
    }
    return count;
}

double yb_line_length_m(const yb_line_t *line)
{
    double length = 0;
    int segments = line->closed ? line->count : line->count - 1;
    for (int i = 0; i < segments; i++) {
        yb_place_t a = line->place[i];
        yb_place_t b = line->place[i + 1 == line->count ? 0 : i + 1];
        length += hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    }
    return length;
}

double yb_line_area_m2(const yb_line_t *line)
{
    if (!line->closed)
        return 0;
    double twice = 0;
    for (int i = 0; i < line->count; i++) {
        yb_place_t a = line->place[i];
        yb_place_t b = line->place[i + 1 == line->count ? 0 : i + 1];
        twice += a.x_m * b.y_m - b.x_m * a.y_m;
    }
    return fabs(twice) / 2;
}

/* The grid as a GDAL dataset whose coordinates are the frame's. */
static GDALDatasetH grid_dataset(const yb_grid_t *grid)
{
    GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("MEM"), "", grid->columns, grid->rows, 1, GDT_Float32, NULL);
    if (dataset == NULL)
        return NULL;
    double half = grid->cell_m / 2;
    double transform[6] = {-half, grid->cell_m, 0, yb_grid_depth_m(grid) + half, 0, -grid->cell_m};
    GDALSetGeoTransform(dataset, transform);
    if (GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Write, 0, 0, grid->columns, grid->rows,
                     grid->height_m, grid->columns, grid->rows, GDT_Float32, 0, 0) != CE_None) {
        GDALClose(dataset);
        return NULL;
    }
    return dataset;
}

/* Traces one height into a multi line string. */
static bool trace_level(GDALDatasetH dataset, OGRLayerH layer, double level_m)
{
    char **options = CSLSetNameValue(NULL, "FIXED_LEVELS", CPLSPrintf("%.17g", level_m));
    CPLErr result =
        GDALContourGenerateEx(GDALGetRasterBand(dataset, 1), layer, options, NULL, NULL);
    CSLDestroy(options);
    return result == CE_None;
}

/* All that the layer holds, as one collection. */
static OGRGeometryH take_all(OGRLayerH layer)
{
    OGRGeometryH all = OGR_G_CreateGeometry(wkbMultiLineString);
    OGR_L_ResetReading(layer);
    OGRFeatureH feature = OGR_L_GetNextFeature(layer);
    while (feature != NULL) {
        OGRGeometryH geometry = OGR_F_StealGeometry(feature);
        if (geometry != NULL)
            OGR_G_AddGeometryDirectly(all, geometry);
        OGR_F_Destroy(feature);
        feature = OGR_L_GetNextFeature(layer);
    }
    return all;
}

static bool lines_trace(yb_lines_t *lines, GDALDatasetH raster, GDALDatasetH vector,
                        const double *level_m, int levels, yb_error_t *error)
{
    double snap_m = 1e-6 * (lines->width_m + lines->depth_m);
    for (int i = 0; i < levels; i++) {
        OGRLayerH layer =
            GDALDatasetCreateLayer(vector, CPLSPrintf("%d", i), NULL, wkbLineString, NULL);
        if (layer == NULL || !trace_level(raster, layer, level_m[i]))
            return yb_error_set(error, "cannot trace contour lines: %s", CPLGetLastErrorMsg());
        OGRGeometryH all = take_all(layer);
        bool good = yb_line_cut(lines, level_m[i], all, snap_m, error);
        OGR_G_DestroyGeometry(all);
        if (!good)
            return false;
    }
    return true;
}

yb_lines_t *yb_lines_from_grid(const yb_grid_t *grid, const double *level_m, int levels,
                               yb_error_t *error)
{
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    GDALDatasetH raster = grid_dataset(grid);
    GDALDatasetH vector = GDALCreate(GDALGetDriverByName("Memory"), "", 0, 0, 0, GDT_Unknown, NULL);
    yb_lines_t *lines = yb_lines_new(yb_grid_width_m(grid), yb_grid_depth_m(grid));
    bool good = raster != NULL && vector != NULL && lines != NULL;
    if (!good)
        yb_error_set(error, "cannot trace contour lines: out of memory");
    good = good && lines_trace(lines, raster, vector, level_m, levels, error);
    if (raster != NULL)
        GDALClose(raster);
    if (vector != NULL)
        GDALClose(vector);
    CPLPopErrorHandler();
    if (!good) {
        yb_lines_free(lines);
        return NULL;
    }
    return lines;
}
