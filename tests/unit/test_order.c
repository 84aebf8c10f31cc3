/* The order of a frame: what a pixel shows is the nearest leaf there, by rays in floating point. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "clip.h"
#include "mesh.h"
#include "order.h"
#include "pixels.h"
#include "plain_frame.h"
#include "raster.h"
#include "rays.h"

#include "loaded_map.h" /* after mesh.h, whose arguments have the name of its load */

enum {
    WIDTH = 96,
    HEIGHT = 64,
    MOST_LEAVES = 32000
};

static yb_frame_t frame;
static _Alignas(2) uint8_t pixels[WIDTH * HEIGHT * 2];

/* --- What lies where -------------------------------------------------------------------------- */

/* A leaf's corners in view space: right, up and depth. */
typedef struct {
    double p[3][3];
} leaf_t;

static leaf_t leaves[MOST_LEAVES];
static int leaf_count;

/* --- Frames ----------------------------------------------------------------------------------- */

/* A leaf's number, from 1 on, as the value of pixels: all bits but the one that tells. */
static uint16_t value_of(int number)
{
    return (uint16_t)((number & 31) | (number & ~31) << 1 | PIXELS_DRAWN);
}

static int number_of(const uint8_t *pixel)
{
    const int value = pixel[0] << 8 | pixel[1];
    return (value & 31) | (value >> 1 & ~31);
}

/* Draws each leaf with its number. */
static void draw_number(void *context, const yb_point_t *const p[3])
{
    const raster_t *raster = context;
    if (leaf_count == MOST_LEAVES)
        return; /* too many for their numbers: the view is not looked at */
    for (int i = 0; i < 3; i++)
        ray_corner(&frame, p[i], leaves[leaf_count].p[i]);
    const uint16_t value = value_of(++leaf_count);
    if (raster_draw(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot, value, NULL) == RASTER_BEYOND)
        (void)clip_draw(&frame, raster, p, value, false);
}

/* The nearest that is met at each pixel, in the rows of a raster, from the near distance on:
 * corners before it are rounded to more than a pixel.
 */
static void find_nearest(const raster_t *raster, double *nearest)
{
    for (int i = 0; i < leaf_count; i++) {
        leaf_t *leaf = &leaves[i];
        double box[4] = {0, WIDTH - 1, raster->first_row, raster->end_row - 1};
        if (leaf->p[0][2] > 0 && leaf->p[1][2] > 0 && leaf->p[2][2] > 0) {
            double x[3];
            double y[3];
            for (int k = 0; k < 3; k++) {
                x[k] = WIDTH / 2 + leaf->p[k][0] / leaf->p[k][2] * frame.focal_q4 / 16;
                y[k] = HEIGHT / 2 - leaf->p[k][1] / leaf->p[k][2] * frame.focal_q4 / 16;
            }
            box[0] = fmax(box[0], floor(fmin(x[0], fmin(x[1], x[2])) - 1));
            box[1] = fmin(box[1], ceil(fmax(x[0], fmax(x[1], x[2])) + 1));
            box[2] = fmax(box[2], floor(fmin(y[0], fmin(y[1], y[2])) - 1));
            box[3] = fmin(box[3], ceil(fmax(y[0], fmax(y[1], y[2])) + 1));
        }
        for (int y = (int)box[2]; y <= box[3]; y++) {
            for (int x = (int)box[0]; x <= box[1]; x++) {
                bool met;
                const double depth = ray_depth(&frame, leaf->p, x + 0.5, y + 0.5, &met);
                if (met && depth >= frame.near + 4 && depth < nearest[y * WIDTH + x])
                    nearest[y * WIDTH + x] = depth;
            }
        }
    }
}

typedef struct {
    int pixels, wrong, circles;
} sum_t;

/* What is drawn is as near as the nearest, but for places that rounding moves across an outline. A
 * midpoint's depth is known to a 64th: see refine.c.
 */
