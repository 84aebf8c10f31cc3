/* Triangulation: on many thousand random maps valid, Delaunay, unique; on messes, right or refused.
 */
#include <string.h>
#include <time.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "maps.h"
#include "mesh_check.h"
#include "random_plan.h"

static yb_map_t map;
static yb_load_t load;

/* The triangulation alone: what the rules make of it is the matter of other tests. */
static yb_status_t triangulate(const plan_t *plan)
{
    return map_triangulate(&map, &load, plan);
}

static void random_maps_are_triangulated(void **state)
{
    (void)state;
    int largest = 0;
    int lines = 0;
    for (uint64_t seed = 0; seed < 20000; seed++) {
        rng_t rng = {seed};
        plan_t plan;
        random_plan(&plan, &rng);
        CHECK(triangulate(&plan) == YB_OK, "map %d is refused", (int)seed);
        const char *wrong = mesh_check_bare(&map, &load, &plan);
        CHECK(wrong == NULL, "map %d: %s", (int)seed, wrong);
        largest = map.vertex_count > largest ? map.vertex_count : largest;
        lines += load.region_count - 1;
    }
    print_message("20000 maps of up to %d vertices, %d lines\n", largest, lines);
    assert_true(largest > 240);
}

static void messes_are_right_or_refused(void **state)
{
    (void)state;
    int good = 0;
    for (uint64_t seed = 0; seed < 40000; seed++) {
        rng_t rng = {seed};
        plan_t plan;
        random_mess(&plan, &rng);
        bool legal = plan_valid(&plan) && plan_codable(&plan, 255);
        yb_status_t status = triangulate(&plan);
        CHECK(status == (legal ? YB_OK : YB_ERR_CORRUPT), "mess %d: %s", (int)seed,
              yb_status_text(status));
        if (!legal)
            continue;
        good++;
        const char *wrong = mesh_check_bare(&map, &load, &plan);
        CHECK(wrong == NULL, "mess %d: %s", (int)seed, wrong);
    }
    print_message("%d of 40000 messes are legal\n", good);
    assert_true(good > 2000 && good < 38000);
}

/* The same points in another order give the same triangles where no four lie on a circle; where
 * they do, those of the rule, which mesh_check has looked at. Here: the corners' numbers move.
 */
static void four_on_a_circle(void **state)
{
    (void)state;
    static const int order[4][4] = {{0, 1, 2, 3}, {1, 2, 3, 0}, {2, 0, 3, 1}, {3, 1, 0, 2}};
    for (int k = 0; k < 4; k++) {
        plan_t plan;
        plan_init(&plan, 255, 255);
        static const plan_point_t square[4] = {{100, 100}, {140, 100}, {140, 140}, {100, 140}};
        for (int i = 0; i < 4; i++)
            assert_true(plan_try(&plan, &square[order[k][i]], 1, 10));
        assert_int_equal(triangulate(&plan), YB_OK);
        assert_null(mesh_check_bare(&map, &load, &plan));
        /* Vertex 0 has the diagonal: to the place opposite. */
        int opposite = 0;
        for (int i = 1; i < 4; i++) {
            if (order[k][i] == (order[k][0] + 2) % 4)
                opposite = i;
        }
        int found = 0;
        for (int t = 0; t < map.triangle_count; t++) {
            bool has = false;
            bool has_too = false;
            for (int i = 0; i < 3; i++) {
                has = has || map.triangle[t][i] == 0;
                has_too = has_too || map.triangle[t][i] == opposite;
            }
            found += has && has_too;
        }
        assert_int_equal(found, 2);
    }
}

/* The code order of the contours must not matter for the shape: no four points on a circle here. */
static void order_of_contours_does_not_matter(void **state)
{
    (void)state;
    static const plan_point_t spot[6] = {{31, 17},   {200, 83}, {90, 211},
                                         {151, 140}, {60, 99},  {7, 250}};
    int64_t first = 0;
    for (int k = 0; k < 6; k++) {
        plan_t plan;
        plan_init(&plan, 255, 254);
        for (int i = 0; i < 6; i++)
            assert_true(plan_try(&plan, &spot[(i + k) % 6], 1, 10));
        assert_int_equal(triangulate(&plan), YB_OK);
        int64_t sum = 0;
        for (int t = 0; t < map.triangle_count; t++) {
            int64_t product = 1;
            for (int i = 0; i < 3; i++) {
                const yb_vertex_t *v = &map.vertex[map.triangle[t][i]];
                product *= v->x_q8 / 256 * 256 + v->y_q8 / 256 + 1;
            }
            sum += product % 1000003;
        }
        if (k == 0)
            first = sum;
        assert_int_equal(sum, first);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_maps_are_triangulated),
        cmocka_unit_test(messes_are_right_or_refused),
        cmocka_unit_test(four_on_a_circle),
        cmocka_unit_test(order_of_contours_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
