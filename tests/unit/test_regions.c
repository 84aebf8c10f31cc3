/* The regions between the contours, on maps small enough to say what must come out. */
#include <yamabiko/yamabiko.h>

#include "check.h"
#include "maps.h"
#include "mesh_check.h"
#include "plan.h"

static yb_map_t map;
static yb_load_t load;

static void load_plan(const plan_t *plan)
{
    assert_int_equal(map_triangulate(&map, &load, plan), YB_OK);
    assert_null(mesh_check_bare(&map, &load, plan));
}

static void a_bare_frame_is_one_region(void **state)
{
    (void)state;
    plan_t plan;
    plan_init(&plan, 255, 255);
    load_plan(&plan);
    assert_int_equal(load.region_count, 1);
}

static void a_ring_has_an_inside(void **state)
{
    (void)state;
    plan_t plan;
    plan_init(&plan, 255, 255);
    plan.shift = 1;
    const plan_point_t ring[] = {{100, 100}, {150, 100}, {150, 150}, {100, 150}};
    const plan_point_t back[] = {{110, 110}, {110, 140}, {140, 140}, {140, 110}};
    const plan_point_t summit = {125, 125};
    const plan_point_t outside = {20, 30};
    assert_true(plan_try(&plan, ring, 4, 10));
    assert_true(plan_try(&plan, back, 4, 20));
    assert_true(plan_try(&plan, &summit, 1, 30));
    assert_true(plan_try(&plan, &outside, 1, 5));
    load_plan(&plan);
    assert_int_equal(load.region_count, 3);
    /* Counter-clockwise: the inside is on the left; the other way round: on the right. */
    assert_int_equal(load.contour[0].left, load.contour[1].left);
    assert_int_equal(load.contour[1].right, load.contour[2].left);
    assert_int_equal(load.contour[2].left, load.contour[2].right);
    assert_int_equal(load.contour[3].left, load.contour[0].right);
    assert_int_not_equal(load.contour[0].left, load.contour[0].right);
}

static void open_lines_cut_the_frame(void **state)
{
    (void)state;
    plan_t plan;
    plan_init(&plan, 60, 60);
    for (int i = 1; i < 50; i++) {
        const plan_point_t line[] = {{i, 0}, {i, 30}, {i, 60}};
        assert_true(plan_try(&plan, line, 3, i));
    }
    load_plan(&plan);
    assert_int_equal(load.region_count, 50);
    for (int i = 0; i < 48; i++) {
        assert_true(yb_contour_is_open(&map, &load.contour[i]));
        assert_int_equal(load.contour[i].right, load.contour[i + 1].left);
    }
}

static void deep_nests_and_many_islands(void **state)
{
    (void)state;
    plan_t nest;
    plan_init(&nest, 255, 255);
    nest.shift = 3;
    for (int i = 0; i < 31; i++) {
        int a = 4 * i + 1;
        int b = a + (248 - 8 * i) / 8 * 8;
        b = b > 254 ? 254 - (254 - a) % 8 : b;
        const plan_point_t ring[] = {{a, a}, {b, a}, {b, b}, {a, b}};
        if (b - a >= 8)
            assert_true(plan_try(&nest, ring, 4, i));
    }
    load_plan(&nest);
    assert_int_equal(load.region_count, nest.contours + 1);
    assert_true(nest.contours >= 29);
    plan_t islands;
    plan_init(&islands, 255, 255);
    for (int i = 0; i < 62; i++) {
        int x = 10 + i % 8 * 20;
        int y = 10 + i / 8 * 20;
        const plan_point_t ring[] = {{x, y}, {x + 10, y}, {x + 10, y + 10}, {x, y + 10}};
        assert_true(plan_try(&islands, ring, 4, i));
    }
    load_plan(&islands);
    assert_int_equal(load.region_count, 63);
    for (int i = 1; i < 62; i++)
        assert_int_equal(load.contour[i].right, load.contour[0].right);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bare_frame_is_one_region),
        cmocka_unit_test(a_ring_has_an_inside),
        cmocka_unit_test(open_lines_cut_the_frame),
        cmocka_unit_test(deep_nests_and_many_islands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
