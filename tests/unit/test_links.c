/* Link points and links, on maps small enough to work them out by hand. A unit of height is a step:
 * 256.
 */
#include <yamabiko/yamabiko.h>

#include "checked_map.h"

static void begin(plan_t *plan)
{
    plan_init(plan, 255, 255);
    plan->shift = 3;
}

static void add_line(plan_t *plan, const plan_point_t *points, int count, int height)
{
    assert_true(plan_try(plan, points, count, height));
}

/* A square of 16 steps round a summit; the summit's height 0: none. */
static void add_peak(plan_t *plan, int x, int y, int height, int summit)
{
    const plan_point_t ring[] = {{x - 8, y - 8}, {x + 8, y - 8}, {x + 8, y + 8}, {x - 8, y + 8}};
    const plan_point_t spot = {x, y};
    add_line(plan, ring, 4, height);
    if (summit > 0)
        add_line(plan, &spot, 1, summit);
}

static int saddles(void)
{
    return load.first_skeleton - load.first_saddle;
}

static const yb_vertex_t *saddle(int k)
{
    return &map.vertex[load.first_saddle + k];
}

/* How many points of a contour are linked to vertex v by a rule. */
static int links(int contour, int v, yb_rule_t rule)
{
    int count = 0;
    for (int k = 0; k < load.contour[contour].count; k++)
        count += map_edge(&map, &load, load.contour[contour].first + k, v) == (int)rule;
    return count;
}

static void begin_twins(plan_t *plan)
{
    begin(plan);
    const plan_point_t parent[] = {{40, 80}, {120, 80}, {216, 80}, {216, 176}, {40, 176}};
    add_line(plan, parent, 5, 20);
}

/* From (88, 128), 2.5 a step, and from (168, 128), 5 a step, the slopes meet at x = 141 1/3. */
static void twins_meet_where_their_slopes_do(void **state)
{
    (void)state;
    plan_t plan;
    begin_twins(&plan);
    add_peak(&plan, 80, 128, 40, 60);
    add_peak(&plan, 176, 128, 40, 80);
    load_checked(&plan);
    assert_int_equal(saddles(), 1);
    assert_int_equal(saddle(0)->x_q8, 141 * 256 + 64);
    assert_int_equal(saddle(0)->y_q8, 128 * 256);
    assert_int_equal(saddle(0)->z_q8, 30 * 256);
    assert_int_equal(yb_vertex_rule(&load, (yb_index_t)load.first_saddle), YB_RULE_SADDLE);
    assert_int_equal(links(1, load.first_saddle, YB_RULE_SADDLE), 1);
    assert_int_equal(links(3, load.first_saddle, YB_RULE_SADDLE), 1);
}

/* (120, 80) is nearer to the western summit (tan = 40 / 62.5), but the eastern one is steeper (60 /
 * 73.8); (168, 120) lies nearest to the way there.
 */
static void the_steeper_summit_rules(void **state)
{
    (void)state;
    plan_t plan;
    begin_twins(&plan);
    add_peak(&plan, 80, 128, 40, 60);
    add_peak(&plan, 176, 128, 40, 80);
    load_checked(&plan);
    assert_int_equal(map_edge(&map, &load, 1, map_vertex_at(&map, 168, 120)), YB_RULE_SLOPE);
    assert_int_equal(map_edge(&map, &load, 0, map_vertex_at(&map, 72, 120)), YB_RULE_SLOPE);
    assert_int_equal(map_edge(&map, &load, 2, map_vertex_at(&map, 184, 120)), YB_RULE_SLOPE);
    assert_int_equal(map_edge(&map, &load, 3, map_vertex_at(&map, 184, 136)), YB_RULE_SLOPE);
    assert_int_equal(map_edge(&map, &load, 4, map_vertex_at(&map, 72, 136)), YB_RULE_SLOPE);
}

/* The same upside down. */
static void twin_pits_meet_too(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    plan.frame_height = 120;
    const plan_point_t parent[] = {{40, 80}, {216, 80}, {216, 176}, {40, 176}};
    add_line(&plan, parent, 4, 100);
    add_peak(&plan, 80, 128, 80, 60);
    add_peak(&plan, 176, 128, 80, 40);
    load_checked(&plan);
    assert_int_equal(saddles(), 1);
    assert_int_equal(saddle(0)->x_q8, 141 * 256 + 64);
    assert_int_equal(saddle(0)->z_q8, 90 * 256);
}

/* Summits that were added count like coded ones: ten above both lines, half way. */
static void twins_without_summits_meet_half_way(void **state)
{
    (void)state;
    plan_t plan;
    begin_twins(&plan);
    add_peak(&plan, 80, 128, 40, 0);
    add_peak(&plan, 176, 128, 40, 0);
    load_checked(&plan);
    assert_int_equal(saddles(), 1);
    assert_int_equal(saddle(0)->x_q8, 128 * 256);
    assert_int_equal(saddle(0)->z_q8, 30 * 256);
}

/* A peak and a pit, peaks of two heights, peaks whose summits go down: no link points. */
static void others_are_no_twins(void **state)
{
    (void)state;
    static const int height[3][4] = {{40, 60, 10, 5}, {40, 60, 50, 60}, {40, 30, 40, 35}};
    for (int i = 0; i < 3; i++) {
        plan_t plan;
        begin_twins(&plan);
        add_peak(&plan, 80, 128, height[i][0], height[i][1]);
        add_peak(&plan, 176, 128, height[i][2], height[i][3]);
        load_checked(&plan);
        assert_int_equal(saddles(), 0);
    }
}

