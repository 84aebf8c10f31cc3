/* The frame: its corners' heights, and what may lie on it. */
#include <yamabiko/yamabiko.h>

#include "check.h"
#include "mesh_check.h"
#include "plan.h"
#include "rng.h"

static yb_map_t map;
static yb_load_t load;

static yb_status_t load_plan(const plan_t *plan)
{
    uint8_t bytes[PLAN_MAX_BYTES];
    return yb_map_load(&map, &load, bytes, plan_write(plan, bytes));
}

/* Height of the vertex at a corner, 0 = SW and on counter-clockwise. */
static int32_t corner(int k)
{
    for (int i = 0; i < map.vertex_count; i++) {
        const yb_vertex_t *v = &map.vertex[i];
        if (v->x_q8 == (k == 1 || k == 2 ? map.east_q8 : 0) &&
            v->y_q8 == (k >= 2 ? map.north_q8 : 0))
            return v->z_q8;
    }
    fail();
    return 0;
}

static void a_frame_that_nothing_meets_has_one_height(void **state)
{
    (void)state;
    plan_t plan;
    plan_init(&plan, 200, 100);
    plan.frame_height = 17;
    const plan_point_t spot = {20, 20};
    assert_true(plan_try(&plan, &spot, 1, 50));
    assert_int_equal(load_plan(&plan), YB_OK);
    for (int k = 0; k < 4; k++)
        assert_int_equal(corner(k), 17 * 256);
}

static void coded_corners_have_their_heights(void **state)
{
    (void)state;
    for (int which = 1; which < 16; which++) {
        plan_t plan;
        plan_init(&plan, 255, 255);
        for (int k = 0; k < 4; k++)
            plan.corner_height[k] = (which >> k & 1) != 0 ? 10 * (k + 1) : -1;
        assert_int_equal(load_plan(&plan), YB_OK);
        for (int k = 0; k < 4; k++) {
            if (plan.corner_height[k] >= 0) {
                assert_int_equal(corner(k), plan.corner_height[k] * 256);
                continue;
            }
            /* A square: half way, or by thirds, or the only height there is. */
            int ahead = 1;
            int behind = 1;
            while ((which >> (k + ahead) % 4 & 1) == 0)
                ahead++;
            while ((which >> (k + 4 - behind) % 4 & 1) == 0)
                behind++;
            int64_t za = plan.corner_height[(k + ahead) % 4] * 256;
            int64_t zb = plan.corner_height[(k + 4 - behind) % 4] * 256;
            int64_t sum = za * behind * 255 * 256 + zb * ahead * 255 * 256;
            int64_t way = (ahead + behind) * 255 * 256;
            assert_int_equal(corner(k), (sum + way / 2) / way);
        }
    }
}

static void corners_lie_between_the_ends_of_lines(void **state)
{
    (void)state;
    plan_t plan;
    plan_init(&plan, 100, 60);
    const plan_point_t west[] = {{0, 20}, {20, 20}, {40, 0}};
    const plan_point_t east[] = {{80, 60}, {100, 40}};
    assert_true(plan_try(&plan, west, 3, 10));
    assert_true(plan_try(&plan, east, 2, 30));
    plan.frame_height = 99; /* not used: lines meet the frame */
    assert_int_equal(load_plan(&plan), YB_OK);
    assert_int_equal(corner(0), 10 * 256);
    assert_int_equal(corner(2), 30 * 256);
    /* From (40, 0) by 60 + 0 to the south-eastern corner, then 40 up. */
    assert_int_equal(corner(1), (10 * 40 + 30 * 60) * 256 / 100);
    /* North-western: 80 from the north line's end, 40 from the west line's. */
    assert_int_equal(corner(3), ((10 * 80 + 30 * 40) * 256 + 60) / 120);
    assert_null(mesh_check(&map, &load, &plan));
}

