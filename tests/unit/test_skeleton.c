/* Skeletons, on maps small enough to work them out by hand. A unit of height is a step: 256. */
#include <stdlib.h>

#include <yamabiko/yamabiko.h>

#include "checked_map.h"

static void begin(plan_t *plan)
{
    plan_init(plan, 248, 248);
    plan->shift = 3;
}

static void add_line(plan_t *plan, const plan_point_t *points, int count, int height)
{
    assert_true(plan_try(plan, points, count, height));
}

/* A point of a skeleton at a place, in steps. */
static int point_at(double x, double y)
{
    int v = map_vertex_at(&map, x, y);
    CHECK(v >= load.first_skeleton, "no point of a skeleton at (%g, %g)", x, y);
    assert_int_equal(yb_vertex_rule(&load, (yb_index_t)v), YB_RULE_SKELETON);
    return v;
}

/* Length as the rules have it (SPEC 3.1), q8. */
static int length(int a, int b)
{
    int dx = abs(map.vertex[a].x_q8 - map.vertex[b].x_q8);
    int dy = abs(map.vertex[a].y_q8 - map.vertex[b].y_q8);
    return dx > dy ? dx + 3 * dy / 8 : dy + 3 * dx / 8;
}

static void begin_canyon(plan_t *plan)
{
    begin(plan);
    const plan_point_t parent[] = {{32, 32}, {224, 32}, {224, 224}, {128, 224}, {32, 224}};
    const plan_point_t spot = {80, 128};
    add_line(plan, parent, 5, 20);
    add_line(plan, &spot, 1, 60);
}

/* The paper's polygon: P = (128, 224) of the parent, Q and S 8 to each side of (128, 192), R 88
 * farther in. M goes to the middle of QS.
 */
static void a_canyon_has_a_point_in_its_mouth(void **state)
{
    (void)state;
    plan_t plan;
    begin_canyon(&plan);
    const plan_point_t dented[] = {{64, 64},   {192, 64},  {192, 192}, {136, 192},
                                   {128, 104}, {120, 192}, {64, 192}};
    add_line(&plan, dented, 7, 40);
    load_checked(&plan);
    int m = point_at(128, 192);
    int p = map_vertex_at(&map, 128, 224);
    int r = map_vertex_at(&map, 128, 104);
    assert_int_equal(load.branch[m].parent, p);
    assert_int_equal(map_edge(&map, &load, m, p), YB_RULE_SKELETON);
    assert_true(map_edge(&map, &load, m, r) >= 0);
    assert_int_equal(map_edge(&map, &load, 9, 11), -1); /* Q and S */
    /* From 20 at P evenly to 40 at R: 32 of 120 steps. */
    assert_int_equal(map.vertex[m].z_q8, 20 * 256 + 20 * 256 * 32 / 120);
}

/* A spur is a canyon upside down: it goes out from the child towards a parent that is bent round
 * it, or, here, from a pit's rim.
 */
static void a_canyon_of_a_pit_goes_up(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    plan.frame_height = 100;
    const plan_point_t parent[] = {{32, 32}, {224, 32}, {224, 224}, {128, 224}, {32, 224}};
    const plan_point_t dented[] = {{64, 64},   {192, 64},  {192, 192}, {136, 192},
                                   {128, 104}, {120, 192}, {64, 192}};
    const plan_point_t spot = {80, 128};
    add_line(&plan, parent, 5, 80);
    add_line(&plan, dented, 7, 60);
    add_line(&plan, &spot, 1, 40);
    load_checked(&plan);
    int m = point_at(128, 192);
    assert_int_equal(map.vertex[m].z_q8, 80 * 256 - 20 * 256 * 32 / 120);
}

/* A canyon of many points: from the mouth to its head the heights are even along the branch. */
static void a_long_canyon_rises_evenly(void **state)
{
    (void)state;
    plan_t plan;
    begin_canyon(&plan);
    const plan_point_t dented[] = {{64, 64},   {192, 64},  {192, 192}, {136, 192}, {136, 168},
                                   {136, 144}, {136, 120}, {128, 88},  {120, 120}, {120, 144},
                                   {120, 168}, {120, 192}, {64, 192}};
    add_line(&plan, dented, 13, 40);
    load_checked(&plan);
    /* The deepest point of the branch, and from there back to where it began. */
    int last = point_at(128, 120);
    int chain[32];
    int count = 0;
    for (int v = last; count < 32; v = load.branch[v].parent) {
        chain[count++] = v;
        if (v < load.first_skeleton)
            break;
    }
    assert_int_equal(chain[count - 1], map_vertex_at(&map, 128, 224));
    assert_true(count >= 6);
    int whole = length(last, map_vertex_at(&map, 128, 88));
    for (int k = 0; k + 1 < count; k++)
        whole += length(chain[k], chain[k + 1]);
    int way = 0;
    for (int k = count - 2; k >= 0; k--) {
        way += length(chain[k], chain[k + 1]);
        int even = 20 * 256 + 20 * 256 * way / whole;
        assert_in_range(map.vertex[chain[k]].z_q8 + count - even, 0, 2 * count);
    }
}

