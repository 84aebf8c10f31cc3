/* A map of contour lines in full detail, for the PC: no code, all points of the lines.
 *
 * The frame gets up to 255 steps on its longer side and the points a lattice of 1/16 step, on which
 * lines that touch or cross are parted (line_lattice.h). The rest is the engine's (yb_map_build):
 * the same rules as for a code of a hundred bytes, without fractal detail.
 */
#ifndef YB_DETAILED_MAP_H
#define YB_DETAILED_MAP_H

#include <yamabiko/yamabiko.h>

#include "contour_lines.h"
#include "line_lattice.h"

/* Builds the map; load->contour[] are the lines as they were laid. If they have more points than a
 * mesh can hold, those that tell least are left out: that far, *thinned_m, a line may lie off.
 * loss and thinned_m may be NULL. False with a sentence: no line can be laid, the frame is too
 * narrow or the heights are no metres.
 */
bool yb_detailed_map(const yb_lines_t *lines, yb_map_t *map, yb_load_t *load, yb_line_loss_t *loss,
                     double *thinned_m, yb_error_t *error);

#endif
