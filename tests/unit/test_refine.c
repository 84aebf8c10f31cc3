/* Refinement for a frame: edge functions are symmetric, and bounds hold what they bound. */
#include <stdlib.h>
#include <string.h>

#include "camera.h"
#include "order.h"
#include "plain_frame.h"

#include "refine.c"

#include "loaded_map.h"

static yb_frame_t frame;

static void begin_random_frame(rng_t *rng, int round)
{
    static const yb_screen_t screens[] = {
        {128, 64, YB_GREY4}, {320, 240, YB_RGB565}, {64, 200, YB_RGB565}, {1024, 700, YB_GREY4}};
    if (round % 10 == 0) {
        plan_t plan;
        random_fitting_plan(&plan, rng);
        if (round % 40 == 0)
            plan.gain = 255;
        load_plan(&plan);
    }
    yb_view_t view;
    random_view(&view, &map, rng);
    if (view.edge_q4 < 160)
        view.edge_q4 = 160;
    yb_frame_begin(&frame, &map, &view, &screens[round % 4]);
}

/* --- An edge is the same from both ends ------------------------------------------------------- */

static void check_edge(const yb_point_t *a, const yb_point_t *b)
{
    const int32_t open = ORDER_OPEN / (1 + (int32_t)((a->place + b->place) % 3));
    yb_edge_t there = refine_edge(&frame, a, b, open);
    assert_true(there == refine_edge(&frame, b, a, open));
    if (!relief_splits(relief_dx(a->place, b->place), relief_dy(a->place, b->place))) {
        assert_true(there < REFINE_ONCE);
        return;
    }
    for (int how = 0; how < 2; how++) { /* by the spots, if there are any; exactly */
        yb_point_t forth_middle;
        yb_point_t back_middle;
        if (how == 0 && (a->spot.near == 0 || b->spot.near == 0))
            continue;
        there = (plain_split(a, b, there) & REFINE_WHOLE) | (how == 0 ? REFINE_ONCE : REFINE_AGAIN);
        memset(&forth_middle, 0, sizeof forth_middle);
        memset(&back_middle, 0, sizeof back_middle);
        refine_middle(&frame, plain_view(&frame), a, b, there, &forth_middle);
        refine_middle(&frame, plain_view(&frame), b, a, there, &back_middle);
        assert_memory_equal(&forth_middle, &back_middle, sizeof forth_middle);
    }
}

static void check_leaf(void *context, const yb_point_t *const p[3])
{
    (void)context;
    for (int i = 0; i < 3; i++)
        check_edge(p[i], p[(i + 1) % 3]);
}

static void edges_are_the_same_from_both_ends(void **state)
{
    (void)state;
    rng_t rng = {61};
    for (int round = 0; round < 80; round++) {
        begin_random_frame(&rng, round);
        (void)plain_leaves(&frame, check_leaf, NULL);
        for (int t = 0; t < map.triangle_count; t++) {
            yb_part_t root;
            refine_root(&frame, plain_view(&frame), (yb_triangle_t)t, NULL, &root);
            check_leaf(NULL, root.point);
        }
    }
}

/* A midpoint is that of the surface: SPEC 3.2. */
static void midpoints_are_the_surfaces(void **state)
{
    (void)state;
    rng_t rng = {64};
    for (int round = 0; round < 40; round++) {
        begin_random_frame(&rng, round);
        for (int t = 0; t < map.triangle_count; t++) {
            yb_part_t root;
            refine_root(&frame, plain_view(&frame), (yb_triangle_t)t, NULL, &root);
            for (int i = 0; i < 3; i++) {
                const yb_vertex_t *a = &map.vertex[map.triangle[t][i]];
                const yb_vertex_t *b = &map.vertex[map.triangle[t][(i + 1) % 3]];
                yb_vertex_t truth;
                yb_point_t middle;
                if (!relief_splits(b->x_q8 - a->x_q8, b->y_q8 - a->y_q8))
                    continue;
                root.edge[i] = plain_split(root.point[i], root.point[(i + 1) % 3], root.edge[i]) |
                               REFINE_AGAIN;
                relief_middle(&map, a, b, &truth);
                refine_middle(&frame, plain_view(&frame), root.point[i], root.point[(i + 1) % 3],
                              root.edge[i], &middle);
                assert_int_equal(middle.z_q8, truth.z_q8);
                assert_int_equal(middle.place, relief_place(&truth));
                assert_int_equal((int)(middle.slope & 0xffff) - 0x8000, truth.gx_q11);
                assert_int_equal((int)(middle.slope >> 16) - 0x8000, truth.gy_q11);
                /* The class of a half is its own, if it can be split on. */
                int32_t dx = relief_dx(root.point[i]->place, middle.place);
                int32_t dy = relief_dy(root.point[i]->place, middle.place);
                if (relief_splits(dx, dy))
                    assert_int_equal(refine_class(refine_half(root.edge[i])), relief_class(dx, dy));
            }
        }
    }
}

