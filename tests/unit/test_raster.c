/* The rasteriser: every pixel once, none outside, the first one stays. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "fix.h"
#include "lines.h"
#include "pixels.h"
#include "raster.h"
#include "rng.h"
#include "rows.h"

enum {
    WIDTH = 64,
    HEIGHT = 48,
    GUARD = 64,
    PITCH = WIDTH * 2 + 6
};

static uint8_t greys[WIDTH / 2 * HEIGHT]; /* of dots */
static uint8_t pixels[GUARD + PITCH * HEIGHT + GUARD];

typedef struct {
    yb_screen_t screen;
    yb_band_t band;
    raster_t raster;
} page_t;

static void open_page(page_t *page, yb_format_t format, int y, int rows)
{
    page->screen = (yb_screen_t){WIDTH, HEIGHT, format};
    page->band = (yb_band_t){(uint16_t)y, (uint16_t)rows, pixels + GUARD, PITCH, greys};
    page->raster = pixels_open(&page->screen, &page->band);
    memset(pixels, 0xa5, sizeof pixels);
    for (int i = 0; i < rows; i++)
        pixels_clear(&page->raster, y + i, 0);
}

/* A number below 32 as what is drawn, with colours or without. */
static uint16_t value_of(const yb_screen_t *screen, uint16_t number)
{
    return screen->format == YB_RGB565 ? number | PIXELS_DRAWN : number;
}

/* Draws a triangle; true if it shows its front and lies between the sides of the band. */
static bool draw(const raster_t *raster, const yb_spot_t corner[3], uint16_t pixel)
{
    pixel = value_of(raster->screen, pixel);
    return raster_draw(raster, &corner[0], &corner[1], &corner[2], pixel, NULL) != RASTER_NOTHING;
}

/* The number that was drawn, 0 where none was. */
static uint16_t pixel_at(const page_t *page, int x, int line)
{
    const uint8_t *row = page->band.pixels + (size_t)line * page->band.pitch;
    if (page->screen.format == YB_RGB565)
        return (uint16_t)((row[2 * x] << 8 | row[2 * x + 1]) & ~PIXELS_DRAWN);
    if (page->screen.format == YB_MONO)
        row = greys + (size_t)line * WIDTH / 2;
    return x % 2 == 0 ? row[x / 2] >> 4 : row[x / 2] & 15;
}

static void show(const page_t *page)
{
    for (int y = page->raster.first_row; y < page->raster.end_row; y++)
        pixels_show(&page->raster, y);
}

/* What the screen makes of it. */
static uint16_t shown_at(const page_t *page, int x, int line)
{
    const uint8_t *row = page->band.pixels + (size_t)line * page->band.pitch;
    if (page->screen.format == YB_RGB565)
        return pixel_at(page, x, line);
    if (page->screen.format == YB_MONO)
        return row[x / 8] >> (7 - x % 8) & 1;
    return x % 2 == 0 ? row[x / 2] >> 4 : row[x / 2] & 15;
}

/* Nothing but the band's own pixels may change: guards, the rest of each row, rows below. */
static void check_guards(const page_t *page)
{
    size_t used = yb_screen_pitch(&page->screen);
    show(page);
    for (size_t i = 0; i < sizeof pixels; i++) {
        bool inside =
            i >= GUARD && (i - GUARD) / PITCH < page->band.rows && (i - GUARD) % PITCH < used;
        assert_true(inside || pixels[i] == 0xa5);
    }
}

/* --- A mesh over the screen ------------------------------------------------------------------- */

enum {
    MOST = 400
};

typedef struct {
    yb_spot_t point[MOST];
    int triangle[MOST][3];
    int points, triangles;
} mesh_t;

static int64_t twice_area(const yb_spot_t *a, const yb_spot_t *b, const yb_spot_t *c)
{
    return (int64_t)(b->x_q4 - a->x_q4) * (c->y_q4 - a->y_q4) -
           (int64_t)(b->y_q4 - a->y_q4) * (c->x_q4 - a->x_q4);
}

