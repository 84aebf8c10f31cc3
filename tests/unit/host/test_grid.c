/* Grids from rasters of every kind. */
#include "grid.h"
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>
#include <sys/resource.h>
#include <time.h>

#include <cpl_string.h>
#include <gdal.h>
#include <ogr_srs_api.h>

static yb_grid_t *read_all(const char *path, yb_error_t *error)
{
    yb_window_t window = {.kind = YB_WINDOW_WHOLE};
    return yb_grid_read(path, &window, 256, error);
}

static void test_cells_as_they_are(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("cone.tif");
    scratch_raster(path, 64, 48, relief_cone);
    yb_grid_t *grid = read_all(path, &error);
    assert_non_null(grid);
    assert_int_equal(grid->columns, 64);
    assert_int_equal(grid->rows, 48);
    assert_true(fabs(grid->cell_m - 30) < 1e-9);
    assert_true(grid->placed);
    assert_non_null(grid->projection);
    assert_true(grid->holes == 0);
    for (int row = 0; row < 48; row++)
        for (int column = 0; column < 64; column++) {
            double truth = relief_cone(column / 63.0, (47 - row) / 47.0);
            assert_true(fabs((double)grid->height_m[row * 64 + column] - truth) < 0.01);
        }
    /* The frame's corners are the centres of the outer cells. */
    assert_true(fabs(yb_grid_height(grid, 0, 0) - relief_cone(0, 0)) < 0.01);
    assert_true(fabs(yb_grid_height(grid, 63 * 30, 47 * 30) - relief_cone(1, 1)) < 0.01);
    assert_true(fabs(yb_grid_height(grid, 1e9, -1e9) - relief_cone(1, 0)) < 0.01);
    yb_grid_free(grid);
}

static void test_coarser(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("big.tif");
    scratch_raster(path, 600, 300, relief_range);
    yb_grid_t *grid = read_all(path, &error);
    assert_non_null(grid);
    assert_int_equal(grid->columns, 256);
    assert_int_equal(grid->rows, 128);
    assert_true(fabs(grid->cell_m * 256 - 600 * 30) < 0.01);
    assert_true(fabs(yb_grid_height(grid, yb_grid_width_m(grid) / 2, yb_grid_depth_m(grid) / 2) -
                     relief_range(0.5, 0.5)) < 5);
    yb_grid_free(grid);
}

static void test_window(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("window.tif");
    scratch_raster(path, 64, 64, relief_cone);
    yb_window_t window = {.kind = YB_WINDOW_BOX, .box = {500300, 5000300, 500900, 5000600}};
    yb_grid_t *grid = yb_grid_read(path, &window, 256, &error);
    assert_non_null(grid);
    assert_int_equal(grid->columns, 20);
    assert_int_equal(grid->rows, 10);
    assert_true(fabs(yb_grid_height(grid, 0, 0) - relief_cone(10 / 63.0, 10 / 63.0)) < 0.01);
    yb_grid_free(grid);
    window.box[0] = 0;
    assert_null(yb_grid_read(path, &window, 256, &error));
    assert_non_null(strstr(error.text, "reaches out of"));
    window = (yb_window_t){.kind = YB_WINDOW_BOX, .box = {500300, 5000300, 500360, 5000360}};
    assert_null(yb_grid_read(path, &window, 256, &error));
    assert_non_null(strstr(error.text, "only 2 x 2 cells"));
}

static void test_degrees(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("degrees.tif");
    scratch_raster_degrees(path, 200, 200, relief_cone);
    yb_grid_t *grid = read_all(path, &error);
    assert_non_null(grid);
    /* One arc second at 46 N: 30.9 m to the north, 21.5 m to the east. */
    assert_true(fabs(yb_grid_depth_m(grid) - 199 * 30.9) < 60);
    assert_true(fabs(yb_grid_width_m(grid) - 199 * 21.5) < 60);
    assert_true(fabs(yb_grid_height(grid, yb_grid_width_m(grid) / 2, yb_grid_depth_m(grid) / 2) -
                     1000) < 15);
    yb_grid_free(grid);
    yb_window_t window = {
        .kind = YB_WINDOW_CENTER, .lon_deg = 9.0278, .lat_deg = 46.0278, .side_m = 2000};
    grid = yb_grid_read(path, &window, 256, &error);
    assert_non_null(grid);
    assert_int_equal(grid->columns, grid->rows);
    assert_true(fabs(grid->columns * grid->cell_m - 2000) < 30);
    assert_true(fabs(yb_grid_height(grid, 1000, 1000) - 1000) < 20);
    yb_grid_free(grid);
    window.lon_deg = 20;
    assert_null(yb_grid_read(path, &window, 256, &error));
    assert_non_null(strstr(error.text, "does not lie on"));
}

