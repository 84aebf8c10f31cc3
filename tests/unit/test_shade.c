/* Light, haze and colours against floating point. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "colour.h"
#include "cosine.h"
#include "maps.h"
#include "plan.h"
#include "random_plan.h"
#include "rng.h"
#include "shade.h"

static yb_map_t map;
static yb_load_t load;
static yb_frame_t frame;
static yb_view_t view;

static void begin(yb_format_t format)
{
    const yb_screen_t screen = {128, 64, format};
    yb_frame_begin(&frame, &map, &view, &screen);
}

static int load_map(void **state)
{
    (void)state;
    rng_t rng = {601};
    plan_t plan;
    uint8_t bytes[PLAN_MAX_BYTES];
    random_fitting_plan(&plan, &rng);
    assert_int_equal(yb_map_load(&map, &load, bytes, plan_write(&plan, bytes)), YB_OK);
    map.smooth = true;
    return 0;
}

static int start_view(void **state)
{
    (void)state;
    yb_view_init(&view, &map);
    return 0;
}

/* A triangle, counter-clockwise, with slopes at its corners. */
static void random_triangle(rng_t *rng, yb_point_t p[3], int least_log2, int most_log2)
{
    const int size = 1 << rng_range(rng, least_log2, most_log2);
    const int height = size << rng_range(rng, 0, 2);
    for (;;) {
        int32_t x[3];
        int32_t y[3];
        for (int i = 0; i < 3; i++) {
            x[i] = rng_range(rng, 0, size);
            y[i] = rng_range(rng, 0, size);
            p[i].place = (uint32_t)(20000 + y[i]) << 16 | (uint32_t)(20000 + x[i]);
            p[i].z_q8 = p[i].top_q8 = rng_range(rng, 1000, 1000 + height);
            p[i].slope = (uint32_t)(rng_range(rng, -YB_MAX_SLOPE_Q11, YB_MAX_SLOPE_Q11) + 32768)
                             << 16 |
                         (uint32_t)(rng_range(rng, -YB_MAX_SLOPE_Q11, YB_MAX_SLOPE_Q11) + 32768);
            p[i].spot = (yb_spot_t){100, 100, 5000, 0};
        }
        const int32_t area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
        if (area > size * size / 16)
            return;
    }
}

/* What a shade would be if numbers had no ends. */
static double true_shade(const yb_point_t p[3])
{
    const double scale = view.exaggerate_q8 / 256.0;
    double d[2][3];
    for (int i = 0; i < 2; i++) {
        d[i][0] = (double)(p[i + 1].place & 0xffff) - (p[0].place & 0xffff);
        d[i][1] = (double)(p[i + 1].place >> 16) - (p[0].place >> 16);
        d[i][2] = (p[i + 1].top_q8 - p[0].top_q8) * scale;
    }
    double n[3] = {d[0][1] * d[1][2] - d[0][2] * d[1][1], d[0][2] * d[1][0] - d[0][0] * d[1][2],
                   d[0][0] * d[1][1] - d[0][1] * d[1][0]};
    if (map.smooth) {
        double east = 0;
        double north = 0;
        for (int i = 0; i < 3; i++) {
            east += ((p[i].slope & 0xffff) - 32768.0) / 2048 / 3 * scale;
            north += ((p[i].slope >> 16) - 32768.0) / 2048 / 3 * scale;
        }
        n[0] -= n[2] * 0.75 * east;
        n[1] -= n[2] * 0.75 * north;
        n[2] *= 1.75;
    }
    double dot = 0;
    for (int i = 0; i < 3; i++)
        dot += n[i] * view.sun_q14[i] / 16384.0;
    const double cosine = dot / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return fmin(DARKEST + fmax(cosine, 0) * (SHADES - DARKEST) + 0.25, SHADES - 1);
}

