/* No holes: nothing shows through between triangles, nor between walls and the ground. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "colour.h"
#include "plain_frame.h"
#include "rays.h"

#include "loaded_map.h" /* after relief.h, whose arguments have the name of its map */

enum {
    WIDTH = 160,
    HEIGHT = 120,
    MOST_PIXELS = 320 * 240
};

static yb_frame_t frame;
static uint8_t whole[MOST_PIXELS / 2]; /* or WIDTH * HEIGHT with colours */

static void draw(const yb_view_t *view, const yb_screen_t *screen)
{
    static uint8_t greys[WIDTH / 2 * HEIGHT];
    const yb_band_t band = {0, screen->height, whole, yb_screen_pitch(screen), greys};
    yb_frame_begin(&frame, &map, view, screen);
    yb_frame_band(&frame, &band);
}

/* --- Cracks ----------------------------------------------------------------------------------- */

/* Rays from the eye through places of the screen, and how far off they met the front of a leaf: 0,
 * not at all.
 */
enum {
    CLOSE = 33
};

static const yb_screen_t small_screen = {128, 64, YB_GREY4};
static const yb_screen_t large_screen = {320, 240, YB_GREY4};

typedef struct {
    double left, top, pitch; /* the first place, and from one to the next, in pixels */
    int across, down;
    double *depth;
} rays_t;

/* Where on the screen the part of a triangle beyond the least distance lies. */
typedef struct {
    double left, right, top, bottom;
} box_t;

static void widen(box_t *box, const double p[3])
{
    double x = frame.screen.width / 2 + p[0] / p[2] * frame.focal_q4 / 16;
    double y = frame.screen.height / 2 - p[1] / p[2] * frame.focal_q4 / 16;
    box->left = fmin(box->left, x);
    box->right = fmax(box->right, x);
    box->top = fmin(box->top, y);
    box->bottom = fmax(box->bottom, y);
}

static void find_box(double p[3][3], box_t *box)
{
    *box = (box_t){1e9, -1e9, 1e9, -1e9};
    for (int i = 0; i < 3; i++) {
        const double *a = p[i];
        const double *b = p[(i + 1) % 3];
        if (a[2] >= camera_least(&frame))
            widen(box, a);
        if ((a[2] >= camera_least(&frame)) != (b[2] >= camera_least(&frame))) {
            double part = (camera_least(&frame) - a[2]) / (b[2] - a[2]);
            double cut[3];
            for (int k = 0; k < 3; k++)
                cut[k] = a[k] + part * (b[k] - a[k]);
            widen(box, cut);
        }
    }
}

static double within(double a, double low, double high)
{
    return fmin(fmax(a, low), high);
}

/* Marks the rays that meet the front of a leaf beyond the least distance. */
static void cast(void *context, const yb_point_t *const corner[3])
{
    const rays_t *rays = context;
    double p[3][3];
    for (int i = 0; i < 3; i++)
        ray_corner(&frame, corner[i], p[i]);
    if (ray_determinant(p[0], p[1], p[2]) <= 0)
        return;
    box_t box;
    find_box(p, &box);
    int x0 = (int)within((box.left - rays->left) / rays->pitch - 1, 0, rays->across);
    int x1 = (int)within((box.right - rays->left) / rays->pitch + 1, -1, rays->across - 1);
    int y0 = (int)within((box.top - rays->top) / rays->pitch - 1, 0, rays->down);
    int y1 = (int)within((box.bottom - rays->top) / rays->pitch + 1, -1, rays->down - 1);
    for (int y = y0; y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            bool met;
            const double depth = ray_depth(&frame, p, rays->left + x * rays->pitch,
                                           rays->top + y * rays->pitch, &met);
            double *nearest = &rays->depth[y * rays->across + x];
            if (met && depth >= camera_least(&frame) * 1.5 + 2 &&
                (*nearest == 0 || depth < *nearest))
                *nearest = depth;
        }
    }
}

