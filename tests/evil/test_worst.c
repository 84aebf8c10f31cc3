/* Codes made to cost as much as can be, and rubbish. Whatever comes is decided in bounded time. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "mesh_check.h"
#include "random_plan.h"

static yb_map_t map;
static yb_load_t load;

enum {
    MOST_MS = 1000
}; /* generous: sanitizers, slow machines; a PC needs a few */

static double slowest_ms;

static double load_ms(const uint8_t *bytes, size_t count, yb_status_t *status)
{
    clock_t start = clock();
    *status = yb_map_load(&map, &load, bytes, count);
    return 1000.0 * (double)(clock() - start) / CLOCKS_PER_SEC;
}

static void load_within_bounds(const plan_t *plan, const char *name)
{
    uint8_t bytes[PLAN_MAX_BYTES];
    size_t count = plan_write(plan, bytes);
    assert_true(plan_codable(plan, 255));
    assert_true(count <= YB_MAX_CODE_BYTES);
    yb_status_t status;
    double took = load_ms(bytes, count, &status);
    print_message("%-30s %4d bytes, %3d vertices: %.2f ms%s\n", name, (int)count, map.vertex_count,
                  took, status == YB_ERR_LIMIT ? ", too large" : "");
    assert_true(status == YB_OK || status == YB_ERR_LIMIT);
    assert_true(took < MOST_MS);
    slowest_ms = fmax(slowest_ms, took);
    if (status == YB_ERR_LIMIT)
        return;
    const char *wrong = mesh_check(&map, &load, plan);
    CHECK(wrong == NULL, "%s: %s", name, wrong);
}

/* --- Points ----------------------------------------------------------------------------------- */

static void spots_on_a_grid(plan_t *plan)
{
    for (int i = 0; i < 251; i++) {
        const plan_point_t p = {10 + i % 16 * 14, 10 + i / 16 * 14};
        assert_true(plan_try(plan, &p, 1, 1 + i));
    }
}

static void spots_in_a_row(plan_t *plan)
{
    for (int i = 0; i < 251; i++) {
        const plan_point_t p = {1 + (i * 97) % 254, 127};
        (void)plan_try(plan, &p, 1, 1 + i);
    }
}

/* Along a parabola in order: every new point sees all those before it. */
static void spots_on_a_parabola(plan_t *plan)
{
    for (int i = 0; i < 251; i++) {
        const plan_point_t p = {2 + i, 1 + i * i / 250};
        assert_true(plan_try(plan, &p, 1, 1 + i));
    }
}

