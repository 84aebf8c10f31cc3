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

/* How far right a side of a small triangle goes in a sixteenth of a row, within 2: what is off by
 * that in every sixteenth, up to 255 times, is off by less than ROWS_HALF.
 */
static inline int32_t rows_slope_by_table(int32_t dx, int32_t dy)
{
    /* The inverse is rounded down, so this is off by less than dx: what is left of dx goes round
     * again. All products are below 2^30. */
    const int32_t inverse = fix_inverse(dy);
    const int32_t slope = dx * inverse;
    const int32_t left = dx * ((int32_t)1 << ROWS_FRACTION) - slope * dy;
    return slope + (left * inverse >> ROWS_FRACTION);
}

/* The same in two instructions, where one of them divides. */
static inline int32_t rows_slope_by_division(int32_t dx, int32_t dy)
{
    return dx * ((int32_t)1 << ROWS_FRACTION) / dy;
}

static inline int32_t rows_small_slope(int32_t dx, int32_t dy)
{
#if defined(__ARM_FEATURE_IDIV) || defined(__riscv_div)
    return rows_slope_by_division(dx, dy);
#else
    return rows_slope_by_table(dx, dy);
#endif
}

/* --- Values ----------------------------------------------------------------------------------- */

/* A value that is linear on a triangle, at a pixel. */
typedef struct {
    uint32_t at_q14;
    int32_t along_x, along_y;
} plane_t;

/* --- Lines ------------------------------------------------------------------------------------ */

/* A triangle's cut, as it goes from row to row. */
typedef struct {
    plane_t plane;         /* of the value, less that of a line */
    int32_t half;          /* of a line's width in value, and of the interval, 14 fractional bits */
    int32_t half_interval; /* 0: there is one line only */
    const raster_cut_t *cut;
} cutter_t;

/* From row y on. False: the lines would lie so close together that nothing else would be left. */
bool rows_start_cut(cutter_t *cutter, const raster_cut_t *cut, const raster_shape_t *shape,
                    int32_t y);

/* What is seen at a value. Values are below 2^16, and the interval is: within 2^30. */
static inline uint16_t cut_at(const cutter_t *cutter, uint32_t value)
{
    int32_t off = (int32_t)value;
    if (cutter->half_interval > 0) {
        while (off >= cutter->half_interval)
            off -= 2 * cutter->half_interval;
    }
    return fix_abs(off) <= cutter->half ? cutter->cut->line
           : off < 0                    ? cutter->cut->below
                                        : cutter->cut->above;
}

/* Where speed counts more than size, there is a copy with colours and one without, for lines and
 * for none: branching on that would be a seventh of what a triangle costs.
 */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define ROWS_COPIED static inline __attribute__((always_inline))
#define ROWS_DRAW(draw, raster, ...)                                                               \
    ((raster)->colours ? draw(true, raster, __VA_ARGS__) : draw(false, raster, __VA_ARGS__))
#else
#define ROWS_COPIED static
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

/* The same, with lines. */
static inline void rows_cut(bool colours, uint8_t *row, int32_t x, int32_t end,
                            const cutter_t *cutter)
{
    uint32_t value = cutter->plane.at_q14 + (uint32_t)cutter->plane.along_x * (uint32_t)x;
    for (; x < end; x++, value += (uint32_t)cutter->plane.along_x) {
        const uint16_t pixel = cut_at(cutter, value);
        if (colours)
            pixels_put_colour(row + 2 * x, pixels_swapped(pixel));
        else
            pixels_put_grey(row, x, pixel);
    }
}

#endif
