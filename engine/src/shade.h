/* Light and colour: 14 shades of a hue that depends on the height (colour paper). */
#ifndef YB_SHADE_H
#define YB_SHADE_H

#include <yamabiko/yamabiko.h>

/* Fills in frame's colour constants. */
void shade_begin(yb_frame_t *frame);

uint16_t shade_background(const yb_frame_t *frame);

/* The pixel value of a triangle of the ground (or of the water, where all three corners are in
 * it).
 */
uint16_t shade_ground(const yb_frame_t *frame, const yb_point_t *const corner[3]);

/* The pixel value of the wall below the edge ab of the frame, ground to its left. */
uint16_t shade_wall(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b);

#endif
