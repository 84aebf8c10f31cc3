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

/* The side down from one corner to another at row y. It lies within 24 + 3 RASTER_WIDE_Q4 of the
 * base: below 2^31 with its 20 fractional bits.
 */
static inline side_t begin_side(const yb_spot_t *from, const yb_spot_t *to, int32_t base_q4,
                                int32_t y)
{
    const int32_t slope =
        rows_small_slope(to->x_q4 - (int32_t)from->x_q4, to->y_q4 - (int32_t)from->y_q4);
    const int32_t at = (from->x_q4 - base_q4) * ((int32_t)1 << ROWS_FRACTION) - 1 +
                       slope * (y * 16 + 8 - from->y_q4);
    return (side_t){(uint32_t)at, (uint32_t)slope << 4};
}

static inline int32_t crossing_of(const side_t *side)
{
    return (int32_t)side->at >> ROWS_PIXEL;
}

/* Where speed counts more than size, there is a copy with colours and one without, for lines and
 * for none: branching on that would be a seventh of what a triangle costs.
 */

/* Draws a small triangle: in one pixel value, or with lines. */
COPIED void draw_level(bool colours, const raster_t *raster, const raster_shape_t *shape,
                       uint16_t pixel, const raster_cut_t *cut)
{
    const yb_spot_t *a = shape->p[0];
    const yb_spot_t *b = shape->p[1];
    const yb_spot_t *c = shape->p[2];
    int32_t y = fix_max(shape->top, raster->first_row);
    const int32_t end = fix_min(shape->bottom, raster->end_row);
    /* Down the left side to b and on to c, down the right one to c and on to b: to the lower. */
    const int32_t left_end = raster_pixel(b->y_q4);
    const int32_t right_end = raster_pixel(c->y_q4);
    const int32_t base = a->x_q4 >> 5 << 1; /* even: two greys are a byte */
    const int32_t centre_q4 = base * 16 - 8;
    side_t left = begin_side(y < left_end ? a : b, y < left_end ? b : c, centre_q4, y);
    side_t right = begin_side(y < right_end ? a : c, y < right_end ? c : b, centre_q4, y);
    const size_t pitch = pixels_pitch(raster);
    uint8_t *row = pixels_row(raster, y) + (colours ? 2 * base : base / 2);
    uint32_t value = 0;
    if (cut != NULL)
        value = rows_value(cut, y) + (uint32_t)cut->along_x * (uint32_t)base;
    for (;;) {
        if (cut != NULL) {
            rows_cut(colours, row, crossing_of(&left), crossing_of(&right), value, cut);
            value += (uint32_t)cut->along_y;
        } else {
            rows_fill(colours, row, crossing_of(&left), crossing_of(&right), pixel);
        }
        if (++y == end)
            return;
        row += pitch;
        left.at += left.step;
        right.at += right.step;
        if (y == left_end)
            left = begin_side(b, c, centre_q4, y);
        if (y == right_end)
            right = begin_side(c, b, centre_q4, y);
    }
}

static void draw_lines(const raster_t *raster, const raster_shape_t *shape, const raster_cut_t *cut)
{
    if (pixels_have_colours(raster->screen))
        draw_level(true, raster, shape, 0, cut);
    else
        draw_level(false, raster, shape, 0, cut);
}

void raster_level(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut)
{
    if (shape->top >= raster->end_row || shape->bottom <= raster->first_row)
        return;
    if (cut != NULL)
        draw_lines(raster, shape, cut);
    else if (pixels_have_colours(raster->screen))
        draw_level(true, raster, shape, pixel, NULL);
    else
        draw_level(false, raster, shape, pixel, NULL);
}

/* --- Triangles -------------------------------------------------------------------------------- */

raster_look_t raster_draw(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                          const yb_spot_t *c, uint16_t pixel)
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
        raster_fill(raster, &shape, look, pixel, NULL);
    return look;
}