/* Splits triangles at random places inside: slivers and all, but without cracks. Counter-clockwise
 * to the eye is clockwise in these coordinates.
 */
static void random_mesh(mesh_t *mesh, rng_t *rng, int splits)
{
    static const yb_spot_t frame[4] = {{-WIDTH * 16, -HEIGHT * 16, 100, 0},
                                       {2 * WIDTH * 16, -HEIGHT * 16, 100, 0},
                                       {2 * WIDTH * 16, 2 * HEIGHT * 16, 100, 0},
                                       {-WIDTH * 16, 2 * HEIGHT * 16, 100, 0}};
    memcpy(mesh->point, frame, sizeof frame);
    mesh->points = 4;
    const int start[2][3] = {{0, 2, 1}, {0, 3, 2}};
    memcpy(mesh->triangle, start, sizeof start);
    mesh->triangles = 2;
    for (int i = 0; i < splits && mesh->triangles + 2 <= MOST; i++) {
        yb_spot_t p = {rng_range(rng, 0, WIDTH * 16), rng_range(rng, 0, HEIGHT * 16), 100, 0};
        if (rng_one_in(rng, 2)) { /* a pixel's centre */
            p.x_q4 = p.x_q4 / 16 * 16 + 8;
            p.y_q4 = p.y_q4 / 16 * 16 + 8;
        }
        for (int t = 0; t < mesh->triangles; t++) {
            int *v = mesh->triangle[t];
            const yb_spot_t *q[3] = {&mesh->point[v[0]], &mesh->point[v[1]], &mesh->point[v[2]]};
            if (twice_area(q[0], q[1], &p) >= 0 || twice_area(q[1], q[2], &p) >= 0 ||
                twice_area(q[2], q[0], &p) >= 0)
                continue;
            int n = mesh->points++;
            mesh->point[n] = p;
            const int second[3] = {v[1], v[2], n};
            const int third[3] = {v[2], v[0], n};
            v[2] = n;
            memcpy(mesh->triangle[mesh->triangles++], second, sizeof second);
            memcpy(mesh->triangle[mesh->triangles++], third, sizeof third);
            break;
        }
    }
}

static void each_pixel_is_drawn_once(void **state)
{
    (void)state;
    static const yb_format_t formats[3] = {YB_RGB565, YB_GREY4, YB_MONO};
    rng_t rng = {41};
    for (int round = 0; round < 120; round++) {
        static mesh_t mesh;
        random_mesh(&mesh, &rng, 3 + round);
        page_t page;
        static int count[WIDTH * HEIGHT];
        memset(count, 0, sizeof count);
        for (int t = 0; t < mesh.triangles; t++) {
            open_page(&page, formats[round % 3], 0, HEIGHT);
            yb_spot_t corner[3];
            int first = rng_range(&rng, 0, 2);
            for (int i = 0; i < 3; i++)
                corner[i] = mesh.point[mesh.triangle[t][(i + first) % 3]];
            (void)draw(&page.raster, corner, 15);
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                uint16_t pixel = pixel_at(&page, i % WIDTH, i / WIDTH);
                assert_true(pixel == 0 || pixel == 15);
                count[i] += pixel == 15;
            }
            check_guards(&page);
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                const int lit = pixel_at(&page, i % WIDTH, i / WIDTH) == 15;
                const uint16_t full = page.screen.format == YB_MONO ? 1 : 15; /* dots are bits */
                assert_int_equal(shown_at(&page, i % WIDTH, i / WIDTH), lit ? full : 0);
            }
        }
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            CHECK(count[i] == 1, "round %d: pixel (%d, %d) is drawn %d times", round, i % WIDTH,
                  i / WIDTH, count[i]);
    }
}

