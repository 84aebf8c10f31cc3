/* Leaves that stick out of the view: cut at the least distance, a screen size beyond the screen and
 * at the pyramid in which points can be projected.
 *
 * Nearly all leaves need none of this. A cut point is always computed from the end inside to the
 * end outside, so two triangles that share an edge cut it in the same place; a corner that has its
 * spot on the screen keeps it.
 */
#ifndef YB_CLIP_H
#define YB_CLIP_H

#include <yamabiko/yamabiko.h>

#include "raster.h"
#include "shade.h"

/* Clips a triangle and draws what is left, with its lines, if it may have any; true if that is
 * front-facing and on the screen.
 */
bool clip_draw(const yb_frame_t *frame, const raster_t *raster, const yb_point_t *const corner[3],
               shade_t shade, bool lines);

#endif
