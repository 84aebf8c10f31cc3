/* Loads a plan that must be legal and checks all that is known of meshes and rules. */
#ifndef TEST_CHECKED_MAP_H
#define TEST_CHECKED_MAP_H

#include "check.h"
#include "maps.h"
#include "mesh_check.h"
#include "rule_check.h"

static yb_map_t map;
static yb_load_t load;

static void load_plan(const plan_t *plan)
{
    uint8_t bytes[PLAN_MAX_BYTES];
    assert_int_equal(yb_map_load(&map, &load, bytes, plan_write(plan, bytes)), YB_OK);
    const char *wrong = mesh_check(&map, &load, plan);
    CHECK(wrong == NULL, "%s", wrong);
    wrong = rule_check(&map, &load, plan);
    CHECK(wrong == NULL, "%s", wrong);
}

#endif
