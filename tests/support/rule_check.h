/* What the rules must have made of a mesh (SPEC 2.4 to 2.6), checked without the engine's own
 * arithmetic: NULL, or what is wrong. The mesh must have passed mesh_check; load as loading left
 * it.
 */
#ifndef TEST_RULE_CHECK_H
#define TEST_RULE_CHECK_H

#include <yamabiko/yamabiko.h>

#include "plan.h"

/* No triangle of one height, unless all that is coded is of one height. */
const char *rule_check_flats(const yb_map_t *map, const plan_t *plan);

/* A summit only in a region of one height, one in each, off the line by an eighth of the rise
 * outside and less than one; saddles strictly between the heights that they are between; links from
 * what they may start at to what they may end at, of different heights, from the one summit of a
 * leaf to each point of its line that it sees and no ridge keeps away, and down slopes towards the
 * steepest peak; no edge left that dams a valley or cuts a ridge between two points of one height;
 * branches of skeletons monotonic, off the height of their sides.
 */
const char *rule_check(const yb_map_t *map, const yb_load_t *load, const plan_t *plan);

#endif