static void spots_on_circles(plan_t *plan)
{
    for (int r = 5; plan->points < 245; r += 5) {
        static const int ring[12][2] = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                        {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
        for (int i = 0; i < 12 && plan->points < 251; i++) {
            const plan_point_t p = {127 + ring[i][0] * r / 5, 127 + ring[i][1] * r / 5};
            (void)plan_try(plan, &p, 1, 1 + plan->points);
        }
    }
}

/* --- Lines ------------------------------------------------------------------------------------ */

static void one_comb(plan_t *plan)
{
    assert_true(shape_comb(plan, 2, 100, 60, 2, 31, 10));
}

static void zigzag_across(plan_t *plan)
{
    plan_point_t line[251];
    int count = 0;
    for (int x = 0; x <= 250; x++)
        line[count++] = (plan_point_t){x, x % 2 == 0 ? 100 : 131};
    plan->east = 250;
    assert_true(plan_try(plan, line, count, 5));
}

/* Long straight lines with spots close to both sides: each line has a long channel. */
static void lines_through_clouds(plan_t *plan)
{
    plan->shift = 3;
    plan->east = 248;
    for (int i = 0; i < 190; i++) {
        int on = 1 + i * 246 / 190;
        const plan_point_t p = {on, 8 + i * 37 % 238};
        (void)plan_try(plan, &p, 1, 300 + plan->points);
    }
    for (int y = 4; y < 250 && plan->points < 250; y += 8) {
        const plan_point_t line[2] = {{0, y}, {248, y}};
        (void)plan_try(plan, line, 2, y);
    }
}

static void slanted_lines_through_a_cloud(plan_t *plan)
{
    plan->shift = 3;
    plan->east = plan->north = 248;
    for (int i = 0; i < 28; i++) {
        const plan_point_t line[2] = {{0, i * 8}, {248, i * 8 + 24}};
        (void)plan_try(plan, line, 2, i);
    }
    rng_t rng = {93};
    for (int tries = 0; tries < 20000 && plan->points < 251; tries++) {
        plan_point_t p;
        p.x = rng_range(&rng, 1, 247);
        p.y = rng_range(&rng, 1, 247);
        (void)plan_try(plan, &p, 1, 300 + plan->points);
    }
}

static void as_many_open_lines_as_fit(plan_t *plan)
{
    plan->shift = 3;
    plan->north = 248;
    for (int x = 1; x < 255 && plan->points < 248; x += 2) {
        const plan_point_t line[2] = {{x, 0}, {x, 248}};
        assert_true(plan_try(plan, line, 2, x));
    }
}

static void open_lines_between_all_sides(plan_t *plan)
{
    plan->shift = 3;
    plan->east = plan->north = 248;
    for (int i = 1; i < 31 && plan->points < 246; i++) {
        const plan_point_t corners[4][2] = {{{8 * i, 0}, {0, 8 * i}},
                                            {{8 * i, 248}, {0, 248 - 8 * i}},
                                            {{248 - 8 * i, 0}, {248, 8 * i}},
                                            {{248 - 8 * i, 248}, {248, 248 - 8 * i}}};
        for (int k = 0; k < 4; k++)
            (void)plan_try(plan, corners[k], 2, i);
    }
}

static void squares_side_by_side(plan_t *plan)
{
    for (int i = 0; i < 46; i++) {
        int x = 3 + i % 8 * 31;
        int y = 3 + i / 8 * 31;
        const plan_point_t ring[] = {{x, y}, {x + 30, y}, {x + 30, y + 30}, {x, y + 30}};
        assert_true(plan_try(plan, ring, 4, i));
    }
}

static void squares_in_each_other(plan_t *plan)
{
    plan->shift = 2;
    for (int i = 0; i < 31; i++) {
        int a = 3 + 4 * i;
        const plan_point_t ring[] = {{a, 127}, {127, a}, {254 - a, 127}, {127, 254 - a}};
        assert_true(plan_try(plan, ring, 4, i));
    }
}

static void a_spiral(plan_t *plan)
{
    plan_point_t line[251];
    int count = 0;
    plan->shift = 1;
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < 125; i++) {
            int k = side == 0 ? i : 124 - i;
            double angle = 10 + k * 0.42;
            double r = 2.2 * (angle - 10) + 6 + side * 6;
            line[count].x = 127 + 2 * (int)lround(r / 2 * cos(angle));
            line[count].y = 127 + 2 * (int)lround(r / 2 * sin(angle));
            count++;
        }
    }
    if (!plan_try(plan, line, count, 9))
        (void)plan_try(plan, line, 125, 9);
}

/* --- What the rules have to think about ------------------------------------------------------- */

/* One line round everything, in steps of 31. */
static void frame_all(plan_t *plan, int height)
{
    static const plan_point_t way[4] = {{31, 0}, {0, 31}, {-31, 0}, {0, -31}};
    plan_point_t ring[32];
    plan_point_t at = {1, 1};
    for (int i = 0; i < 32; i++) {
        ring[i] = at;
        at.x += way[i / 8].x;
        at.y += way[i / 8].y;
    }
    assert_true(plan_try(plan, ring, 32, height));
}

/* Peaks side by side in one parent; every pair of them may be joined. */
static void many_peaks(plan_t *plan, int count, int pitch, bool summits)
{
    for (int i = 0; i < count; i++) {
        int x = 4 + i % 8 * pitch;
        int y = 4 + i / 8 * pitch;
        const plan_point_t ring[] = {{x, y}, {x + 8, y}, {x + 8, y + 8}};
        const plan_point_t spot = {x + 6, y + 2};
        assert_true(plan_try(plan, ring, 3, 40));
        if (summits)
            assert_true(plan_try(plan, &spot, 1, 50 + i));
    }
}

static void sibling_triangles(plan_t *plan)
{
    many_peaks(plan, 48, 30, false);
}

static void sibling_triangles_with_summits(plan_t *plan)
{
    many_peaks(plan, 44, 30, true);
}

static void few_siblings(plan_t *plan)
{
    many_peaks(plan, 24, 30, true);
}

/* Two arms of a bow with one line in each and as many summits in that as fit: every pair of them is
 * tried, and not one can be joined.
 */
