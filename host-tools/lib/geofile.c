#include "geofile.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include "output.h"

static bool has_extension(GDALDriverH driver, const char *extension)
{
    const char *known = GDALGetMetadataItem(driver, GDAL_DMD_EXTENSIONS, NULL);
    char **list = CSLTokenizeString2(known != NULL ? known : "", " ", 0);
    const bool found = CSLFindString(list, extension) >= 0;
    CSLDestroy(list);
    return found;
}

static bool can(GDALDriverH driver, const char *capability)
{
    const char *value = GDALGetMetadataItem(driver, capability, NULL);
    return value != NULL && strcmp(value, "YES") == 0;
}

/* The first driver that writes files with the path's ending. */
static GDALDriverH driver_for(const char *path, bool lines, yb_error_t *error)
{
    GDALAllRegister();
    if (strcmp(path, "-") == 0)
        return GDALGetDriverByName(lines ? "GeoJSON" : "GTiff");
    const char *extension = CPLGetExtension(path);
    for (int i = 0; *extension != '\0' && i < GDALGetDriverCount(); i++) {
        GDALDriverH driver = GDALGetDriver(i);
        const bool fits =
            lines ? can(driver, GDAL_DCAP_VECTOR) && can(driver, GDAL_DCAP_CREATE)
                  : can(driver, GDAL_DCAP_RASTER) &&
                        (can(driver, GDAL_DCAP_CREATE) || can(driver, GDAL_DCAP_CREATECOPY));
        if (fits && has_extension(driver, extension))
            return driver;
    }
    yb_error_set(error,
                 "cannot write %s: GDAL knows no format of %s by its ending; %s is always good",
                 path, lines ? "lines" : "rasters", lines ? ".geojson" : ".tif");
    return NULL;
}

static bool gdal_failed(const char *path, yb_error_t *error)
{
    const char *why = CPLGetLastErrorMsg();
    return yb_error_set(error, "cannot write %s: %s", path,
                        *why != '\0' ? why : "GDAL does not say why");
}

/* The commit moves one file: a format that needs more would arrive broken. */
static bool is_one_file(const char *written, const char *path, yb_error_t *error)
{
    GDALDatasetH dataset = GDALOpenEx(written, GDAL_OF_READONLY, NULL, NULL, NULL);
    char **files = dataset != NULL ? GDALGetFileList(dataset) : NULL;
    const int count = CSLCount(files);
    CSLDestroy(files);
    if (dataset != NULL)
        GDALClose(dataset);
    return count <= 1 ||
           yb_error_set(error,
                        "cannot write %s: this format is a bundle of %d files; choose one "
                        "that is a single file",
                        path, count);
}

typedef bool (*write_fn)(GDALDriverH driver, const char *path, const void *what);

/* Writes beside the target by `write`, then moves it there. */
static bool write_file(const char *path, bool force, bool lines, write_fn write, const void *what,
                       yb_error_t *error)
{
    GDALDriverH driver = driver_for(path, lines, error);
    if (driver == NULL)
        return false;
    yb_output_t *output = yb_output_open(path, force, error);
    if (output == NULL)
        return false;
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO");
    CPLErrorReset();
    bool good = write(driver, yb_output_path(output), what) || gdal_failed(path, error);
    good = good && is_one_file(yb_output_path(output), path, error);
    CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", NULL);
    CPLPopErrorHandler();
    good = good && yb_output_commit(output, error);
    yb_output_close(output);
    return good;
}

/* The system of the coordinates written; without one some formats assume degrees. */
static OGRSpatialReferenceH system_of(const yb_origin_t *origin)
{
    OGRSpatialReferenceH srs = OSRNewSpatialReference(origin->projection);
    if (origin->projection == NULL) {
        OSRSetLocalCS(srs, "metres from the south-west corner");
        OSRSetLinearUnits(srs, SRS_UL_METER, 1);
    }
    return srs;
}

static const yb_origin_t nowhere = {0};

typedef struct {
    const yb_raster_t *raster;
    const float *z_m;
    const yb_origin_t *origin;
} heights_t;

