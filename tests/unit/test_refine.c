/* Refinement for a frame: edge functions are symmetric, and bounds hold what they bound. */
#include <stdlib.h>
#include <string.h>

#include "camera.h"
#include "check.h"
#include "maps.h"
#include "plain_frame.h"

#include "refine.c"

static yb_map_t map;
static yb_load_t load;
static yb_frame_t frame;

static void load_plan(const plan_t *plan)
{
    uint8_t bytes[PLAN_MAX_BYTES];
    assert_int_equal(yb_map_load(&map, &load, bytes, plan_write(plan, bytes)), YB_OK);
}

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

static void check_edge(void *context, const yb_point_t *const p[3])
{
    (void)context;
    for (int i = 0; i < 3; i++) {
        const yb_point_t *a = p[i];
        const yb_point_t *b = p[(i + 1) % 3];
        assert_int_equal(refine_splits(&frame, a, b), refine_splits(&frame, b, a));
        if (!relief_splits(b->at.x_q8 - a->at.x_q8, b->at.y_q8 - a->at.y_q8))
            continue;
        yb_point_t forth;
        yb_point_t back;
        memset(&forth, 0, sizeof forth);
        memset(&back, 0, sizeof back);
        refine_middle(&frame, a, b, &forth);
        refine_middle(&frame, b, a, &back);
        assert_memory_equal(&forth, &back, sizeof forth);
    }
}