static void bands_are_parts_of_the_whole(void **state)
{
    (void)state;
    rng_t rng = {42};
    for (int round = 0; round < 2000; round++) {
        yb_spot_t corner[3];
        int depths = 65534 >> rng_range(&rng, 0, 12);
        int least = rng_range(&rng, 1, 65535 - depths);
        for (int i = 0; i < 3; i++) {
            corner[i].x_q4 = rng_range(&rng, -WIDTH * 16, 2 * WIDTH * 16);
            corner[i].y_q4 = rng_range(&rng, -HEIGHT * 16, 2 * HEIGHT * 16);
            corner[i].near = (uint16_t)(least + rng_range(&rng, 0, depths));
        }
        yb_format_t format = round % 2 == 0 ? YB_RGB565 : YB_GREY4;
        page_t page;
        open_page(&page, format, 0, HEIGHT);
        bool front = draw(&page.raster, corner, 5);
        static uint16_t whole[WIDTH * HEIGHT];
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            whole[i] = pixel_at(&page, i % WIDTH, i / WIDTH);
        int y = rng_range(&rng, 0, HEIGHT - 1);
        int rows = rng_range(&rng, 1, HEIGHT - y);
        open_page(&page, format, y, rows);
        assert_true(front || !draw(&page.raster, corner, 5));
        (void)draw(&page.raster, corner, 5);
        for (int i = 0; i < WIDTH * rows; i++)
            assert_int_equal(pixel_at(&page, i % WIDTH, i / WIDTH), whole[i + y * WIDTH]);
        check_guards(&page);
    }
}

static void back_faces_and_flat_ones_draw_nothing(void **state)
{
    (void)state;
    static const yb_spot_t back[3] = {{0, 0, 9, 0}, {500, 0, 9, 0}, {0, 500, 9, 0}};
    static const yb_spot_t front[3] = {{0, 0, 9, 0}, {0, 500, 9, 0}, {500, 0, 9, 0}};
    static const yb_spot_t flat[3] = {{0, 0, 9, 0}, {50, 50, 9, 0}, {250, 250, 9, 0}};
    static const yb_spot_t high[3] = {{0, 0, 9, 0}, {100, 100, 9, 0}, {500, 500, 9, 0}};
    static const yb_spot_t away[3] = {{-500, 0, 9, 0}, {-500, 500, 9, 0}, {-100, 0, 9, 0}};
    page_t page;
    open_page(&page, YB_RGB565, 0, HEIGHT);
    assert_false(draw(&page.raster, back, 7));
    assert_false(draw(&page.raster, flat, 7));
    assert_false(draw(&page.raster, away, 7));
    (void)draw(&page.raster, high, 7);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        assert_int_equal(pixel_at(&page, i % WIDTH, i / WIDTH), 0);
    assert_true(draw(&page.raster, front, 7));
    assert_int_equal(pixel_at(&page, 0, 0), 7);
}

/* The centre of pixel (x, y) lies at 16 x + 8, 16 y + 8; left and top edges belong to a triangle.
 */
static void edges_through_centres(void **state)
{
    (void)state;
    static const yb_spot_t upper[3] = {{8, 8, 9, 0}, {8, 72, 9, 0}, {72, 8, 9, 0}};
    page_t page;
    open_page(&page, YB_GREY4, 0, HEIGHT);
    assert_true(draw(&page.raster, upper, 7));
    for (int y = 0; y < 6; y++) {
        for (int x = 0; x < 6; x++)
            assert_int_equal(pixel_at(&page, x, y), x + y < 4 ? 7 : 0);
    }
}

/* Sides of all slopes through centres: a triangle with a whole number of pixels at two sides. */
static void sides_through_centres(void **state)
{
    (void)state;
    for (int wide = 1; wide < 15; wide++) {
        for (int high = 1; high < 15; high++) {
            const int x = 8 + 16 * wide;
            const int y = 8 + 16 * high;
            const yb_spot_t right[3] = {{x, 8, 9, 0}, {8, y, 9, 0}, {x, y, 9, 0}};
            const yb_spot_t left[3] = {{8, 8, 9, 0}, {8, y, 9, 0}, {x, y, 9, 0}};
            page_t page;
            open_page(&page, YB_GREY4, 0, HEIGHT);
            assert_true(draw(&page.raster, right, 7));
            for (int i = 0; i <= wide; i++) /* from the slanted side on, up to the upright one */
                for (int j = 0; j < high; j++)
                    assert_int_equal(pixel_at(&page, i, j),
                                     i < wide && (wide - i) * high <= j * wide ? 7 : 0);
            open_page(&page, YB_GREY4, 0, HEIGHT);
            assert_true(draw(&page.raster, left, 7));
            for (int i = 0; i <= wide; i++) /* from the upright side up to the slanted one */
                for (int j = 0; j < high; j++)
                    assert_int_equal(pixel_at(&page, i, j), i * high < j * wide ? 7 : 0);
        }
    }
}

