/* The rules: what they add to the triangulation, on many thousand random maps. How many is for
 * YB_TEST_MAPS in the environment to say.
 */
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "maps.h"
#include "mesh_check.h"
#include "random_plan.h"
#include "rule_check.h"

static yb_map_t map;
static yb_load_t load;

static uint64_t maps_asked_for(uint64_t standard)
{
    const char *count = getenv("YB_TEST_MAPS");
    return count != NULL ? strtoull(count, NULL, 10) : standard;
}

/* Byte by byte, into memory with something in it. */
static yb_status_t feed_bytes(yb_map_t *other, const uint8_t *bytes, size_t count)
{
    static yb_load_t work;
    memset(other, 0xa5, sizeof *other);
    memset(&work, 0x5a, sizeof work);
    yb_map_begin(other, &work);
    for (size_t i = 0; i < count; i++) {
        if (yb_map_feed(other, &work, bytes + i, 1) < 0)
            break;
    }
    return yb_map_end(other, &work);
}

static const char *check_all(const plan_t *plan)
{
    const char *wrong = mesh_check(&map, &load, plan);
    return wrong == NULL ? rule_check(&map, &load, plan) : wrong;
}

static void rules_hold_on_random_maps(void **state)
{
    (void)state;
    uint64_t maps = maps_asked_for(24000);
    int taken = 0;
    int summits = 0;
    int saddles = 0;
    int skeletons = 0;
    int wrongs = 0;
    for (uint64_t seed = 0; seed < maps; seed++) {
        rng_t rng = {seed};
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        if (seed % 4 == 0)
            random_plan(&plan, &rng);
        else
            random_mountain(&plan, &rng);
        size_t count = plan_write(&plan, bytes);
        yb_status_t status = yb_map_load(&map, &load, bytes, count);
        CHECK(status == YB_OK || status == YB_ERR_LIMIT, "map %d: %s", (int)seed,
              yb_status_text(status));
        static yb_map_t fed;
        CHECK(feed_bytes(&fed, bytes, count) == status, "map %d fed by bytes", (int)seed);
        if (status != YB_OK)
            continue;
        taken++;
        CHECK(map_same(&map, &fed), "map %d: another one when fed by bytes", (int)seed);
        const char *wrong = check_all(&plan);
        if (wrong != NULL && wrongs++ < 20)
            print_error("map %d: %s\n", (int)seed, wrong);
        summits += load.first_saddle - load.first_summit;
        saddles += load.first_skeleton - load.first_saddle;
        skeletons += map.vertex_count - load.first_skeleton;
    }
    print_message("%d of %d maps; %d summits, %d link points, %d points of skeletons\n", taken,
                  (int)maps, summits, saddles, skeletons);
    assert_int_equal(wrongs, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rules_hold_on_random_maps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
