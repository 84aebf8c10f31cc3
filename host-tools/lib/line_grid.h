/* The relief between contour lines, as a grid. */
#ifndef YB_LINE_GRID_H
#define YB_LINE_GRID_H

#include "contour_lines.h"

/* A grid of 256 cells on the longer side through the lines: cells on a line have its height, those
 * between are interpolated. An innermost closed line without a spot height in it gets one, half an
 * interval beyond, at the place farthest from the line: upwards if the next line outside is lower
 * or there is none. NULL with a sentence: all lines have one height and none is closed, or no
 * memory.
 */
yb_grid_t *yb_line_grid_new(const yb_lines_t *lines, yb_error_t *error);

/* The distinct heights of the lines (not of spot heights), rising; if there are more than `most`,
 * evenly chosen ones. Answers how many.
 */
int yb_line_grid_levels(const yb_lines_t *lines, double *level_m, int most);

#endif
