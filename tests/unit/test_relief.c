/* The surface of an edge: symmetric, bounded, as rough as the code says. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "relief.c"

#include "loaded_map.h"
#include "split.h"

/* --- The midpoint ----------------------------------------------------------------------------- */

static yb_vertex_t random_vertex(rng_t *rng, bool extreme)
{
    yb_vertex_t v = {
        .x_q8 = (uint16_t)(rng_range(rng, 0, 65280 / 2) * 2),
        .y_q8 = (uint16_t)(rng_range(rng, 0, 65280 / 2) * 2),
        .z_q8 = rng_range(rng, -200000, 400000),
        .gx_q11 = (int16_t)rng_range(rng, -YB_MAX_SLOPE_Q11, YB_MAX_SLOPE_Q11),
        .gy_q11 = (int16_t)rng_range(rng, -YB_MAX_SLOPE_Q11, YB_MAX_SLOPE_Q11),
    };
    if (extreme) {
        v.x_q8 = rng_one_in(rng, 2) ? 0 : 65280;
        v.y_q8 = rng_one_in(rng, 2) ? 0 : 65280;
        v.z_q8 = rng_one_in(rng, 2) ? -400000 : 400000;
        v.gx_q11 = rng_one_in(rng, 2) ? -YB_MAX_SLOPE_Q11 : YB_MAX_SLOPE_Q11;
        v.gy_q11 = rng_one_in(rng, 2) ? -YB_MAX_SLOPE_Q11 : YB_MAX_SLOPE_Q11;
    }
    return v;
}

static void a_midpoint_is_the_same_from_both_ends(void **state)
{
    (void)state;
    rng_t rng = {21};
    for (int i = 0; i < 500000; i++) {
        if (i % 1000 == 0) {
            plan_t plan;
            random_fitting_plan(&plan, &rng);
            load_plan(&plan);
            map.smooth = !rng_one_in(&rng, 4);
            if (rng_one_in(&rng, 3)) {
                for (int c = 0; c < YB_LENGTH_CLASSES; c++)
                    map.noise[c] = (uint16_t)rng_range(&rng, 0, 65535);
            }
        }
        yb_vertex_t a = random_vertex(&rng, i % 7 == 0);
        yb_vertex_t b = random_vertex(&rng, i % 7 == 0);
        yb_vertex_t forth;
        yb_vertex_t back;
        memset(&forth, 0, sizeof forth);
        memset(&back, 0, sizeof back);
        relief_middle(&map, &a, &b, &forth);
        relief_middle(&map, &b, &a, &back);
        assert_memory_equal(&forth, &back, sizeof forth);
        assert_int_equal(2 * forth.x_q8, a.x_q8 + b.x_q8);
        assert_int_equal(2 * forth.y_q8, a.y_q8 + b.y_q8);
        assert_int_equal(relief_class(b.x_q8 - a.x_q8, b.y_q8 - a.y_q8),
                         relief_class(a.x_q8 - b.x_q8, a.y_q8 - b.y_q8));
    }
}

static void noise_keeps_to_the_gravity_limit(void **state)
{
    (void)state;
    rng_t rng = {22};
    plan_t plan;
    plan_init(&plan, 255, 255);
    load_plan(&plan);
    int limited = 0;
    for (int i = 0; i < 300000; i++) {
        for (int c = 0; c < YB_LENGTH_CLASSES; c++)
            map.noise[c] = (uint16_t)(i % 3 == 0 ? 65535 : 20 * c);
        yb_vertex_t a = random_vertex(&rng, false);
        yb_vertex_t b = random_vertex(&rng, false);
        b.x_q8 = (uint16_t)fix_clamp(a.x_q8 + 2 * rng_range(&rng, -2000, 2000), 0, 65280);
        b.y_q8 = (uint16_t)fix_clamp(a.y_q8 + 2 * rng_range(&rng, -2000, 2000), 0, 65280);
        b.z_q8 = a.z_q8 + rng_range(&rng, -6000, 6000);
        yb_vertex_t rough;
        yb_vertex_t smooth;
        map.detail = true;
        relief_middle(&map, &a, &b, &rough);
        map.detail = false;
        relief_middle(&map, &a, &b, &smooth);
        int32_t length = fix_length(b.x_q8 - a.x_q8, b.y_q8 - a.y_q8);
        int32_t most = length - abs(b.z_q8 - a.z_q8) / 2;
        int32_t moved = abs(rough.z_q8 - smooth.z_q8);
        assert_true(moved <= (most < 0 ? 0 : most));
        limited += moved == most;
    }
    assert_true(limited > 1000);
}