/* Does ground lie all round the centre of pixel i without a gap? Farther round than corners are
 * moved by rounding: to 1/16 pixel, and to a quarter of a unit where they are cut at the least
 * distance. Between the outlines of two ridges the background rightly shows through.
 */
static bool all_ground(int i)
{
    static double around[CLOSE * CLOSE];
    memset(around, 0, sizeof around);
    double radius = 0.15 + frame.focal_q4 / 16.0 / (4 * camera_least(&frame));
    rays_t rays = {.left = i % frame.screen.width + 0.5 - radius,
                   .top = i / frame.screen.width + 0.5 - radius,
                   .pitch = 2 * radius / (CLOSE - 1),
                   .across = CLOSE,
                   .down = CLOSE,
                   .depth = around};
    (void)plain_leaves(&frame, cast, &rays);
    for (int k = 0; k < CLOSE * CLOSE; k++) {
        if (around[k] == 0)
            return false;
    }
    return true;
}

/* Maps at the ends of what there is: level ground, one needle, a cliff of all the heights there
 * are. Else any.
 */
static void load_extreme(rng_t *rng, int kind)
{
    plan_t plan;
    const plan_point_t needle = {rng_range(rng, 20, 230), rng_range(rng, 20, 230)};
    if (kind > 2) {
        random_fitting_plan(&plan, rng);
        load_plan(&plan);
        return;
    }
    do {
        plan_init(&plan, 255, 255);
        plan.seed = rng_range(rng, 0, 255);
        plan.gain = rng_range(rng, 0, 255);
        plan.dimension = rng_range(rng, 0, 255);
        for (int k = 0; k < 4; k++)
            plan.corner_height[k] = kind == 2 && k > 1 ? rng_range(rng, 400, 511) : 0;
        if (kind == 1)
            assert_true(plan_try(&plan, &needle, 1, rng_range(rng, 100, 511)));
    } while (!map_fits(&plan));
    load_plan(&plan);
}

/* What rays met the ground, pixels that show the background there, those of them with ground all
 * round, and how many rays met it nearer than the near distance.
 */
typedef struct {
    int hits, gaps, cracks, close;
} found_t;

static void look_for_gaps(const yb_view_t *view, const yb_screen_t *screen, int seed, int round,
                          found_t *found)
{
    const int width = screen->width;
    const int count = width * screen->height;
    draw(view, screen);
    static double depth[MOST_PIXELS];
    memset(depth, 0, sizeof depth);
    rays_t rays = {0.5, 0.5, 1, width, screen->height, depth};
    (void)plain_leaves(&frame, cast, &rays);
    for (int i = 0; i < count; i++) {
        int pixel = i % 2 == 0 ? whole[i / 2] >> 4 : whole[i / 2] & 15;
        found->hits += depth[i] > 0;
        found->close += depth[i] > 0 && depth[i] < frame.near;
        if (depth[i] == 0 || pixel != 0)
            continue;
        found->gaps++;
        if (!all_ground(i))
            continue;
        print_message("seed %d, view %d: the background shows through at (%d, %d)\n", seed, round,
                      i % width, i / width);
        found->cracks++;
    }
}

/* Cameras in the map, above or below it, at its frame's edge, straight down, looking away … */
static void look_for_cracks(uint64_t seed, int rounds, found_t *found)
{
    rng_t rng = {seed};
    for (int round = 0; round < rounds; round++) {
        yb_view_t view;
        if (round % 8 == 0)
            load_extreme(&rng, round / 8 % 6);
        random_view(&view, &map, &rng);
        if (round % 16 == 5) { /* away: over the shoulder of what it looks at */
            for (int i = 0; i < 3; i++)
                view.look_q8[i] = 2 * view.eye_q8[i] - view.look_q8[i];
        }
        view.walls = false;
        look_for_gaps(&view, &small_screen, (int)seed, round, found);
    }
}