static void a_line_may_end_in_a_corner(void **state)
{
    (void)state;
    plan_t plan;
    plan_init(&plan, 100, 60);
    plan.shift = 2;
    const plan_point_t across[] = {{0, 0}, {100, 60}};
    assert_true(plan_try(&plan, across, 2, 10));
    assert_int_equal(load_plan(&plan), YB_OK);
    assert_int_equal(map.vertex_count, 4);
    assert_int_equal(map.triangle_count, 2);
    assert_null(mesh_check(&map, &load, &plan));
    plan.corner_height[2] = 10;
    assert_int_equal(load_plan(&plan), YB_ERR_CORRUPT);
    plan.corner_height[2] = -1;
    plan.corner_height[1] = 55;
    assert_int_equal(load_plan(&plan), YB_OK);
    assert_int_equal(corner(1), 55 * 256);
    assert_int_equal(corner(3), 10 * 256);
}

/* The base of a compact code may lie above the ground. */
static void corners_may_lie_below_the_base(void **state)
{
    (void)state;
    static const struct {
        int32_t west, east;
    } cases[] = {{-700, -700}, {-701, 100}, {701, -100}, {-1, 0}, {5, 9}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        yb_map_begin(&map, &load);
        map.east_q8 = 50 * 256;
        map.north_q8 = 50 * 256;
        map.cell = 64;
        map.unit = 64;
        map.hurst_q8m1 = 255;
        load.contour_count = 2;
        load.point_count = 4;
        load.contour[0] = (yb_contour_t){.first = 0, .count = 2};
        load.contour[1] = (yb_contour_t){.first = 2, .count = 2};
        const int x[] = {10, 0, 20, 50};
        const int y[] = {0, 10, 0, 30};
        for (int k = 0; k < 4; k++)
            map.vertex[k] = (yb_vertex_t){.x_q8 = (uint16_t)(x[k] * 256),
                                          .y_q8 = (uint16_t)(y[k] * 256),
                                          .z_q8 = k < 2 ? cases[i].west : cases[i].east};
        assert_int_equal(yb_map_build(&map, &load), YB_OK);
        assert_int_equal(corner(0), cases[i].west);
        assert_int_equal(corner(1), cases[i].east);
        /* 20 steps from the end in the east, 90 from that in the west. */
        int64_t far = (int64_t)cases[i].west * 20 + (int64_t)cases[i].east * 90;
        int64_t z = (far + 55) / 110;
        z -= far + 55 < 0 && (far + 55) % 110 != 0;
        assert_int_equal(corner(2), z);
    }
}

/* All ways an open line of two or three points can lie: legal exactly when SPEC 1.5 says so. */
static void all_short_lines(void **state)
{
    (void)state;
    int good = 0;
    for (int code = 0; code < 6 * 6 * 6 * 6 * 7 * 6; code++) {
        plan_t plan;
        plan_init(&plan, 5, 5);
        int c = code;
        const plan_point_t line[] = {
            {c % 6, c / 6 % 6}, {c / 1296 % 7, c / 9072}, {c / 36 % 6, c / 216 % 6}};
        /* x = 6 stands for a line without a bend. */
        const plan_point_t straight[] = {line[0], line[2]};
        bool bent = line[1].x < 6;
        assert_true(bent ? plan_add(&plan, line, 3, 4) : plan_add(&plan, straight, 2, 4));
        yb_status_t expected = plan_valid(&plan) ? YB_OK : YB_ERR_CORRUPT;
        CHECK(load_plan(&plan) == expected, "(%d, %d) (%d, %d) (%d, %d)", line[0].x, line[0].y,
              line[1].x, line[1].y, line[2].x, line[2].y);
        if (expected == YB_OK) {
            good++;
            assert_null(mesh_check(&map, &load, &plan));
        }
    }
    print_message("%d of %d short lines are legal\n", good, 6 * 6 * 6 * 6 * 7 * 6);
    assert_true(good > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_that_nothing_meets_has_one_height),
        cmocka_unit_test(coded_corners_have_their_heights),
        cmocka_unit_test(corners_lie_between_the_ends_of_lines),
        cmocka_unit_test(a_line_may_end_in_a_corner),
        cmocka_unit_test(corners_may_lie_below_the_base),
        cmocka_unit_test(all_short_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