/* What is said of all noise of a scale holds for each, at any class and rise. */
static void noise_that_is_not_looked_at_keeps_to_its_limit(void **state)
{
    (void)state;
    rng_t rng = {26};
    int kept = 0;
    for (int i = 0; i < 1000000; i++) {
        int class = rng_range(&rng, 0, 61);
        int32_t length = (int32_t)1 << (class >> 2);
        int32_t scale = rng_range(&rng, 0, 65535) % (3 * length);
        int32_t rise = rng_range(&rng, -4 * length, 4 * length);
        if (!relief_keeps_all(scale, class, rise))
            continue;
        kept++;
        uint32_t place = (uint32_t)rng_next(&rng);
        assert_true(relief_keeps(relief_shake(scale, place, 0), class, rise));
        assert_true(relief_keeps(scale, class, rise) && relief_keeps(-scale, class, rise));
    }
    assert_true(kept > 100000);
}

static void ways_are_differences(void **state)
{
    (void)state;
    rng_t rng = {27};
    for (int i = 0; i < 100000; i++) {
        yb_vertex_t a = random_vertex(&rng, i % 7 == 0);
        yb_vertex_t b = random_vertex(&rng, i % 7 == 0);
        const uint32_t middle = relief_half_way(relief_place(&a), relief_place(&b));
        const uint32_t half = middle - relief_place(&a);
        assert_int_equal(2 * relief_way_x(half), b.x_q8 - a.x_q8);
        assert_int_equal(2 * relief_way_y(half), b.y_q8 - a.y_q8);
        const int32_t bend_x = a.gx_q11 - b.gx_q11;
        const int32_t bend_y = a.gy_q11 - b.gy_q11;
        assert_int_equal(relief_half_bulge(bend_x, bend_y, relief_way_x(half), relief_way_y(half)),
                         relief_bulge(bend_x, bend_y, b.x_q8 - a.x_q8, b.y_q8 - a.y_q8));
    }
}

/* --- The noise -------------------------------------------------------------------------------- */

/* Of the sum of four bytes less its mean, cut to ±RELIEF_HASH_MOST: from its whole distribution. */
static double deviation_of_four_bytes(void)
{
    static double ways[2][1021];
    double squares = 0;
    memset(ways, 0, sizeof ways);
    ways[0][0] = 1;
    for (int byte = 0; byte < 4; byte++) {
        for (int sum = 0; sum < 1021; sum++) {
            double count = 0;
            for (int b = 0; b < 256 && b <= sum; b++)
                count += ways[byte & 1][sum - b];
            ways[~byte & 1][sum] = count / 256;
        }
    }
    for (int sum = 0; sum < 1021; sum++)
        squares += ways[0][sum] *
                   pow(fix_clamp(sum - RELIEF_HASH_MEAN, -RELIEF_HASH_MOST, RELIEF_HASH_MOST), 2);
    return sqrt(squares);
}

static void noise_is_centred_and_has_its_deviation(void **state)
{
    (void)state;
    for (int seed = 0; seed < 256; seed += 15) {
        map.seed = (uint8_t)seed;
        double sum = 0;
        double squares = 0;
        double along = 0;
        int32_t before = 0;
        const int n = 1 << 18;
        for (int i = 0; i < n; i++) {
            /* Neighbours on the finest lattice, row by row of a small square. */
            uint32_t place = (uint32_t)(i & 511) | (uint32_t)(i >> 9) << 16;
            int32_t noise = relief_noise(place, relief_salt(map.seed));
            assert_in_range(noise + RELIEF_HASH_MOST, 0, 2 * RELIEF_HASH_MOST);
            sum += noise;
            squares += (double)noise * noise;
            along += (double)noise * before;
            before = noise;
        }
        double deviation = sqrt(squares / n);
        assert_true(fabs(sum / n) < 1.5);
        assert_true(fabs(deviation - 145.37) < 1);
        assert_true(fabs(along / squares) < 0.01);
    }
    assert_int_equal(HASH_LOG2_Q11, lround(2048 * log2(deviation_of_four_bytes())));
}

static void seeds_give_different_noise(void **state)
{
    (void)state;
    for (int seed = 1; seed < 256; seed++) {
        double product = 0;
        double squares = 0;
        for (uint32_t i = 0; i < 4096; i++) {
            map.seed = (uint8_t)(seed - 1);
            int32_t a = relief_noise(i * 16 | (i * 112 & 0xffff) << 16, relief_salt(map.seed));
            map.seed = (uint8_t)seed;
            int32_t b = relief_noise(i * 16 | (i * 112 & 0xffff) << 16, relief_salt(map.seed));
            product += (double)a * b;
            squares += (double)a * a;
        }
        assert_true(fabs(product / squares) < 0.08);
    }
}

