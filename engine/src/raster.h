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

enum {
    RASTER_WIDE = 20, /* pixels of a small triangle: in a row, … */
    RASTER_HIGH = 16  /* … and rows */
};

/* Of each row of a triangle, the first pixel on its left side or right of it, and that of its right
 * side: the first that is not drawn any more.
 */
typedef struct {
    int16_t left[RASTER_HIGH], right[RASTER_HIGH];
} raster_sides_t;

typedef struct {
    const yb_screen_t *screen;
    const yb_band_t *band;      /* NULL: nothing is drawn, only looked at */
    int32_t first_row, end_row; /* of the screen */
    yb_triangle_fn each;        /* takes what would be drawn, if there is no band */
    void *context;
    raster_sides_t *sides; /* of the triangle in hand; not needed if there is no band */
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

typedef enum {
    RASTER_NOTHING, /* seen from behind, or the box round it meets no pixel's centre in the band */
    RASTER_FRONT,
    RASTER_SMALL, /* and small: drawn at one depth */
    RASTER_BEYOND /* a corner has no spot: it must be clipped */
} raster_look_t;

/* A triangle on the screen, and the box of the pixels whose centres it may cover: from the first
 * up to the one after the last.
 */
typedef struct {
    const yb_spot_t *p[3];
    int32_t left, right, top, bottom;
} raster_shape_t;

static inline int32_t raster_least(int32_t a, int32_t b, int32_t c)
{
    a = a < b ? a : b;
    return a < c ? a : c;
}

static inline int32_t raster_most(int32_t a, int32_t b, int32_t c)
{
    a = a > b ? a : b;
    return a > c ? a : c;
}

/* Looks at a triangle, counter-clockwise from the front, whose corners have spots and are not all
 * beyond one side of the band, and finds its box.
 */
static inline raster_look_t raster_front(raster_shape_t *shape)
{
    const yb_spot_t *a = shape->p[0];
    const yb_spot_t *b = shape->p[1];
    const yb_spot_t *c = shape->p[2];
    const int32_t ay = a->y_q4;
    const int32_t by = b->y_q4;
    const int32_t cy = c->y_q4;
    const int32_t top = raster_pixel(raster_least(ay, by, cy));
    const int32_t bottom = raster_pixel(raster_most(ay, by, cy));
    if (top >= bottom)
        return RASTER_NOTHING;
    const int32_t ax = a->x_q4;
    const int32_t bx = b->x_q4;
    const int32_t cx = c->x_q4;
    /* y points down: a front, counter-clockwise with y up, is negative here. */
    if ((raster_area_t)(bx - ax) * (cy - ay) - (raster_area_t)(by - ay) * (cx - ax) >= 0)
        return RASTER_NOTHING;
    const int32_t left = raster_pixel(raster_least(ax, bx, cx));
    const int32_t right = raster_pixel(raster_most(ax, bx, cx));
    if (left >= right)
        return RASTER_NOTHING;
    shape->left = left;
    shape->right = right;
    shape->top = top;
    shape->bottom = bottom;
    return right - left > RASTER_WIDE || bottom - top > RASTER_HIGH ? RASTER_FRONT : RASTER_SMALL;
}

/* Draw a triangle that raster_front finds RASTER_FRONT, or RASTER_SMALL, in one pixel value, where
 * it is nearer than what is there. A pixel is covered if its centre is inside, or on a top or left
 * edge: pixels along the common edge of two triangles are drawn once, none is left out. The first
 * is for small ones alone that lie between the screen's left and right side, at one depth, and not
 * for YB_MONO, after raster_covers has said that it covers a pixel in the band, as one in six does
 * not; with a cut (or NULL) the second draws its lines.
 */
bool raster_covers(const raster_t *raster, const raster_shape_t *shape);
void raster_level(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel);
void raster_plane(const raster_t *raster, const raster_shape_t *shape, raster_look_t look,
                  uint16_t pixel, const raster_cut_t *cut);

/* Is a triangle one for raster_level? */
static inline bool raster_is_level(const raster_t *raster, const raster_shape_t *shape,
                                   raster_look_t look)
{
    return look == RASTER_SMALL && shape->left >= 0 && shape->right <= raster->screen->width &&
           raster->screen->format != YB_MONO;
}

static inline void raster_fill(const raster_t *raster, const raster_shape_t *shape,
                               raster_look_t look, uint16_t pixel)
{
    if (!raster_is_level(raster, shape, look))
        raster_plane(raster, shape, look, pixel, NULL);
    else if (raster_covers(raster, shape))
        raster_level(raster, shape, pixel);
}

/* Both: looks, and draws what is in front, if there is a band. */
raster_look_t raster_draw(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                          const yb_spot_t *c, uint16_t pixel);

#endif
