/* Triangles to pixels, with a depth per pixel. */
#ifndef YB_RASTER_H
#define YB_RASTER_H

#include <yamabiko/yamabiko.h>

/* Twice an area in 1/256 square pixel. Corners lie within a screen size and a little of the screen,
 * so differences are at most 3 * 16 * YB_MAX_SIDE + 80: 24656 for 512 pixels, and a product of two,
 * twice, 2 * 24656^2 < 2^31.
 */
#if YB_MAX_SIDE <= 512
typedef int32_t raster_area_t;
#else
typedef int64_t raster_area_t;
#endif

typedef struct {
    const yb_screen_t *screen;
    const yb_band_t *band;
    int32_t first_row, end_row; /* of the screen */
} raster_t;

/* Clears the band's depths and fills it with one pixel value. */
void raster_clear(const raster_t *raster, uint16_t pixel);

/* A triangle ready to be filled. */
typedef struct {
    const yb_spot_t *p[3]; /* clockwise as seen, the topmost first */
    int32_t y0, y1;        /* rows of the band that it may touch, the end excluded */
} raster_setup_t;

/* Looks at a triangle, counter-clockwise from the front and within a screen size of the screen:
 * false if it is seen from behind or the box round it meets no pixel's centre in the band.
 */
bool raster_setup(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                  const yb_spot_t *c, raster_setup_t *setup);

/* Draws it in one pixel value where it is nearer than what is there. A pixel is covered if its
 * centre is inside, or on a top or left edge: pixels along the common edge of two triangles are
 * drawn once, none is left out.
 */
void raster_fill(const raster_t *raster, const raster_setup_t *setup, uint16_t pixel);

#endif