/* --- Roughness -------------------------------------------------------------------------------- */

static void ring_plan(plan_t *plan)
{
    plan_init(plan, 255, 255);
    for (int k = 0; k < 4; k++) {
        plan_point_t ring[20];
        for (int i = 0; i < 20; i++) {
            double angle = i * 6.283185307 / 20;
            ring[i] = (plan_point_t){(int)lround(128 + (110 - 28 * k) * cos(angle)),
                                     (int)lround(128 + (100 - 28 * k) * sin(angle))};
        }
        plan->shift = 0;
        /* Steps of up to 34: each fourth ring point moves in a little less than 32. */
        if (!plan_try(plan, ring, 20, 15 * (k + 1))) {
            plan->shift = 1;
            for (int i = 1; i < 20; i++) {
                ring[i].x = ring[i - 1].x + (ring[i].x - ring[i - 1].x) / 2 * 2;
                ring[i].y = ring[i - 1].y + (ring[i].y - ring[i - 1].y) / 2 * 2;
            }
            assert_true(plan_try(plan, ring, 20, 15 * (k + 1)));
        }
        plan->shift = 0;
    }
    plan->shift = 1;
    plan->unit = 8; /* gentle: the gravity limit must not hide the law */
    const plan_point_t top = {128, 128};
    assert_true(plan_try(plan, &top, 1, 75));
}

/* Mean size of what the noise does to the second difference of heights one step apart. */
static double roughness(plan_t *plan)
{
    load_plan(plan);
    double sum = 0;
    int count = 0;
    for (int y = 10; y < 245; y += 3) {
        for (int x = 10; x < 245; x += 3) {
            int32_t bend[2];
            for (int detail = 0; detail < 2; detail++) {
                map.detail = detail == 1;
                bend[detail] = yb_map_height(&map, (uint16_t)(x * 256 - 256), (uint16_t)(y * 256)) +
                               yb_map_height(&map, (uint16_t)(x * 256 + 256), (uint16_t)(y * 256)) -
                               2 * yb_map_height(&map, (uint16_t)(x * 256), (uint16_t)(y * 256));
            }
            sum += abs(bend[1] - bend[0]);
            count++;
        }
    }
    return sum / count;
}

static void a_larger_dimension_is_rougher(void **state)
{
    (void)state;
    static const int dimension[] = {0, 16, 48, 96, 144, 200, 255};
    double before = -1;
    for (size_t i = 0; i < sizeof dimension / sizeof *dimension; i++) {
        plan_t plan;
        ring_plan(&plan);
        plan.gain = 32;
        plan.dimension = dimension[i];
        double now = roughness(&plan);
        print_message("D = 1 + %d/256: second differences of %.2f / 256 step\n", dimension[i], now);
        assert_true(now > before * 1.1);
        before = now;
    }
}

static void gain_scales_the_noise(void **state)
{
    (void)state;
    plan_t plan;
    ring_plan(&plan);
    plan.dimension = 128;
    plan.gain = 0;
    assert_true(roughness(&plan) == 0);
    for (int c = 0; c < YB_LENGTH_CLASSES; c++)
        assert_int_equal(map.noise[c] | map.reach_q8[c], 0);
    plan.gain = 16;
    double one = roughness(&plan);
    plan.gain = 32;
    double two = roughness(&plan);
    assert_true(two > 1.8 * one && two < 2.1 * one);
}

