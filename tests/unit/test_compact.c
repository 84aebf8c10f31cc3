/* The compact profile: the same maps as the paper profile's, what is refused, and as what; the
 * models, steps and runs that encoder and decoder share.
 */
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "code.h"
#include "compact_plan.h"
#include "maps.h"
#include "mesh_check.h"
#include "model.h"
#include "random_plan.h"

static yb_map_t map;
static yb_load_t load;

/* 15 m a step, 1 m a unit, V = 255 */
static const compact_head_t plain = {.cell_exponent = 2,
                                     .cell_mantissa = 224,
                                     .spacing = 1,
                                     .unit_exponent = 2,
                                     .interval = 1,
                                     .dimension = 8,
                                     .gain = 6,
                                     .vertices = 7};

/* --- Codes ------------------------------------------------------------------------------------ */

/* A square, a triangle in it and a summit. */
static void small_plan(plan_t *plan)
{
    const plan_point_t square[] = {{64, 64}, {160, 64}, {160, 160}, {64, 160}};
    const plan_point_t triangle[] = {{96, 96}, {136, 104}, {108, 132}};
    const plan_point_t across[] = {{0, 200}, {99, 231}, {255, 190}};
    const plan_point_t summit = {112, 108};
    plan_init(plan, 255, 255);
    plan->frame_height = 10;
    plan->seed = 99;
    assert_true(plan_add(plan, square, 4, 200));
    assert_true(plan_add(plan, triangle, 3, 600));
    assert_true(plan_add(plan, across, 3, 100));
    assert_true(plan_add(plan, &summit, 1, 1000));
}

/* One that both profiles can say; its head too. */
static void random_compact_plan(plan_t *plan, compact_head_t *head, rng_t *rng)
{
    *head = plain;
    head->cell_exponent = rng_range(rng, 1, 4);
    head->cell_mantissa = rng_range(rng, 0, 255);
    head->unit_mantissa = rng_range(rng, 0, 15);
    head->base = 64 * rng_range(rng, -60, 60);
    head->dimension = rng_range(rng, 0, 31);
    head->gain = rng_range(rng, 0, 15);
    plan_init(plan, 255, 255);
    compact_head_of_plan(head, plan);
    plan->seed = rng_range(rng, 0, 127);
    plan->straight = rng_one_in(rng, 3);
    plan->frame_height = rng_range(rng, 0, 99);
    for (int i = rng_range(rng, 0, 9); i > 0 && plan->points < 150; i--) {
        int height = rng_range(rng, 0, 300);
        plan_point_t p = {rng_range(rng, 1, 254), rng_range(rng, 1, 254)};
        if (rng_one_in(rng, 3))
            (void)random_open_line(plan, rng, height);
        else if (rng_one_in(rng, 2))
            (void)shape_blob(plan, rng, p.x, p.y, rng_range(rng, 2, 120), height);
        else
            (void)plan_try(plan, &p, 1, height);
    }
    if (rng_one_in(rng, 2))
        plan->corner_height[1] = 77;
    if (!plan_valid(plan))
        plan->corner_height[1] = -1;
    compact_sort(plan);
}

static size_t random_code(uint8_t *code, rng_t *rng)
{
    plan_t plan;
    compact_head_t head;
    random_compact_plan(&plan, &head, rng);
    return compact_write(&plan, &head, code);
}

/* All at once, and byte by byte: the answer, which must be the same, or an answer nobody gives. */
static yb_status_t load_both(const uint8_t *code, size_t count)
{
    static yb_map_t whole;
    yb_status_t status = yb_map_load(&whole, &load, code, count);
    yb_map_begin(&map, &load);
    yb_status_t fed = YB_MORE;
    for (size_t i = 0; i < count && fed >= 0; i++)
        fed = yb_map_feed(&map, &load, code + i, 1);
    if (yb_map_end(&map, &load) != status || (status == YB_OK && !map_same(&map, &whole)))
        return YB_MORE;
    return status;
}

