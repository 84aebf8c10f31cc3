/* The decoder: bytes in, fields out, in pieces of any size; what it refuses, and as what. */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "maps.h"
#include "mesh_check.h"
#include "random_plan.h"

static yb_map_t map;
static yb_load_t load;

/* docs/SPEC.md 1.6 */
static const uint8_t worked[] = {
    0x20, 0x02, 0x03, 0x0c, 0xff, 0xff, 0x07, 0x80, 0x02, 0x80, 0x03, 0xe8, 0x07, 0x08,
    0x00, 0x0a, 0x04, 0x03, 0x01, 0x40, 0x00, 0x14, 0x40, 0x40, 0x60, 0x00, 0x18, 0xa0,
    0x00, 0x03, 0xc6, 0x06, 0x02, 0x82, 0xe4, 0x70, 0x06, 0x47, 0x06, 0xc0, 0x1f,
};

static void worked_plan(plan_t *plan)
{
    plan_init(plan, 255, 255);
    plan->shift = 2;
    plan->cell = 0x780;
    plan->unit = 0x280;
    plan->base = 1000;
    plan->seed = 7;
    plan->gain = 8;
    plan->frame_height = 10;
    plan->vertices = 12;
    const plan_point_t square[] = {{64, 64}, {160, 64}, {160, 160}, {64, 160}};
    const plan_point_t triangle[] = {{96, 96}, {136, 104}, {108, 132}};
    const plan_point_t summit = {112, 108};
    assert_true(plan_try(plan, square, 4, 20));
    assert_true(plan_try(plan, triangle, 3, 60));
    assert_true(plan_try(plan, &summit, 1, 100));
}

static void worked_example_says_what_spec_says(void **state)
{
    (void)state;
    plan_t plan;
    uint8_t bytes[PLAN_MAX_BYTES];
    worked_plan(&plan);
    assert_int_equal(plan_write(&plan, bytes), sizeof worked);
    assert_memory_equal(bytes, worked, sizeof worked);
    assert_int_equal(yb_map_load(&map, &load, worked, sizeof worked), YB_OK);
    assert_null(mesh_check(&map, &load, &plan));
    assert_int_equal(map.cell, 0x780);
    assert_int_equal(yb_unit_64th_m(map.cell), 30 * 64);
    assert_int_equal(yb_unit_64th_m(map.unit), 10 * 64);
    assert_int_equal(map.base_m, 1000);
    assert_int_equal(map.seed, 7);
    assert_int_equal(map.hurst_q8m1 + 1, 192);
    assert_true(map.smooth && map.detail);
    assert_int_equal(map.vertex[7].z_q8, (1000 * 256 + 15) / 30);
    assert_int_equal(map.vertex[8].z_q8, (100 * 256 + 15) / 30);
    assert_int_equal(map.low_q8, map.vertex[8].z_q8);
    assert_int_equal(map.high_q8, map.vertex[7].z_q8);
    assert_int_equal(load.region_count, 3);
    assert_int_equal(yb_map_height(&map, 127 * 256, 127 * 256), 4895);
    assert_int_equal(yb_map_height(&map, 10 * 256, 20 * 256), 1289);
    assert_int_equal(yb_map_height(&map, 130 * 256 + 128, 99 * 256 + 64), 5174);
    map.detail = false;
    assert_int_equal(yb_map_height(&map, 127 * 256, 127 * 256), 4852);
    assert_int_equal(yb_map_height(&map, 10 * 256, 20 * 256), 1049);
    assert_int_equal(yb_map_height(&map, 130 * 256 + 128, 99 * 256 + 64), 5175);
}