/* Between two blocks of one height (with hollows in them: no peaks, no link point), from the east
 * to the frame in the west, where it lies half way up.
 */
static void a_canyon_leaves_by_the_frame(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    const plan_point_t north[] = {{0, 136}, {96, 136}, {96, 248}};
    const plan_point_t south[] = {{96, 0}, {96, 120}, {0, 120}};
    add_line(&plan, north, 3, 40);
    add_line(&plan, south, 3, 40);
    const plan_point_t hollow[] = {{48, 200}, {48, 56}};
    add_line(&plan, &hollow[0], 1, 30);
    add_line(&plan, &hollow[1], 1, 30);
    plan.corner_height[1] = plan.corner_height[2] = 20;
    load_checked(&plan);
    int v = point_at(0, 128);
    assert_true(load.branch[v].other != v);
    assert_int_equal(map.vertex[v].z_q8, 30 * 256);
    for (int w = load.branch[v].parent; w >= load.first_skeleton; w = load.branch[w].parent) {
        assert_true(map.vertex[w].z_q8 < map.vertex[v].z_q8);
        assert_true(map.vertex[w].z_q8 > 20 * 256);
    }
}

/* Two summits of one height in one leaf: between them a saddle, half way down to the line. */
static void two_summits_have_a_saddle(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    const plan_point_t leaf[] = {{80, 96}, {168, 96}, {168, 160}, {80, 160}};
    const plan_point_t spot[] = {{112, 128}, {136, 128}};
    add_line(&plan, leaf, 4, 40);
    add_line(&plan, &spot[0], 1, 60);
    add_line(&plan, &spot[1], 1, 60);
    load_checked(&plan);
    int v = point_at(124, 128);
    assert_true(load.branch[v].other != v);
    assert_int_equal(map.vertex[v].z_q8, 50 * 256);
}

/* A ridge between two valleys: a line that is as high on both sides of a narrow neck. */
static void a_neck_is_a_saddle(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    const plan_point_t glass[] = {{40, 40},   {120, 80},  {208, 40},
                                  {208, 208}, {120, 168}, {40, 208}};
    const plan_point_t west = {56, 124};
    const plan_point_t east = {192, 124};
    add_line(&plan, glass, 6, 40);
    add_line(&plan, &west, 1, 60);
    add_line(&plan, &east, 1, 80);
    load_checked(&plan);
    int v = point_at(120, 124);
    assert_true(load.branch[v].other != v);
    assert_in_range(map.vertex[v].z_q8, 40 * 256 + 1, 80 * 256 - 1);
    assert_int_equal(map_edge(&map, &load, 1, 4), -1);
}

/* Where lines lie regularly nothing is flat, and nothing is added. */
static void a_cone_needs_none(void **state)
{
    (void)state;
    plan_t plan;
    begin(&plan);
    for (int i = 1; i < 4; i++) {
        int r = 104 - 24 * i;
        const plan_point_t ring[] = {
            {124 - r, 124 - r}, {124 + r, 124 - r}, {124 + r, 124 + r}, {124 - r, 124 + r}};
        add_line(&plan, ring, 4, 20 * i);
    }
    const plan_point_t spot = {124, 124};
    add_line(&plan, &spot, 1, 80);
    load_checked(&plan);
    assert_int_equal(map.vertex_count, 17);
}

/* A ridge that the frame cuts off: its line ends at both sides of it, whichever way it is coded. */
static void a_ridge_goes_on_to_the_frame(void **state)
{
    (void)state;
    for (int back = 0; back < 2; back++) {
        plan_t plan;
        begin(&plan);
        const plan_point_t there[] = {{0, 96}, {40, 96}, {40, 144}, {0, 144}};
        const plan_point_t here[] = {{0, 144}, {40, 144}, {40, 96}, {0, 96}};
        const plan_point_t summit[] = {{16, 120}};
        add_line(&plan, back ? here : there, 4, 100);
        add_line(&plan, summit, 1, 150);
        load_checked(&plan);
        int v = map_vertex_at(&map, 0, 120);
        assert_true(v >= load.first_skeleton);
        assert_int_equal(map.vertex[v].z_q8, 125 * 256);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_canyon_has_a_point_in_its_mouth),
        cmocka_unit_test(a_canyon_of_a_pit_goes_up),
        cmocka_unit_test(a_long_canyon_rises_evenly),
        cmocka_unit_test(a_canyon_leaves_by_the_frame),
        cmocka_unit_test(two_summits_have_a_saddle),
        cmocka_unit_test(a_neck_is_a_saddle),
        cmocka_unit_test(a_cone_needs_none),
        cmocka_unit_test(a_ridge_goes_on_to_the_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
