/* Light and colour: 14 shades of a hue that depends on the height (colour paper). */
#ifndef YB_SHADE_H
#define YB_SHADE_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

/* The pixel value of a triangle of the ground (or of the water, where all three corners are in
 * it).
 */
uint16_t shade_ground(const yb_frame_t *frame, const yb_point_t *const corner[3]);

/* The line that a triangle of this pixel value is cut by, if there is one: the shore, or contour
 * lines.
 */
bool shade_cut(const yb_frame_t *frame, const yb_point_t *const corner[3], uint16_t pixel,
               raster_cut_t *cut);

/* The pixel value of the wall below the edge ab of the frame, ground to its left. */
uint16_t shade_wall(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b);

#endif