static void both_profiles_say_the_same(void **state)
{
    (void)state;
    rng_t rng = {21};
    int maps = 0;
    for (int round = 0; round < 1000; round++) {
        plan_t plan;
        compact_head_t head;
        static yb_map_t paper;
        uint8_t code[COMPACT_MOST_BYTES];
        random_compact_plan(&plan, &head, &rng);
        plan.vertices = 255;
        size_t count = plan_write(&plan, code);
        yb_status_t status = yb_map_load(&paper, &load, code, count);
        count = compact_write(&plan, &head, code);
        assert_int_equal(load_both(code, count), status);
        assert_true(status != YB_OK || map_same(&map, &paper));
        maps += status == YB_OK ? 1 : 0;
    }
    assert_true(maps > 900);
}

static void header_elements(void **state)
{
    (void)state;
    plan_t plan;
    uint8_t code[COMPACT_MOST_BYTES];
    plan_init(&plan, 70, 250);
    plan.straight = true;
    plan.seed = 127;
    compact_head_t head = {.cell_exponent = 0,
                           .cell_mantissa = 255,
                           .spacing = 10,
                           .unit_exponent = 3,
                           .unit_mantissa = 5,
                           .interval = 4,
                           .base = -1001,
                           .dimension = 31,
                           .gain = 15,
                           .vertices = 0};
    assert_int_equal(load_both(code, compact_write(&plan, &head, code)), YB_OK);
    assert_int_equal(map.east_q8, 70 * 256);
    assert_int_equal(map.north_q8, 250 * 256);
    assert_int_equal(yb_unit_64th_m(map.cell), 255);
    assert_int_equal(yb_unit_64th_m(map.unit), 21 * 8);
    assert_int_equal(map.base_m, -2628); /* -2627.625 */
    assert_int_equal(map.seed, 127);
    assert_int_equal(map.hurst_q8m1 + 1, 256 - 248);
    assert_false(map.smooth);
    assert_int_equal(load.vertices_promised, 32);
    assert_int_equal(map.vertex[0].z_q8, (24 * 256 + 127) / 255); /* what rounding cut off */
    head.cell_mantissa = 0;
    assert_int_equal(load_both(code, compact_write(&plan, &head, code)), YB_ERR_CORRUPT);
}

static void base_has_a_range(void **state)
{
    (void)state;
    plan_t plan;
    uint8_t code[COMPACT_MOST_BYTES];
    static const struct {
        int exponent, base, metres;
    } cases[] = {{2, 32766, 32766},   {2, -32766, -32766}, {3, 16383, 32766}, {3, 16384, 0},
                 {3, -16384, -32768}, {3, -16385, 0},      {0, -1, -1},       {15, 3, 24576},
                 {15, 4, 0},          {15, -4, -32768},    {15, -32766, 0}};
    small_plan(&plan);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        compact_head_t head = plain;
        head.cell_exponent = 15;
        head.unit_exponent = cases[i].exponent;
        head.base = cases[i].base;
        size_t count = compact_write(&plan, &head, code);
        assert_int_equal(load_both(code, count), cases[i].metres != 0 ? YB_OK : YB_ERR_CORRUPT);
        if (cases[i].metres != 0)
            assert_int_equal(map.base_m, cases[i].metres);
    }
}

/* --- What is refused -------------------------------------------------------------------------- */

static void every_truncation_is_said_so(void **state)
{
    (void)state;
    rng_t rng = {22};
    for (int round = 0; round < 300; round++) {
        uint8_t code[COMPACT_MOST_BYTES];
        size_t count = random_code(code, &rng);
        for (size_t cut = 0; cut < count; cut++)
            assert_int_equal(yb_map_load(&map, &load, code, cut), YB_ERR_TRUNCATED);
    }
}

static void every_flipped_bit_is_refused(void **state)
{
    (void)state;
    rng_t rng = {23};
    for (int round = 0; round < 60; round++) {
        uint8_t code[COMPACT_MOST_BYTES];
        size_t count = random_code(code, &rng);
        for (size_t bit = 0; bit < count * 8; bit++) {
            code[bit / 8] ^= (uint8_t)(0x80 >> bit % 8);
            assert_true(load_both(code, count) < 0);
            code[bit / 8] ^= (uint8_t)(0x80 >> bit % 8);
        }
    }
}

