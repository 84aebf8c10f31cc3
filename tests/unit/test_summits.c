/* Summits that are added, on maps small enough to say where and how high. A unit of height is a
 * step: 256.
 */
#include <yamabiko/yamabiko.h>

#include "checked_map.h"

static void begin(plan_t *plan, int frame_height)
{
    plan_init(plan, 255, 255);
    plan->shift = 3;
    plan->frame_height = frame_height;
}

static void add_square(plan_t *plan, int x, int y, int side, int height)
{
    const plan_point_t ring[] = {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
    assert_true(plan_try(plan, ring, 4, height));
}

static void add_spot(plan_t *plan, int x, int y, int height)
{
    const plan_point_t p = {x, y};
    assert_true(plan_try(plan, &p, 1, height));
}

static int summits(void)
{
    return load.first_saddle - load.first_summit;
}

static const yb_vertex_t *summit(int k)
{
    return &map.vertex[load.first_summit + k];
}

/* How high a summit is above its line: that of a paraboloid which begins with the mean slope s
 * outside: s times area over length of line; rounded down here and there.
 */
static void check_rise(int k, int line, double slope, double area, double length)
{
    int z = (int)((line + slope * area / length) * 256);
    assert_in_range(summit(k)->z_q8, z - 6, z + 1);
}

/* The slope outside is small: an eighth of an interval above the line, or below it. Where a
 * triangle is all there is the place is half way from the middle of its longest side to the corner
 * opposite.
 */
static void three_points_get_one_inside(void **state)
{
    (void)state;
    for (int pit = 0; pit < 2; pit++) {
        plan_t plan;
        begin(&plan, pit == 1 ? 30 : 10);
        const plan_point_t ring[] = {{100, 100}, {140, 108}, {116, 140}};
        assert_true(plan_try(&plan, ring, 3, 20));
        load_checked(&plan);
        assert_int_equal(summits(), 1);
        assert_int_equal(summit(0)->z_q8, 20 * 256 + (pit == 1 ? -1 : 1) * 10 * 256 / 8);
        /* Longest: from the third back to the first, 43 steps. */
        assert_int_equal(summit(0)->x_q8, (108 + 140) / 2 * 256);
        assert_int_equal(summit(0)->y_q8, (120 + 108) / 2 * 256);
        assert_int_equal(yb_vertex_rule(&load, (yb_index_t)load.first_summit), YB_RULE_SUMMIT);
        for (int k = 0; k < 3; k++)
            assert_int_equal(map_edge(&map, &load, k, load.first_summit), YB_RULE_SUMMIT);
        assert_int_equal(load.all_contours - load.contour_count, 1);
        assert_int_equal(load.contour[1].first, load.first_summit);
        assert_int_equal(load.contour[1].left, load.contour[0].left);
    }
}

/* What counts is the ground next to the line, not the frame: up 24 over 40 or 56 steps. */
static void the_rise_is_that_of_a_paraboloid(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 0);
    add_square(&plan, 40, 40, 160, 20);
    add_square(&plan, 80, 80, 64, 44);
    load_checked(&plan);
    assert_int_equal(summits(), 1);
    check_rise(0, 44, 24 / 48.0, 64 * 64, 4 * 64);
    assert_int_equal(summit(0)->x_q8, 112 * 256);
    assert_int_equal(summit(0)->y_q8, 112 * 256);
}

static void a_summit_of_its_own_is_enough(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 10);
    add_square(&plan, 80, 80, 64, 20);
    add_spot(&plan, 100, 120, 21);
    load_checked(&plan);
    assert_int_equal(summits(), 0);
    assert_int_equal(map.vertex_count, 9);
    for (int k = 0; k < 4; k++)
        assert_int_equal(map_edge(&map, &load, k, 4), YB_RULE_SUMMIT);
}

static void two_summits_share_a_leaf(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 10);
    add_square(&plan, 80, 80, 96, 20);
    add_spot(&plan, 100, 128, 30);
    add_spot(&plan, 156, 128, 40);
    load_checked(&plan);
    assert_int_equal(summits(), 0);
    /* (80, 80): tan = 10 / 52 to the near one, 20 / 90 to the far one, which is the steeper. */
    assert_int_equal(map_edge(&map, &load, 0, 5), YB_RULE_SUMMIT);
    assert_int_not_equal(map_edge(&map, &load, 0, 4), YB_RULE_SUMMIT);
    assert_int_equal(map_edge(&map, &load, 1, 5), YB_RULE_SUMMIT);
}

