/* Editing of a contour set. */
#include "contour_set.h"
#include "sketch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

/* A triangle, a line from frame to frame, a spot height. */
static void begin(yb_contour_set_t *set)
{
    const yb_step_t ring[] = {{10, 10}, {30, 10}, {20, 30}};
    const yb_step_t line[] = {{0, 100}, {130, 110}, {255, 130}};
    const yb_step_t summit = {50, 60};
    yb_sketch_begin(set, 10000, 10000, 200, 1800, 1);
    assert_true(yb_contour_set_append(set, 100, false, ring, 3));
    assert_true(yb_contour_set_append(set, 200, true, line, 3));
    assert_true(yb_contour_set_append(set, 300, false, &summit, 1));
}

static void test_units(void **state)
{
    (void)state;
    for (double metres = 1.0 / 64; metres < 2e6; metres *= 1.37) {
        double coded = yb_unit_m(yb_unit_coded(metres));
        assert_true(fabs(coded - metres) <= fmax(metres / 4000, 1.0 / 128));
    }
    assert_true(yb_unit_m(yb_unit_coded(0)) > 0);
    assert_true(yb_unit_m(yb_unit_coded(1e30)) > 2e6);
}

static void test_insert_and_remove(void **state)
{
    (void)state;
    yb_contour_set_t set;
    begin(&set);
    yb_contour_set_t before = set;
    assert_true(yb_contour_set_insert(&set, 1, 4, (yb_step_t){60, 90}));
    assert_int_equal(set.contour[1].count, 4);
    assert_int_equal(set.point[5].x, 130);
    yb_contour_set_remove(&set, 1, 4);
    assert_memory_equal(set.point, before.point, 7 * sizeof(set.point[0]));
    yb_contour_set_drop(&set, 0);
    assert_int_equal(set.contour_count, 2);
    assert_int_equal(set.point_count, 4);
    assert_int_equal(set.point[0].y, 100);
    assert_int_equal(set.contour[0].height, 200);
}

static void test_ends(void **state)
{
    (void)state;
    yb_contour_set_t set;
    begin(&set);
    assert_int_equal(yb_contour_set_first(&set, 2), 6);
    assert_true(yb_contour_set_is_end(&set, 1, 0));
    assert_false(yb_contour_set_is_end(&set, 1, 1));
    assert_true(yb_contour_set_is_end(&set, 1, 2));
    assert_false(yb_contour_set_is_end(&set, 0, 0));
    assert_false(yb_contour_set_is_end(&set, 2, 0));
}

static void test_reorder(void **state)
{
    (void)state;
    yb_contour_set_t set;
    begin(&set);
    const yb_contour_set_t before = set;
    assert_false(yb_contour_set_reorder(&set, 1, 1));
    assert_true(yb_contour_set_reorder(&set, 0, 2));
    assert_int_equal(set.contour[0].height, 200);
    assert_int_equal(set.contour[2].height, 100);
    assert_int_equal(set.point[3].x, 50);
    assert_int_equal(set.point[4].x, 10);
    assert_true(yb_contour_set_reorder(&set, 2, 0));
    assert_memory_equal(set.point, before.point, 7 * sizeof(set.point[0]));
}

static void test_turn(void **state)
{
    (void)state;
    yb_contour_set_t set;
    begin(&set);
    yb_contour_set_turn(&set, 0, 1, false);
    assert_int_equal(set.point[0].x, 30);
    assert_int_equal(set.point[1].x, 20);
    assert_int_equal(set.point[2].x, 10);
    yb_contour_set_turn(&set, 1, 2, true);
    assert_int_equal(set.point[3].x, 255);
    assert_int_equal(set.point[4].x, 130);
    assert_int_equal(set.point[5].x, 0);
}

/* Heights stay where they are in metres, as nearly as the new unit can say it. */
static void test_rescale(void **state)
{
    (void)state;
    yb_contour_set_t set;
    begin(&set);
    set.profile = YB_COMPACT;
    set.unit = yb_compact_unit(2);
    set.base = 50;
    set.corner[2] = 40;
    const yb_contour_set_t before = set;
    assert_false(yb_contour_set_rescale(&set, set.unit));
    assert_true(yb_contour_set_rescale(&set, yb_compact_unit(3)));
    for (int i = 0; i < 3; i++)
        assert_true(fabs(yb_contour_set_height_m(&set, set.contour[i].height) -
                         yb_contour_set_height_m(&before, before.contour[i].height)) <= 1.5);
    assert_true(fabs(yb_contour_set_height_m(&set, set.corner[2]) - 180) <= 1.5);
}

/* More points than a byte counts; and more than there is room for. */
static void test_long_line(void **state)
{
    (void)state;
    yb_contour_set_t set;
    yb_step_t point[YB_SET_POINTS] = {{0}};
    begin(&set);
    assert_true(yb_contour_set_append(&set, 1, false, point, 300));
    assert_int_equal(set.contour[3].count, 300);
    assert_int_equal(set.point_count, 307);
    assert_false(yb_contour_set_append(&set, 1, false, point, YB_SET_POINTS - 306));
    assert_int_equal(set.contour_count, 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_units),    cmocka_unit_test(test_insert_and_remove),
        cmocka_unit_test(test_ends),     cmocka_unit_test(test_reorder),
        cmocka_unit_test(test_turn),     cmocka_unit_test(test_rescale),
        cmocka_unit_test(test_long_line)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