/* Before a point is read. */
static void too_many_vertices_are_refused_at_once(void **state)
{
    (void)state;
    plan_t plan;
    small_plan(&plan);
    for (int vertices = 0; vertices < 16; vertices++) {
        uint8_t code[COMPACT_MOST_BYTES];
        compact_head_t head = plain;
        head.vertices = vertices;
        size_t count = compact_write(&plan, &head, code);
        bool fits = vertices <= 7;
        assert_int_equal(load_both(code, count), fits ? YB_OK : YB_ERR_LIMIT);
        if (fits)
            continue;
        assert_int_equal(load.point_count, 0);
        assert_int_equal(yb_map_load(&map, &load, code, 12), YB_ERR_LIMIT);
    }
}

static void points_beyond_the_promise_are_corrupt(void **state)
{
    (void)state;
    compact_head_t head = plain;
    head.vertices = 0;
    for (int spots = 20; spots < 40; spots++) {
        plan_t plan;
        uint8_t code[COMPACT_MOST_BYTES];
        plan_init(&plan, 255, 255);
        for (int i = 0; i < spots; i++) {
            plan_point_t p = {7 + i * 6, 100 + i * i % 31};
            assert_true(plan_add(&plan, &p, 1, i));
        }
        compact_sort(&plan);
        size_t count = compact_write(&plan, &head, code);
        yb_status_t status = load_both(code, count);
        assert_true(spots > 28 ? status == YB_ERR_CORRUPT
                               : status == YB_OK || status == YB_ERR_LIMIT);
        assert_true(load.point_count <= 32);
    }
}

/* A frame of two spacings has one column of places: as many passed as 16 bits count once led back
 * to the first ones.
 */
static void no_spot_height_beyond_the_last_place(void **state)
{
    (void)state;
    for (int more = 0; more < 2000; more++) {
        static compact_pen_t pen;
        plan_t plan;
        uint8_t code[COMPACT_MOST_BYTES];
        plan_init(&plan, 2, 255);
        compact_begin_code(&pen);
        compact_put_head(&pen, &plain, &plan);
        compact_number(&pen, MODEL_LINES, 0);
        compact_bit(&pen, MODEL_CORNER, true);
        compact_difference(&pen, MODEL_CORNER_HEIGHT, MODEL_CORNER_DOWN, 5);
        for (int k = 1; k < 4; k++)
            compact_bit(&pen, MODEL_CORNER, false);
        compact_number(&pen, MODEL_SPOTS, 1);
        for (int i = 0; i < more; i++)
            compact_bit(&pen, MODEL_GAP, true);
        compact_bit(&pen, MODEL_GAP, false);
        compact_one_of(&pen, gap_run(254, 1), 80);
        compact_difference(&pen, MODEL_SPOT_HEIGHT, MODEL_SPOT_DOWN, -9);
        size_t count = compact_end_code(&pen, 0, NULL, 0, code);
        int place = more * (int)gap_run(254, 1) + 80;
        assert_int_equal(load_both(code, count), place < 254 ? YB_OK : YB_ERR_CORRUPT);
        if (place < 254)
            assert_int_equal(map.vertex[0].y_q8, (1 + place) * 256);
    }
}

/* 512 steps, 7680 m here; differences may add up to far more. */
static void heights_have_a_limit(void **state)
{
    (void)state;
    static const int rises[] = {32, 7680, 7681, 7936, 32766};
    for (size_t k = 0; k < sizeof rises / sizeof *rises; k++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            plan_t plan;
            uint8_t code[COMPACT_MOST_BYTES];
            compact_head_t head = plain;
            head.interval = k < 4 ? 1 : 8;
            plan_init(&plan, 255, 255);
            for (int i = 0; i < 60; i++) {
                plan_point_t triangle[] = {{8 + 4 * i, 9}, {9 + 4 * i, 9}, {8 + 4 * i, 10}};
                int height = sign * (k < 4 ? rises[k] : (i + 1) * rises[k] * 8);
                assert_true(plan_add(&plan, triangle, 3, height));
            }
            plan.frame_height = plan.contour[0].height;
            size_t count = compact_write(&plan, &head, code);
            yb_status_t status = load_both(code, count);
            assert_int_equal(status, rises[k] <= 7680 ? YB_OK : YB_ERR_CORRUPT);
        }
    }
}

