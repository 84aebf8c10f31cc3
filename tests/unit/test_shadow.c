/* Cast shadows against rays that are followed from the ground towards the sun. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "maps.h"
#include "plan.h"
#include "random_plan.h"
#include "rng.h"
#include "shadow.h"

enum {
    SIDE = 64
};

static yb_map_t map;
static yb_load_t load;
static uint8_t lit[YB_SHADOW_BYTES(256)];
static uint8_t work[YB_SHADOW_WORK(256)];

static void load_plan(const plan_t *plan)
{
    uint8_t bytes[PLAN_MAX_BYTES];
    assert_int_equal(yb_map_load(&map, &load, bytes, plan_write(plan, bytes)), YB_OK);
}

static double ground_at(const yb_view_t *view, double x, double y)
{
    int32_t z = yb_map_height(&map, (uint16_t)x, (uint16_t)y);
    z = z > view->water_q8 ? z : view->water_q8;
    return z * (view->exaggerate_q8 / 256.0);
}

/* How far the way from a place to the sun clears the ground, at least, in 1/256 step; negative: it
 * is in shadow.
 */
static double clearance(const yb_view_t *view, double x, double y)
{
    const double flat = hypot(view->sun_q14[0], view->sun_q14[1]);
    const double ahead_x = view->sun_q14[0] / flat;
    const double ahead_y = view->sun_q14[1] / flat;
    const double rise = view->sun_q14[2] / flat;
    const double from = ground_at(view, x, y);
    double least = (double)INFINITY;
    /* The first cell's worth of ground is left out: it is what the cell itself is. */
    for (double way = 1500; way < 100000; way += 200) {
        double at_x = x + ahead_x * way;
        double at_y = y + ahead_y * way;
        if (at_x < 0 || at_y < 0 || at_x > map.east_q8 || at_y > map.north_q8)
            break;
        least = fmin(least, from + rise * way - ground_at(view, at_x, at_y));
    }
    return least;
}

static bool is_lit(const yb_shadow_t *shadow, int i, int j)
{
    int at = j * shadow->side + i;
    return (shadow->lit[at / 8] >> (at % 8) & 1) != 0;
}

static void cells_agree_with_rays(void **state)
{
    (void)state;
    rng_t rng = {501};
    int dark = 0;
    int asked = 0;
    int wrong = 0;
    for (int round = 0; round < 160; round++) {
        plan_t plan;
        random_fitting_plan(&plan, &rng);
        plan.gain = 0; /* without detail, which a grid of cells knows only in part */
        load_plan(&plan);
        yb_view_t view;
        yb_view_init(&view, &map);
        yb_view_sun(&view, (uint16_t)rng_range(&rng, 0, 65535),
                    (uint16_t)rng_range(&rng, 1000, 8000));
        if (rng_one_in(&rng, 2))
            view.exaggerate_q8 = 512;
        if (rng_one_in(&rng, 2))
            view.water_q8 = rng_range(&rng, map.low_q8, map.high_q8);
        yb_shadow_t shadow = {.side = SIDE, .lit = lit};
        yb_shadow_cast(&map, &view, &shadow, work);
        /* Heights have 7 to 8 bits, and a ray is blended from cell to cell. */
        const double doubtful =
            (map.high_q8 - map.low_q8) * (view.exaggerate_q8 / 256.0) / 24 + 200;
        for (int j = 0; j < shadow.rows; j++) {
            for (int i = 0; i < shadow.columns; i++) {
                double clear = clearance(&view, i * 1024 + 512, j * 1024 + 512);
                if (fabs(clear) < doubtful)
                    continue;
                asked++;
                dark += clear < 0;
                wrong += is_lit(&shadow, i, j) != (clear > 0);
            }
        }
    }
    print_message("%d cells, %d of them dark, %d wrong\n", asked, dark, wrong);
    assert_true(asked > 50000 && dark > asked / 20);
    assert_true(wrong * 200 < asked);
}