static void any_pieces_give_the_same_map(void **state)
{
    (void)state;
    rng_t rng = {11};
    for (int round = 0; round < 100; round++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_fitting_plan(&plan, &rng);
        size_t count = plan_write(&plan, bytes);
        static yb_map_t whole;
        assert_int_equal(yb_map_load(&whole, &load, bytes, count), YB_OK);
        for (size_t cut = 0; cut <= count; cut += round < 20 ? 1 : 37) {
            memset(&map, 0xa5, sizeof map);
            memset(&load, 0x5a, sizeof load);
            yb_map_begin(&map, &load);
            yb_status_t status = yb_map_feed(&map, &load, bytes, cut);
            assert_int_equal(status, cut == count ? YB_OK : YB_MORE);
            if (cut < count)
                status = yb_map_feed(&map, &load, bytes + cut, count - cut);
            assert_int_equal(status, YB_OK);
            assert_true(map_same(&map, &whole));
        }
        yb_map_begin(&map, &load);
        for (size_t i = 0; i < count; i++) {
            assert_int_equal(yb_map_feed(&map, &load, bytes + i, 1),
                             i + 1 < count ? YB_MORE : YB_OK);
            assert_int_equal(yb_map_feed(&map, &load, NULL, 0), i + 1 < count ? YB_MORE : YB_OK);
        }
        assert_int_equal(yb_map_end(&map, &load), YB_OK);
        assert_true(map_same(&map, &whole));
    }
}

static void errors_stay(void **state)
{
    (void)state;
    uint8_t longer[sizeof worked + 1] = {0};
    memcpy(longer, worked, sizeof worked);
    assert_int_equal(yb_map_load(&map, &load, longer, sizeof longer), YB_ERR_CORRUPT);
    yb_map_begin(&map, &load);
    assert_int_equal(yb_map_feed(&map, &load, worked, sizeof worked), YB_OK);
    assert_int_equal(yb_map_feed(&map, &load, worked, 0), YB_OK);
    assert_int_equal(yb_map_end(&map, &load), YB_OK);
    assert_int_equal(yb_map_feed(&map, &load, worked, 1), YB_ERR_CORRUPT);
    assert_int_equal(yb_map_feed(&map, &load, worked, sizeof worked), YB_ERR_CORRUPT);
    assert_int_equal(yb_map_end(&map, &load), YB_ERR_CORRUPT);
    yb_map_begin(&map, &load);
    assert_int_equal(yb_map_feed(&map, &load, worked, 10), YB_MORE);
    assert_int_equal(yb_map_end(&map, &load), YB_ERR_TRUNCATED);
    assert_int_equal(yb_map_feed(&map, &load, worked + 10, 31), YB_ERR_TRUNCATED);
    const uint8_t version = 0x10;
    yb_map_begin(&map, &load);
    assert_int_equal(yb_map_feed(&map, &load, &version, 1), YB_ERR_VERSION);
    assert_int_equal(yb_map_feed(&map, &load, worked, sizeof worked), YB_ERR_VERSION);
}

static void versions_and_profiles_not_known_are_said_so(void **state)
{
    (void)state;
    uint8_t bytes[sizeof worked];
    memcpy(bytes, worked, sizeof worked);
    for (int first = 0; first < 256; first++) {
        bytes[0] = (uint8_t)first;
        plan_mend(bytes, sizeof bytes);
        yb_status_t status = yb_map_load(&map, &load, bytes, sizeof bytes);
        if (first == 0x21) /* the compact profile, of which these bytes are none */
            assert_true(status == YB_ERR_CORRUPT || status == YB_ERR_TRUNCATED ||
                        status == YB_ERR_LIMIT);
        else
            assert_int_equal(status, first == 0x20 ? YB_OK : YB_ERR_VERSION);
    }
}

static void every_truncation_is_said_so(void **state)
{
    (void)state;
    rng_t rng = {12};
    for (int round = 0; round < 300; round++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_plan(&plan, &rng);
        size_t count = plan_write(&plan, bytes);
        for (size_t cut = 0; cut < count; cut++)
            assert_int_equal(yb_map_load(&map, &load, bytes, cut), YB_ERR_TRUNCATED);
    }
}

/* Also fed byte by byte: no prefix of a code with one wrong bit is taken for a whole one and then
 * held to be one at the end.
 */