static void check_rows(const raster_t *raster, sum_t *sum)
{
    static double nearest[WIDTH * HEIGHT];
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        nearest[i] = (double)INFINITY;
    find_nearest(raster, nearest);
    for (int y = raster->first_row; y < raster->end_row; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const int number = number_of(&pixels[(y * WIDTH + x) * 2]);
            if (number == 0 || nearest[y * WIDTH + x] == (double)INFINITY)
                continue;
            bool met;
            const double depth = ray_depth(&frame, leaves[number - 1].p, x + 0.5, y + 0.5, &met);
            sum->pixels++;
            sum->wrong += depth > nearest[y * WIDTH + x] * (1 + 1. / 32) + 3;
        }
    }
}

static void check_view(const yb_view_t *view, sum_t *sum)
{
    const yb_screen_t screen = {WIDTH, HEIGHT, YB_RGB565};
    const yb_band_t band = {0, HEIGHT, pixels, sizeof pixels / HEIGHT, NULL};
    raster_t raster = pixels_open(&screen, &band);
    yb_frame_begin(&frame, &map, view, &screen);
    for (int y = 0; y < HEIGHT; y++)
        pixels_clear(&raster, y, 0);
    for (int y = 0; y < HEIGHT; y = raster.end_row) {
        raster.first_row = y;
        raster.end_row = order_rows(&frame, y, HEIGHT);
        sum->circles += raster.end_row < HEIGHT;
        leaf_count = 0;
        (void)plain_ordered(&frame, draw_number, &raster);
        if (leaf_count < MOST_LEAVES)
            check_rows(&raster, sum);
    }
}

/* Any view of any map. */
static void next_view(rng_t *rng, int round, yb_view_t *view)
{
    if (round % 8 == 0) {
        plan_t plan;
        random_fitting_plan(&plan, rng);
        load_plan(&plan);
    }
    random_view(view, &map, rng);
}

static void the_nearest_is_drawn(void **state)
{
    (void)state;
    rng_t rng = {91};
    sum_t sum = {0, 0, 0};
    for (int round = 0; round < 450; round++) {
        yb_view_t view;
        next_view(&rng, round, &view);
        view.edge_q4 = view.edge_q4 < 96 ? 96 : view.edge_q4;
        check_view(&view, &sum);
    }
    print_message("%d pixels, %d show what is hidden\n", sum.pixels, sum.wrong);
    assert_true(sum.pixels > 450000);
    assert_true(sum.wrong < sum.pixels / 4000);
}

/* What lies across the edges of a map's triangles. */
static void find_across(void)
{
    for (int t = 0; t < map.triangle_count; t++) {
        map.across[t] = 0;
        for (int i = 2; i >= 0; i--) {
            yb_across_t beside = NO_TRIANGLE;
            for (int u = 0; u < map.triangle_count; u++) {
                for (int k = 0; k < 3; k++) {
                    if (map.triangle[u][k] == map.triangle[t][next3(i)] &&
                        map.triangle[u][next3(k)] == map.triangle[t][i])
                        beside = (yb_across_t)u;
                }
            }
            map.across[t] = map.across[t] << ENTRY_BITS | beside;
        }
    }
}

/* Six triangles round another, each in front of the next as seen from there: all edges that lead
 * outward are turned the same way.
 */
static void load_circle(rng_t *rng)
{
    enum {
        MIDDLE = 128 * 256
    };
    static const yb_index_t ring[7][3] = {{0, 1, 2}, {0, 3, 1}, {1, 4, 2}, {2, 5, 0},
                                          {1, 3, 4}, {2, 4, 5}, {0, 5, 3}};
    plan_t plan;
    plan_init(&plan, 255, 255);
    load_plan(&plan);
    map.vertex_count = 6;
    map.triangle_count = 7;
    memcpy(map.triangle, ring, sizeof ring);
    for (int i = 0; i < 6; i++) {
        const double angle = (i < 3 ? 120 * i : 120 * (i - 3) + 130) * acos(-1) / 180;
        const double way = (i < 3 ? 12 : 110) * 256;
        map.vertex[i] = (yb_vertex_t){
            .x_q8 = (uint16_t)((MIDDLE + (int)(way * cos(angle))) & ~31),
            .y_q8 = (uint16_t)((MIDDLE + (int)(way * sin(angle))) & ~31),
            .z_q8 = rng_range(rng, 0, 9000),
        };
    }
    map.low_q8 = 0;
    map.high_q8 = 9000;
    find_across();
}

