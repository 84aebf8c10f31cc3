/* The encoder as a whole, on reliefs made here. */
#include "compact_code.h"
#include "contour_code.h"
#include "encode.h"
#include "scratch.h"
#include "sketch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

static void encode_grid(const yb_grid_t *grid, const yb_encode_task_t *task,
                        yb_encode_result_t *result)
{
    yb_error_t error;
    if (!yb_encode_grid(grid, task, result, &error))
        fail_msg("%s", error.text);
    assert_true(result->code->size <= task->most_bytes);
}

static double contour_m(const yb_code_file_t *code, int contour)
{
    const yb_vertex_t *first = &code->map.vertex[code->load.contour[contour].first];
    return code->map.base_m + first->z_q8 * yb_unit_m(code->map.cell) / 256;
}

/* How far the map is off at the highest place. */
static double summit_error_m(const yb_code_file_t *code, const yb_grid_t *grid)
{
    yb_place_t summit = yb_sketch_summit(grid);
    const yb_map_t *map = &code->map;
    int32_t z_q8 =
        yb_map_height(map, (uint16_t)lround(summit.x_m / yb_grid_width_m(grid) * map->east_q8),
                      (uint16_t)lround(summit.y_m / yb_grid_depth_m(grid) * map->north_q8));
    double height_m = map->base_m + z_q8 * yb_unit_m(map->cell) / 256;
    return fabs(height_m - (double)grid->high_m);
}

static void test_near_the_relief(void **state)
{
    (void)state;
    const relief_fn reliefs[] = {relief_cone, relief_range};
    for (int i = 0; i < 2; i++) {
        yb_grid_t *grid = scratch_grid(128, 96, reliefs[i]);
        yb_encode_task_t task = {.profile = YB_COMPACT, .most_bytes = 100, .seed = 1, .effort = 1};
        yb_encode_result_t result;
        encode_grid(grid, &task, &result);
        assert_true(result.rmse_m / result.std_m < 0.12);
        assert_true(summit_error_m(result.code, grid) < 0.3 * grid->std_m);
        yb_encode_result_free(&result);
        yb_grid_free(grid);
    }
}

/* However many threads there are. */
static void test_same_bytes_again(void **state)
{
    (void)state;
    yb_grid_t *grid = scratch_grid(64, 64, relief_range);
    const yb_profile_t profiles[] = {YB_PAPER, YB_COMPACT, YB_COMPACT};
    const size_t budgets[] = {80, 80, 160};
    for (int i = 0; i < 3; i++) {
        yb_encode_task_t task = {
            .profile = profiles[i], .most_bytes = budgets[i], .seed = 3, .effort = 1};
        yb_encode_result_t first;
        yb_encode_result_t second;
        task.threads = 1;
        encode_grid(grid, &task, &first);
        task.threads = 2;
        encode_grid(grid, &task, &second);
        assert_int_equal(first.code->size, second.code->size);
        assert_memory_equal(first.code->bytes, second.code->bytes, first.code->size);
        yb_encode_result_free(&first);
        yb_encode_result_free(&second);
    }
    yb_grid_free(grid);
}

/* What the engine has read is what was written. */
static void test_written_again(void **state)
{
    (void)state;
    yb_grid_t *grid = scratch_grid(96, 64, relief_range);
    const int budgets[] = {40, 110};
    for (int i = 0; i < 2; i++) {
        yb_encode_task_t task = {.profile = YB_COMPACT,
                                 .most_bytes = (size_t)budgets[i],
                                 .interval_m = i * 100.0,
                                 .seed = 77,
                                 .effort = 1};
        yb_encode_result_t result;
        encode_grid(grid, &task, &result);
        yb_contour_set_t draft;
        uint8_t code[YB_CONTOUR_CODE_BYTES];
        yb_compact_read(result.code, &draft);
        assert_int_equal(draft.seed, 77);
        assert_int_equal(yb_compact_write(&draft, code, sizeof(code), NULL), result.code->size);
        assert_memory_equal(code, result.code->bytes, result.code->size);
        yb_encode_result_free(&result);
    }
    yb_grid_free(grid);
}

static void test_budgets(void **state)
{
    (void)state;
    yb_grid_t *grid = scratch_grid(64, 64, relief_range);
    double before = HUGE_VAL;
    const size_t budgets[] = {YB_ENCODE_LEAST_BYTES, 60, 240};
    for (int i = 0; i < 3; i++) {
        yb_encode_task_t task = {
            .profile = YB_COMPACT, .most_bytes = budgets[i], .seed = 1, .effort = 1};
        yb_encode_result_t result;
        encode_grid(grid, &task, &result);
        assert_true(result.rmse_m < before);
        before = result.rmse_m;
        yb_encode_result_free(&result);
    }
    yb_error_t error;
    yb_encode_result_t result;
    yb_encode_task_t task = {
        .profile = YB_COMPACT, .most_bytes = YB_ENCODE_LEAST_BYTES - 1, .effort = 1};
    assert_false(yb_encode_grid(grid, &task, &result, &error));
    assert_non_null(strstr(error.text, "the least is 23"));
    yb_grid_free(grid);
}

