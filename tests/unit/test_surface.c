/* The reference surface: whole, without cracks, and the same asked point by point. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "maps.h"
#include "random_plan.h"
#include "relief.h"

static yb_map_t map;
static yb_load_t load;

static void load_plan(const plan_t *plan)
{
    uint8_t bytes[PLAN_MAX_BYTES];
    assert_int_equal(yb_map_load(&map, &load, bytes, plan_write(plan, bytes)), YB_OK);
}

/* All leaves of a refined map. */
typedef struct {
    yb_vertex_t (*leaf)[3];
    size_t count, room;
} leaves_t;

static void keep(void *context, const yb_vertex_t *a, const yb_vertex_t *b, const yb_vertex_t *c)
{
    leaves_t *leaves = context;
    if (leaves->count == leaves->room) {
        leaves->room = leaves->room * 2 + 1024;
        leaves->leaf = realloc(leaves->leaf, leaves->room * sizeof *leaves->leaf);
        assert_non_null(leaves->leaf);
    }
    leaves->leaf[leaves->count][0] = *a;
    leaves->leaf[leaves->count][1] = *b;
    leaves->leaf[leaves->count][2] = *c;
    leaves->count++;
}

static void refine_all(leaves_t *leaves, uint16_t longest)
{
    leaves->count = 0;
    for (uint16_t t = 0; t < map.triangle_count; t++)
        yb_map_refine(&map, t, longest, keep, leaves);
}

static int64_t twice_area(const yb_vertex_t p[3])
{
    return ((int64_t)p[1].x_q8 - p[0].x_q8) * ((int64_t)p[2].y_q8 - p[0].y_q8) -
           ((int64_t)p[1].y_q8 - p[0].y_q8) * ((int64_t)p[2].x_q8 - p[0].x_q8);
}

/* An edge in its direction, and the heights of its ends. */
typedef struct {
    uint64_t from, to;
} half_edge_t;

static uint64_t name_of(const yb_vertex_t *v)
{
    return (uint64_t)(uint32_t)v->z_q8 | (uint64_t)v->x_q8 << 48 | (uint64_t)v->y_q8 << 32;
}

static int by_edge(const void *a, const void *b)
{
    const half_edge_t *p = a;
    const half_edge_t *q = b;
    if (p->from != q->from)
        return p->from < q->from ? -1 : 1;
    return p->to < q->to ? -1 : p->to > q->to;
}

static bool along_frame(const yb_vertex_t *a, const yb_vertex_t *b)
{
    return (a->x_q8 == b->x_q8 && (a->x_q8 == 0 || a->x_q8 == map.east_q8)) ||
           (a->y_q8 == b->y_q8 && (a->y_q8 == 0 || a->y_q8 == map.north_q8));
}

static void check_whole(const leaves_t *leaves, int longest)
{
    size_t count = 3 * leaves->count;
    half_edge_t *edge = malloc(count * sizeof *edge);
    assert_non_null(edge);
    int64_t area = 0;
    for (size_t i = 0; i < leaves->count; i++) {
        assert_true(twice_area(leaves->leaf[i]) > 0);
        area += twice_area(leaves->leaf[i]);
        for (int k = 0; k < 3; k++) {
            const yb_vertex_t *a = &leaves->leaf[i][k];
            const yb_vertex_t *b = &leaves->leaf[i][(k + 1) % 3];
            edge[3 * i + (size_t)k] = (half_edge_t){name_of(a), name_of(b)};
            int32_t dx = b->x_q8 - a->x_q8;
            int32_t dy = b->y_q8 - a->y_q8;
            assert_true(fix_length(dx, dy) <= longest || !relief_splits(dx, dy));
        }
    }
    assert_int_equal(area, 2 * (int64_t)map.east_q8 * map.north_q8);
    qsort(edge, count, sizeof *edge, by_edge);
    for (size_t i = 0; i < leaves->count; i++) {
        for (int k = 0; k < 3; k++) {
            const yb_vertex_t *a = &leaves->leaf[i][k];
            const yb_vertex_t *b = &leaves->leaf[i][(k + 1) % 3];
            const half_edge_t back = {name_of(b), name_of(a)};
            bool met = bsearch(&back, edge, count, sizeof *edge, by_edge) != NULL;
            assert_int_equal(met, !along_frame(a, b));
        }
    }
    for (size_t i = 1; i < count; i++)
        assert_int_not_equal(by_edge(&edge[i - 1], &edge[i]), 0);
    free(edge);
}

