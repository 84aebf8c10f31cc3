/* One hash over what the engine makes of many random maps: every build must print the same.
 *
 *     mesh_hashes COUNT [each]
 *
 * A build that takes larger meshes than a code may ask for also sees whether a code that is said to
 * be too large is.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "fnv.h"
#include "maps.h"
#include "mesh_check.h"
#include "random_plan.h"

static yb_map_t map;
static yb_load_t load;

/* The vertices that the plan's mesh needs, or 0: it cannot be said. */
static int vertices_needed(const plan_t *plan)
{
#if YB_MAX_VERTICES > 255
    map_set(&map, &load, plan);
    return yb_map_build(&map, &load) == YB_OK ? map.vertex_count : 0;
#else
    (void)plan;
    return 0;
#endif
}

int main(int argc, char **argv)
{
    uint64_t seeds = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000;
    bool each = argc > 2 && strcmp(argv[2], "each") == 0;
    uint64_t hash = FNV_START;
    int too_large = 0;
    for (uint64_t seed = 0; seed < seeds; seed++) {
        plan_t plan;
        uint8_t bytes[PLAN_MAX_BYTES];
        random_map(&plan, seed);
        int needed = vertices_needed(&plan);
        yb_status_t status = yb_map_load(&map, &load, bytes, plan_write(&plan, bytes));
        if (needed > 0 && status != (needed > 255 ? YB_ERR_LIMIT : YB_OK)) {
            printf("map %" PRIu64 " of %d vertices: %s\n", seed, needed, yb_status_text(status));
            return 1;
        }
        if (status != YB_OK && status != YB_ERR_LIMIT) {
            printf("map %" PRIu64 ": %s\n", seed, yb_status_text(status));
            return 1;
        }
        uint64_t one = status == YB_OK ? mesh_hash(&map) : 0;
        too_large += status != YB_OK;
        if (each)
            printf("%" PRIu64 " %016" PRIx64 "\n", seed, one);
        hash = fnv_number(hash, (int64_t)one);
    }
    printf("%016" PRIx64 ": %" PRIu64 " maps, %d too large\n", hash, seeds, too_large);
    return 0;
}