static void test_levels_are_kept(void **state)
{
    (void)state;
    yb_error_t error;
    yb_grid_t *grid = scratch_grid(64, 64, relief_range);
    yb_encode_task_t task = {
        .profile = YB_COMPACT, .most_bytes = 120, .interval_m = 250, .seed = 1, .effort = 1};
    yb_encode_result_t result;
    encode_grid(grid, &task, &result);
    int lines = 0;
    for (int i = 0; i < result.code->load.contour_count; i++)
        if (result.code->load.contour[i].count > 1) {
            double height = contour_m(result.code, i);
            assert_true(fabs(height - 250 * round(height / 250)) < 1);
            lines++;
        }
    assert_true(lines > 0);
    yb_encode_result_free(&result);
    task.interval_m = 1e6;
    assert_false(yb_encode_grid(grid, &task, &result, &error));
    assert_non_null(strstr(error.text, "choose a smaller interval"));
    task.interval_m = 0.5;
    assert_false(yb_encode_grid(grid, &task, &result, &error));
    assert_non_null(strstr(error.text, "choose a larger one"));
    yb_grid_free(grid);
}

/* Three closed lines and an open one, given as lines. */
static void test_lines(void **state)
{
    (void)state;
    yb_error_t error;
    yb_lines_t *lines = yb_lines_new(4000, 3000);
    for (int k = 0; k < 3; k++) {
        yb_place_t ring[40];
        for (int i = 0; i < 40; i++) {
            double angle = 6.283185307179586 * i / 40;
            ring[i] = (yb_place_t){2000 + (1000 - 300 * k) * cos(angle),
                                   1800 + (900 - 250 * k) * sin(angle)};
        }
        assert_true(yb_lines_add(lines, 200 + 100 * k, true, ring, 40));
    }
    yb_place_t across[] = {{0, 500}, {2000, 400}, {4000, 600}};
    assert_true(yb_lines_add(lines, 100, false, across, 3));
    yb_encode_task_t task = {.profile = YB_COMPACT, .most_bytes = 100, .seed = 1, .effort = 1};
    yb_encode_result_t result;
    if (!yb_encode_lines(lines, &task, &result, &error))
        fail_msg("%s", error.text);
    for (int i = 0; i < result.code->load.contour_count; i++)
        if (result.code->load.contour[i].count > 1) {
            double height = contour_m(result.code, i);
            assert_true(fabs(height - 100 * round(height / 100)) < 1);
        }
    assert_true(result.rmse_m / result.std_m < 0.3);
    yb_encode_result_free(&result);
    yb_lines_free(lines);
}

static void test_vertices_are_kept(void **state)
{
    (void)state;
    const yb_profile_t profiles[] = {YB_COMPACT, YB_PAPER};
    yb_grid_t *grid = scratch_grid(64, 64, relief_range);
    for (int i = 0; i < 2; i++) {
        yb_encode_task_t task = {
            .profile = profiles[i], .most_bytes = 250, .seed = 1, .effort = 1, .vertices = 40};
        yb_encode_result_t result;
        encode_grid(grid, &task, &result);
        assert_true(result.code->map.vertex_count <= 40);
        yb_encode_result_free(&result);
    }
    yb_grid_free(grid);
    assert_int_equal(yb_compact_vertex_class_within(32), 0);
    assert_int_equal(yb_compact_vertex_class_within(40), 0);
    assert_int_equal(yb_compact_vertex_class_within(64), 1);
    assert_int_equal(yb_compact_vertex_class_within(254), 6);
    assert_int_equal(yb_compact_vertex_class_within(255), 7);
    assert_int_equal(yb_compact_vertex_class_within(511), 7);
    assert_int_equal(yb_compact_vertex_class_within(512), 8);
    assert_int_equal(yb_compact_vertex_class_within(65535), 15);
}

/* Bytes that are asked for are used, on a smooth slope and with little effort too: a search that
 * does not want to grow ends with two thirds of them here.
 */
static void test_long_code_is_full(void **state)
{
    (void)state;
    yb_grid_t *grid = scratch_grid(64, 64, relief_cone);
    yb_encode_task_t task = {
        .profile = YB_COMPACT, .most_bytes = 400, .seed = 1, .effort = 1, .vertices = 1000};
    yb_encode_result_t result;
    encode_grid(grid, &task, &result);
    assert_true(result.code->size >= 360);
    assert_true(result.rmse_m / result.std_m < 0.015);
    yb_encode_result_free(&result);
    yb_grid_free(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_near_the_relief),   cmocka_unit_test(test_same_bytes_again),
        cmocka_unit_test(test_written_again),     cmocka_unit_test(test_budgets),
        cmocka_unit_test(test_levels_are_kept),   cmocka_unit_test(test_lines),
        cmocka_unit_test(test_vertices_are_kept), cmocka_unit_test(test_long_code_is_full),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