static void refined_maps_are_whole(void **state)
{
    (void)state;
    rng_t rng = {31};
    leaves_t leaves = {0};
    static const uint16_t lengths[] = {65535, 20000, 5000, 2000, 700};
    size_t most = 0;
    for (int round = 0; round < 150; round++) {
        plan_t plan;
        random_fitting_plan(&plan, &rng);
        load_plan(&plan);
        uint16_t longest = lengths[round % 5];
        if (round % 50 == 0)
            longest = YB_REFERENCE_Q8;
        refine_all(&leaves, longest);
        check_whole(&leaves, longest);
        most = leaves.count > most ? leaves.count : most;
    }
    print_message("up to %d leaves\n", (int)most);
    free(leaves.leaf);
}

/* Down to the last bit of the lattice, on frames small enough. */
static void refinement_ends_at_the_lattice(void **state)
{
    (void)state;
    rng_t rng = {32};
    leaves_t leaves = {0};
    for (int round = 0; round < 60; round++) {
        plan_t plan;
        plan_init(&plan, rng_range(&rng, 1, 4), rng_range(&rng, 1, 4));
        for (int i = 0; i < 4; i++)
            (void)random_open_line(&plan, &rng, rng_range(&rng, 0, 3));
        load_plan(&plan);
        int longest = rng_range(&rng, 0, 60);
        refine_all(&leaves, (uint16_t)longest);
        check_whole(&leaves, longest);
    }
    free(leaves.leaf);
    /* Long thin triangles need the most levels: a wide frame, refined as far as it goes. */
    for (int round = 0; round < 6; round++) {
        plan_t plan;
        plan_init(&plan, round < 3 ? 255 : 128, 1);
        plan.corner_height[round & 3] = 100;
        load_plan(&plan);
        leaves_t none = {0};
        refine_all(&none, (uint16_t)(round * 20));
        check_whole(&none, round * 20);
        free(none.leaf);
    }
}

static void heights_lie_on_the_leaves(void **state)
{
    (void)state;
    rng_t rng = {33};
    leaves_t leaves = {0};
    for (int round = 0; round < 25; round++) {
        plan_t plan;
        random_fitting_plan(&plan, &rng);
        load_plan(&plan);
        map.detail = round % 4 != 3;
        refine_all(&leaves, YB_REFERENCE_Q8);
        for (int i = 0; i < 4000; i++) {
            const yb_vertex_t *p = leaves.leaf[rng_next(&rng) % leaves.count];
            int a = rng_range(&rng, 0, 64);
            int b = rng_range(&rng, 0, 64 - a);
            int x = p[0].x_q8 + ((p[1].x_q8 - p[0].x_q8) * a + (p[2].x_q8 - p[0].x_q8) * b) / 64;
            int y = p[0].y_q8 + ((p[1].y_q8 - p[0].y_q8) * a + (p[2].y_q8 - p[0].y_q8) * b) / 64;
            int64_t whole = twice_area(p);
            int64_t part[3];
            bool inside = true;
            for (int k = 0; k < 3; k++) {
                yb_vertex_t q[3] = {p[0], p[1], p[2]};
                q[k].x_q8 = (uint16_t)x;
                q[k].y_q8 = (uint16_t)y;
                part[k] = twice_area(q);
                inside = inside && part[k] >= 0;
            }
            if (!inside)
                continue; /* rounding put it out */
            int64_t sum = part[0] * p[0].z_q8 + part[1] * p[1].z_q8 + part[2] * p[2].z_q8;
            int64_t truth = sum / whole - (sum % whole < 0);
            assert_int_equal(yb_map_height(&map, (uint16_t)x, (uint16_t)y), truth);
        }
        for (int i = 0; i < map.vertex_count; i++) {
            const yb_vertex_t *v = &map.vertex[i];
            assert_int_equal(yb_map_height(&map, v->x_q8, v->y_q8), v->z_q8);
        }
        assert_int_equal(yb_map_height(&map, 65535, 65535),
                         yb_map_height(&map, map.east_q8, map.north_q8));
    }
    free(leaves.leaf);
}

