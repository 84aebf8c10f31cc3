/* Loads a plan that must be legal and checks all that is known of meshes and rules. */
#ifndef TEST_CHECKED_MAP_H
#define TEST_CHECKED_MAP_H

#include "loaded_map.h"
#include "mesh_check.h"
#include "rule_check.h"

static void load_checked(const plan_t *plan)
{
    load_plan(plan);
    const char *wrong = mesh_check(&map, &load, plan);
    CHECK(wrong == NULL, "%s", wrong);
    wrong = rule_check(&map, &load, plan);
    CHECK(wrong == NULL, "%s", wrong);
}

#endif
