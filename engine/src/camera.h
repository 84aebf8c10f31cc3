/* The camera (colour paper): from the map's axes to the view's, and on to the screen.
 *
 * View space: right, up and depth, in q8 steps from the eye. "Visible" is what lies beyond the near
 * distance and in the pyramid |right|, |up| < 2 depth, which holds the picture: there a point can
 * be projected with 32-bit arithmetic.
 */
#ifndef YB_CAMERA_H
#define YB_CAMERA_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

typedef struct {
    int32_t right_q8, up_q8, depth_q8;
} camera_point_t;

/* Fills in frame's camera constants and turns all vertices of the map: frame->seen. */
void camera_begin(yb_frame_t *frame);

/* Where a point of the surface is seen: itself, or the water above it. */
void camera_place(const yb_frame_t *frame, const yb_point_t *point, camera_point_t *place);

/* A visible place on the screen (also one that rounding put just outside). */
void camera_project(const yb_frame_t *frame, const camera_point_t *place, raster_point_t *screen);

/* Sets a point's screen position and whether it is visible, from its view position. */
void camera_see(const yb_frame_t *frame, yb_point_t *point);

/* The point straight above or below `point` at height z, to be drawn there, under water or not. */
void camera_drop(const yb_frame_t *frame, const yb_point_t *point, int32_t z_q8, yb_point_t *to);

#endif
