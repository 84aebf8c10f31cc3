/* A map of contour lines in full detail, for the PC: no code, all points of the lines.
 *
 * The frame gets 255 steps on its longer side and the points a lattice of 1/16 step. The rest is
 * the engine's (yb_map_build): the same rules as for a code of a hundred bytes.
 */
#ifndef YB_DETAILED_MAP_H
#define YB_DETAILED_MAP_H

#include <yamabiko/yamabiko.h>

#include "contour_lines.h"

/* Builds the map. False with a sentence: too many points, or lines that cross. */
bool yb_detailed_map(const yb_lines_t *lines, yb_map_t *map, yb_load_t *load, yb_error_t *error);

#endif