/* In bands, whose triangles come in one order above some row and in another one below. */
static void check_bands(const yb_view_t *view)
{
    static _Alignas(2) uint8_t whole[sizeof pixels];
    const yb_screen_t screen = {WIDTH, HEIGHT, YB_RGB565};
    yb_band_t band = {0, HEIGHT, whole, sizeof whole / HEIGHT, NULL};
    yb_frame_begin(&frame, &map, view, &screen);
    yb_frame_band(&frame, &band);
    band.rows = 4;
    for (; band.y < HEIGHT; band.y = (uint16_t)(band.y + band.rows)) {
        band.pixels = pixels + band.y * band.pitch;
        yb_frame_band(&frame, &band);
    }
    assert_memory_equal(whole, pixels, sizeof whole);
}

static void circles_are_seen_in_two_parts(void **state)
{
    (void)state;
    rng_t rng = {93};
    sum_t sum = {0, 0, 0};
    for (int round = 0; round < 200; round++) {
        yb_view_t view;
        load_circle(&rng);
        yb_view_init(&view, &map);
        view.edge_q4 = 200;
        view.zoom_q12 = 1500; /* 107 degrees across */
        for (int i = 0; i < 2; i++) {
            view.eye_q8[i] = 128 * 256 + rng_range(&rng, -500, 500);
            view.look_q8[i] = view.eye_q8[i] + rng_range(&rng, -4000, 4000);
        }
        view.eye_q8[2] = rng_range(&rng, 5000, 40000);
        view.look_q8[2] = view.eye_q8[2] - 5000;
        view.azimuth_bam = (uint16_t)rng_range(&rng, 0, 65535);
        check_view(&view, &sum);
        check_bands(&view);
    }
    print_message("%d pixels, %d show what is hidden; %d frames in two orders\n", sum.pixels,
                  sum.wrong, sum.circles);
    assert_true(sum.pixels > 300000 && sum.circles > 50);
    assert_true(sum.wrong < sum.pixels / 50000);
}

/* --- Base triangles --------------------------------------------------------------------------- */

/* Are two triangles beside each other in the order that the eye sees them in, and is each there
 * once?
 */
static void each_comes_after_its_hiders(void **state)
{
    (void)state;
    rng_t rng = {92};
    int edges = 0;
    int circles = 0;
    for (int round = 0; round < 4000; round++) {
        yb_view_t view;
        next_view(&rng, round, &view);
        const yb_screen_t screen = {WIDTH, HEIGHT, YB_GREY4};
        yb_frame_begin(&frame, &map, &view, &screen);
        (void)order_rows(&frame, 0, HEIGHT);
        circles += frame.order_for != ORDER_ALL;
        static int rank[YB_MAX_TRIANGLES];
        for (int t = 0; t < map.triangle_count; t++)
            rank[t] = -1;
        for (int i = 0; i < map.triangle_count; i++) {
            assert_int_equal(rank[frame.order[i]], -1);
            rank[frame.order[i]] = i;
        }
        if (frame.order_for != ORDER_ALL)
            continue;
        for (int t = 0; t < map.triangle_count; t++) {
            for (int i = 0; i < 3; i++) {
                const yb_vertex_t *a = &map.vertex[map.triangle[t][i]];
                const yb_vertex_t *b = &map.vertex[map.triangle[t][(i + 1) % 3]];
                const unsigned beside = map.across[t] >> (ENTRY_BITS * i) & NO_TRIANGLE;
                const int64_t left =
                    (int64_t)(b->x_q8 - a->x_q8) * ((frame.view.eye_q8[1] & ~3) - a->y_q8) -
                    (int64_t)(b->y_q8 - a->y_q8) * ((frame.view.eye_q8[0] & ~3) - a->x_q8);
                if (beside >= map.triangle_count || left >= 0)
                    continue;
                CHECK(rank[beside] < rank[t], "view %d: %d is hidden by %d", round, t, (int)beside);
                edges++;
            }
        }
    }
    print_message("%d edges, %d circles\n", edges, circles);
    assert_true(edges > 100000);
}