/* Over 255 sixteenths of a row a slope of 20 bits is off by 2 * 255 / 2^20: 1/33,000 pixel. */
static void slopes_are_nearly_exact(void **state)
{
    (void)state;
    for (int32_t dy = 1; dy <= RASTER_HIGH_Q4; dy++) {
        for (int32_t dx = -2 * RASTER_WIDE_Q4; dx <= 2 * RASTER_WIDE_Q4; dx++) {
            const double exact = (double)dx * (1 << ROWS_FRACTION) / dy;
            CHECK(fabs(rows_small_slope(dx, dy) - exact) < 2, "%d over %d: off by %g", (int)dx,
                  (int)dy, rows_small_slope(dx, dy) - exact);
        }
    }
}

/* Lines where a value is `zero`, or that and a multiple of the interval, if there is one. False:
 * too many.
 */
static bool find_lines(const yb_spot_t p[3], const int32_t value[3], int32_t zero, int32_t interval,
                       raster_cut_t *cut)
{
    const yb_point_t corner[3] = {
        {.spot = p[0], .z_q8 = value[0]},
        {.spot = p[1], .z_q8 = value[1]},
        {.spot = p[2], .z_q8 = value[2]},
    };
    lines_scale_t scale = {.scale = (uint32_t)1 << 15};
    if (interval > 0) {
        scale.scale = UINT32_MAX / (uint32_t)interval + 1;
        scale.shift = fix_log2_floor(scale.scale) - 15;
    }
    scale.zero = 0 - (uint32_t)zero * scale.scale;
    static const yb_screen_t large = {YB_MAX_SIDE, YB_MAX_SIDE, YB_GREY4};
    return lines_find(&large, (const yb_point_t *const[3]){&corner[0], &corner[1], &corner[2]},
                      scale, cut);
}

/* Small triangles are drawn in two ways: where they lie, and whether lines cross them, decides. */
static void both_ways_are_the_same(void **state)
{
    (void)state;
    static const yb_format_t formats[3] = {YB_RGB565, YB_GREY4, YB_MONO};
    static uint8_t level[sizeof pixels];
    static uint8_t level_greys[sizeof greys];
    rng_t rng = {47};
    int pairs = 0;
    for (int round = 0; round < 20000; round++) {
        const int size = 1 << rng_range(&rng, 3, 8);
        const int x = rng_range(&rng, 0, WIDTH * 16);
        const int y = rng_range(&rng, 0, HEIGHT * 16);
        raster_cut_t cut = {.below = 3, .above = 3, .line = 14};
        int32_t value[3];
        yb_spot_t p[3];
        for (int i = 0; i < 3; i++) {
            p[i].x_q4 = fix_clamp(x + rng_range(&rng, -size, size), 0, WIDTH * 16);
            p[i].y_q4 = y + rng_range(&rng, -size, size);
            p[i].near = (uint16_t)rng_range(&rng, 100, 60000);
            value[i] = rng_range(&rng, 20000, 45000);
        }
        const int32_t interval = round % 2 == 0 ? rng_range(&rng, 2000, 60000) : 0;
        const int32_t zero = round % 2 == 0 ? 0 : 30000;
        if (round % 3 == 0) {
            cut.below = cut.above = 3 | PIXELS_DRAWN;
            cut.line = 14 | PIXELS_DRAWN;
        }
        raster_shape_t shape;
        if (raster_front(&p[0], &p[1], &p[2], &shape) != RASTER_SMALL)
            continue;
        const bool cuts = round % 4 < 2 && find_lines(p, value, zero, interval, &cut);
        const raster_cut_t *const lines = cuts ? &cut : NULL;
        page_t page;
        const int rows = rng_range(&rng, 1, HEIGHT);
        const int first = rng_range(&rng, 0, HEIGHT - rows);
        open_page(&page, formats[round % 3], first, rows);
        if (!raster_clip(&page.raster, &shape))
            continue;
        raster_level(&page.raster, &shape, value_of(&page.screen, 9), lines);
        memcpy(level, pixels, sizeof pixels);
        memcpy(level_greys, greys, sizeof greys);
        open_page(&page, formats[round % 3], first, rows);
        raster_plane(&page.raster, &shape, value_of(&page.screen, 9), lines);
        assert_memory_equal(level, pixels, sizeof pixels);
        if (page.screen.format == YB_MONO)
            assert_memory_equal(level_greys, greys, (size_t)(WIDTH / 2 * rows));
        pairs++;
    }
    assert_true(pairs > 3000);
}