/* 48 and 80 apart, 128 the two outer ones, which are joined by then. */
static void nearest_pairs_are_joined_first(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    const plan_point_t parent[] = {{24, 80}, {232, 80}, {232, 176}, {24, 176}};
    add_line(&plan, parent, 4, 20);
    add_peak(&plan, 48, 128, 40, 60); /* contours 1 and 2 */
    add_peak(&plan, 176, 128, 40, 60);
    add_peak(&plan, 96, 128, 40, 60);
    load_checked(&plan);
    assert_int_equal(saddles(), 2);
    assert_int_equal(saddle(0)->x_q8, 72 * 256);
    assert_int_equal(saddle(1)->x_q8, 136 * 256);
    assert_int_equal(links(1, load.first_saddle, YB_RULE_SADDLE), 1);
    assert_int_equal(links(5, load.first_saddle, YB_RULE_SADDLE), 1);
    assert_int_equal(links(3, load.first_saddle + 1, YB_RULE_SADDLE), 1);
    assert_int_equal(links(5, load.first_saddle + 1, YB_RULE_SADDLE), 1);
}

/* Others that lie nearer but cannot be joined, for their summits go down, change nothing. */
static void others_do_not_disturb_twins(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    const plan_point_t parent[] = {{24, 40}, {232, 40}, {232, 216}, {24, 216}};
    add_line(&plan, parent, 4, 20);
    add_peak(&plan, 80, 80, 40, 60);
    add_peak(&plan, 176, 80, 40, 60);
    add_peak(&plan, 112, 176, 60, 50);
    add_peak(&plan, 144, 176, 60, 50);
    load_checked(&plan);
    assert_int_equal(saddles(), 1);
    assert_int_equal(saddle(0)->z_q8, 30 * 256);
}

/* Where there is no height between two lines there can be no pass between them. */
static void twins_a_unit_above_their_parent(void **state)
{
    (void)state;
    plan_t plan;
    begin_twins(&plan);
    plan.cell = 256; /* a unit of height is the smallest there is */
    plan.unit = 1;
    add_peak(&plan, 80, 128, 21, 40);
    add_peak(&plan, 176, 128, 21, 40);
    load_checked(&plan);
}

/* Round a square: three sides join four peaks, the fourth and the diagonals join nothing. */
static void four_peaks_have_three_link_points(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    const plan_point_t parent[] = {{32, 32}, {224, 32}, {224, 224}, {32, 224}};
    add_line(&plan, parent, 4, 20);
    add_peak(&plan, 88, 88, 40, 60);
    add_peak(&plan, 168, 88, 40, 60);
    add_peak(&plan, 168, 168, 40, 60);
    add_peak(&plan, 88, 168, 40, 60);
    load_checked(&plan);
    assert_int_equal(saddles(), 3);
}

/* Two summits behind one line stand for one peak. */
static void one_link_point_for_two_lines(void **state)
{
    (void)state;
    plan_t plan;
    begin_twins(&plan);
    add_peak(&plan, 80, 128, 40, 60);
    add_peak(&plan, 176, 128, 40, 80);
    const plan_point_t second = {178, 132};
    add_line(&plan, &second, 1, 70);
    load_checked(&plan);
    assert_int_equal(saddles(), 1);
}

/* Round a bow the segment between the summits leaves the parent: no link point there, but a saddle
 * of the skeleton in the bow, half way up.
 */
static void bows_are_left_to_the_skeleton(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    const plan_point_t bow[] = {{40, 40},  {216, 40}, {216, 200}, {168, 200},
                                {168, 88}, {88, 88},  {88, 200},  {40, 200}};
    add_line(&plan, bow, 8, 20);
    add_peak(&plan, 64, 176, 40, 60);
    add_peak(&plan, 192, 176, 40, 60);
    load_checked(&plan);
    assert_int_equal(saddles(), 0);
    int found = 0;
    for (int v = load.first_skeleton; v < map.vertex_count; v++) {
        const yb_vertex_t *p = &map.vertex[v];
        if (load.branch[v].other == v || p->x_q8 < 88 * 256 || p->x_q8 > 168 * 256)
            continue;
        found++;
        assert_in_range(p->y_q8, 40 * 256, 88 * 256);
        assert_in_range(p->z_q8, 20 * 256 + 1, 40 * 256 - 1);
    }
    CHECK(found > 0, "no saddle in the bow");
}

/* What the summit does not see stays without a link, round the corner of an L; and what stands by a
 * ridge that is narrower than the summit is far: the two points at the corner.
 */
static void fans_do_not_cross_their_line(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    const plan_point_t ell[] = {{40, 40}, {200, 40}, {200, 72}, {72, 72}, {72, 200}, {40, 200}};
    const plan_point_t spot = {56, 180};
    add_line(&plan, ell, 6, 20);
    add_line(&plan, &spot, 1, 30);
    load_checked(&plan);
    static const int linked[6] = {0, 0, 0, 0, 1, 1};
    for (int k = 0; k < 6; k++)
        assert_int_equal(map_edge(&map, &load, k, 6) == YB_RULE_SUMMIT, linked[k]);
    assert_true(map.vertex_count > load.first_skeleton);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(twins_meet_where_their_slopes_do),
        cmocka_unit_test(the_steeper_summit_rules),
        cmocka_unit_test(twin_pits_meet_too),
        cmocka_unit_test(twins_without_summits_meet_half_way),
        cmocka_unit_test(others_are_no_twins),
        cmocka_unit_test(nearest_pairs_are_joined_first),
        cmocka_unit_test(others_do_not_disturb_twins),
        cmocka_unit_test(twins_a_unit_above_their_parent),
        cmocka_unit_test(four_peaks_have_three_link_points),
        cmocka_unit_test(one_link_point_for_two_lines),
        cmocka_unit_test(bows_are_left_to_the_skeleton),
        cmocka_unit_test(fans_do_not_cross_their_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
