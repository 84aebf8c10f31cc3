/* What fills a triangle: the sides of small ones, as raster.c has them, and what lies between two
 * sides, also where plane.c fills all others.
 */
#ifndef YB_ROWS_H
#define YB_ROWS_H

#include "fix.h"
#include "pixels.h"
#include "raster.h"

/* --- Rows ------------------------------------------------------------------------------------- */

/* A row's whole pixels lie this far up in where a side crosses it. */
enum {
    ROWS_FRACTION = 20, /* of a sixteenth of a pixel */
    ROWS_PIXEL = ROWS_FRACTION + 4
};

/* A side is a function of its two corners, whichever way it is drawn: both triangles at it come to
 * the same pixels, where the one ends and the other begins. A small triangle's goes at most
 * 2 RASTER_WIDE_Q4 < 2^10 to a side and at most RASTER_HIGH_Q4 < 2^8 down, and where it crosses
 * a row is a multiple of 1/RASTER_HIGH_Q4 or of more: 2^20 / 255 = 4112. What is taken for it,
 * rounded, may be off by less than half of that, and if half of that is taken away beforehand, its
 * whole pixels are right: a centre on the side is still right of it.
 */
enum {
    ROWS_HALF = 2048
};

#if defined(__ARM_FEATURE_IDIV) || defined(__riscv_div)
#define ROWS_DIVIDE 1
#else
#define ROWS_DIVIDE 0
#endif

/* How far right a side of a small triangle goes in a sixteenth of a row, within 2: what is off by
 * that in every sixteenth, up to 255 times, is off by less than ROWS_HALF. So processors may come
 * to it in their own ways, and to the same pixels. One that divides is asked to: one instruction.
 */
static inline int32_t rows_small_slope(int32_t dx, int32_t dy)
{
#if ROWS_DIVIDE
    return dx * ((int32_t)1 << ROWS_FRACTION) / dy;
#else
    /* The inverse is rounded down, so this is off by less than dx: what is left of dx goes round
     * again. All products are below 2^30. */
    const int32_t inverse = fix_inverse(dy);
    const int32_t slope = dx * inverse;
    const int32_t left = dx * ((int32_t)1 << ROWS_FRACTION) - slope * dy;
    return slope + (left * inverse >> ROWS_FRACTION);
#endif
}

/* --- Lines ------------------------------------------------------------------------------------ */

/* A cut's value in a row. */
static inline uint32_t rows_value(const raster_cut_t *cut, int32_t y)
{
    return cut->at + (uint32_t)cut->along_y * (uint32_t)y;
}

/* What is seen at a value. */
static inline uint16_t cut_at(const raster_cut_t *cut, uint32_t value)
{
    return value <= cut->width ? cut->line : (int32_t)value < 0 ? cut->below : cut->above;
}

/* Where speed counts more than size, there is a copy with colours and one without, for lines and
 * for none: branching on that would be a seventh of what a triangle costs.
 */
#if COPIES
#define ROWS_DRAW(draw, raster, ...)                                                               \
    ((raster)->colours ? draw(true, raster, __VA_ARGS__) : draw(false, raster, __VA_ARGS__))
#else
#define ROWS_DRAW(draw, raster, ...) draw((raster)->colours, raster, __VA_ARGS__)
#endif

/* --- Pixels ------------------------------------------------------------------------------------
 */

/* The pixels from x up to end of a row. */
static inline void rows_fill(bool colours, uint8_t *row, int32_t x, int32_t end, uint16_t pixel)
{
    if (colours)
        pixels_fill_colour(row, x, end, pixel);
    else
        pixels_fill_grey(row, x, end, pixel);
}

/* The same, with lines, by the value at the pixel 0. */
static inline void rows_cut(bool colours, uint8_t *row, int32_t x, int32_t end, uint32_t value,
                            const raster_cut_t *cut)
{
    value += (uint32_t)cut->along_x * (uint32_t)x;
    for (; x < end; x++, value += (uint32_t)cut->along_x) {
        const uint16_t pixel = cut_at(cut, value);
        if (colours)
            pixels_put_colour(row + 2 * x, pixels_swapped(pixel));
        else
            pixels_put_grey(row, x, pixel);
    }
}

#endif