/* --- Bounds ----------------------------------------------------------------------------------- */

enum {
    NODES = 64
};

/* What was said of the triangles that one came from. */
typedef struct {
    refine_view_t view;
    int first_row, end_row;
    bool out[NODES];
    int depth;
    int64_t outside;
} bounds_t;

/* A point of the surface against what was said of all triangles that it came from. Between a leaf's
 * corners lies what its corners bound.
 */
static void check_point(bounds_t *bounds, const yb_point_t *point)
{
    const yb_spot_t *spot = &point->spot;
    /* From beyond the first pixels' centres on. */
    bool seen = spot->near > 0 && spot->x_q4 > 8 && spot->x_q4 <= frame.screen.width * 16 - 8 &&
                spot->y_q4 > bounds->first_row * 16 + 8 && spot->y_q4 <= bounds->end_row * 16 - 8;
    for (int i = 0; i < bounds->depth; i++) {
        CHECK(!bounds->out[i] || !seen, "a point at %d, %d of a triangle that is outside",
              (int)spot->x_q4, (int)spot->y_q4);
        bounds->outside += bounds->out[i];
    }
}

static void descend(bounds_t *bounds, yb_part_t part)
{
    assert_true(bounds->depth < NODES);
    if (plain_behind(&frame, &part))
        return;
    bool splits = refine_splits(&part);
    bounds->out[bounds->depth++] =
        (splits && refine_part_misses(&frame, &bounds->view, &part)) ||
        refine_misses(&frame, &bounds->view, part.point, 3, refine_stray(&frame, &part));
    for (int i = 0; i < 3; i++)
        check_point(bounds, part.point[i]);
    if (splits) {
        yb_level_t rest[REFINE_PIECES];
        yb_level_t *level = refine_split(&frame, &bounds->view, &part, rest);
        descend(bounds, part);
        for (yb_part_t *done = &part; (level = refine_next(rest, level, done)) != NULL;) {
            done = &level->rest;
            descend(bounds, *done);
        }
    }
    bounds->depth--;
}

static void bounds_hold_all_that_a_triangle_becomes(void **state)
{
    (void)state;
    rng_t rng = {62};
    bounds_t bounds = {.depth = 0};
    int hidden = 0;
    for (int round = 0; round < 400; round++) {
        begin_random_frame(&rng, round);
        bounds.first_row = rng_range(&rng, 0, frame.screen.height - 1);
        bounds.end_row = rng_range(&rng, bounds.first_row + 1, frame.screen.height);
        refine_see(&frame, bounds.first_row, bounds.end_row, &bounds.view);
        for (int t = 0; t < map.triangle_count; t++) {
            yb_part_t root;
            refine_root(&frame, &bounds.view, (yb_triangle_t)t, NULL, &root);
            bounds.out[bounds.depth++] = !order_shows(&frame, (yb_triangle_t)t);
            hidden += bounds.out[0];
            descend(&bounds, root);
            bounds.depth--;
        }
    }
    print_message("%.0f points of triangles outside, %d base triangles out of sight\n",
                  (double)bounds.outside, hidden);
    assert_true(bounds.outside > 10000);
    assert_true(hidden > 1000);
}

/* The rows that a base triangle is binned to hold all rows whose pixels' centres it may cover: with
 * a point of it, those next to the point.
 */
static void check_rows(int t, const yb_point_t *point)
{
    const yb_spot_t *spot = &point->spot;
    if (spot->near == 0 || spot->x_q4 < 0 || spot->x_q4 >= frame.screen.width * 16)
        return;
    const int32_t below = raster_pixel(spot->y_q4);
    if (below < 1 || below >= frame.screen.height)
        return;
    assert_true(below >> frame.row_shift >= frame.bins[t] >> 4);
    assert_true((below - 1) >> frame.row_shift <= (frame.bins[t] & 15));
}

