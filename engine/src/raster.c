#include "raster.h"

#include "fix.h"
#include "pixels.h"
#include "rows.h"

/* --- Small triangles -------------------------------------------------------------------------- */

/* A side of a small triangle on its way down: where it crosses a row, right of some pixel, rounded
 * so that its whole pixels are the first whose centre is on the side or right of it.
 */
typedef struct {
    uint32_t at, step; /* it may wrap after the last row */
} side_t;

/* The side down from one corner to another, at row y, right of a base that is given as by
 * begin_base. It lies within 24 + 3 RASTER_WIDE_Q4 of it: below 2^31 with its 20 fractional bits.
 */
static inline side_t find_side(const yb_spot_t *from, const yb_spot_t *to, uint32_t base, int32_t y)
{
    const int32_t slope =
        rows_small_slope(to->x_q4 - (int32_t)from->x_q4, to->y_q4 - (int32_t)from->y_q4);
    const uint32_t start = base + ((uint32_t)from->x_q4 << ROWS_FRACTION);
    return (side_t){start + (uint32_t)slope * (uint32_t)(y * 16 + 8 - from->y_q4),
                    (uint32_t)slope << 4};
}

#if COPIES
static inline side_t begin_side(const yb_spot_t *from, const yb_spot_t *to, uint32_t base,
                                int32_t y)
{
    return find_side(from, to, base, y);
}
#else
/* Where size counts it is called, and its answer comes in two registers, the step in the upper one:
 * a struct would come by memory.
 */
APART uint64_t find_words(const yb_spot_t *from, const yb_spot_t *to, uint32_t base, int32_t y)
{
    const side_t side = find_side(from, to, base, y);
    return (uint64_t)side.step << 32 | side.at;
}

TINY side_t begin_side(const yb_spot_t *from, const yb_spot_t *to, uint32_t base, int32_t y)
{
    const uint64_t words = find_words(from, to, base, y);
    return (side_t){(uint32_t)words, (uint32_t)(words >> 32)};
}
#endif

/* What is to be added to a coordinate: pixels from a base, 8 sixteenths for the first whose centre
 * is not left of it, and the rounding.
 */
static inline uint32_t begin_base(int32_t base)
{
    return ((uint32_t)(8 - base * 16) << ROWS_FRACTION) - ROWS_HALF;
}

static inline int32_t crossing_of(const side_t *side)
{
    return (int32_t)side->at >> ROWS_PIXEL;
}

/* Draws a small triangle: in one pixel value, or with lines. */
TINY void draw_level(bool colours, const raster_t *raster, const raster_shape_t *shape,
                     uint16_t pixel, const raster_cut_t *cut)
{
    const yb_spot_t *a = shape->p[0];
    const yb_spot_t *b = shape->p[1];
    const yb_spot_t *c = shape->p[2];
    const int32_t pair = a->x_q4 >> 5; /* of pixels: two greys are a byte */
    const int32_t y = shape->top;
    uint8_t *row = pixels_row(raster, y) + (colours ? 4 * pair : pair);
    const size_t pitch = raster->pitch;
    uint32_t value = 0;
    if (cut != NULL)
        value = rows_value(cut, y) + (uint32_t)cut->along_x * 2 * (uint32_t)pair;
    /* Down the left side to b and on to c, down the right one to c and on to b: to the lower. */
    const bool turns_left = b->y_q4 < c->y_q4;
    const int32_t turn = raster_pixel(turns_left ? b->y_q4 : c->y_q4);
    const uint32_t base = begin_base(2 * pair);
    side_t left;
    side_t right;
    int32_t rows = shape->bottom - y;
    int32_t rest = 0;
    if (y < turn) {
        left = begin_side(a, b, base, y);
        right = begin_side(a, c, base, y);
        rest = shape->bottom - turn;
        if (rest > 0)
            rows = turn - y;
    } else if (turns_left) {
        left = begin_side(b, c, base, y);
        right = begin_side(a, c, base, y);
    } else {
        left = begin_side(a, b, base, y);
        right = begin_side(c, b, base, y);
    }
    for (;;) {
        do {
            if (cut != NULL) {
                rows_cut(colours, row, crossing_of(&left), crossing_of(&right), value, cut);
                value += (uint32_t)cut->along_y;
            } else {
                rows_fill(colours, row, crossing_of(&left), crossing_of(&right), pixel);
            }
            row += pitch;
            left.at += left.step;
            right.at += right.step;
        } while (--rows != 0);
        if (rest <= 0)
            return;
        if (turns_left)
            left = begin_side(b, c, base, turn);
        else
            right = begin_side(c, b, base, turn);
        rows = rest;
        rest = 0;
    }
}

#if COPIES
APART void draw_lines(const raster_t *raster, const raster_shape_t *shape, const raster_cut_t *cut)
{
    ROWS_DRAW(draw_level, raster, shape, 0, cut);
}

void raster_greys(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel)
{
    draw_level(false, raster, shape, pixel, NULL);
}

void raster_colours(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel)
{
    draw_level(true, raster, shape, pixel, NULL);
}

void raster_level(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut)
{
    if (cut != NULL)
        draw_lines(raster, shape, cut);
    else
        raster_plain(raster, shape, pixel);
}
#else
/* Greys have a copy even here: what they need nearly fits the registers. */
APART void draw_greys(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel)
{
    draw_level(false, raster, shape, pixel, NULL);
}

void raster_level(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut)
{
    if (cut == NULL && !raster->colours)
        draw_greys(raster, shape, pixel);
    else
        draw_level(cut == NULL || raster->colours, raster, shape, pixel, cut);
}
#endif

/* --- Triangles -------------------------------------------------------------------------------- */

#if !COPIES
raster_look_t raster_front(const yb_spot_t *a, const yb_spot_t *b, const yb_spot_t *c,
                           raster_shape_t *shape)
{
    return raster_front_here(a, b, c, shape);
}
#endif

raster_look_t raster_draw(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                          const yb_spot_t *c, uint16_t pixel, const raster_cut_t *cut)
{
    if (a->near == 0 || b->near == 0 || c->near == 0)
        return RASTER_BEYOND;
    int32_t top = raster->first_row * 16 + 8;
    int32_t bottom = raster->end_row * 16 - 8;
    int32_t right = raster->screen->width * 16 - 8;
    if ((a->y_q4 <= top && b->y_q4 <= top && c->y_q4 <= top) ||
        (a->y_q4 > bottom && b->y_q4 > bottom && c->y_q4 > bottom) ||
        (a->x_q4 <= 8 && b->x_q4 <= 8 && c->x_q4 <= 8) ||
        (a->x_q4 > right && b->x_q4 > right && c->x_q4 > right))
        return RASTER_NOTHING;
    raster_shape_t shape;
    raster_look_t look = raster_front(a, b, c, &shape);
    if (raster->band != NULL && (look == RASTER_FRONT || look == RASTER_SMALL))
        raster_fill(raster, &shape, look, pixel, cut);
    return look;
}
