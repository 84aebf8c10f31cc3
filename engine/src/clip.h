/* Leaves that stick out of the view: cut at the near distance, a screen size beyond the screen and
 * at the pyramid in which points can be projected.
 *
 * Nearly all leaves need none of this. A cut point is always computed from the end inside to the
 * end outside, so two triangles that share an edge cut it in the same place.
 */
#ifndef YB_CLIP_H
#define YB_CLIP_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

/* Must a triangle be clipped before the rasteriser can take it? If not, `to` has its corners. */
bool clip_needs(const yb_frame_t *frame, const yb_point_t *const corner[3], raster_point_t to[3]);

/* Clips a triangle and draws what is left; true if that is front-facing and on the screen. */
bool clip_draw(const yb_frame_t *frame, const raster_t *raster, const yb_point_t *const corner[3],
               uint16_t pixel);

#endif