/* Corners between line ends below the base. */
static void the_frame_may_lie_below_the_base(void **state)
{
    (void)state;
    plan_t plan;
    uint8_t code[COMPACT_MOST_BYTES];
    const plan_point_t line[] = {{0, 85}, {100, 100}, {85, 0}};
    plan_init(&plan, 255, 255);
    assert_true(plan_add(&plan, line, 3, -90));
    plan.corner_height[1] = -261;
    assert_int_equal(load_both(code, compact_write(&plan, &plain, code)), YB_OK);
    /* In q8 steps of 15 m: -90 m is -1536, -261 m is -4454. */
    assert_int_equal(map.vertex[0].z_q8, -1536);
    for (int i = 3; i < 7; i++) {
        bool south_west = map.vertex[i].x_q8 == 0 && map.vertex[i].y_q8 == 0;
        assert_true(map.vertex[i].z_q8 >= -4454 && map.vertex[i].z_q8 <= -1536);
        assert_true(!south_west || map.vertex[i].z_q8 == -1536);
    }
}

static void sections_are_skipped(void **state)
{
    (void)state;
    static const struct {
        uint8_t bytes[8];
        size_t count;
    } good[] = {{{0x80}, 1},
                {{0xf0}, 1},
                {{0x9f, 0, 2, 40, 200}, 5},
                {{0x92, 40, 200}, 3},
                {{0x03, 1, 2, 3, 0x0f, 0, 0, 0x80}, 8}};
    for (size_t k = 0; k < sizeof good / sizeof *good; k++) {
        static compact_pen_t pen;
        plan_t plan;
        uint8_t code[COMPACT_MOST_BYTES];
        plan_init(&plan, 255, 255);
        compact_begin_code(&pen);
        compact_put_head(&pen, &plain, &plan);
        compact_number(&pen, MODEL_LINES, 0);
        for (int i = 0; i < 4; i++)
            compact_bit(&pen, MODEL_CORNER, false);
        compact_number(&pen, MODEL_CORNER_HEIGHT, 0);
        compact_number(&pen, MODEL_SPOTS, 0);
        size_t count = compact_end_code(&pen, 3, good[k].bytes, good[k].count, code);
        assert_int_equal(load_both(code, count), YB_OK);
        assert_int_equal(load.relief_size, count - 1 - good[k].count);
        assert_int_equal(map.certified_error, k == 2 || k == 3 ? 40 : 0);
        assert_int_equal(map.certified_k, k == 2 || k == 3 ? 200 : 0);
        for (size_t cut = 0; cut < count; cut++)
            assert_int_equal(yb_map_load(&map, &load, code, cut), YB_ERR_TRUNCATED);
    }
}

/* A million bytes; half of them after the true beginning of a code. */
static void random_bytes_are_refused_or_sound(void **state)
{
    (void)state;
    rng_t rng = {24};
    int sound = 0;
    int codes = 0;
    for (size_t total = 0; total < 1000000; codes++) {
        uint8_t code[COMPACT_MOST_BYTES] = {0x21};
        size_t count = (size_t)rng_range(&rng, 2, 300);
        size_t kept = rng_one_in(&rng, 2) ? random_code(code, &rng) : 1;
        kept = kept == 1 ? 1 : (size_t)rng_range(&rng, 6, (int)kept - 1);
        int fill = rng_range(&rng, 0, 9);
        for (size_t i = kept; i < count; i++)
            code[i] = (uint8_t)(fill == 0 ? 0 : fill == 1 ? 255 : rng_range(&rng, 0, 255));
        /* Where the relief ends, if it does, the check may stand. */
        yb_map_begin(&map, &load);
        for (size_t i = 0; i < count && load.relief_size == 0; i++) {
            if (yb_map_feed(&map, &load, code + i, 1) < 0)
                break;
        }
        if (load.relief_size != 0 && load.relief_size < count)
            count = load.relief_size + 1u;
        plan_mend(code, count);
        yb_status_t status = load_both(code, count);
        assert_true(status <= YB_OK && status != YB_ERR_VERSION);
        total += count;
        if (status != YB_OK)
            continue;
        sound++;
        plan_t none;
        plan_init(&none, 255, 255);
        none.east = map.east_q8 >> 8;
        none.north = map.north_q8 >> 8;
        assert_null(mesh_check_tiling(&map, &none));
    }
    print_message("%d of %d codes of random bytes are maps\n", sound, codes);
    assert_true(codes > 5000 && sound > 10);
}