static void edges_are_the_same_from_both_ends(void **state)
{
    (void)state;
    rng_t rng = {61};
    for (int round = 0; round < 80; round++) {
        begin_random_frame(&rng, round);
        (void)plain_leaves(&frame, check_edge, NULL);
        for (int t = 0; t < map.triangle_count; t++) {
            yb_point_t a;
            yb_point_t b;
            refine_root(&frame, map.triangle[t][0], &a);
            refine_root(&frame, map.triangle[t][1], &b);
            assert_int_equal(refine_splits(&frame, &a, &b), refine_splits(&frame, &b, &a));
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
    uint8_t planes[NODES];
    int depth;
    int64_t checked, out_checked;
} bounds_t;

/* A point of the surface against what was said of all triangles that it came from. */
static void check_point(bounds_t *bounds, const yb_point_t *point)
{
    camera_point_t place;
    camera_place(&frame, point, &place);
    bool seen = point->visible && point->x_q4 >= 0 && point->x_q4 < frame.screen.width * 16 &&
                point->y_q4 >= bounds->first_row * 16 && point->y_q4 < bounds->end_row * 16;
    for (int i = 0; i < bounds->depth; i++) {
        if (bounds->out[i]) {
            CHECK(!seen, "a point at %d, %d of a triangle that is outside", (int)point->x_q4,
                  (int)point->y_q4);
            bounds->out_checked++;
            continue;
        }
        for (int k = 0; k < REFINE_PLANES; k++) {
            if ((bounds->planes[i] & 1 << k) != 0)
                continue;
            const refine_plane_t *plane = &bounds->view.plane[k];
            double value = (double)plane->right * place.right_q8 + (double)plane->up * place.up_q8 +
                           (double)plane->slope_q8 * place.depth_q8 / 256 - plane->near_q8;
            CHECK(value >= 0, "a point %.1f outside plane %d, of a triangle inside it", -value, k);
            bounds->checked++;
        }
    }
}

static void descend(bounds_t *bounds, const yb_point_t *const corner[3])
{
    assert_true(bounds->depth < NODES);
    if (plain_behind(&frame, corner))
        return;
    uint8_t planes = REFINE_ALL_PLANES;
    bounds->out[bounds->depth] = outside(&frame, &bounds->view, corner, &planes);
    bounds->planes[bounds->depth++] = planes;
    const yb_point_t *point[6] = {corner[0], corner[1], corner[2]};
    yb_point_t middle[3];
    int pattern = 0;
    for (int i = 0; i < 3; i++) {
        check_point(bounds, corner[i]);
        if (!refine_splits(&frame, corner[i], corner[(i + 1) % 3]))
            continue;
        refine_middle(&frame, corner[i], corner[(i + 1) % 3], &middle[i]);
        point[3 + i] = &middle[i];
        pattern |= 1 << i;
    }
    for (int k = 0; pattern != 0 && k < SPLIT_CHILDREN; k++) {
        const uint8_t *child = split_child[pattern][k];
        if (child[0] == SPLIT_END)
            break;
        const yb_point_t *const below[3] = {point[child[0]], point[child[1]], point[child[2]]};
        descend(bounds, below);
    }
    bounds->depth--;
}

static void bounds_hold_all_that_a_triangle_becomes(void **state)
{
    (void)state;
    rng_t rng = {62};
    bounds_t bounds = {.depth = 0};
    for (int round = 0; round < 120; round++) {
        begin_random_frame(&rng, round);
        bounds.first_row = rng_range(&rng, 0, frame.screen.height - 1);
        bounds.end_row = rng_range(&rng, bounds.first_row + 1, frame.screen.height);
        refine_see(&frame, bounds.first_row, bounds.end_row, &bounds.view);
        for (int t = 0; t < map.triangle_count; t++) {
            yb_point_t root[3];
            for (int i = 0; i < 3; i++)
                refine_root(&frame, map.triangle[t][i], &root[i]);
            const yb_point_t *const corner[3] = {&root[0], &root[1], &root[2]};
            descend(&bounds, corner);
        }
    }
    print_message("%.0f points inside planes, %.0f of triangles outside\n", (double)bounds.checked,
                  (double)bounds.out_checked);
    assert_true(bounds.checked > 100000 && bounds.out_checked > 10000);
}

/* The rows that a base triangle is binned to hold all rows it touches. */
static void check_rows(uint16_t t, const yb_point_t *point)
{
    if (!point->visible || point->x_q4 < 0 || point->x_q4 >= frame.screen.width * 16 ||
        point->y_q4 < 0 || point->y_q4 >= frame.screen.height * 16)
        return;
    uint32_t row = (uint32_t)point->y_q4 >> 4 >> YB_ROW_SHIFT;
    assert_in_range(row, frame.first_row[t], frame.last_row[t]);
}

typedef struct {
    uint16_t triangle;
} rows_t;

static void check_leaf_rows(void *context, const yb_point_t *const p[3])
{
    rows_t *rows = context;
    /* Leaves come triangle by triangle: find whose this is by its middle. */
    int64_t x = (int64_t)p[0]->at.x_q8 + p[1]->at.x_q8 + p[2]->at.x_q8;
    int64_t y = (int64_t)p[0]->at.y_q8 + p[1]->at.y_q8 + p[2]->at.y_q8;
    for (;; rows->triangle++) {
        assert_true(rows->triangle < map.triangle_count);
        bool inside = true;
        for (int i = 0; i < 3; i++) {
            const yb_vertex_t *a = &map.vertex[map.triangle[rows->triangle][i]];
            const yb_vertex_t *b = &map.vertex[map.triangle[rows->triangle][(i + 1) % 3]];
            inside = inside && (int64_t)(b->x_q8 - a->x_q8) * (y - 3 * (int64_t)a->y_q8) >
                                   (int64_t)(b->y_q8 - a->y_q8) * (x - 3 * (int64_t)a->x_q8);
        }
        if (inside)
            break;
    }
    for (int i = 0; i < 3; i++)
        check_rows(rows->triangle, p[i]);
}

static void bins_hold_their_triangles(void **state)
{
    (void)state;
    rng_t rng = {63};
    for (int round = 0; round < 100; round++) {
        begin_random_frame(&rng, round);
        rows_t rows = {0};
        (void)plain_leaves(&frame, check_leaf_rows, &rows);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_are_the_same_from_both_ends),
        cmocka_unit_test(bounds_hold_all_that_a_triangle_becomes),
        cmocka_unit_test(bins_hold_their_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
