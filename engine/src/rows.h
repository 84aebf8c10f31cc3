/* What the two ways to fill a triangle share: its sides, and the pixels between them. raster.c
 * fills small ones at one depth, fast; plane.c all others.
 */
#ifndef YB_ROWS_H
#define YB_ROWS_H

#include <yamabiko/rom.h>

#include "fix.h"
#include "raster.h"

/* --- Pixels ----------------------------------------------------------------------------------- */

/* rows_dither[m][y]: which of every four pixels of a row are lit at a shade that reaches m of 16,
 * the leftmost in the highest bit, twice: Bayer's order of four by four.
 */
extern const uint8_t rows_dither[17][4] YB_ROM;

/* What a pixel value is in one row: where a pixel is a bit, eight of them side by side. Shade 15 is
 * all of them.
 */
static inline uint16_t in_row(const raster_t *raster, uint16_t pixel, int32_t y)
{
    if (raster->screen->format != YB_MONO)
        return pixel;
    return yb_rom_u8(&rows_dither[pixel + (pixel >> 3)][y & 3]);
}

static inline void put_grey4(uint8_t *row, int32_t x, uint16_t pixel)
{
    if ((x & 1) == 0)
        row[x >> 1] = (uint8_t)((row[x >> 1] & 0x0f) | pixel << 4);
    else
        row[x >> 1] = (uint8_t)((row[x >> 1] & 0xf0) | pixel);
}

static inline void put_rgb565(uint8_t *row, int32_t x, uint16_t pixel)
{
    row[2 * x] = (uint8_t)(pixel >> 8);
    row[2 * x + 1] = (uint8_t)pixel;
}

/* `pixel` as of in_row. */
static inline void put_mono(uint8_t *row, int32_t x, uint16_t pixel)
{
    const uint8_t bit = (uint8_t)(0x80 >> (x & 7));
    uint8_t *at = &row[x >> 3];
    *at = (uint8_t)((*at & ~bit) | (pixel & bit));
}

static inline void put_pixel(yb_format_t format, uint8_t *row, int32_t x, uint16_t pixel)
{
    if (format == YB_RGB565)
        put_rgb565(row, x, pixel);
    else if (format == YB_MONO)
        put_mono(row, x, pixel);
    else
        put_grey4(row, x, pixel);
}

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

/* --- Values ----------------------------------------------------------------------------------- */

/* A value that is linear on a triangle, at a pixel. */
typedef struct {
    uint32_t at_q14;
    int32_t along_x, along_y;
} plane_t;

/* 1/depth, of which it is a plane. */
static inline uint16_t depth_of(uint32_t near_q14)
{
    return (uint16_t)fix_clamp((int32_t)near_q14 >> 14, 1, 65535);
}

/* --- Lines ------------------------------------------------------------------------------------ */

/* A triangle's cut, as it goes from row to row. */
typedef struct {
    const raster_cut_t *cut;
    plane_t plane;
    int32_t half; /* of a line's width in value, and of the interval, 14 fractional bits */
    int32_t half_interval;
} cutter_t;

/* From row y on. False: the lines would lie so close together that nothing else would be left. */
bool rows_start_cut(cutter_t *cutter, const raster_cut_t *cut, const raster_shape_t *shape,
                    int32_t y);

/* The pixels from x up to end of row y, with lines, where `plane`, the depth, is nearer than what
 * is there. Values are below 2^16, and the interval is: within 2^30.
 */
static inline void draw_cut(const raster_t *raster, uint16_t *depth, uint8_t *row, int32_t y,
                            int32_t x, int32_t end, const plane_t *plane, const cutter_t *cutter)
{
    const raster_cut_t *cut = cutter->cut;
    uint32_t near = plane->at_q14 + (uint32_t)plane->along_x * (uint32_t)x;
    uint32_t value = cutter->plane.at_q14 + (uint32_t)cutter->plane.along_x * (uint32_t)x;
    uint16_t below = cut->below;
    uint16_t above = cut->above;
    uint16_t line = cut->line;
    if (raster->screen->format == YB_MONO) {
        below = in_row(raster, below, y);
        above = in_row(raster, above, y);
        line = in_row(raster, line, y);
    }
    for (; x < end; x++) {
        const uint16_t nearer = depth_of(near);
        if (nearer > depth[x]) {
            int32_t off = (int32_t)value;
            while (cut->interval > 0 && off >= cutter->half_interval)
                off -= 2 * cutter->half_interval;
            depth[x] = nearer;
            put_pixel(raster->screen->format, row, x,
                      fix_abs(off) <= cutter->half ? line
                      : off < 0                    ? below
                                                   : above);
        }
        near += (uint32_t)plane->along_x;
        value += (uint32_t)cutter->plane.along_x;
    }
}

/* A third of three times 16 bits, exact for three equal ones: 98303 * 43691 < 2^32. */
static inline uint16_t mean_near(const yb_spot_t *const p[3])
{
    uint32_t sum = (uint32_t)p[0]->near + p[1]->near + p[2]->near + 1;
    return (uint16_t)((sum >> 1) * (uint32_t)43691 >> 16);
}

#endif