static void summits_in_two_arms(plan_t *plan, int each)
{
    plan->shift = 3;
    plan->frame_height = 0;
    const plan_point_t bow[] = {{1, 1},    {249, 1},  {249, 249}, {145, 249},
                                {145, 17}, {105, 17}, {105, 249}, {1, 249}};
    const plan_point_t west[] = {{9, 25}, {97, 25}, {97, 241}, {9, 241}};
    const plan_point_t east[] = {{153, 25}, {241, 25}, {241, 241}, {153, 241}};
    assert_true(plan_try(plan, bow, 8, 20));
    assert_true(plan_try(plan, west, 4, 40));
    assert_true(plan_try(plan, east, 4, 40));
    for (int i = 0; i < 2 * each; i++) {
        plan_point_t p = {16 + i / 2 % 9 * 8 + i % 2 * 144, 36 + i / 2 / 9 * 16};
        assert_true(plan_try(plan, &p, 1, 60 + i));
    }
}

static void many_summits_in_two_arms(plan_t *plan)
{
    summits_in_two_arms(plan, 105);
}

static void some_summits_in_two_arms(plan_t *plan)
{
    summits_in_two_arms(plan, 30);
}

/* Rings of one height, the innermost first: each has to wait for the next one outside. */
static void nest(plan_t *plan, int rings, int points)
{
    plan->shift = 3;
    for (int i = 0; i < rings; i++) {
        int a = 123 - 4 * i;
        int b = 131 + 4 * i;
        const plan_point_t ring[] = {{a, a}, {b, a}, {b, b}, {a, b}};
        assert_true(plan_try(plan, ring, 4, 40));
    }
    rng_t rng = {96};
    for (int tries = 0; tries < 5000 && plan->points < points; tries++) {
        const plan_point_t p = {rng_range(&rng, 1, 254), rng_range(&rng, 248, 254)};
        (void)plan_try(plan, &p, 1, 50 + tries % 100);
    }
}

static void nest_of_one_height(plan_t *plan)
{
    nest(plan, 24, 130);
}

static void larger_nest_of_one_height(plan_t *plan)
{
    nest(plan, 29, 200);
}

/* Rings of rising height with the spots in the innermost: every ring looks at all of them. */
static void nest_round_summits(plan_t *plan)
{
    plan->shift = 3;
    for (int i = 0; i < 20; i++) {
        int a = 7 + 4 * i;
        int b = 247 - 4 * i;
        const plan_point_t ring[] = {{a, a}, {b, a}, {b, b}, {a, b}};
        assert_true(plan_try(plan, ring, 4, 20 + i));
    }
    rng_t rng = {98};
    for (int tries = 0; tries < 9000 && plan->points < 230; tries++) {
        const plan_point_t p = {rng_range(&rng, 85, 169), rng_range(&rng, 85, 169)};
        (void)plan_try(plan, &p, 1, 400 + tries % 300);
    }
}

/* One line of many points against one summit, or one parent: deep teeth, no point sees far. */
static void comb_in_a_parent(plan_t *plan)
{
    frame_all(plan, 20);
    assert_true(shape_comb(plan, 4, 100, 48, 5, 31, 40));
}

static void comb_with_summit(plan_t *plan)
{
    frame_all(plan, 20);
    assert_true(shape_comb(plan, 4, 100, 30, 8, 31, 40));
    const plan_point_t spot = {20, 101};
    (void)plan_try(plan, &spot, 1, 60);
}

static void star_of_120(plan_t *plan)
{
    plan_point_t line[120];
    plan->shift = 0;
    for (int i = 0; i < 120; i++) {
        double angle = i * 6.283185307 / 120;
        double r = i % 2 == 0 ? 120 : 100;
        line[i].x = 127 + (int)lround(r * cos(angle));
        line[i].y = 127 + (int)lround(r * sin(angle));
    }
    assert_true(plan_try(plan, line, 120, 40));
}

/* Spot heights and lines, half and half. */
static void spots_among_peaks(plan_t *plan)
{
    frame_all(plan, 20);
    many_peaks(plan, 20, 30, true);
    rng_t rng = {97};
    for (int tries = 0; tries < 20000 && plan->points < 190; tries++) {
        const plan_point_t p = {rng_range(&rng, 2, 248), rng_range(&rng, 2, 248)};
        (void)plan_try(plan, &p, 1, 25 + tries % 60);
    }
}

/* As many summits as fit behind few lines, all of which can be joined. */
static void summits_by_the_dozen(plan_t *plan)
{
    const plan_point_t parent[] = {{1, 1}, {249, 1}, {249, 249}, {1, 249}};
    plan->shift = 3;
    assert_true(plan_try(plan, parent, 4, 20));
    for (int i = 0; i < 4; i++) {
        int x = 9 + i % 2 * 120;
        int y = 9 + i / 2 * 120;
        const plan_point_t ring[] = {{x, y}, {x + 104, y}, {x + 104, y + 104}, {x, y + 104}};
        assert_true(plan_try(plan, ring, 4, 40));
        for (int k = 0; k < 40; k++) {
            const plan_point_t p = {x + 8 + k % 8 * 12, y + 8 + k / 8 * 12};
            assert_true(plan_try(plan, &p, 1, 60 + k));
        }
    }
}

