/* Heights of contour lines that tell none, by how they lie in each other. */
#ifndef YB_NESTING_H
#define YB_NESTING_H

#include "contour_lines.h"

/* The land outside the outermost lines lies below them; if lines run from frame to frame, it is
 * the region with the longest share of the frame. From there on each line that is crossed lies one
 * interval higher, the first at base_m; a spot height lies half an interval above the last. Sets
 * the heights of all lines, which must not touch each other. False with a sentence: two lines cross
 * each other, a height no map can hold, or no memory.
 */
bool yb_nesting_heights(yb_lines_t *lines, double base_m, double interval_m, yb_error_t *error);

#endif
