/* Triangles to pixels, the nearest triangle first. */
#ifndef YB_RASTER_H
#define YB_RASTER_H

#include <yamabiko/yamabiko.h>

#include "compiler.h"
#include "fix.h"

/* Twice an area in 1/256 square pixel. Corners lie within a screen size and a little of the screen,
 * so differences are at most 3 * 16 * YB_MAX_SIDE + 80: 24656 for 512 pixels, and a product of two,
 * twice, 2 * 24656^2 < 2^31.
 */
#if YB_MAX_SIDE <= 512
typedef int32_t raster_area_t;
#else
typedef int64_t raster_area_t;
#endif

/* Lines across a triangle, by a value that is linear on it, modulo 2^32: where it is no more than
 * their width, which is about a pixel. Beyond, where it is negative, or not, one side of a line may
 * have another pixel value than the other.
 */
typedef struct {
    uint32_t at; /* in the middle of the screen's pixel (0, 0) */
    int32_t along_x, along_y;
    uint32_t width;
    uint16_t below, above, line;
} raster_cut_t;

enum {
    RASTER_WIDE_Q4 = 320, /* from the top of a small triangle to either side, at most, … */
    RASTER_HIGH_Q4 = 255, /* … and to the bottom */
    RASTER_TURNED_Q4 = 4  /* a front may be turned away by so much: see raster_front_here */
};

typedef struct {
    const yb_screen_t *screen;
    const yb_band_t *band;      /* NULL: nothing is drawn, only looked at */
    int32_t first_row, end_row; /* of the screen */
    yb_triangle_fn each;        /* takes what would be drawn, if there is no band */
    void *context;
    uint8_t *pixels; /* of the band, as they are while it is drawn: see pixels.h */
    size_t pitch;    /* bytes from one row of them to the next */
    int32_t top;     /* their first row */
    bool colours;
} raster_t;

/* First pixel whose centre is at or right of (below) a coordinate. */
static inline int32_t raster_pixel(int32_t q4)
{
    return (q4 + 7) >> 4;
}

typedef enum {
    RASTER_NOTHING, /* seen from behind, or from its side */
    RASTER_BETWEEN, /* between two rows of pixels' centres: there is nothing to draw */
    RASTER_FRONT,
    RASTER_SMALL, /* and small */
    RASTER_BEYOND /* a corner has no spot: it must be clipped */
} raster_look_t;

/* A triangle on the screen, counter-clockwise from its topmost corner, and the rows of pixels whose
 * centres it may cover: from the first up to the one after the last.
 */
typedef struct {
    const yb_spot_t *p[3];
    int32_t top, bottom;
} raster_shape_t;

static inline bool raster_is_within(int32_t dx, int32_t most)
{
    return (uint32_t)(dx + most) <= 2 * (uint32_t)most;
}

/* Looks at a triangle, counter-clockwise from the front, whose corners have spots.
 *
 * Rounding may turn a sliver over. Its neighbours overlap then, and nothing is missing without it.
 * But sides that are higher than those of small triangles are themselves rounded (see plane.c), so
 * that two of them may cross: where the neighbours leave a pixel to it, a sliver that is drawn has
 * that pixel, and no other. So of those a quarter of a pixel turned away is a front.
 */
TINY raster_look_t raster_front_here(const yb_spot_t *a, const yb_spot_t *b, const yb_spot_t *c,
                                     raster_shape_t *shape)
{
    if (b->y_q4 < a->y_q4 && b->y_q4 <= c->y_q4) {
        const yb_spot_t *last = a;
        a = b;
        b = c;
        c = last;
    } else if (c->y_q4 < a->y_q4) {
        const yb_spot_t *last = b;
        b = a;
        a = c;
        c = last;
    }
    const int32_t high = a->y_q4;
    const int32_t low = fix_max(b->y_q4, c->y_q4);
    shape->top = raster_pixel(high);
    shape->bottom = raster_pixel(low);
    const int32_t bx = (int32_t)b->x_q4 - a->x_q4;
    const int32_t cx = (int32_t)c->x_q4 - a->x_q4;
    /* y points down: what is counter-clockwise with y up is negative here. */
    const raster_area_t twice =
        (raster_area_t)bx * (c->y_q4 - high) - (raster_area_t)(b->y_q4 - high) * cx;
    if (!USUAL(twice < 0) &&
        (low - high <= RASTER_HIGH_Q4 || twice > RASTER_TURNED_Q4 * (low - high)))
        return RASTER_NOTHING;
    if (shape->top == shape->bottom)
        return RASTER_BETWEEN;
    shape->p[0] = a;
    shape->p[1] = b;
    shape->p[2] = c;
    return low - high <= RASTER_HIGH_Q4 && raster_is_within(bx, RASTER_WIDE_Q4) &&
                   raster_is_within(cx, RASTER_WIDE_Q4)
               ? RASTER_SMALL
               : RASTER_FRONT;
}

/* The same, where a call takes less room. */
#if COPIES
#define raster_front raster_front_here
#else
raster_look_t raster_front(const yb_spot_t *a, const yb_spot_t *b, const yb_spot_t *c,
                           raster_shape_t *shape);
#endif

/* Leaves what is in the raster's rows of a triangle. False: nothing. */
static inline bool raster_clip(const raster_t *raster, raster_shape_t *shape)
{
    shape->top = shape->top > raster->first_row ? shape->top : raster->first_row;
    shape->bottom = shape->bottom < raster->end_row ? shape->bottom : raster->end_row;
    return shape->top < shape->bottom;
}

/* Draw a triangle that raster_front finds RASTER_FRONT, or RASTER_SMALL, and that lies in the
 * raster's rows, by its corners or by raster_clip: in one pixel value, where nothing is drawn yet.
 * A pixel is covered if its centre is inside, or on a top or left edge: pixels along the common
 * edge of two triangles are drawn once, none is left out. The first is for small ones alone that
 * lie between the screen's left and right side. With a cut (or NULL) both draw its lines.
 */
void raster_level(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut);
void raster_plane(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut);

/* As raster_level, without lines: a call less. */
#if COPIES
void raster_colours(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel);
void raster_greys(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel);
static inline void raster_plain(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel)
{
    if (raster->colours)
        raster_colours(raster, shape, pixel);
    else
        raster_greys(raster, shape, pixel);
}
#else
static inline void raster_plain(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel)
{
    raster_level(raster, shape, pixel, NULL);
}
#endif

static inline bool raster_on_screen(const raster_t *raster, const yb_spot_t *p)
{
    return (uint32_t)p->x_q4 <= raster->screen->width * (uint32_t)16;
}

static inline void raster_fill(const raster_t *raster, raster_shape_t *shape, raster_look_t look,
                               uint16_t pixel, const raster_cut_t *cut)
{
    if (!raster_clip(raster, shape))
        return;
    if (look == RASTER_SMALL && raster_on_screen(raster, shape->p[0]) &&
        raster_on_screen(raster, shape->p[1]) && raster_on_screen(raster, shape->p[2]))
        raster_level(raster, shape, pixel, cut);
    else
        raster_plane(raster, shape, pixel, cut);
}

/* Both: looks, and draws what is in front, if there is a band. */
raster_look_t raster_draw(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                          const yb_spot_t *c, uint16_t pixel, const raster_cut_t *cut);

#endif