/* Long slivers, some of them turned over by the rounding of their corners, beside a side that runs
 * through a pixel's centre: that side is known less well than where the sliver's corners are.
 */
static void slivers_leave_no_gaps(void **state)
{
    (void)state;
    enum {
        SLIVERS = 3
    };
    rng_t rng = {48};
    int turned = 0;
    for (int round = 0; round < 20000; round++) {
        page_t page;
        open_page(&page, YB_RGB565, 0, HEIGHT);
        const int x = rng_range(&rng, 0, WIDTH - 1);
        const int y = rng_range(&rng, 0, HEIGHT - 1);
        const int aside = rng_range(&rng, -40, 40);
        const int along = rng_range(&rng, 60, 200);
        const int down = rng_range(&rng, 1, 6);
        const int up = rng_range(&rng, 1, 6);
        const yb_spot_t foot = {x * 16 + 8 + down * aside, y * 16 + 8 + down * along, 100, 0};
        yb_spot_t top[SLIVERS + 1];
        for (int i = 0; i <= SLIVERS; i++) {
            top[i] = (yb_spot_t){x * 16 + 8 - up * aside, y * 16 + 8 - up * along, 100, 0};
            if (i != round % (SLIVERS + 1)) {
                top[i].x_q4 = (yb_side_t)(top[i].x_q4 + rng_range(&rng, -2, 2));
                top[i].y_q4 = (yb_side_t)(top[i].y_q4 + rng_range(&rng, -2, 2));
            }
        }
        const bool whole = foot.y_q4 > y * 16 + 16 && top[0].y_q4 < y * 16;
        const yb_spot_t left[3] = {{-WIDTH * 16, y * 16 + 8, 100, 0}, foot, top[0]};
        const yb_spot_t right[3] = {foot, {2 * WIDTH * 16, y * 16 + 8, 100, 0}, top[SLIVERS]};
        (void)draw(&page.raster, left, 5);
        (void)draw(&page.raster, right, 5);
        for (int i = 0; i < SLIVERS; i++) {
            const yb_spot_t sliver[3] = {foot, top[i + 1], top[i]};
            turned += twice_area(&sliver[0], &sliver[1], &sliver[2]) >= 0;
            (void)draw(&page.raster, sliver, 5);
        }
        CHECK(!whole || pixel_at(&page, x, y) == 5, "round %d: a gap at (%d, %d)", round, x, y);
    }
    assert_true(turned > 10000);
}