static bool write_heights(GDALDriverH driver, const char *path, const void *what)
{
    const heights_t *heights = what;
    const yb_raster_t *raster = heights->raster;
    const int columns = (int)raster->columns, rows = (int)raster->rows;
    GDALDatasetH memory =
        GDALCreate(GDALGetDriverByName("MEM"), "", columns, rows, 1, GDT_Float32, NULL);
    if (memory == NULL)
        return false;
    const yb_origin_t *origin = heights->origin;
    double transform[6] = {origin->west_m + raster->west_m,
                           raster->cell_m,
                           0,
                           origin->south_m + raster->south_m + rows * raster->cell_m,
                           0,
                           -raster->cell_m};
    bool good = GDALSetGeoTransform(memory, transform) == CE_None;
    if (origin->projection != NULL)
        good = good && GDALSetProjection(memory, origin->projection) == CE_None;
    GDALRasterBandH band = GDALGetRasterBand(memory, 1);
    for (int j = 0; good && j < rows; j++) {
        /* GDAL reads from the buffer, but its signature cannot say so. */
        float *row = (float *)(uintptr_t)(heights->z_m + (size_t)(rows - 1 - j) * (size_t)columns);
        good = GDALRasterIO(band, GF_Write, 0, j, columns, 1, row, columns, 1, GDT_Float32, 0, 0) ==
               CE_None;
    }
    GDALDatasetH copy = good ? GDALCreateCopy(driver, path, memory, TRUE, NULL, NULL, NULL) : NULL;
    good = copy != NULL;
    if (copy != NULL) {
        GDALClose(copy);
        good = CPLGetLastErrorType() < CE_Failure;
    }
    GDALClose(memory);
    return good;
}

bool yb_geofile_write_raster(const char *path, bool force, const yb_raster_t *raster,
                             const float *z_m, const yb_origin_t *origin, yb_error_t *error)
{
    const heights_t heights = {raster, z_m, origin != NULL ? origin : &nowhere};
    return write_file(path, force, false, write_heights, &heights, error);
}

typedef struct {
    const yb_isolines_t *lines;
    const yb_origin_t *origin;
} placed_lines_t;

static bool write_line(OGRLayerH layer, const yb_isoline_t *line, const yb_origin_t *origin)
{
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    OGRGeometryH geometry = OGR_G_CreateGeometry(wkbLineString);
    for (size_t i = 0; i < line->count; i++)
        OGR_G_AddPoint_2D(geometry, origin->west_m + line->point[i].x,
                          origin->south_m + line->point[i].y);
    if (line->closed)
        OGR_G_AddPoint_2D(geometry, origin->west_m + line->point[0].x,
                          origin->south_m + line->point[0].y);
    OGR_F_SetFieldDouble(feature, 0, line->height_m);
    const bool good = OGR_F_SetGeometryDirectly(feature, geometry) == OGRERR_NONE &&
                      OGR_L_CreateFeature(layer, feature) == OGRERR_NONE;
    OGR_F_Destroy(feature);
    return good;
}

static bool write_lines(GDALDriverH driver, const char *path, const void *what)
{
    const placed_lines_t *placed = what;
    const yb_isolines_t *lines = placed->lines;
    GDALDatasetH dataset = GDALCreate(driver, path, 0, 0, 0, GDT_Unknown, NULL);
    if (dataset == NULL)
        return false;
    OGRSpatialReferenceH metres = system_of(placed->origin);
    /* GeoJSON can name a system by its number only: what has none is written in degrees. */
    bool nameless = placed->origin->projection != NULL && OSRGetAuthorityCode(metres, NULL) == NULL;
    char **options = nameless && EQUAL(GDALGetDriverShortName(driver), "GeoJSON")
                         ? CSLSetNameValue(NULL, "RFC7946", "YES")
                         : NULL;
    OGRLayerH layer = GDALDatasetCreateLayer(dataset, "contours", metres, wkbLineString, options);
    CSLDestroy(options);
    OSRRelease(metres);
    OGRFieldDefnH field = OGR_Fld_Create("elevation", OFTReal);
    bool good = layer != NULL && OGR_L_CreateField(layer, field, TRUE) == OGRERR_NONE;
    OGR_Fld_Destroy(field);
    for (size_t i = 0; good && i < lines->count; i++)
        good = write_line(layer, &lines->line[i], placed->origin);
    GDALClose(dataset);
    return good && CPLGetLastErrorType() < CE_Failure;
}

bool yb_geofile_write_lines(const char *path, bool force, const yb_isolines_t *lines,
                            const yb_origin_t *origin, yb_error_t *error)
{
    const placed_lines_t placed = {lines, origin != NULL ? origin : &nowhere};
    return write_file(path, force, true, write_lines, &placed, error);
}
