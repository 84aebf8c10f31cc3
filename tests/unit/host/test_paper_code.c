/* The bytes of the paper profile, judged by the engine. */
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

static void begin(yb_paper_t *paper, int shift)
{
    yb_sketch_begin(paper, 10000, 10000, 200, 1800, 1 << shift);
}

static void test_units(void **state)
{
    (void)state;
    for (double metres = 1.0 / 64; metres < 2e6; metres *= 1.37) {
        double coded = yb_paper_metres(yb_paper_unit(metres));
        assert_true(fabs(coded - metres) <= fmax(metres / 4000, 1.0 / 128));
    }
    assert_true(yb_paper_metres(yb_paper_unit(0)) > 0);
    assert_true(yb_paper_metres(yb_paper_unit(1e30)) > 2e6);
}

static void test_engine_reads_what_is_written(void **state)
{
    (void)state;
    yb_error_t error;
    yb_paper_t paper;
    begin(&paper, 1);
    paper.corners = 0x5;
    paper.corner[0] = yb_paper_height(&paper, 250);
    paper.corner[2] = yb_paper_height(&paper, 300);
    paper.gain = 17;
    paper.seed = 99;
    yb_step_t square[] = {{50, 50}, {110, 52}, {112, 110}, {50, 112}};
    yb_step_t line[] = {{0, 200}, {50, 210}, {100, 210}, {140, 254}};
    yb_step_t summit = {80, 81};
    assert_true(yb_paper_append(&paper, yb_paper_height(&paper, 1000), false, square, 4));
    assert_true(yb_paper_append(&paper, yb_paper_height(&paper, 600), true, line, 4));
    assert_true(yb_paper_append(&paper, yb_paper_height(&paper, 1500), false, &summit, 1));
    yb_code_file_t *file = yb_paper_check(&paper, &error);
    if (file == NULL)
        fail_msg("%s", error.text);
    /* 14 + 2 corners + 3 counts + F = 12 * 9 + 20 * 3 + 8 bits + check */
    assert_int_equal(file->size, 14 + 4 + 3 + 22 + 1);
    assert_int_equal(file->size, yb_paper_size(&paper));
    assert_int_equal(file->load.contour_count, 3);
    assert_int_equal(file->map.vertex_count, 14); /* one of a skeleton */
    assert_true(file->load.contour[1].open);
    assert_int_equal(file->map.seed, 99);
    for (int i = 0; i < paper.point_count; i++) {
        assert_int_equal(file->map.vertex[i].x_q8, paper.point[i].x * 256);
        assert_int_equal(file->map.vertex[i].y_q8, paper.point[i].y * 256);
    }
    double summit_m = paper.base_m + file->map.vertex[8].z_q8 * yb_paper_metres(paper.cell) / 256;
    assert_true(fabs(summit_m - 1500) < 1);
    yb_code_file_free(file);
}

static void test_long_segments(void **state)
{
    (void)state;
    yb_error_t error;
    for (int shift = 0; shift <= 3; shift++) {
        yb_paper_t paper;
        uint8_t code[YB_MAX_CODE_BYTES];
        begin(&paper, shift);
        yb_step_t across[] = {{0, 8}, {paper.east, 240}};
        assert_true(yb_paper_append(&paper, 20000, true, across, 2));
        if (shift < 3)
            assert_int_equal(yb_paper_write(&paper, code), 0);
        assert_true(yb_paper_split(&paper));
        assert_int_equal(yb_paper_write(&paper, code), yb_paper_size(&paper));
        yb_code_file_t *file = yb_paper_check(&paper, &error);
        assert_non_null(file);
        yb_code_file_free(file);
    }
}

static void test_insert_and_remove(void **state)
{
    (void)state;
    yb_paper_t paper;
    begin(&paper, 0);
    yb_step_t first[] = {{10, 10}, {30, 10}, {20, 30}};
    yb_step_t second[] = {{100, 100}, {130, 100}, {120, 130}};
    assert_true(yb_paper_append(&paper, 1, false, first, 3));
    assert_true(yb_paper_append(&paper, 2, false, second, 3));
    yb_paper_t before = paper;
    assert_true(yb_paper_insert(&paper, 1, 4, (yb_step_t){115, 90}));
    assert_int_equal(paper.contour[1].count, 4);
    assert_int_equal(paper.point[5].x, 130);
    yb_paper_remove(&paper, 1, 4);
    assert_memory_equal(paper.point, before.point, 6 * sizeof(paper.point[0]));
    yb_paper_drop(&paper, 0);
    assert_int_equal(paper.contour_count, 1);
    assert_int_equal(paper.point_count, 3);
    assert_int_equal(paper.point[0].x, 100);
    assert_int_equal(paper.contour[0].height, 2);
}

static void test_damage_is_named(void **state)
{
    (void)state;
    yb_error_t error;
    yb_paper_t paper;
    begin(&paper, 0);
    yb_step_t summit = {80, 80};
    assert_true(yb_paper_append(&paper, 30000, false, &summit, 1));
    uint8_t code[YB_MAX_CODE_BYTES];
    size_t size = yb_paper_write(&paper, code);
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
        cmocka_unit_test(test_units),           cmocka_unit_test(test_engine_reads_what_is_written),
        cmocka_unit_test(test_long_segments),   cmocka_unit_test(test_insert_and_remove),
        cmocka_unit_test(test_damage_is_named),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
