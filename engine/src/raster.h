/* Triangles to pixels, with a depth per pixel. */
#ifndef YB_RASTER_H
#define YB_RASTER_H

#include <yamabiko/yamabiko.h>

typedef struct {
    const yb_screen_t *screen;
    const yb_band_t *band;
    int32_t first_row, end_row; /* of the screen */
} raster_t;

/* A corner on the screen: 1/16 pixel, x to the right and y down, and 1/depth. */
typedef struct {
    int32_t x_q4, y_q4;
    int32_t near;
} raster_point_t;

/* Clears the band's depths and fills it with one pixel value. */
void raster_clear(const raster_t *raster, uint16_t pixel);

/* Draws a triangle in one pixel value where it is nearer than what is there; true if it is
 * front-facing (counter-clockwise to the eye). Coordinates lie within one screen size of the
 * screen. A pixel is covered if its centre is inside, or on a top or left edge: pixels along the
 * common edge of two triangles are drawn once, none is left out.
 */
bool raster_triangle(const raster_t *raster, const raster_point_t corner[3], uint16_t pixel);

#endif