/* What covers a pixel first stays, whatever comes after it. */
static void the_first_stays(void **state)
{
    (void)state;
    enum {
        COUNT = 8
    };
    static const yb_format_t formats[3] = {YB_RGB565, YB_GREY4, YB_MONO};
    rng_t rng = {43};
    for (int round = 0; round < 300; round++) {
        const int size = round % 2 == 0 ? WIDTH * 16 : 200; /* among them small ones */
        yb_spot_t corner[COUNT][3];
        page_t page;
        static uint16_t first[WIDTH * HEIGHT];
        memset(first, 0, sizeof first);
        for (int i = 0; i < COUNT; i++) {
            const int x = rng_range(&rng, 0, WIDTH * 16 - size);
            const int y = rng_range(&rng, 0, HEIGHT * 16 - size / 2);
            do {
                for (int k = 0; k < 3; k++)
                    corner[i][k] = (yb_spot_t){(yb_side_t)rng_range(&rng, x, x + size),
                                               (yb_side_t)rng_range(&rng, y, y + size / 2), 100, 0};
            } while (twice_area(&corner[i][0], &corner[i][1], &corner[i][2]) >= 0);
            open_page(&page, formats[round % 3], 0, HEIGHT);
            (void)draw(&page.raster, corner[i], (uint16_t)(i + 1));
            for (int k = 0; k < WIDTH * HEIGHT; k++)
                first[k] = first[k] != 0 ? first[k] : pixel_at(&page, k % WIDTH, k / WIDTH);
        }
        open_page(&page, formats[round % 3], 0, HEIGHT);
        for (int i = 0; i < COUNT; i++)
            (void)draw(&page.raster, corner[i], (uint16_t)(i + 1));
        for (int k = 0; k < WIDTH * HEIGHT; k++)
            assert_int_equal(pixel_at(&page, k % WIDTH, k / WIDTH), first[k]);
    }
}

static void huge_triangles_fit(void **state)
{
    (void)state;
    rng_t rng = {45};
    static uint8_t row[YB_MAX_SIDE * 2];
    yb_screen_t screen = {YB_MAX_SIDE, YB_MAX_SIDE, YB_RGB565};
    for (int round = 0; round < 2000; round++) {
        int y = rng_range(&rng, 0, YB_MAX_SIDE - 1);
        yb_band_t band = {(uint16_t)y, 1, row, sizeof row, NULL};
        raster_t raster = pixels_open(&screen, &band);
        pixels_clear(&raster, y, 0);
        yb_spot_t p[3];
        for (int k = 0; k < 3; k++) {
            p[k].x_q4 = rng_one_in(&rng, 2) ? -YB_MAX_SIDE * 16 : 2 * YB_MAX_SIDE * 16;
            p[k].y_q4 = rng_one_in(&rng, 2) ? -YB_MAX_SIDE * 16 : 2 * YB_MAX_SIDE * 16;
            p[k].near = (uint16_t)(rng_one_in(&rng, 2) ? 1 : 65535);
        }
        bool front = draw(&raster, p, 0xffff);
        const int64_t area = twice_area(&p[0], &p[1], &p[2]);
        assert_true(area == 0 || front == (area < 0));
    }
}

/* A value that is linear on a triangle, at a pixel's centre, and how it changes from pixel to
 * pixel.
 */
typedef struct {
    double at, along_x, along_y;
} slope_t;

static slope_t slope_of(const yb_spot_t p[3], const int32_t value[3], int x, int y)
{
    const double x1 = p[1].x_q4 - p[0].x_q4;
    const double y1 = p[1].y_q4 - p[0].y_q4;
    const double x2 = p[2].x_q4 - p[0].x_q4;
    const double y2 = p[2].y_q4 - p[0].y_q4;
    const double d1 = value[1] - value[0];
    const double d2 = value[2] - value[0];
    slope_t slope = {value[0], (d1 * y2 - d2 * y1) / (x1 * y2 - y1 * x2) * 16,
                     (d2 * x1 - d1 * x2) / (x1 * y2 - y1 * x2) * 16};
    slope.at += slope.along_x * (x + 0.5 - p[0].x_q4 / 16.0);
    slope.at += slope.along_y * (y + 0.5 - p[0].y_q4 / 16.0);
    return slope;
}