static void check_bins(int t, yb_part_t part)
{
    if (plain_behind(&frame, &part))
        return;
    for (int i = 0; i < 3; i++)
        check_rows(t, part.point[i]);
    if (!refine_splits(&part))
        return;
    yb_level_t rest[REFINE_PIECES];
    yb_level_t *level = refine_split(&frame, plain_view(&frame), &part, rest);
    check_bins(t, part);
    for (yb_part_t *done = &part; (level = refine_next(rest, level, done)) != NULL;) {
        done = &level->rest;
        check_bins(t, *done);
    }
}

static void bins_hold_their_triangles(void **state)
{
    (void)state;
    rng_t rng = {63};
    for (int round = 0; round < 150; round++) {
        begin_random_frame(&rng, round);
        if (round % 3 == 0) { /* where refinement moves points farthest */
            yb_view_t view = frame.view;
            const yb_screen_t screen = frame.screen;
            view.exaggerate_q8 = 2048;
            yb_frame_begin(&frame, &map, &view, &screen);
        }
        refine_view_t whole;
        refine_see(&frame, 0, frame.screen.height, &whole);
        for (int t = 0; t < map.triangle_count; t++) {
            yb_part_t root;
            refine_bin(&frame, &whole, (yb_triangle_t)t);
            refine_root(&frame, plain_view(&frame), (yb_triangle_t)t, NULL, &root);
            check_bins(t, root);
        }
    }
}

static void count_leaf(void *context, const yb_point_t *const p[3])
{
    (void)p;
    ++*(uint32_t *)context;
}

/* A line across a triangle goes by half of the edge beside it, and may be far longer than that:
 * here, by a shore. plain_frame says if it is halved more often than the half has classes for.
 */
static void lines_across_are_not_halved_too_often(void **state)
{
    (void)state;
    static const uint8_t code[] = {
        0x20, 0x60, 0x09, 0xff, 0x80, 0x80, 0x01, 0x09, 0x00, 0x1b, 0x00, 0x0d, 0xa4,
        0x00, 0x00, 0x2f, 0x00, 0x3b, 0x07, 0x03, 0x01, 0x01, 0x01, 0x01, 0x01, 0x01,
        0x01, 0x9e, 0x00, 0x55, 0x47, 0x43, 0xef, 0x51, 0x74, 0x34, 0x02, 0x08, 0x04,
        0xdd, 0x46, 0x00, 0x69, 0x58, 0x37, 0xcb, 0xc1, 0x0e, 0x00, 0x4f, 0x25, 0x54,
        0x00, 0x66, 0x25, 0x50, 0x00, 0x60, 0x1f, 0x5c, 0x00, 0x62, 0x29, 0x54, 0x00,
        0x65, 0x2b, 0x52, 0x00, 0x49, 0x21, 0x51, 0x00, 0x64, 0x26, 0x53, 0xec};
    assert_int_equal(yb_map_load(&map, &load, code, sizeof code), YB_OK);
    yb_view_t view;
    yb_view_init(&view, &map);
    static const int32_t eye[3] = {9519, 21438, 2480};
    static const int32_t look[3] = {10374, 20410, -13849};
    memcpy(view.eye_q8, eye, sizeof eye);
    memcpy(view.look_q8, look, sizeof look);
    view.zoom_q12 = 9449;
    view.edge_q4 = 49;
    view.water_q8 = 2180;
    view.walls = false;
    view.azimuth_bam = 25526;
    static const yb_screen_t screen = {320, 240, YB_RGB565};
    yb_frame_begin(&frame, &map, &view, &screen);
    uint32_t count = 0;
    (void)plain_leaves(&frame, count_leaf, &count);
    assert_true(count > 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_are_the_same_from_both_ends),
        cmocka_unit_test(midpoints_are_the_surfaces),
        cmocka_unit_test(bounds_hold_all_that_a_triangle_becomes),
        cmocka_unit_test(bins_hold_their_triangles),
        cmocka_unit_test(lines_across_are_not_halved_too_often),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