static void there_are_no_cracks(void **state)
{
    (void)state;
    found_t found = {0, 0, 0, 0};
    look_for_cracks(74, 1000, &found);
    /* Among these are corners that are cut twice, very near to a far eye's least distance. */
    look_for_cracks(1074, 570, &found);
    look_for_cracks(8074, 504, &found);
    print_message("%d pixels lie on the ground and show it, but for %d at its outline\n",
                  found.hits, found.gaps);
    assert_true(found.hits > 1200000 && found.gaps < found.hits / 5000 && found.cracks == 0);
}

/* Who stands on the ground and looks down, to his feet, sees ground there. */
static void look_at_the_feet(const yb_screen_t *screen)
{
    rng_t rng = {1303};
    found_t found = {0, 0, 0, 0};
    for (int round = 0; round < 100; round++) {
        if (round % 8 == 0) {
            plan_t plan;
            random_gentle_plan(&plan, &rng, 12);
            load_plan(&plan);
        }
        yb_view_t view;
        const uint16_t x = (uint16_t)rng_range(&rng, 0, map.east_q8);
        const uint16_t y = (uint16_t)rng_range(&rng, 0, map.north_q8);
        yb_view_init(&view, &map);
        const uint16_t azimuth = (uint16_t)rng_range(&rng, 0, 65535);
        const int16_t tilt = (int16_t)-rng_range(&rng, YB_DEGREES(20), YB_DEGREES(90));
        yb_view_walk(&view, &map, x, y, 128, azimuth, tilt);
        look_for_gaps(&view, screen, 1303, round, &found);
    }
    print_message("%d pixels lie on the ground, %d of them near, and show it, but for %d\n",
                  found.hits, found.close, found.gaps);
    assert_true(found.close > 150000 && found.gaps < found.hits / 5000 && found.cracks == 0);
}

static void the_ground_at_the_feet_is_there(void **state)
{
    (void)state;
    look_at_the_feet(&small_screen);
    look_at_the_feet(&large_screen);
}

/* --- Walls ------------------------------------------------------------------------------------ */

/* A block without overhangs, seen from outside: in each column of the screen the ground and the
 * wall below it leave no background between them.
 */
static void walls_meet_the_ground(void **state)
{
    (void)state;
    rng_t rng = {77};
    int columns = 0;
    for (int round = 0; round < 300; round++) {
        if (round % 6 == 0) {
            plan_t plan;
            random_gentle_plan(&plan, &rng, 12);
            load_plan(&plan);
        }
        yb_view_t view;
        yb_view_init(&view, &map);
        uint16_t azimuth = (uint16_t)rng_range(&rng, 0, 65535);
        uint16_t elevation = (uint16_t)rng_range(&rng, 500, 5000);
        yb_view_orbit(&view, &map, azimuth, elevation, (uint16_t)rng_range(&rng, 250, 700));
        view.look_q8[2] = view.eye_q8[2];
        view.zoom_q12 = (uint16_t)rng_range(&rng, 1500, 4400);
        view.edge_q4 = (uint16_t)rng_range(&rng, 64, 300);
        if (round % 2 == 0)
            view.water_q8 = rng_range(&rng, map.low_q8, map.high_q8);
        const yb_screen_t screen = {WIDTH, HEIGHT, YB_RGB565};
        draw(&view, &screen);
        for (int x = 0; x < screen.width; x++) {
            int changes = 0;
            bool before = false;
            for (int y = 0; y < screen.height; y++) {
                const uint8_t *pixel = &whole[2 * (y * screen.width + x)];
                bool ground = (pixel[0] << 8 | pixel[1]) != colour_sky(&frame, y);
                changes += ground && !before;
                before = ground;
            }
            columns += changes > 0;
            CHECK(changes <= 1, "view %d: a gap in column %d", round, x);
        }
    }
    assert_true(columns > 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_are_no_cracks),
        cmocka_unit_test(the_ground_at_the_feet_is_there),
        cmocka_unit_test(walls_meet_the_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
