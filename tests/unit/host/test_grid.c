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
        cmocka_unit_test(test_without_place),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