static double relief_with_hole(double east, double north)
{
    return hypot(east - 0.5, north - 0.5) < 0.2 ? (double)NAN : relief_range(east, north);
}

static double relief_mostly_hole(double east, double north)
{
    return east > 0.5 ? (double)NAN : relief_range(east, north);
}

static double relief_nothing(double east, double north)
{
    (void)east;
    (void)north;
    return (double)NAN;
}

static void test_holes(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("holes.tif");
    scratch_raster(path, 64, 64, relief_with_hole);
    yb_grid_t *grid = read_all(path, &error);
    assert_non_null(grid);
    assert_true(grid->holes > 0.1 && grid->holes < 0.15);
    for (int i = 0; i < 64 * 64; i++)
        assert_true(grid->height_m[i] > 0 && grid->height_m[i] < 2000);
    yb_grid_free(grid);
    scratch_raster(path, 64, 64, relief_mostly_hole);
    assert_null(read_all(path, &error));
    assert_non_null(strstr(error.text, "50 %"));
    scratch_raster(path, 64, 64, relief_nothing);
    assert_null(read_all(path, &error));
    assert_non_null(strstr(error.text, "all is missing"));
}

/* A cell in 97 is none of the numbers that heights can be. */
static double relief_with_no_numbers(double east, double north)
{
    static const double none[] = {(double)INFINITY, -(double)INFINITY, (double)NAN, 1e30, -1e30};
    int column = (int)lround(east * 255);
    int row = (int)lround(north * 255);
    int i = row * 256 + column;
    return i % 97 == 0 ? none[i / 97 % 5] : relief_range(east, north);
}

static void test_no_numbers_are_holes(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("numbers.tif");
    for (int coarse = 0; coarse < 2; coarse++) {
        scratch_raster(path, 256, 256, relief_with_no_numbers);
        yb_window_t window = {.kind = YB_WINDOW_WHOLE};
        yb_grid_t *grid = yb_grid_read(path, &window, coarse ? 100 : 256, &error);
        if (grid == NULL)
            fail_msg("%s", error.text);
        assert_true(grid->holes > 0.01 && grid->holes < 0.2);
        for (int i = 0; i < grid->columns * grid->rows; i++)
            assert_true(grid->height_m[i] > 200 && grid->height_m[i] < 2000);
        yb_grid_free(grid);
    }
}

static void test_without_place(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("bare.png");
    scratch_raster_bare(path, 50, 40, relief_range);
    yb_grid_t *grid = read_all(path, &error);
    assert_non_null(grid);
    assert_false(grid->placed);
    assert_true(grid->cell_m == YB_GRID_DEFAULT_CELL_M);
    yb_grid_free(grid);
    yb_window_t window = {.cell_m = 12.5};
    grid = yb_grid_read(path, &window, 256, &error);
    assert_non_null(grid);
    assert_true(fabs(grid->cell_m - 12.5) < 1e-9);
    yb_grid_free(grid);
    window.kind = YB_WINDOW_CENTER;
    assert_null(yb_grid_read(path, &window, 256, &error));
    assert_non_null(strstr(error.text, "where on earth"));
}

/* A GeoTIFF of one type of number, of a relief as large as it is wide, laid by a geotransform. */
static void write_typed(const char *path, int columns, int rows, GDALDataType type,
                        const double transform[6], relief_fn relief)
{
    GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("GTiff"), path, columns, rows, 1, type, NULL);
    assert_non_null(dataset);
    double laid[6];
    memcpy(laid, transform, sizeof(laid));
    assert_int_equal(GDALSetGeoTransform(dataset, laid), CE_None);
    OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRImportFromEPSG(srs, 32632), OGRERR_NONE);
    assert_int_equal(GDALSetSpatialRef(dataset, srs), CE_None);
    OSRDestroySpatialReference(srs);
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            float cell = (float)relief((column + 0.5) / columns, 1 - (row + 0.5) / rows);
            assert_int_equal(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Write, column, row, 1,
                                          1, &cell, 1, 1, GDT_Float32, 0, 0),
                             CE_None);
        }
    GDALClose(dataset);
}

