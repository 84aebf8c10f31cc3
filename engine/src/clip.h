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

/* Nothing nearer is drawn. Points nearer than the near distance have no spots, but the ground
 * before the feet of who looks down is not half as far.
 */
static inline int32_t clip_least(const yb_frame_t *frame)
{
    return frame->near >> 3;
}

/* Clips a triangle and draws what is left, with its lines, if it may have any; true if that is
 * front-facing and on the screen.
 */
bool clip_draw(const yb_frame_t *frame, const raster_t *raster, const yb_point_t *const corner[3],
               shade_t shade, bool lines);

#endif
