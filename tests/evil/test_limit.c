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
        size_t count = plan_write(&plan, bytes);
        bool fits = plan_vertices(&plan) <= YB_MAX_VERTICES;
        assert_int_equal(yb_map_load(&map, &load, bytes, count), fits ? YB_OK : YB_ERR_LIMIT);
        if (fits)
            assert_null(mesh_check(&map, &load, &plan));
        fit += fits;
        rest += !fits;
        yb_map_begin(&map, &load);
        assert_int_equal(yb_map_feed(&map, &load, bytes, 14), fits ? YB_MORE : YB_ERR_LIMIT);
        if (!fits)
            assert_int_equal(yb_map_end(&map, &load), YB_ERR_LIMIT);
    }
    print_message("%d fit, %d do not\n", fit, rest);
    assert_true(fit > 500 && rest > 500);
}

/* A code that understates its vertices is corrupt before it writes one too many. */
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
        yb_status_t expected = plan.vertices == plan_vertices(&plan) ? YB_OK : YB_ERR_CORRUPT;
        assert_int_equal(yb_map_load(&map, &load, bytes, count), expected);
    }
}

static void the_structs_are_as_small_as_promised(void **state)
{
    (void)state;
    print_message("64 vertices: map %d, load %d, frame %d bytes\n", (int)sizeof map,
                  (int)sizeof load, (int)sizeof(yb_frame_t));
    assert_true(sizeof map < 64 * 18 + 64 * 4 + 100);
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