static void light_is_lamberts(void **state)
{
    (void)state;
    rng_t rng = {602};
    double worst = 0;
    for (int round = 0; round < 20000; round++) {
        yb_point_t p[3];
        const yb_point_t *const corner[3] = {&p[0], &p[1], &p[2]};
        map.smooth = rng_one_in(&rng, 2);
        view.exaggerate_q8 = (uint16_t)(rng_one_in(&rng, 2) ? 256 : 8 * rng_range(&rng, 8, 100));
        yb_view_sun(&view, (uint16_t)rng_range(&rng, 0, 65535),
                    (uint16_t)rng_range(&rng, 500, 16384));
        begin(YB_GREY4);
        random_triangle(&rng, p, 4, 15);
        const double shade = shade_pixel(shade_ground(&frame, corner));
        frame.looks |= LOOK_ODD; /* there might be a lamp, or water */
        assert_int_equal(shade_pixel(shade_ground(&frame, corner)), (int)shade);
        /* Rounded down, so between the truth and one below it. */
        const double off = fabs(shade + 0.5 - true_shade(p));
        worst = off > worst ? off : worst;
        CHECK(off < 0.5 + 0.05, "triangle %d has shade %g, not %g", round, shade, true_shade(p));
    }
    map.smooth = true;
    print_message("shades are within %.3f of the truth, rounded down\n", worst - 0.5);
}

/* The shade of the square of a cosine: the greatest that begins no later. */
static int exact_shade(uint64_t square, uint64_t whole_q12)
{
    int shade = DARKEST;
    while (shade + 1 < SHADES && square >= whole_q12 * COSINE_LEAST(shade + 1))
        shade++;
    return shade;
}

static void check_cosine(uint32_t number, uint32_t whole_q12)
{
    const int shade = exact_shade((uint64_t)number * number, whole_q12);
    CHECK(cosine_divided(number, whole_q12) == shade && cosine_searched(number, whole_q12) == shade,
          "%u^2 over %u has shades %d and %d, not %d", number, whole_q12,
          (int)cosine_divided(number, whole_q12), (int)cosine_searched(number, whole_q12), shade);
}

/* Both ways from a cosine to a shade agree, around all beginnings of shades and a little above 1.
 */
static void cosines_have_their_shades(void **state)
{
    (void)state;
    rng_t rng = {606};
    for (int round = 0; round < 20000; round++) {
        const int bits = rng_range(&rng, 8, 17);
        const uint32_t least = (uint32_t)1 << bits;
        const uint32_t whole = least + (uint32_t)rng_range(&rng, 0, (int)least - 1);
        const uint32_t one = (uint32_t)sqrt(4096.0 * whole);
        for (uint32_t shade = DARKEST + 1; shade <= SHADES; shade++) {
            const uint32_t from = shade < SHADES ? COSINE_LEAST(shade) : 4096;
            const uint32_t number = (uint32_t)sqrt((double)from * whole);
            for (uint32_t n = number > 2 ? number - 2 : 0; n <= number + 2 && n < 32768; n++)
                check_cosine(n, whole);
        }
        check_cosine(0, whole);
        check_cosine((uint32_t)rng_range(&rng, 0, (int)fmin(one + one / 256, 32767)), whole);
    }
}

/* A lamp far away in the sun's direction lights as the sun does, one nearby as it stands. */
static void a_lamp_shines_from_its_place(void **state)
{
    (void)state;
    rng_t rng = {605};
    view.lamp = true;
    begin(YB_GREY4);
    int beside = 0;
    for (int round = 0; round < 4000; round++) {
        yb_point_t p[3];
        const yb_point_t *const corner[3] = {&p[0], &p[1], &p[2]};
        random_triangle(&rng, p, 7, 13);
        const int32_t way[3] = {rng_range(&rng, -9000, 9000), rng_range(&rng, -9000, 9000),
                                rng_range(&rng, 100, 9000)};
        const double length =
            sqrt((double)way[0] * way[0] + (double)way[1] * way[1] + (double)way[2] * way[2]);
        const int32_t at[3] = {(int32_t)(p[0].place & 0xffff), (int32_t)(p[0].place >> 16),
                               p[0].top_q8};
        for (int i = 0; i < 3; i++) {
            frame.view.lamp_q8[i] = at[i] + way[i];
            frame.view.sun_q14[i] = (int16_t)lround(way[i] / length * 16384);
        }
        frame.view.lamp = true;
        const int by_lamp = shade_pixel(shade_ground(&frame, corner));
        frame.view.lamp = false;
        const int by_sun = shade_pixel(shade_ground(&frame, corner));
        assert_true(abs(by_lamp - by_sun) <= 1);
        beside += by_lamp != by_sun;
    }
    assert_true(beside < 100);
}

