/* Rasters and lines in files of GDAL. */
#define _XOPEN_SOURCE 700
#include "codes.h"
#include "geofile.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <gdal.h>
#include <ogr_api.h>

static char directory[] = "yamabiko-test-XXXXXX";
static char path[sizeof(directory) + 64];

static int make_directory(void **state)
{
    (void)state;
    return mkdtemp(directory) == NULL;
}

static int remove_directory(void **state)
{
    (void)state;
    return rmdir(directory);
}

static const char *in_directory(const char *name)
{
    snprintf(path, sizeof(path), "%s/%s", directory, name);
    return path;
}

static int files_left(void)
{
    int count = 0;
    DIR *entries = opendir(directory);
    assert_non_null(entries);
    for (struct dirent *entry = readdir(entries); entry != NULL; entry = readdir(entries))
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(entries);
    return count;
}

static const yb_raster_t raster = {
    .columns = 3, .rows = 2, .cell_m = 10, .west_m = -5, .south_m = -5};
static const float heights[] = {1, 2, 3, 4, 5, 6.5F};

static void rasters_come_back(void **state)
{
    static const char *const names[] = {"a.tif", "b.asc"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        yb_error_t error = {""};
        double transform[6];
        float row[3];
        if (!yb_geofile_write_raster(in_directory(names[i]), false, &raster, heights, NULL, &error))
            fail_msg("%s", error.text);
        GDALDatasetH dataset = GDALOpen(path, GA_ReadOnly);
        assert_non_null(dataset);
        assert_int_equal(GDALGetRasterXSize(dataset), 3);
        assert_int_equal(GDALGetGeoTransform(dataset, transform), CE_None);
        assert_true(transform[0] == -5 && transform[3] == 15 && transform[5] == -10);
        GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
        assert_int_equal(GDALRasterIO(band, GF_Read, 0, 0, 3, 1, row, 3, 1, GDT_Float32, 0, 0),
                         CE_None);
        assert_true(row[0] == 4 && row[2] == 6.5F);
        GDALClose(dataset);
        assert_int_equal(files_left(), 1);
        /* Nothing is overwritten unasked. */
        assert_false(yb_geofile_write_raster(path, false, &raster, heights, NULL, &error));
        assert_non_null(strstr(error.text, "--force"));
        assert_true(yb_geofile_write_raster(path, true, &raster, heights, NULL, &error));
        unlink(path);
    }
}

static void lines_come_back(void **state)
{
    static const char *const names[] = {"a.geojson", "b.gpkg"};
    yb_point2_t ring[] = {{0, 0}, {10, 0}, {10, 10}}, open[] = {{0, 5}, {20, 6}};
    yb_isoline_t list[] = {{.point = ring, .count = 3, .height_m = 100, .closed = true},
                           {.point = open, .count = 2, .height_m = 150.5}};
    const yb_isolines_t lines = {list, 2};
    (void)state;
    for (int i = 0; i < 2; i++) {
        yb_error_t error = {""};
        if (!yb_geofile_write_lines(in_directory(names[i]), false, &lines, NULL, &error))
            fail_msg("%s", error.text);
        GDALDatasetH dataset = GDALOpenEx(path, GDAL_OF_VECTOR, NULL, NULL, NULL);
        assert_non_null(dataset);
        OGRLayerH layer = GDALDatasetGetLayer(dataset, 0);
        assert_int_equal(OGR_L_GetFeatureCount(layer, TRUE), 2);
        OGRFeatureH first = OGR_L_GetNextFeature(layer), second = OGR_L_GetNextFeature(layer);
        assert_int_equal(OGR_G_GetPointCount(OGR_F_GetGeometryRef(first)), 4);
        assert_int_equal(OGR_G_GetPointCount(OGR_F_GetGeometryRef(second)), 2);
        assert_true(OGR_F_GetFieldAsDouble(second, OGR_F_GetFieldIndex(second, "elevation")) ==
                    150.5);
        OGR_F_Destroy(first);
        OGR_F_Destroy(second);
        GDALClose(dataset);
        assert_int_equal(files_left(), 1);
        unlink(path);
    }
}

static void what_cannot_be_written_leaves_nothing(void **state)
{
    static const char *const rasters[] = {"a", "a.nosuch", "no/a.tif", "a.png", "a.geojson"};
    static const char *const vectors[] = {"a", "a.nosuch", "no/a.geojson", "a.shp", "a.tif"};
    yb_point2_t open[] = {{0, 5}, {20, 6}};
    yb_isoline_t line = {.point = open, .count = 2};
    const yb_isolines_t lines = {&line, 1};
    (void)state;
    for (size_t i = 0; i < sizeof(rasters) / sizeof(rasters[0]); i++) {
        yb_error_t error = {""};
        if (yb_geofile_write_raster(in_directory(rasters[i]), false, &raster, heights, NULL,
                                    &error))
            fail_msg("%s was written", path);
        assert_non_null(strstr(error.text, rasters[i]));
        assert_int_equal(files_left(), 0);
        if (yb_geofile_write_lines(in_directory(vectors[i]), false, &lines, NULL, &error))
            fail_msg("%s was written", path);
        assert_non_null(strstr(error.text, vectors[i]));
        assert_int_equal(files_left(), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rasters_come_back),
        cmocka_unit_test(lines_come_back),
        cmocka_unit_test(what_cannot_be_written_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
