/* The bytes of the paper profile, judged by the engine. */
#include "contour_code.h"
#include "paper_code.h"
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

static void begin(yb_contour_set_t *set, int shift)
{
    yb_sketch_begin(set, 10000, 10000, 200, 1800, 1 << shift);
}

static void test_engine_reads_what_is_written(void **state)
{
    (void)state;
    yb_error_t error;
    yb_contour_set_t set;
    begin(&set, 1);
    set.corners = 0x5;
    set.corner[0] = yb_contour_set_height(&set, 250);
    set.corner[2] = yb_contour_set_height(&set, 300);
    set.gain = 17;
    set.seed = 99;
    yb_step_t square[] = {{50, 50}, {110, 52}, {112, 110}, {50, 112}};
    yb_step_t line[] = {{0, 200}, {50, 210}, {100, 210}, {140, 254}};
    yb_step_t summit = {80, 81};
    assert_true(yb_contour_set_append(&set, yb_contour_set_height(&set, 1000), false, square, 4));
    assert_true(yb_contour_set_append(&set, yb_contour_set_height(&set, 600), true, line, 4));
    assert_true(yb_contour_set_append(&set, yb_contour_set_height(&set, 1500), false, &summit, 1));
    yb_code_file_t *file = yb_contour_code_load(&set, &error);
    if (file == NULL)
        fail_msg("%s", error.text);
    /* 14 + 2 corners + 3 counts + F = 12 * 9 + 20 * 3 + 8 bits + check */
    assert_int_equal(file->size, 14 + 4 + 3 + 22 + 1);
    assert_int_equal(file->size, yb_paper_size(&set));
    assert_int_equal(file->load.contour_count, 3);
    assert_int_equal(file->map.vertex_count, 14); /* one of a skeleton */
    assert_true(yb_contour_is_open(&file->map, &file->load.contour[1]));
    assert_int_equal(file->map.seed, 99);
    for (int i = 0; i < set.point_count; i++) {
        assert_int_equal(file->map.vertex[i].x_q8, set.point[i].x * 256);
        assert_int_equal(file->map.vertex[i].y_q8, set.point[i].y * 256);
    }
    double summit_m = set.base_m + file->map.vertex[8].z_q8 * yb_unit_m(set.cell) / 256;
    assert_true(fabs(summit_m - 1500) < 1);
    yb_code_file_free(file);
}

static void test_long_segments(void **state)
{
    (void)state;
    yb_error_t error;
    for (int shift = 0; shift <= 3; shift++) {
        yb_contour_set_t set;
        uint8_t code[YB_MAX_CODE_BYTES];
        begin(&set, shift);
        yb_step_t across[] = {{0, 8}, {set.east, 240}};
        assert_true(yb_contour_set_append(&set, 20000, true, across, 2));
        if (shift < 3)
            assert_int_equal(yb_paper_write(&set, code), 0);
        assert_true(yb_paper_split(&set));
        assert_int_equal(yb_paper_write(&set, code), yb_paper_size(&set));
        yb_code_file_t *file = yb_contour_code_load(&set, &error);
        assert_non_null(file);
        yb_code_file_free(file);
    }
}

static void test_damage_is_named(void **state)
{
    (void)state;
    yb_error_t error;
    yb_contour_set_t set;
    begin(&set, 0);
    yb_step_t summit = {80, 80};
    assert_true(yb_contour_set_append(&set, 30000, false, &summit, 1));
    uint8_t code[YB_MAX_CODE_BYTES];
    size_t size = yb_paper_write(&set, code);
    assert_true(size > 0);
    assert_null(yb_code_file_from_bytes("x.yb", code, size - 1, &error));
    assert_string_equal(error.text, "x.yb ends too early: the code was cut off");
    assert_null(yb_code_file_from_bytes("x.yb", code, 0, &error));
    assert_string_equal(error.text, "x.yb is empty");
    code[size - 2] ^= 1;
    assert_null(yb_code_file_from_bytes("x.yb", code, size, &error));
    assert_non_null(strstr(error.text, "x.yb is damaged"));
    code[0] = 0x30;
    assert_null(yb_code_file_from_bytes("x.yb", code, size, &error));
    assert_non_null(strstr(error.text, "its first byte is 30"));
    assert_null(yb_code_file_read(scratch_path("none.yb"), &error));
    assert_non_null(strstr(error.text, "cannot open"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_engine_reads_what_is_written),
        cmocka_unit_test(test_long_segments),
        cmocka_unit_test(test_damage_is_named),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