static void shadows_dim_and_never_hide(void **state)
{
    (void)state;
    rng_t rng = {603};
    static uint8_t lit[YB_SHADOW_BYTES(64)];
    yb_shadow_t shadow = {.side = 64, .columns = 64, .rows = 64, .lit = lit};
    view.shadow = &shadow;
    begin(YB_GREY4);
    int darker = 0;
    for (int round = 0; round < 2000; round++) {
        yb_point_t p[3];
        const yb_point_t *const corner[3] = {&p[0], &p[1], &p[2]};
        random_triangle(&rng, p, 7, 13);
        frame.view.shadow = NULL;
        const int plain = shade_pixel(shade_ground(&frame, corner));
        frame.view.shadow = &shadow;
        memset(lit, 0xff, sizeof lit);
        assert_int_equal(shade_pixel(shade_ground(&frame, corner)), plain);
        memset(lit, 0, sizeof lit);
        const int dark = shade_pixel(shade_ground(&frame, corner));
        assert_in_range(dark, DARKEST, plain);
        assert_true(plain < DARKEST + 2 || dark < plain);
        darker += dark < plain;
    }
    assert_true(darker > 500);
}

static int sum_of(uint16_t pixel)
{
    return (pixel >> 11) * 2 + (pixel >> 5 & 63) + (pixel & 31) * 2;
}

static void haze_takes_over_with_distance(void **state)
{
    (void)state;
    view.haze_q8 = 20000;
    for (int palette = 0; palette < YB_PALETTES; palette++) {
        view.palette = (yb_palette_t)palette;
        begin(YB_RGB565);
        const int32_t from = frame.haze_near;
        assert_true(from > 100);
        const uint16_t clear = colour_pixel(&frame, 3, 9, 0);
        assert_int_equal(colour_pixel(&frame, 3, 9, from), clear);
        assert_int_equal(colour_pixel(&frame, 3, 9, 65535), clear);
        const uint16_t all_haze = colour_pixel(&frame, HUE_HAZE, SHADES - 1, 0);
        int before = abs(sum_of(clear) - sum_of(all_haze));
        for (int32_t near = from; near > 0; near -= from / 60) {
            const int off = abs(sum_of(colour_pixel(&frame, 3, 9, near)) - sum_of(all_haze));
            assert_true(off <= before + 4);
            before = off;
        }
        assert_true(before <= 6);
    }
    view.haze_q8 = 0;
    begin(YB_RGB565);
    assert_int_equal(colour_pixel(&frame, 3, 9, 1), colour_pixel(&frame, 3, 9, 60000));
}

static void palettes_have_their_shades(void **state)
{
    (void)state;
    for (int palette = 0; palette < YB_PALETTES; palette++) {
        view.palette = (yb_palette_t)palette;
        begin(YB_RGB565);
        for (int hue = 0; hue < HUES; hue++) {
            int different = 1;
            for (int shade = DARKEST + 1; shade < SHADES; shade++) {
                const uint16_t pixel = colour_pixel(&frame, hue, shade, 0);
                const uint16_t darker = colour_pixel(&frame, hue, shade - 1, 0);
                assert_true(sum_of(pixel) >= sum_of(darker));
                different += pixel != darker;
            }
            /* At night some of them fall together in 16 bits. */
            assert_true(different >= (palette == YB_PALETTE_NIGHT ? 8 : 14));
        }
        /* Ground, water, line and shore can be told apart. */
        for (int hue = 0; hue < HUES; hue++)
            assert_int_not_equal(colour_pixel(&frame, hue, 9, 0),
                                 colour_pixel(&frame, HUE_WATER, 9, 0));
        assert_int_not_equal(colour_pixel(&frame, HUE_SHORE, 15, 0),
                             colour_pixel(&frame, HUE_WATER, 9, 0));
    }
}