static void every_flipped_bit_is_refused(void **state)
{
    (void)state;
    rng_t rng = {13};
    for (int round = 0; round < 60; round++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_plan(&plan, &rng);
        size_t count = plan_write(&plan, bytes);
        for (size_t bit = 0; bit < count * 8; bit++) {
            bytes[bit / 8] ^= (uint8_t)(0x80 >> bit % 8);
            yb_map_begin(&map, &load);
            yb_status_t status = YB_MORE;
            for (size_t i = 0; i < count; i++)
                status = yb_map_feed(&map, &load, bytes + i, 1);
            assert_int_not_equal(status, YB_OK);
            assert_true(yb_map_end(&map, &load) < 0);
            assert_true(yb_map_load(&map, &load, bytes, count) < 0);
            bytes[bit / 8] ^= (uint8_t)(0x80 >> bit % 8);
        }
    }
}

/* Two changed bits pass an eight-bit check now and then: what gets through must be sound. */
static void mended_flips_are_refused_or_sound(void **state)
{
    (void)state;
    rng_t rng = {14};
    int sound = 0;
    for (int round = 0; round < 20000; round++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        if (round % 50 == 0)
            random_plan(&plan, &rng);
        size_t count = plan_write(&plan, bytes);
        bytes[rng_range(&rng, 0, (int)count - 2)] ^= (uint8_t)(1 << rng_range(&rng, 0, 7));
        plan_mend(bytes, count);
        if (yb_map_load(&map, &load, bytes, count) != YB_OK)
            continue;
        sound++;
        plan_t none;
        plan_init(&none, 255, 255);
        assert_null(mesh_check_tiling(&map, &none));
    }
    print_message("%d of 20000 changed codes are maps\n", sound);
    assert_true(sound > 1000 && sound < 19000);
}

static void header_rules(void **state)
{
    (void)state;
    static const struct {
        int at;
        uint8_t value;
    } bad[] = {{1, 0x0a}, {3, 3}, {3, 0}, {3, 11}, {4, 0}, {5, 0}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        uint8_t bytes[sizeof worked];
        memcpy(bytes, worked, sizeof worked);
        bytes[bad[i].at] = bad[i].value;
        plan_mend(bytes, sizeof bytes);
        assert_int_equal(yb_map_load(&map, &load, bytes, sizeof bytes), YB_ERR_CORRUPT);
    }
    for (int at = 6; at <= 8; at += 2) {
        uint8_t bytes[sizeof worked];
        memcpy(bytes, worked, sizeof worked);
        bytes[at] = 0xf0; /* no mantissa */
        bytes[at + 1] = 0;
        plan_mend(bytes, sizeof bytes);
        assert_int_equal(yb_map_load(&map, &load, bytes, sizeof bytes), YB_ERR_CORRUPT);
    }
}

static void padding_must_be_zero(void **state)
{
    (void)state;
    for (int bit = 0; bit < 4; bit++) {
        uint8_t bytes[sizeof worked];
        memcpy(bytes, worked, sizeof worked);
        bytes[sizeof worked - 2] |= (uint8_t)(1 << bit);
        plan_mend(bytes, sizeof bytes);
        assert_int_equal(yb_map_load(&map, &load, bytes, sizeof bytes), YB_ERR_CORRUPT);
    }
}

