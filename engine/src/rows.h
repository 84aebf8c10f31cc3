/* What the two ways to fill a triangle share: its sides, and what lies between them. raster.c fills
 * small ones, fast; plane.c all others.
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

/* How far right a side of a small triangle goes in a sixteenth of a row. A side is a function of
 * its two corners, whichever way it is drawn: both triangles at it come to the same pixels, where
 * the one ends and the other begins.
 */
static inline int32_t rows_small_slope(int32_t dx, int32_t dy)
{
    /* The inverse is rounded down, so this is off by less than dx: what is left of dx goes round
     * again. |dx| is at most 2 RASTER_WIDE_Q4 < 2^10, and all products are below 2^30. */
    const int32_t inverse = fix_inverse(dy);
    const int32_t slope = dx * inverse;
    const int32_t left = dx * ((int32_t)1 << ROWS_FRACTION) - slope * dy;
    return slope + (left * inverse >> ROWS_FRACTION);
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