/* --- How far triangles are open --------------------------------------------------------------- */

static double clamped(double a, double low, double high)
{
    return a < low ? low : a > high ? high : a;
}

/* How far a corner is from the eye, as it is taken: its depth, or else the longer of the way in
 * plan and in height.
 */
static double distance_to(const double way[3], uint16_t near)
{
    if (near > 0)
        return 65535.0 * frame.near * (1 << frame.eye_shift) / near;
    return fmax(hypot(way[0], way[1]), fabs(way[2]));
}

/* A triangle is open by how high the eye is above its plane, against its nearest corner: within 8
 * %, and what the weights of its corners are rounded by. -1: it is too thin for that, or out of
 * sight.
 */
static int check_open(const yb_view_t *view, int t)
{
    if (!order_shows(&frame, (yb_triangle_t)t))
        return -1;
    const yb_index_t *corner = yb_map_triangle(&map, (yb_triangle_t)t);
    double way[3][3];
    double nearest = (double)INFINITY;
    double highest = 0;
    for (int i = 0; i < 3; i++) {
        const yb_vertex_t *v = &map.vertex[corner[i]];
        const int32_t top = v->z_q8 > view->water_q8 ? v->z_q8 : view->water_q8;
        way[i][0] = v->x_q8 - (double)view->eye_q8[0];
        way[i][1] = v->y_q8 - (double)view->eye_q8[1];
        way[i][2] = top * (view->exaggerate_q8 / 256.0) - view->eye_q8[2];
        nearest = fmin(nearest, distance_to(way[i], frame.seen[corner[i]].near));
        highest = fmax(highest, fabs(way[i][2]));
    }
    double area = 0;
    double above = 0;
    double most = 0;
    for (int i = 0; i < 3; i++) {
        const double *a = way[i];
        const double *b = way[(i + 1) % 3];
        const double left = a[0] * b[1] - a[1] * b[0];
        area += left;
        above -= left * way[(i + 2) % 3][2];
        most = fmax(most, fabs(left));
    }
    const double steep = (fmax(way[0][2], fmax(way[1][2], way[2][2])) -
                          fmin(way[0][2], fmin(way[1][2], way[2][2]))) /
                         sqrt(area);
    if (area < most / 64 || steep > 16)
        return -1;
    const double turned = frame.open_turn * above / area / nearest;
    const double off =
        0.02 + frame.open_turn *
                   (highest * most / area / 500 + 16 * steep + 4 * (1 << frame.eye_shift)) /
                   nearest;
    const double open = frame.open[t] / (double)ORDER_OPEN;
    assert_true(open >= clamped(turned * (turned > 0 ? 0.92 : 1.08) - off, 0.25, 1) - 0.01);
    assert_true(open <= clamped(turned * (turned > 0 ? 1.08 : 0.92) + off, 0.25, 1) + 0.01);
    return frame.open[t] == ORDER_OPEN ? 2 : frame.open[t] > ORDER_OPEN / 4 ? 1 : 0;
}

static void triangles_are_open_as_they_are_turned(void **state)
{
    (void)state;
    static const yb_screen_t screen = {WIDTH, HEIGHT, YB_RGB565};
    rng_t rng = {97};
    int count[3] = {0};
    for (int round = 0; round < 2000; round++) {
        yb_view_t view;
        next_view(&rng, round, &view);
        if (rng_one_in(&rng, 2))
            view.look_q8[2] = view.eye_q8[2];
        yb_frame_begin(&frame, &map, &view, &screen);
        for (int t = 0; t < map.triangle_count; t++) {
            const int how = check_open(&frame.view, t);
            if (how >= 0)
                count[how]++;
        }
    }
    print_message("open: a quarter %d, some %d, all %d\n", count[0], count[1], count[2]);
    for (int i = 0; i < 3; i++)
        assert_true(count[i] > 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_comes_after_its_hiders),
        cmocka_unit_test(the_nearest_is_drawn),
        cmocka_unit_test(circles_are_seen_in_two_parts),
        cmocka_unit_test(triangles_are_open_as_they_are_turned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