/* Heights up to 512 steps and not a unit more; the largest cell and unit do not overflow. */
static void heights_have_a_limit(void **state)
{
    (void)state;
    static const struct {
        int cell, unit, height;
        yb_status_t status;
        int32_t z_q8;
    } cases[] = {
        {64, 64, 512, YB_OK, 131072},
        {64, 64, 513, YB_ERR_CORRUPT, 0},
        {256, 1, 65535, YB_OK, 65535},
        {0xffff, 0xffff, 512, YB_OK, 131072},
        {1, 0xffff, 65535, YB_ERR_CORRUPT, 0},
        {1, 0xffff, 0, YB_OK, 0},
        {0xffff, 1, 65535, YB_OK, 0},
        {0x3fff, 1, 65535, YB_OK, 512},
        {2 * 512, 1, 2, YB_OK, 1},
        {2 * 513, 1, 2, YB_OK, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (int where = 0; where < 3; where++) {
            plan_t plan;
            uint8_t bytes[PLAN_MAX_BYTES];
            plan_init(&plan, 255, 255);
            plan.cell = cases[i].cell;
            plan.unit = cases[i].unit;
            const plan_point_t spot = {100, 100};
            assert_true(plan_add(&plan, &spot, 1, where == 0 ? cases[i].height : 0));
            if (where == 1)
                plan.frame_height = cases[i].height;
            if (where == 2)
                plan.corner_height[3] = cases[i].height;
            size_t count = plan_write(&plan, bytes);
            assert_int_equal(yb_map_load(&map, &load, bytes, count), cases[i].status);
            if (cases[i].status == YB_OK)
                assert_int_equal(map.vertex[where == 0 ? 0 : 4].z_q8, cases[i].z_q8);
        }
    }
}

static void the_flat_map_is_a_map(void **state)
{
    (void)state;
    plan_t plan;
    uint8_t bytes[PLAN_MAX_BYTES];
    plan_init(&plan, 1, 255);
    plan.frame_height = 3;
    size_t count = plan_write(&plan, bytes);
    assert_int_equal(count, 14 + 2 + 1 + 1);
    assert_int_equal(yb_map_load(&map, &load, bytes, count), YB_OK);
    assert_null(mesh_check(&map, &load, &plan));
    assert_int_equal(map.triangle_count, 2);
    assert_int_equal(yb_map_height(&map, 77, 9999), 3 * 256);
    plan.vertices = 4;
    count = plan_write(&plan, bytes);
    assert_int_equal(yb_map_load(&map, &load, bytes, count), YB_OK);
}

static void steps_reach_as_far_as_their_shift(void **state)
{
    (void)state;
    for (int shift = 0; shift < 4; shift++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        plan_init(&plan, 255, 255);
        plan.shift = shift;
        int up = 31 << shift;
        int down = up < 253 - (32 << shift) ? 32 << shift : 1 << shift;
        const plan_point_t line[] = {{1, 254}, {1 + up, 254 - (1 << shift)}, {1, 254 - down}};
        assert_true(plan_add(&plan, line, 3, 9));
        size_t count = plan_write(&plan, bytes);
        yb_status_t expected =
            plan_valid(&plan) && plan_codable(&plan, 255) ? YB_OK : YB_ERR_CORRUPT;
        assert_int_equal(yb_map_load(&map, &load, bytes, count), expected);
        if (expected == YB_OK)
            assert_null(mesh_check(&map, &load, &plan));
    }
}

static void statuses_have_words(void **state)
{
    (void)state;
    for (int i = -10; i < 10; i++)
        assert_true(strlen(yb_status_text((yb_status_t)i)) > 1);
    assert_string_not_equal(yb_status_text(YB_ERR_CORRUPT), yb_status_text(YB_ERR_LIMIT));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(worked_example_says_what_spec_says),
        cmocka_unit_test(any_pieces_give_the_same_map),
        cmocka_unit_test(errors_stay),
        cmocka_unit_test(versions_and_profiles_not_known_are_said_so),
        cmocka_unit_test(every_truncation_is_said_so),
        cmocka_unit_test(every_flipped_bit_is_refused),
        cmocka_unit_test(mended_flips_are_refused_or_sound),
        cmocka_unit_test(header_rules),
        cmocka_unit_test(padding_must_be_zero),
        cmocka_unit_test(heights_have_a_limit),
        cmocka_unit_test(the_flat_map_is_a_map),
        cmocka_unit_test(steps_reach_as_far_as_their_shift),
        cmocka_unit_test(statuses_have_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