static void lines_lie_where_they_should(void **state)
{
    (void)state;
    rng_t rng = {46};
    int lines = 0;
    int doubtful = 0;
    int pixels_seen = 0;
    for (int round = 0; round < 3000; round++) {
        yb_spot_t p[3];
        raster_cut_t cut = {.below = 3, .above = round % 2 == 0 ? 3 : 9, .line = 14};
        int32_t value[3];
        for (int i = 0; i < 3; i++) {
            p[i].x_q4 = rng_range(&rng, -100, WIDTH * 16 + 100);
            p[i].y_q4 = rng_range(&rng, -100, HEIGHT * 16 + 100);
            p[i].near = (uint16_t)(rng_range(&rng, 100, 60000));
            value[i] = rng_range(&rng, 20000, 45000);
        }
        if (-twice_area(&p[0], &p[1], &p[2]) < 20000)
            continue;
        const int32_t interval = round % 2 == 0 ? rng_range(&rng, 10000, 30000) : 0;
        const int32_t zero = round % 2 == 0 ? 0 : rng_range(&rng, 20000, 45000);
        page_t page;
        open_page(&page, YB_GREY4, 0, HEIGHT);
        raster_shape_t shape;
        if (raster_front(&p[0], &p[1], &p[2], &shape) <= RASTER_BETWEEN ||
            !raster_clip(&page.raster, &shape))
            continue;
        const bool cuts = find_lines(p, value, zero, interval, &cut);
        assert_true(cuts || interval > 0);
        raster_plane(&page.raster, &shape, 5, cuts ? &cut : NULL);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            if (pixel_at(&page, i % WIDTH, i / WIDTH) == 0)
                continue;
            const slope_t slope = slope_of(p, value, i % WIDTH, i / WIDTH);
            const double half = fmax(fabs(slope.along_x), fabs(slope.along_y)) / 2;
            double off = slope.at - zero;
            if (interval > 0)
                off = remainder(off, interval);
            const int pixel = pixel_at(&page, i % WIDTH, i / WIDTH);
            pixels_seen++;
            if (interval > 0 && half > interval / 8.0 * 0.9) { /* too dense, or nearly */
                CHECK(half < interval / 8.0 * 1.1 || pixel == 5, "round %d: too dense", round);
                continue;
            }
            if (fabs(fabs(off) - half) < 4 + half / 50) {
                doubtful++;
                continue;
            }
            lines += fabs(off) < half;
            const int should = fabs(off) < half ? cut.line : off < 0 ? cut.below : cut.above;
            CHECK(pixel == should, "round %d, (%d, %d): %d, not %d", round, i % WIDTH, i / WIDTH,
                  pixel, should);
        }
    }
    print_message("%d pixels, %d of lines, %d doubtful\n", pixels_seen, lines, doubtful);
    assert_true(lines > 10000 && doubtful < pixels_seen / 20);
}

/* The more light, the more pixels: those of a darker shade stay lit. */
static void shades_become_dots(void **state)
{
    (void)state;
    static const yb_spot_t all[3] = {{-900, -900, 9, 0}, {-900, 3000, 9, 0}, {3000, -900, 9, 0}};
    uint16_t before[WIDTH * HEIGHT] = {0};
    for (uint16_t shade = 1; shade < 16; shade++) {
        page_t page;
        open_page(&page, YB_MONO, 0, HEIGHT);
        assert_true(draw(&page.raster, all, shade));
        check_guards(&page);
        int of_sixteen = 0;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const uint16_t pixel = shown_at(&page, i % WIDTH, i / WIDTH);
            of_sixteen += i / WIDTH < 4 && i % WIDTH < 4 ? pixel : 0;
            assert_true(pixel >= before[i]);
            assert_int_equal(pixel, shown_at(&page, i % WIDTH % 4, i / WIDTH % 4));
            before[i] = pixel;
        }
        assert_int_equal(of_sixteen, shade == 1 ? 0 : shade + (shade >= 8));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pixel_is_drawn_once),
        cmocka_unit_test(lines_lie_where_they_should),
        cmocka_unit_test(shades_become_dots),
        cmocka_unit_test(bands_are_parts_of_the_whole),
        cmocka_unit_test(back_faces_and_flat_ones_draw_nothing),
        cmocka_unit_test(edges_through_centres),
        cmocka_unit_test(sides_through_centres),
        cmocka_unit_test(slopes_are_nearly_exact),
        cmocka_unit_test(both_ways_are_the_same),
        cmocka_unit_test(slivers_leave_no_gaps),
        cmocka_unit_test(the_first_stays),
        cmocka_unit_test(huge_triangles_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
