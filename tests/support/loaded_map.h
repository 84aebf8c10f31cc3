/* The map of a test, and what loads a plan into it that must be legal. */
#ifndef TEST_LOADED_MAP_H
#define TEST_LOADED_MAP_H

#include "check.h"
#include "maps.h"

static yb_map_t map;
static yb_load_t load;

static void load_plan(const plan_t *plan)
{
    uint8_t bytes[PLAN_MAX_BYTES];
    assert_int_equal(yb_map_load(&map, &load, bytes, plan_write(plan, bytes)), YB_OK);
}

#endif