/* The scale of the noise by SPEC 3.3, in double: the deviation of a class's displacement. */
static void noise_scales_follow_the_law(void **state)
{
    (void)state;
    rng_t rng = {23};
    int checked = 0;
    for (int round = 0; round < 400; round++) {
        plan_t plan;
        random_fitting_plan(&plan, &rng);
        load_plan(&plan);
        double h = (map.hurst_q8m1 + 1) / 256.0;
        double sum = 0;
        int edges = 0;
        for (int t = 0; t < map.triangle_count; t++) {
            for (int i = 0; i < 3; i++) {
                const yb_vertex_t *a = &map.vertex[map.triangle[t][i]];
                const yb_vertex_t *b = &map.vertex[map.triangle[t][next3(i)]];
                bool inner = twin_of(&load, 4 * t + i) != NO_HALF;
                double length = hypot(b->x_q8 - a->x_q8, b->y_q8 - a->y_q8) / 256;
                double weight = inner ? 0.5 : 1;
                sum += weight * pow(b->z_q8 - a->z_q8, 2) / pow(length, 2 * h);
                edges += inner ? 1 : 2;
            }
        }
        double variance = sum / (edges / 2.0) * pow(2, -2 * h) * (1 - pow(2, 2 * h - 2));
        double amplitude = sqrt(variance) * plan.gain / 32;
        for (int c = 20; c < 60; c++) {
            double length = sqrt(pow(2, fmin(c, 48) / 2 + 0.25) * 4) / 256;
            double scale = amplitude * pow(length, h) * 512 / 145.37;
            if (h > 0.99 || scale < 20 || scale > 65000)
                continue;
            checked++;
            CHECK(fabs(map.noise[c] / scale - 1) < 0.03 + 1 / scale,
                  "map %d class %d: %d, not %.1f", round, c, map.noise[c], scale);
        }
    }
    assert_true(checked > 2000);
}

/* --- Slopes ----------------------------------------------------------------------------------- */

/* The share of a slope that is left when no edge at v begins steeper than one and a half times its
 * rise; a multiple of 2^-15.
 */
static double least_share(int v, double gx, double gy)
{
    double share = 1;
    for (int t = 0; t < map.triangle_count; t++) {
        const yb_index_t *c = map.triangle[t];
        for (int i = 0; i < 3 && (c[0] == v || c[1] == v || c[2] == v); i++) {
            const yb_vertex_t *a = &map.vertex[v];
            const yb_vertex_t *b = &map.vertex[c[i]];
            double along = gx * (b->x_q8 - a->x_q8) + gy * (b->y_q8 - a->y_q8);
            double most = 1.5 * 2048 * (b->z_q8 - a->z_q8);
            if (along * most > 0 && fabs(along) > fabs(most))
                share = fmin(share, floor(32768 * (most / along)) / 32768);
        }
    }
    return share;
}

static void slopes_are_those_of_spec(void **state)
{
    (void)state;
    rng_t rng = {24};
    for (int round = 0; round < 500; round++) {
        plan_t plan;
        random_fitting_plan(&plan, &rng);
        load_plan(&plan);
        for (int v = 0; v < map.vertex_count; v++) {
            double n[3] = {0, 0, 0};
            for (int t = 0; t < map.triangle_count; t++) {
                const yb_index_t *c = map.triangle[t];
                if (c[0] != v && c[1] != v && c[2] != v)
                    continue;
                const yb_vertex_t *p[3] = {&map.vertex[c[0]], &map.vertex[c[1]], &map.vertex[c[2]]};
                double d[2][3];
                for (int k = 0; k < 2; k++) {
                    d[k][0] = p[k + 1]->x_q8 - p[0]->x_q8;
                    d[k][1] = p[k + 1]->y_q8 - p[0]->y_q8;
                    d[k][2] = p[k + 1]->z_q8 - p[0]->z_q8;
                }
                if (d[0][2] == 0 && d[1][2] == 0)
                    continue;
                for (int i = 0; i < 3; i++) {
                    int j = (i + 1) % 3;
                    int k = (i + 2) % 3;
                    n[i] += d[0][j] * d[1][k] - d[0][k] * d[1][j];
                }
            }
            double gx = n[2] == 0 ? 0 : fmax(-4, fmin(4, -n[0] / n[2]));
            double gy = n[2] == 0 ? 0 : fmax(-4, fmin(4, -n[1] / n[2]));
            gx = floor(gx * 2048 + 1e-9);
            gy = floor(gy * 2048 + 1e-9);
            double share = least_share(v, gx, gy);
            assert_true(fabs(map.vertex[v].gx_q11 - floor(gx * share)) <= 0);
            assert_true(fabs(map.vertex[v].gy_q11 - floor(gy * share)) <= 0);
        }
    }
}

/* --- Reach ------------------------------------------------------------------------------------ */

enum {
    DEEPEST = 40
};

typedef struct {
    yb_vertex_t corner[DEEPEST][3];
    double worst; /* largest part of a reach that was used */
    rng_t rng;
    uint64_t fate; /* which edges this refinement splits */
} search_t;

/* Any refinement: an edge is split or not by a toss that depends on the edge alone, longer ones
 * rather than shorter ones.
 */
