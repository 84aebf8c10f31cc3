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

/* Lines across a triangle: where a value that is linear on it, 0 to 65535 at its corners, equals
 * `zero`, or that and any multiple of the interval. A line is about a pixel wide. Where there is no
 * interval one side of it has another pixel value.
 */
typedef struct {
    int32_t value[3];
    int32_t zero;
    int32_t interval; /* 0: there is one line only */
    uint16_t below, above, line;
} raster_cut_t;

typedef struct {
    const yb_screen_t *screen;
    const yb_band_t *band;      /* NULL: nothing is drawn, only looked at */
    int32_t first_row, end_row; /* of the screen */
    yb_triangle_fn each;        /* takes what would be drawn, if there is no band */
    void *context;
} raster_t;

/* Clears the band's depths. */
void raster_clear(const raster_t *raster);

/* Fills a row of the band, y counted on the screen, with one pixel value. */
void raster_row(const raster_t *raster, int32_t y, uint16_t pixel);

/* First pixel whose centre is at or right of (below) a coordinate. */
static inline int32_t raster_pixel(int32_t q4)
{
    return (q4 + 7) >> 4;
}

enum {
    RASTER_LEVEL = 16
};

typedef enum {
    RASTER_NOTHING, /* seen from behind, or the box round it meets no pixel's centre in the band */
    RASTER_FRONT,
    RASTER_SMALL, /* and not larger than RASTER_LEVEL pixels: drawn at one depth */
    RASTER_BEYOND /* a corner has no spot: it must be clipped */
} raster_look_t;

/* Looks at a triangle, counter-clockwise from the front, whose corners have spots and are not all
 * beyond one side of the band.
 */
static inline raster_look_t raster_front(const yb_spot_t *a, const yb_spot_t *b, const yb_spot_t *c)
{
    int32_t top = a->y_q4 < b->y_q4 ? a->y_q4 : b->y_q4;
    int32_t bottom = a->y_q4 < b->y_q4 ? b->y_q4 : a->y_q4;
    top = raster_pixel(c->y_q4 < top ? c->y_q4 : top);
    bottom = raster_pixel(c->y_q4 > bottom ? c->y_q4 : bottom);
    /* y points down: a front, counter-clockwise with y up, is negative here. */
    if (top >= bottom ||
        ((raster_area_t)b->x_q4 - a->x_q4) * ((raster_area_t)c->y_q4 - a->y_q4) -
                ((raster_area_t)b->y_q4 - a->y_q4) * ((raster_area_t)c->x_q4 - a->x_q4) >=
            0)
        return RASTER_NOTHING;
    int32_t left = a->x_q4 < b->x_q4 ? a->x_q4 : b->x_q4;
    int32_t right = a->x_q4 < b->x_q4 ? b->x_q4 : a->x_q4;
    left = raster_pixel(c->x_q4 < left ? c->x_q4 : left);
    right = raster_pixel(c->x_q4 > right ? c->x_q4 : right);
    if (left >= right)
        return RASTER_NOTHING;
    return right - left > RASTER_LEVEL || bottom - top > RASTER_LEVEL ? RASTER_FRONT : RASTER_SMALL;
}

/* Draw a triangle that raster_front finds RASTER_FRONT, or RASTER_SMALL, in one pixel value, where
 * it is nearer than what is there. A pixel is covered if its centre is inside, or on a top or left
 * edge: pixels along the common edge of two triangles are drawn once, none is left out. The first
 * is for small ones alone, at one depth; with a cut (or NULL) the second draws its lines.
 */
void raster_level(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                  const yb_spot_t *c, uint16_t pixel);
void raster_plane(const raster_t *raster, const yb_spot_t *const p[3], raster_look_t look,
                  uint16_t pixel, const raster_cut_t *cut);

static inline void raster_fill(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                               const yb_spot_t *c, raster_look_t look, uint16_t pixel)
{
    if (look == RASTER_SMALL)
        raster_level(raster, a, b, c, pixel);
    else
        raster_plane(raster, (const yb_spot_t *const[3]){a, b, c}, look, pixel, NULL);
}

/* Both: looks, and draws what is in front, if there is a band. */
raster_look_t raster_draw(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                          const yb_spot_t *c, uint16_t pixel);

#endif