static void the_sky_has_no_steps(void **state)
{
    (void)state;
    view.look_q8[2] = view.eye_q8[2]; /* the horizon in the middle */
    begin(YB_RGB565);
    for (int row = 4; row < 64; row++)
        assert_true(abs(sum_of(colour_sky(&frame, row)) - sum_of(colour_sky(&frame, row - 4))) <=
                    24);
    assert_true(sum_of(colour_sky(&frame, 0)) + 20 < sum_of(colour_sky(&frame, 63)));
    begin(YB_MONO);
    assert_int_equal(colour_sky(&frame, 0), 0);
}

/* Seen from above, a step of the plan on 32 pixels. The change of height per pixel, in the
 * direction of x or of y where it is more.
 */
static double see_from_above(yb_point_t p[3])
{
    double x[3];
    double y[3];
    for (int i = 0; i < 3; i++) {
        p[i].spot.x_q4 = (yb_side_t)(2 * ((int32_t)(p[i].place & 0xffff) - 20000));
        p[i].spot.y_q4 = (yb_side_t)(-2 * ((int32_t)(p[i].place >> 16) - 20000));
        x[i] = (p[i].spot.x_q4 - p[0].spot.x_q4) / 16.0;
        y[i] = (p[i].spot.y_q4 - p[0].spot.y_q4) / 16.0;
    }
    const double area = x[1] * y[2] - y[1] * x[2];
    const double rise_b = p[1].z_q8 - p[0].z_q8;
    const double rise_c = p[2].z_q8 - p[0].z_q8;
    return fmax(fabs(rise_b * y[2] - rise_c * y[1]), fabs(rise_c * x[1] - rise_b * x[2])) /
           fabs(area);
}

/* How far a cut's value at a point is from that of the point's height, in intervals. */
static double off_at(const raster_cut_t *cut, const yb_point_t *p, int32_t interval)
{
    const double turn = 4294967296.0;
    const double value = cut->at - cut->width / 2.0 + cut->along_x * (p->spot.x_q4 / 16.0 - 0.5) +
                         cut->along_y * (p->spot.y_q4 / 16.0 - 0.5);
    return fabs(remainder(value / turn - (double)p->z_q8 / interval, 1));
}

static void lines_stand_out(void **state)
{
    (void)state;
    rng_t rng = {604};
    int lines = 0;
    view.contour_q8 = 300;
    for (int format = YB_GREY4; format <= YB_MONO; format++) {
        begin((yb_format_t)format);
        for (int round = 0; round < 3000; round++) {
            yb_point_t p[3];
            const yb_point_t *const corner[3] = {&p[0], &p[1], &p[2]};
            raster_cut_t cut;
            random_triangle(&rng, p, 7, 13);
            const double steepest = see_from_above(p);
            const shade_t shade = shade_ground(&frame, corner);
            const uint16_t pixel = shade_pixel(shade);
            bool crossed = false;
            for (int i = 0; i < 3; i++)
                crossed = crossed || p[i].z_q8 / 300 != p[0].z_q8 / 300;
            const bool cuts = shade_cut(&frame, corner, shade, &cut);
            const bool close = steepest > 300 / 4.0; /* too close together */
            assert_true(cuts || !crossed || close || steepest > 300 / 4.0 * 0.99);
            assert_true(!cuts || !close || steepest < 300 / 4.0 * 1.01);
            if (!cuts)
                continue;
            lines++;
            for (int i = 0; i < 3; i++)
                assert_true(off_at(&cut, &p[i], 300) < 0.02);
            assert_int_equal(cut.above, pixel);
            assert_int_not_equal(cut.line, pixel);
        }
    }
    assert_true(lines > 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(light_is_lamberts, start_view),
        cmocka_unit_test(cosines_have_their_shades),
        cmocka_unit_test_setup(a_lamp_shines_from_its_place, start_view),
        cmocka_unit_test_setup(shadows_dim_and_never_hide, start_view),
        cmocka_unit_test_setup(haze_takes_over_with_distance, start_view),
        cmocka_unit_test_setup(palettes_have_their_shades, start_view),
        cmocka_unit_test_setup(the_sky_has_no_steps, start_view),
        cmocka_unit_test_setup(lines_stand_out, start_view),
    };
    return cmocka_run_group_tests(tests, load_map, NULL);
}