/* Round 500000, 5000000, cells of 10 m, turned to the left by an angle. */
static void turned(double transform[6], int cells, double degrees)
{
    double along_x = 10 * cos(degrees * acos(-1) / 180);
    double along_y = 10 * sin(degrees * acos(-1) / 180);
    double half = cells / 2.0;
    const double result[6] = {500000 - half * along_x - half * along_y,  along_x, along_y,
                              5000000 - half * along_y + half * along_x, along_y, -along_x};
    memcpy(transform, result, sizeof(result));
}

/* Rises to the east of the raster, by 1000 m from side to side. */
static double relief_ramp(double east, double north)
{
    (void)north;
    return 1000 * east;
}

static void test_turned_rasters(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("turned.tif");
    double transform[6];
    const double degrees[] = {0, 5, 30, 90, 180, -60};
    for (size_t i = 0; i < sizeof(degrees) / sizeof(degrees[0]); i++) {
        turned(transform, 64, degrees[i]);
        write_typed(path, 64, 64, GDT_Float32, transform, relief_ramp);
        const yb_window_t windows[] = {
            {.kind = YB_WINDOW_BOX, .box = {499900, 4999900, 500100, 5000100}},
            {.kind = YB_WINDOW_CENTER, .lon_deg = 9, .lat_deg = 45.153399, .side_m = 200}};
        for (int k = 0; k < 2; k++) {
            yb_grid_t *grid = yb_grid_read(path, &windows[k], 256, &error);
            if (grid == NULL)
                fail_msg("%g degrees: %s", degrees[i], error.text);
            assert_int_equal(grid->columns, 20);
            double turn = degrees[i] * acos(-1) / 180;
            double rise_east = yb_grid_height(grid, 150, 95) - yb_grid_height(grid, 40, 95);
            double rise_north = yb_grid_height(grid, 95, 150) - yb_grid_height(grid, 95, 40);
            assert_true(fabs(rise_east / 110 - 1000 / 640.0 * cos(turn)) < 0.02);
            assert_true(fabs(rise_north / 110 - 1000 / 640.0 * sin(turn)) < 0.02);
            yb_grid_free(grid);
        }
    }
    turned(transform, 64, 30);
    write_typed(path, 64, 64, GDT_Float32, transform, relief_ramp);
    assert_null(read_all(path, &error));
    assert_non_null(strstr(error.text, "are missing in the window"));
    const double southwards[6] = {500000, 10, 0, 5000000, 0, 10};
    write_typed(path, 64, 64, GDT_Float32, southwards, relief_range);
    yb_grid_t *grid = read_all(path, &error);
    assert_non_null(grid);
    assert_true(fabs(yb_grid_height(grid, 300, 0) - relief_range(0.476, 1)) < 10);
    yb_grid_free(grid);
}

static double relief_byte(double east, double north)
{
    return 255 * east * north;
}

static void test_types_of_numbers(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("typed.tif");
    const double transform[6] = {500000, 30, 0, 5000960, 0, -30};
    const GDALDataType good[] = {GDT_Byte,  GDT_UInt16,  GDT_Int16,  GDT_UInt32,
                                 GDT_Int32, GDT_Float32, GDT_Float64};
    for (size_t i = 0; i < sizeof(good) / sizeof(good[0]); i++) {
        write_typed(path, 32, 32, good[i], transform, relief_byte);
        yb_grid_t *grid = read_all(path, &error);
        assert_non_null(grid);
        assert_true(grid->high_m > 230 && grid->high_m < 256);
        yb_grid_free(grid);
    }
    const GDALDataType bad[] = {GDT_CInt16, GDT_CInt32, GDT_CFloat32, GDT_CFloat64};
    for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
        write_typed(path, 32, 32, bad[i], transform, relief_byte);
        assert_null(read_all(path, &error));
        assert_non_null(strstr(error.text, "holds complex numbers, not heights"));
    }
}

static double relief_voids(double east, double north)
{
    return fmod(east * 50, 1) < 0.1 ? -32768 : relief_range(east, north);
}

/* Voids as the first data of the space shuttle had them, marked by nothing but their number. */
static void test_unmarked_voids(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("voids.tif");
    const double transform[6] = {500000, 30, 0, 5006000, 0, -30};
    write_typed(path, 200, 200, GDT_Int16, transform, relief_voids);
    yb_window_t window = {.kind = YB_WINDOW_WHOLE};
    yb_grid_t *grid = yb_grid_read(path, &window, 60, &error);
    assert_non_null(grid);
    assert_true(grid->low_m > 200 && grid->high_m < 2000);
    yb_grid_free(grid);
}