static void a_plane_stays_a_plane(void **state)
{
    (void)state;
    rng_t rng = {34};
    for (int round = 0; round < 20; round++) {
        plan_t plan;
        plan_init(&plan, 255, 255);
        plan.gain = 0;
        int a = rng_range(&rng, 0, 1);
        int b = rng_range(&rng, 0, 1);
        for (int k = 0; k < 4; k++)
            plan.corner_height[k] = (k == 1 || k == 2 ? 255 * a : 0) + (k >= 2 ? 255 * b : 0);
        for (int i = 0; i < 150; i++) {
            const plan_point_t spot = {rng_range(&rng, 1, 254), rng_range(&rng, 1, 254)};
            (void)plan_try(&plan, &spot, 1, a * spot.x + b * spot.y);
        }
        load_plan(&plan);
        for (int i = 0; i < map.vertex_count; i++) {
            assert_int_equal(map.vertex[i].gx_q11, 2048 * a);
            assert_int_equal(map.vertex[i].gy_q11, 2048 * b);
        }
        for (int i = 0; i < 2000; i++) {
            int x = rng_range(&rng, 0, 65280);
            int y = rng_range(&rng, 0, 65280);
            int32_t z = yb_map_height(&map, (uint16_t)x, (uint16_t)y);
            assert_true(abs(z - a * x - b * y) <= 8); /* halves, rounded down eight times */
        }
    }
}

/* Each base triangle by itself: the smooth part is one quadratic, the same by every way to it. */
static void the_smooth_part_is_a_quadratic(void **state)
{
    (void)state;
    rng_t rng = {35};
    int checked = 0;
    for (int round = 0; round < 60; round++) {
        plan_t plan;
        random_fitting_plan(&plan, &rng);
        plan.straight = false;
        load_plan(&plan);
        map.detail = false;
        for (int i = 0; i < 300; i++) {
            int t = rng_range(&rng, 0, map.triangle_count - 1);
            const yb_vertex_t *p[3];
            for (int k = 0; k < 3; k++)
                p[k] = &map.vertex[map.triangle[t][k]];
            /* A lattice point of the triangle split three times: barycentric in eighths. */
            int l[3];
            l[0] = rng_range(&rng, 0, 8);
            l[1] = rng_range(&rng, 0, 8 - l[0]);
            l[2] = 8 - l[0] - l[1];
            double z = 0;
            double x = 0;
            double y = 0;
            for (int k = 0; k < 3; k++) {
                const yb_vertex_t *q = p[(k + 1) % 3];
                double rise = ((double)(p[k]->gx_q11 - q->gx_q11) * (q->x_q8 - p[k]->x_q8) +
                               (double)(p[k]->gy_q11 - q->gy_q11) * (q->y_q8 - p[k]->y_q8)) /
                              16384;
                z += p[k]->z_q8 * l[k] / 8.0 + 4 * rise * l[k] * l[(k + 1) % 3] / 64.0;
                x += p[k]->x_q8 * l[k] / 8.0;
                y += p[k]->y_q8 * l[k] / 8.0;
            }
            int32_t found = yb_map_height(&map, (uint16_t)x, (uint16_t)y);
            bool smallest = true;
            for (int k = 0; k < 3; k++) {
                const yb_vertex_t *q = p[(k + 1) % 3];
                smallest =
                    smallest && abs(q->x_q8 - p[k]->x_q8) + abs(q->y_q8 - p[k]->y_q8) > 8 * 512;
            }
            if (!smallest)
                continue;
            checked++;
            assert_true(fabs(found - z) < 16);
        }
    }
    assert_true(checked > 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refined_maps_are_whole),
        cmocka_unit_test(refinement_ends_at_the_lattice),
        cmocka_unit_test(heights_lie_on_the_leaves),
        cmocka_unit_test(a_plane_stays_a_plane),
        cmocka_unit_test(the_smooth_part_is_a_quadratic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