static void a_spot_as_high_as_its_line_is_no_summit(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 10);
    add_square(&plan, 80, 80, 64, 20);
    add_spot(&plan, 100, 120, 20);
    load_checked(&plan);
    assert_int_equal(summits(), 1);
    check_rise(0, 20, 10 / ((80 + 80 + 111 + 111) / 4.0), 64 * 64, 4 * 64);
}

/* A ring between two lines of one height: the mean of what it does outside, by length of line. */
static void a_ring_of_one_height_gets_a_summit(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 10);
    add_square(&plan, 40, 40, 120, 40);
    add_square(&plan, 88, 88, 24, 40);
    add_spot(&plan, 100, 100, 100);
    load_checked(&plan);
    assert_int_equal(summits(), 1);
    /* Along 480 steps of line up 30 over 40 or 95 steps, along 96 down 60 over 12: up all in all.
     */
    check_rise(0, 40, (30.0 * 480 + 60 * 96) / (120 * (40 + 40 + 95 + 95) + 96 * 12),
               120 * 120 - 24 * 24, 480 + 96);
}

/* The ring first, from the ground outside; then what it goes round, from the ring. */
static void a_crater_goes_down_again(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 10);
    add_square(&plan, 80, 80, 32, 40); /* in code order the crater comes before its rim */
    add_square(&plan, 40, 40, 120, 40);
    load_checked(&plan);
    assert_int_equal(summits(), 2);
    check_rise(0, 40, 30.0 * 480 / (120 * (40 + 40 + 95 + 95)), 120 * 120 - 32 * 32, 480 + 128);
    assert_true(summit(1)->z_q8 < 40 * 256);
    assert_true(summit(1)->x_q8 > 80 * 256 && summit(1)->x_q8 < 112 * 256);
}

static void a_nest_of_one_height_goes_up_and_down(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 10);
    for (int i = 0; i < 5; i++)
        add_square(&plan, 8 + 24 * i, 8 + 24 * i, 240 - 48 * i, 40);
    load_checked(&plan);
    assert_int_equal(summits(), 5);
}

static void a_line_round_the_whole_frame(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 0);
    add_square(&plan, 4, 4, 248, 10);
    load_checked(&plan);
    assert_int_equal(summits(), 1);
    assert_int_equal(summit(0)->x_q8, 128 * 256);
    assert_int_equal(summit(0)->y_q8, 128 * 256);
    assert_int_equal(summit(0)->z_q8, 10 * 256 + 10 * 256 * 7 / 8); /* steep outside: no more */
}

/* Its corner has the line's height, so all of it has. */
static void a_corner_cut_off_gets_a_summit(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 0);
    const plan_point_t line[] = {{0, 160}, {160, 0}};
    assert_true(plan_try(&plan, line, 2, 30));
    plan.corner_height[2] = 10;
    load_checked(&plan);
    assert_int_equal(summits(), 1);
    assert_true(summit(0)->z_q8 > 30 * 256);
    assert_true(summit(0)->x_q8 + summit(0)->y_q8 < 160 * 256);
}

/* All of one height: there is nothing to say how it goes on. */
static void a_flat_map_stays_flat(void **state)
{
    (void)state;
    for (int with = 0; with < 4; with++) {
        plan_t plan;
        begin(&plan, 7);
        if ((with & 1) != 0)
            add_square(&plan, 80, 80, 64, 7);
        if ((with & 2) != 0)
            add_spot(&plan, 30, 30, 7);
        load_checked(&plan);
        assert_int_equal(map.vertex_count, plan_vertices(&plan));
    }
}

/* At the highest height that a code may have there is no room for a summit above. */
static void the_highest_line_is_no_plateau(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan, 0);
    add_square(&plan, 80, 80, 64, 512);
    load_checked(&plan);
    assert_int_equal(summits(), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_points_get_one_inside),
        cmocka_unit_test(the_rise_is_that_of_a_paraboloid),
        cmocka_unit_test(a_summit_of_its_own_is_enough),
        cmocka_unit_test(two_summits_share_a_leaf),
        cmocka_unit_test(a_spot_as_high_as_its_line_is_no_summit),
        cmocka_unit_test(a_ring_of_one_height_gets_a_summit),
        cmocka_unit_test(a_crater_goes_down_again),
        cmocka_unit_test(a_nest_of_one_height_goes_up_and_down),
        cmocka_unit_test(a_line_round_the_whole_frame),
        cmocka_unit_test(a_corner_cut_off_gets_a_summit),
        cmocka_unit_test(a_flat_map_stays_flat),
        cmocka_unit_test(the_highest_line_is_no_plateau),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