static bool tossed(const search_t *search, const yb_vertex_t *a, const yb_vertex_t *b, int least)
{
    int32_t dx = b->x_q8 - a->x_q8;
    int32_t dy = b->y_q8 - a->y_q8;
    if (!relief_splits(dx, dy) || fix_length(dx, dy) < least)
        return false;
    rng_t rng = {search->fate ^ (uint64_t)(a->x_q8 + b->x_q8) << 20 ^
                 (uint64_t)(a->y_q8 + b->y_q8)};
    return rng_range(&rng, 0, 255) < (int)(search->fate & 255);
}

static double off_plane(const yb_vertex_t p[3], const yb_vertex_t *at)
{
    double x1 = p[1].x_q8 - p[0].x_q8;
    double y1 = p[1].y_q8 - p[0].y_q8;
    double x2 = p[2].x_q8 - p[0].x_q8;
    double y2 = p[2].y_q8 - p[0].y_q8;
    double x = at->x_q8 - p[0].x_q8;
    double y = at->y_q8 - p[0].y_q8;
    double whole = x1 * y2 - x2 * y1;
    double b = (x * y2 - x2 * y) / whole;
    double c = (x1 * y - x * y1) / whole;
    return fabs(at->z_q8 - (p[0].z_q8 + b * (p[1].z_q8 - p[0].z_q8) + c * (p[2].z_q8 - p[0].z_q8)));
}

/* Every new point against every triangle above it. */
static void descend(search_t *search, int depth, int least)
{
    const yb_vertex_t *p = search->corner[depth];
    yb_vertex_t point[6] = {p[0], p[1], p[2]};
    int pattern = 0;
    /* Edges of `least` by fix_length may be 1/14 shorter. */
    int shortest = relief_class(least * 14 / 15, 0);
    for (int i = 0; i < 3; i++) {
        if (!tossed(search, &p[i], &p[next3(i)], least))
            continue;
        relief_middle(&map, &p[i], &p[next3(i)], &point[3 + i]);
        pattern |= 1 << i;
        for (int k = 0; k <= depth; k++) {
            const yb_vertex_t *q = search->corner[k];
            const yb_vertex_t *const corner[3] = {&q[0], &q[1], &q[2]};
            relief_bound_t bound;
            relief_bound(corner, &bound);
            double part = off_plane(q, &point[3 + i]) / relief_reach(&map, &bound, shortest);
            search->worst = fmax(search->worst, part);
        }
    }
    for (int k = 0; pattern != 0 && k < SPLIT_CHILDREN; k++) {
        const uint8_t *child = split_child[pattern][k];
        if (child[0] == SPLIT_END)
            break;
        for (int i = 0; i < 3; i++)
            search->corner[depth + 1][i] = point[child[i]];
        assert_true(depth + 2 < DEEPEST);
        descend(search, depth + 1, least);
    }
}

static void refinement_never_goes_beyond_its_reach(void **state)
{
    (void)state;
    search_t search = {.rng = {25}};
    for (int round = 0; round < 2500; round++) {
        plan_t plan;
        random_fitting_plan(&plan, &search.rng);
        if (round % 3 == 0) {
            plan.gain = 255;
            plan.dimension = rng_range(&search.rng, 0, 255);
            plan.unit = plan.cell * rng_range(&search.rng, 1, 2) & 0xfff;
            plan.unit = plan.unit == 0 || !plan_valid(&plan) ? 64 : plan.unit;
        }
        if (!map_fits(&plan))
            continue;
        load_plan(&plan);
        for (int tries = 0; tries < 4; tries++) {
            int t = rng_range(&search.rng, 0, map.triangle_count - 1);
            for (int i = 0; i < 3; i++)
                search.corner[0][i] = map.vertex[map.triangle[t][i]];
            search.fate = rng_next(&search.rng) | (round % 2 == 0 ? 255 : 0);
            descend(&search, 0, rng_range(&search.rng, 500, 6000));
            CHECK(search.worst <= 1, "round %d: %.3f of the reach", round, search.worst);
        }
    }
    print_message("at most %.3f of the reach was used\n", search.worst);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_midpoint_is_the_same_from_both_ends),
        cmocka_unit_test(noise_keeps_to_the_gravity_limit),
        cmocka_unit_test(noise_that_is_not_looked_at_keeps_to_its_limit),
        cmocka_unit_test(ways_are_differences),
        cmocka_unit_test(noise_is_centred_and_has_its_deviation),
        cmocka_unit_test(seeds_give_different_noise),
        cmocka_unit_test(a_larger_dimension_is_rougher),
        cmocka_unit_test(gain_scales_the_noise),
        cmocka_unit_test(noise_scales_follow_the_law),
        cmocka_unit_test(slopes_are_those_of_spec),
        cmocka_unit_test(refinement_never_goes_beyond_its_reach),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
