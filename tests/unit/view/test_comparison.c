/* A code beside a relief: a relief that is the code's own, and one that is not. */
#include "codes.h"
#include "comparison.h"
#include "fidelity.h"
#include "sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The map's own reference surface as if it had been read from a file, `lift_m` too high. */
static yb_grid_t *own_grid(const yb_map_t *map, float lift_m)
{
    const uint32_t longer =
        (map->east_q8 > map->north_q8 ? map->east_q8 : map->north_q8) / 256u + 1;
    const yb_raster_t raster = yb_raster_on_map(map, longer);
    float *z_m = yb_raster_heights(map, &raster);
    yb_grid_t *grid = yb_grid_new((int)raster.columns, (int)raster.rows, raster.cell_m);
    assert_non_null(z_m);
    assert_non_null(grid);
    for (uint32_t j = 0; j < raster.rows; j++) {
        for (uint32_t i = 0; i < raster.columns; i++)
            grid->height_m[j * raster.columns + i] =
                z_m[(raster.rows - 1 - j) * raster.columns + i] + lift_m;
    }
    grid->placed = true;
    yb_grid_measure(grid);
    free(z_m);
    return grid;
}

static void measure(yb_code_file_t *file, const yb_grid_t *grid, yb_comparison_t *comparison,
                    yb_fidelity_t *fidelity)
{
    yb_error_t error = {""};
    if (!yb_comparison_make(comparison, file, grid, NULL, &error))
        fail_msg("%s", error.text);
    assert_true(yb_fidelity_measure(fidelity, file, comparison));
}

static void a_map_is_faithful_to_itself(void **state)
{
    (void)state;
    yb_code_file_t *files[] = {code_hill(), code_slope()};
    for (int i = 0; i < 2; i++) {
        yb_grid_t *grid = own_grid(&files[i]->map, 0);
        yb_comparison_t comparison;
        yb_fidelity_t fidelity;
        measure(files[i], grid, &comparison, &fidelity);
        assert_true(fidelity.detail.rmse_m < 1e-3);
        assert_true(fidelity.detail.max_m < 1e-3);
        assert_true(fidelity.detail.slope_deg < 1e-3);
        /* The lattice and the mesh cut the same surface into other triangles. */
        assert_true(fidelity.k > 0.95);
        assert_true(fidelity.k <= 1);
        assert_true(fidelity.detail_spectrum < 1e-6);
        yb_fidelity_free(&fidelity);
        yb_comparison_free(&comparison);
        yb_grid_free(grid);
        yb_code_file_free(files[i]);
    }
}

static void a_lift_is_measured(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    yb_grid_t *grid = own_grid(&file->map, 25);
    yb_comparison_t comparison;
    yb_fidelity_t fidelity;
    measure(file, grid, &comparison, &fidelity);
    assert_true(fabs(fidelity.smooth.rmse_m - 25) < 1e-3);
    assert_true(fabs(fidelity.smooth.p90_m - 25) < 1e-3);
    assert_true(fabs(fidelity.smooth.nrmse - 25 / grid->std_m) < 1e-6);
    assert_true(fidelity.smooth.slope_deg < 1e-3);
    assert_int_equal(fidelity.points, 13);
    assert_int_equal(fidelity.contours, 3);
    assert_int_equal(fidelity.body_bits, 12 * 13 + 20 * 3 + 8);
    assert_int_equal(fidelity.bytes, file->size);
    assert_int_equal(fidelity.contour_count, 2);
    assert_true(fidelity.k < 1);

    json_t *json = yb_fidelity_json(&fidelity);
    assert_non_null(json);
    assert_int_equal(json_array_size(json_object_get(json, "contour")), 2);
    assert_true(json_number_value(json_object_get(json, "k")) == fidelity.k);
    json_decref(json);
    yb_fidelity_free(&fidelity);
    yb_comparison_free(&comparison);
    yb_grid_free(grid);
    yb_code_file_free(file);
}

/* Given lines: the code's own polygons, in a frame of another scale; and one of another height. */
static void given_lines_are_the_originals(void **state)
{
    static const yb_place_t outer[] = {{28, 28},   {128, 20},  {228, 28}, {232, 128},
                                       {228, 228}, {128, 236}, {28, 228}, {20, 128}};
    static const yb_place_t inner[] = {{104, 104}, {152, 104}, {152, 152}, {104, 152}};
    (void)state;
    yb_code_file_t *file = code_hill();
    yb_grid_t *grid = own_grid(&file->map, 0);
    yb_lines_t *lines = yb_lines_new(255, 255);
    yb_comparison_t comparison;
    yb_fidelity_t fidelity;
    yb_error_t error = {""};
    assert_true(yb_lines_add(lines, 200, true, outer, 8));
    assert_true(yb_lines_add(lines, 650, true, inner, 4));
    assert_true(yb_comparison_make(&comparison, file, grid, lines, &error));
    assert_true(yb_fidelity_measure(&fidelity, file, &comparison));
    assert_int_equal(comparison.original.count, 1);
    assert_true(fabs(comparison.original.line[0].point[0].x - 28 * 30) < 1e-6);
    assert_true(fidelity.contour[0].similarity.k > 0.7);
    assert_true(fidelity.contour[1].similarity.k == 0);
    assert_true(fidelity.contour[1].similarity.original == YB_NO_LINE);
    yb_fidelity_free(&fidelity);
    yb_comparison_free(&comparison);
    yb_lines_free(lines);
    yb_grid_free(grid);
    yb_code_file_free(file);
}

static void another_frame_is_refused(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    yb_comparison_t comparison;
    yb_error_t error = {""};
    yb_grid_t *wide = yb_grid_new(256, 200, 30);
    assert_false(yb_comparison_make(&comparison, file, wide, NULL, &error));
    assert_non_null(strstr(error.text, "--window"));
    yb_grid_t *large = yb_grid_new(256, 256, 35);
    large->placed = true;
    assert_false(yb_comparison_make(&comparison, file, large, NULL, &error));
    /* A raster that does not say where it lies may be larger than it claims. */
    large->placed = false;
    assert_true(yb_comparison_make(&comparison, file, large, NULL, &error));
    yb_comparison_free(&comparison);
    yb_grid_free(wide);
    yb_grid_free(large);
    yb_code_file_free(file);
}

static void the_sheet_is_drawn(void **state)
{
    (void)state;
    yb_code_file_t *file = code_rough_hill();
    yb_grid_t *grid = own_grid(&file->map, 0);
    yb_comparison_t comparison;
    yb_fidelity_t fidelity;
    yb_picture_t sheet;
    yb_view_t view;
    measure(file, grid, &comparison, &fidelity);
    yb_view_init(&view, &file->map);
    assert_true(yb_sheet_draw(&sheet, "hill", file, &comparison, &fidelity, &view));
    size_t dark = 0;
    for (size_t i = 0; i < (size_t)sheet.width * sheet.height * 3; i++)
        dark += sheet.samples[i] < 128;
    assert_true(sheet.width > 1000 && dark > 10000);
    yb_picture_free(&sheet);
    yb_fidelity_free(&fidelity);
    yb_comparison_free(&comparison);
    yb_grid_free(grid);
    yb_code_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_map_is_faithful_to_itself),
        cmocka_unit_test(a_lift_is_measured),
        cmocka_unit_test(given_lines_are_the_originals),
        cmocka_unit_test(another_frame_is_refused),
        cmocka_unit_test(the_sheet_is_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