static void the_worst_legal_codes_are_loaded_in_time(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        void (*make)(plan_t *plan);
    } worst[] = {
        {"spots on a grid", spots_on_a_grid},
        {"spots in a row", spots_in_a_row},
        {"spots on a parabola", spots_on_a_parabola},
        {"spots on circles", spots_on_circles},
        {"one comb", one_comb},
        {"a zigzag across", zigzag_across},
        {"lines through clouds", lines_through_clouds},
        {"slanted lines in a cloud", slanted_lines_through_a_cloud},
        {"open lines", as_many_open_lines_as_fit},
        {"open lines round corners", open_lines_between_all_sides},
        {"squares side by side", squares_side_by_side},
        {"squares in each other", squares_in_each_other},
        {"a spiral", a_spiral},
        {"24 peaks", few_siblings},
        {"44 peaks with summits", sibling_triangles_with_summits},
        {"48 triangles", sibling_triangles},
        {"60 summits in two arms", some_summits_in_two_arms},
        {"160 summits behind four lines", summits_by_the_dozen},
        {"a nest of one height", nest_of_one_height},
        {"a larger nest of one height", larger_nest_of_one_height},
        {"a nest round summits", nest_round_summits},
        {"a comb in a parent", comb_in_a_parent},
        {"a comb of 60 and a summit", comb_with_summit},
        {"a star", star_of_120},
        {"spots among peaks", spots_among_peaks},
        {"210 summits in two arms", many_summits_in_two_arms},
    };
    for (size_t i = 0; i < sizeof worst / sizeof *worst; i++) {
        plan_t plan;
        plan_init(&plan, 255, 255);
        worst[i].make(&plan);
        load_within_bounds(&plan, worst[i].name);
    }
}

static void full_random_maps_are_loaded_in_time(void **state)
{
    (void)state;
    rng_t rng = {94};
    int full = 0;
    double worst = 0;
    for (int round = 0; full < 300 && round < 100000; round++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_plan(&plan, &rng);
        if (plan_vertices(&plan) < 200)
            continue;
        full++;
        yb_status_t status;
        worst = fmax(worst, load_ms(bytes, plan_write(&plan, bytes), &status));
        assert_true(status == YB_OK || status == YB_ERR_LIMIT);
    }
    print_message("%d random maps of 200 vertices and more: up to %.2f ms\n", full, worst);
    assert_true(worst < MOST_MS);
}

/* --- Rubbish ---------------------------------------------------------------------------------- */

static void rubbish_is_refused_or_sound(void **state)
{
    (void)state;
    rng_t rng = {95};
    int count_of[5] = {0};
    for (int round = 0; round < 300000; round++) {
        uint8_t bytes[64];
        size_t count = (size_t)rng_range(&rng, 1, 64);
        for (size_t i = 0; i < count; i++)
            bytes[i] = (uint8_t)rng_next(&rng);
        bytes[0] = rng_one_in(&rng, 20) ? bytes[0] : 0x20;
        if (count > 14) { /* a header that gets somewhere */
            bytes[1] &= 0xf7;
            bytes[2] %= 6;
            bytes[8] &= 0x0f;
            bytes[6] |= 0x04;
            for (size_t i = 16; i < count && i < 24; i++)
                bytes[i] = rng_one_in(&rng, 2) ? (uint8_t)(bytes[i] % 5) : bytes[i];
        }
        plan_mend(bytes, count);
        yb_status_t status = yb_map_load(&map, &load, bytes, count);
        assert_in_range(status + 4, 0, 4);
        count_of[status + 4]++;
        if (status == YB_OK) {
            plan_t none;
            plan_init(&none, 255, 255);
            assert_null(mesh_check_tiling(&map, &none));
        }
    }
    print_message("limit %d, version %d, corrupt %d, truncated %d, ok %d\n", count_of[0],
                  count_of[1], count_of[2], count_of[3], count_of[4]);
    assert_true(count_of[1] > 1000 && count_of[2] > 1000 && count_of[3] > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_worst_legal_codes_are_loaded_in_time),
        cmocka_unit_test(full_random_maps_are_loaded_in_time),
        cmocka_unit_test(rubbish_is_refused_or_sound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