static void suns_that_cast_none(void **state)
{
    (void)state;
    rng_t rng = {502};
    plan_t plan;
    random_fitting_plan(&plan, &rng);
    load_plan(&plan);
    yb_view_t view;
    yb_view_init(&view, &map);
    static const int elevations[] = {90, 0};
    for (unsigned side = 16; side <= 256; side *= 2) {
        for (int k = 0; k < 2; k++) {
            yb_shadow_t shadow = {.side = (uint16_t)side, .lit = lit};
            yb_view_sun(&view, YB_DEGREES(100), YB_DEGREES(elevations[k]));
            memset(lit, 0x5a, sizeof lit);
            yb_shadow_cast(&map, &view, &shadow, work);
            for (size_t i = 0; i < YB_SHADOW_BYTES(side); i++)
                assert_int_equal(lit[i], k == 0 ? 0xff : 0);
            for (size_t i = YB_SHADOW_BYTES(side); i < sizeof lit; i++)
                assert_int_equal(lit[i], 0x5a);
        }
    }
}

/* Level ground lies in no shadow of its own, at the lowest sun either. */
static void level_ground_is_lit(void **state)
{
    (void)state;
    rng_t rng = {503};
    plan_t plan;
    random_fitting_plan(&plan, &rng);
    load_plan(&plan);
    yb_view_t view;
    yb_view_init(&view, &map);
    view.water_q8 = map.high_q8 + 20000; /* above all detail */
    for (int round = 0; round < 100; round++) {
        yb_shadow_t shadow = {.side = SIDE, .lit = lit};
        yb_view_sun(&view, (uint16_t)rng_range(&rng, 0, 65535),
                    (uint16_t)rng_range(&rng, 1, 16000));
        yb_shadow_cast(&map, &view, &shadow, work);
        for (int i = 0; i < shadow.columns; i++) {
            for (int j = 0; j < shadow.rows; j++)
                assert_true(is_lit(&shadow, i, j));
        }
        assert_int_equal(shadow_light(&shadow, map.east_q8, map.north_q8), 64);
    }
}

/* Any sun, scale and water at all: the sanitizers look on. */
static void any_view_at_all(void **state)
{
    (void)state;
    rng_t rng = {504};
    for (int round = 0; round < 1600; round++) {
        if (round % 8 == 0) {
            plan_t plan;
            random_fitting_plan(&plan, &rng);
            load_plan(&plan);
        }
        yb_view_t view;
        yb_view_init(&view, &map);
        for (int i = 0; i < 3; i++)
            view.sun_q14[i] = (int16_t)(rng_one_in(&rng, 4) ? rng_range(&rng, -2, 2)
                                                            : rng_range(&rng, -32768, 32767));
        view.exaggerate_q8 = (uint16_t)rng_range(&rng, 0, 2048);
        if (rng_one_in(&rng, 2))
            view.water_q8 = rng_range(&rng, INT32_MIN, INT32_MAX);
        yb_shadow_t shadow = {.side = (uint16_t)(16 << rng_range(&rng, 0, 4)), .lit = lit};
        yb_shadow_cast(&map, &view, &shadow, work);
    }
}

static void light_is_blended(void **state)
{
    (void)state;
    memset(lit, 0, sizeof lit);
    lit[0] = 1; /* the south-western cell */
    yb_shadow_t shadow = {.side = SIDE, .lit = lit, .columns = SIDE, .rows = SIDE};
    assert_int_equal(shadow_light(&shadow, 0, 0), 64); /* beyond its middle: as there */
    assert_int_equal(shadow_light(&shadow, 512, 512), 64);
    assert_int_equal(shadow_light(&shadow, 1024, 512), 32);
    assert_int_equal(shadow_light(&shadow, 1024, 1024), 16);
    assert_int_equal(shadow_light(&shadow, 1536, 512), 0);
    assert_int_equal(shadow_light(&shadow, 65535, 65535), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_agree_with_rays), cmocka_unit_test(suns_that_cast_none),
        cmocka_unit_test(level_ground_is_lit),   cmocka_unit_test(any_view_at_all),
        cmocka_unit_test(light_is_blended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