/* --- What encoder and decoder share ----------------------------------------------------------- */

static void rings_and_steps_are_inverse(void **state)
{
    (void)state;
    for (int dx = -255; dx <= 255; dx++) {
        for (int dy = -255; dy <= 255; dy++) {
            if (dx == 0 && dy == 0)
                continue;
            yb_ring_t ring = ring_of(dx, dy);
            int x, y;
            assert_true(ring.place >= 0 && ring.place < 8 * ring.length);
            ring_step(ring, &x, &y);
            assert_int_equal(x, dx);
            assert_int_equal(y, dy);
        }
    }
    for (int n = 1; n <= 255; n++) { /* neighbours in number are neighbours in place */
        int x, y;
        ring_step((yb_ring_t){n, 8 * n - 1}, &x, &y);
        for (int place = 0; place < 8 * n; place++) {
            int dx, dy;
            ring_step((yb_ring_t){(int16_t)n, (int16_t)place}, &dx, &dy);
            assert_int_equal(abs(dx - x) + abs(dy - y), 1);
            assert_int_equal(ring_ahead((yb_ring_t){(int16_t)n, (int16_t)place}, n),
                             place + 8 * n - n / 2);
            x = dx;
            y = dy;
        }
    }
}

static void models_stay_within_their_bounds(void **state)
{
    (void)state;
    static const uint32_t ranges[] = {1 << 16, (1 << 16) + 1, (1 << 16) + 4095, 1 << 20,
                                      (1 << 24) - 1};
    for (int start = 0; start < MODELS; start++)
        assert_true(model_first(start) >= 31 && model_first(start) <= 65504);
    for (int model = 31; model <= 65504; model++) {
        for (int bit = 0; bit < 2; bit++) {
            int next = model_learn((uint16_t)model, bit);
            assert_true(next >= 31 && next <= 65504);
            assert_true(bit == 1 ? next <= model : next >= model);
        }
        for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
            uint32_t bound = model_bound((uint16_t)model, ranges[i]);
            assert_true(bound > 0 && bound < ranges[i]);
        }
    }
    assert_int_equal(model_learn(31, 1), 31);
    assert_int_equal(model_learn(65504, 0), 65504);
}

static void runs_stay_within_their_bounds(void **state)
{
    (void)state;
    for (uint32_t points = 1; points <= 254 * 254; points += points < 500 ? 1 : 97) {
        for (uint32_t spots = 1; spots <= 32766; spots += spots < 100 ? 1 : 331) {
            uint32_t run = gap_run(points, spots);
            uint32_t exact = 11 * points / (16 * (spots + 1));
            assert_true(run >= 1 && run <= 4096);
            assert_true(run == exact || (exact == 0 && run == 1) || (exact > 4096 && run == 4096));
            assert_true(run <= points);
        }
    }
    assert_int_equal(gap_run(254 * 254, 1), 4096);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_profiles_say_the_same),
        cmocka_unit_test(header_elements),
        cmocka_unit_test(base_has_a_range),
        cmocka_unit_test(every_truncation_is_said_so),
        cmocka_unit_test(every_flipped_bit_is_refused),
        cmocka_unit_test(too_many_vertices_are_refused_at_once),
        cmocka_unit_test(points_beyond_the_promise_are_corrupt),
        cmocka_unit_test(no_spot_height_beyond_the_last_place),
        cmocka_unit_test(heights_have_a_limit),
        cmocka_unit_test(the_frame_may_lie_below_the_base),
        cmocka_unit_test(sections_are_skipped),
        cmocka_unit_test(random_bytes_are_refused_or_sound),
        cmocka_unit_test(rings_and_steps_are_inverse),
        cmocka_unit_test(models_stay_within_their_bounds),
        cmocka_unit_test(runs_stay_within_their_bounds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
