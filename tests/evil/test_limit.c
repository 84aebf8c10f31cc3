/* An engine of 64 vertices: what fits is loaded, the rest is said to be too large, at once. */
#include <yamabiko/yamabiko.h>

#include "check.h"
#include "mesh_check.h"
#include "random_plan.h"

static yb_map_t map;
static yb_load_t load;

static void codes_fit_or_are_refused(void **state)
{
    (void)state;
    rng_t rng = {91};
    int fit = 0;
    int rest = 0;
    for (int round = 0; round < 3000; round++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_plan(&plan, &rng);
        plan.vertices = plan_vertices(&plan) + rng_range(&rng, 0, 40);
        plan.vertices = plan.vertices > 255 ? 255 : plan.vertices;
        size_t count = plan_write(&plan, bytes);
        bool may_fit = plan.vertices <= YB_MAX_VERTICES;
        yb_status_t status = yb_map_load(&map, &load, bytes, count);
        assert_true(may_fit ? status == YB_OK || status == YB_ERR_LIMIT : status == YB_ERR_LIMIT);
        fit += status == YB_OK;
        rest += status != YB_OK;
        yb_map_begin(&map, &load);
        assert_int_equal(yb_map_feed(&map, &load, bytes, 14), may_fit ? YB_MORE : YB_ERR_LIMIT);
        if (!may_fit)
            assert_int_equal(yb_map_end(&map, &load), YB_ERR_LIMIT);
        if (status != YB_OK)
            continue;
        assert_int_equal(yb_map_load(&map, &load, bytes, count), YB_OK);
        assert_null(mesh_check(&map, &load, &plan));
    }
    print_message("%d fit, %d do not\n", fit, rest);
    assert_true(fit > 500 && rest > 500);
}

/* A code that understates its points and corners is corrupt before it writes one too many; one that
 * understates what the rules add to them asks for a larger limit.
 */
static void lies_about_the_count_are_refused(void **state)
{
    (void)state;
    rng_t rng = {92};
    for (int round = 0; round < 3000; round++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_plan(&plan, &rng);
        plan.vertices = rng_range(&rng, 4, YB_MAX_VERTICES);
        size_t count = plan_write(&plan, bytes);
        yb_status_t status = yb_map_load(&map, &load, bytes, count);
        if (plan.vertices < plan_vertices(&plan))
            assert_int_equal(status, YB_ERR_CORRUPT);
        else
            assert_true(status == YB_OK || status == YB_ERR_LIMIT);
        if (status != YB_OK)
            continue;
        assert_true(map.vertex_count <= plan.vertices);
        /* Just as many are enough, one less is not. */
        plan.vertices = map.vertex_count;
        count = plan_write(&plan, bytes);
        assert_int_equal(yb_map_load(&map, &load, bytes, count), YB_OK);
        plan.vertices--;
        count = plan_write(&plan, bytes);
        bool coded = plan.vertices < plan_vertices(&plan);
        if (plan.vertices >= 4)
            assert_int_equal(yb_map_load(&map, &load, bytes, count),
                             coded ? YB_ERR_CORRUPT : YB_ERR_LIMIT);
    }
}

static void the_structs_are_as_small_as_promised(void **state)
{
    (void)state;
    print_message("64 vertices: map %d, load %d, frame %d bytes\n", (int)sizeof map,
                  (int)sizeof load, (int)sizeof(yb_frame_t));
    assert_true(sizeof map < 64 * 26 + 64 * 4 + 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_fit_or_are_refused),
        cmocka_unit_test(lies_about_the_count_are_refused),
        cmocka_unit_test(the_structs_are_as_small_as_promised),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