static void test_thin_rasters(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("thin.tif");
    const double transform[6] = {500000, 30, 0, 5000960, 0, -30};
    const int sizes[][2] = {{1, 1}, {1, 500}, {500, 1}, {7, 100}, {100, 7}};
    for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); i++) {
        write_typed(path, sizes[i][0], sizes[i][1], GDT_Float32, transform, relief_range);
        assert_null(read_all(path, &error));
        char sentence[80];
        snprintf(sentence, sizeof(sentence), "has only %d x %d cells: at least 8 x 8 are needed",
                 sizes[i][0], sizes[i][1]);
        assert_non_null(strstr(error.text, sentence));
    }
}

/* The sanitizers need a multiple of it. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MOST_MB 1000
#endif
#endif
#ifndef MOST_MB
#define MOST_MB 200
#endif

enum {
    HUGE_SIDE = 40000,
    PEAK_SIDE = 2560
};

/* A raster of 1.6 billion cells, nearly all of them in no block of the file; a peak in the middle.
 */
static void write_huge(const char *path)
{
    char **options = CSLSetNameValue(NULL, "SPARSE_OK", "TRUE");
    options = CSLSetNameValue(options, "TILED", "YES");
    options = CSLSetNameValue(options, "COMPRESS", "LZW");
    GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GTiff"), path, HUGE_SIDE, HUGE_SIDE, 1,
                                      GDT_Float32, options);
    CSLDestroy(options);
    assert_non_null(dataset);
    double transform[6] = {500000, 1, 0, 5000000 + HUGE_SIDE, 0, -1};
    assert_int_equal(GDALSetGeoTransform(dataset, transform), CE_None);
    float *row = malloc(PEAK_SIDE * sizeof(*row));
    assert_non_null(row);
    for (int y = 0; y < PEAK_SIDE; y++) {
        for (int x = 0; x < PEAK_SIDE; x++)
            row[x] = (float)(PEAK_SIDE / 2 - (abs(x - PEAK_SIDE / 2) > abs(y - PEAK_SIDE / 2)
                                                  ? abs(x - PEAK_SIDE / 2)
                                                  : abs(y - PEAK_SIDE / 2)));
        int corner = (HUGE_SIDE - PEAK_SIDE) / 2;
        assert_int_equal(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Write, corner, corner + y,
                                      PEAK_SIDE, 1, row, PEAK_SIDE, 1, GDT_Float32, 0, 0),
                         CE_None);
    }
    free(row);
    GDALClose(dataset);
}

static void test_huge_raster(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("huge.tif");
    write_huge(path);
    clock_t begun = clock();
    yb_grid_t *grid = read_all(path, &error);
    double seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
    if (grid == NULL)
        fail_msg("%s", error.text);
    assert_int_equal(grid->columns, 256);
    assert_int_equal(grid->rows, 256);
    /* The mean of a cell at the top of a pyramid, and below. */
    double middle = yb_grid_width_m(grid) / 2;
    assert_true(fabs(yb_grid_height(grid, middle, middle) - 1176) < 20);
    assert_true(fabs(yb_grid_height(grid, middle + 800, middle) - 480) < 20);
    assert_true(grid->low_m == 0);
    yb_grid_free(grid);
    struct rusage usage;
    assert_int_equal(getrusage(RUSAGE_SELF, &usage), 0);
    print_message("%.1f s of the processor, %ld MB at most\n", seconds, usage.ru_maxrss / 1024);
    assert_true(seconds < 20);
    assert_true(usage.ru_maxrss / 1024 < MOST_MB);
}

static void test_refused(void **state)
{
    (void)state;
    yb_error_t error;
    assert_null(read_all(scratch_path("none.tif"), &error));
    assert_non_null(strstr(error.text, "No such file"));
    const char *path = scratch_path("text.txt");
    scratch_text(path, "no raster\n");
    assert_null(read_all(path, &error));
    assert_non_null(strstr(error.text, "no raster that GDAL can read"));
    path = scratch_path("flat.tif");
    scratch_raster(path, 32, 32, relief_flat);
    assert_null(read_all(path, &error));
    assert_non_null(strstr(error.text, "is flat"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cells_as_they_are),
        cmocka_unit_test(test_coarser),
        cmocka_unit_test(test_window),
        cmocka_unit_test(test_degrees),
        cmocka_unit_test(test_holes),
        cmocka_unit_test(test_no_numbers_are_holes),
        cmocka_unit_test(test_without_place),
        cmocka_unit_test(test_turned_rasters),
        cmocka_unit_test(test_types_of_numbers),
        cmocka_unit_test(test_unmarked_voids),
        cmocka_unit_test(test_thin_rasters),
        cmocka_unit_test(test_huge_raster),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
