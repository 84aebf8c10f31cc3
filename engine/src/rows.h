/* What the two ways to fill a triangle share: its sides, and the pixels between them. raster.c fills
 * small ones at one depth, fast; plane.c all others.
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

/* `pixel` as of in_row. */
static inline void put_pixel(const raster_t *raster, uint8_t *row, int32_t x, uint16_t pixel)
{
    if (raster->screen->format == YB_RGB565) {
        row[2 * x] = (uint8_t)(pixel >> 8);
        row[2 * x + 1] = (uint8_t)pixel;
    } else if (raster->screen->format == YB_MONO) {
        uint8_t bit = (uint8_t)(0x80 >> (x & 7));
        row[x >> 3] = (uint8_t)((row[x >> 3] & ~bit) | (pixel & bit));
    } else if ((x & 1) == 0) {
        row[x >> 1] = (uint8_t)((row[x >> 1] & 0x0f) | pixel << 4);
    } else {
        row[x >> 1] = (uint8_t)((row[x >> 1] & 0xf0) | pixel);
    }
}

/* --- Rows ------------------------------------------------------------------------------------- */

/* A row's whole pixels lie this far up in where a side crosses it. */
enum {
    ROWS_FRACTION = 21,         /* of a sixteenth of a pixel */
    ROWS_PIXEL = ROWS_FRACTION + 4
};

/* A side goes down from one corner to another: how far right in one sixteenth of a row. Of sides as
 * those of small triangles without a division. Both triangles at it come to the same pixels: where
 * the one ends and the other begins.
 */
static inline int32_t rows_small_slope(int32_t dx, int32_t dy)
{
    return dx * (int32_t)fix_inverse(dy);
}

/* A third of three times 16 bits, exact for three equal ones: 98303 * 43691 < 2^32. */
static inline uint16_t mean_near(const yb_spot_t *const p[3])
{
    uint32_t sum = (uint32_t)p[0]->near + p[1]->near + p[2]->near + 1;
    return (uint16_t)((sum >> 1) * (uint32_t)43691 >> 16);
}

#endif
