/* Contour lines that cross: a fault of the input, as no relief has two heights at one place. */
#ifndef YB_LINE_CROSSINGS_H
#define YB_LINE_CROSSINGS_H

#include "contour_lines.h"

/* True if no two lines of different heights cross. Lines that touch do not, nor do those that
 * overlap by less than a hundredth of a lattice step (1/25500 of the frame's longer side) or than
 * the rounding of the file's coordinates explains. Lines that had to be mended are left out. Else
 * false, with their heights and places, three at most, in the coordinates of the file at `path`.
 */
bool yb_line_crossings_none(const yb_lines_t *lines, const char *path, yb_error_t *error);

#endif
