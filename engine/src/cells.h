/* Cells: what is known of each pixel of a band so far, as 16 bits of which the greater is the
 * nearer. On a screen without colours a cell is 12 bits of 1/depth above a shade, and turns into a
 * part of a pixel when all is drawn, in place if the caller likes. With colours it is 1/depth
 * alone, and the colour goes straight to the pixels.
 */
#ifndef YB_CELLS_H
#define YB_CELLS_H

#include <yamabiko/yamabiko.h>

#include "fix.h"
#include "raster.h"

static inline bool cells_have_colours(const yb_screen_t *screen)
{
    return screen->format == YB_RGB565;
}

/* 16 bits of 1/depth as the upper 12 of a cell: three of exponent and ten of mantissa, of which the
 * highest shows in the exponent. What is nearer keeps the greater number; below 1024 nothing is
 * lost, above it less than a 512th.
 */
static inline uint16_t cells_near12(uint16_t near)
{
    const int shift = fix_log2_floor(near | (uint32_t)512) - 9;
    return (uint16_t)(((uint32_t)shift << 13) + (uint32_t)(near >> shift << 4));
}

/* The part of a cell that tells how near it is. */
static inline uint16_t cells_depth(bool colours, uint16_t near)
{
    return colours ? near : cells_near12(near);
}

/* A row of a band. */
typedef struct {
    uint16_t *cell;
    uint8_t *pixel;
} cells_row_t;

/* Row y of the screen. */
static inline cells_row_t cells_row(const raster_t *raster, int32_t y)
{
    const yb_band_t *band = raster->band;
    const size_t line = (size_t)(y - raster->first_row);
    return (cells_row_t){band->cells + line * raster->screen->width,
                         band->pixels + line * band->pitch};
}

/* A row from x on. Without colours there are no pixels yet. */
static inline cells_row_t cells_from(bool colours, const cells_row_t *row, int32_t x)
{
    return (cells_row_t){row->cell + x, row->pixel + (colours ? 2 * x : 0)};
}

/* Writes a colour, high byte first: one store, where a processor can and the compiler knows. */
static inline void cells_colour(uint8_t *pixel, uint16_t colour)
{
#if defined(__GNUC__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    const uint16_t swapped = (uint16_t)(colour << 8 | colour >> 8);
    __builtin_memcpy(pixel, &swapped, sizeof swapped);
#else
    pixel[0] = (uint8_t)(colour >> 8);
    pixel[1] = (uint8_t)colour;
#endif
}

/* Puts a pixel value at a place, if it is nearer than all so far. Of two at one depth the brighter
 * stays; of two colours, the first.
 */
static inline void cells_put(bool colours, cells_row_t at, uint16_t depth, uint16_t pixel)
{
    const uint16_t cell = (uint16_t)(colours ? depth : depth | pixel);
    if (cell <= *at.cell)
        return;
    *at.cell = cell;
    if (colours)
        cells_colour(at.pixel, pixel);
}

/* Nothing but the sky in row y: without colours that is black. */
void cells_clear(const raster_t *raster, int32_t y, uint16_t sky);

/* Row y's pixels, when all is drawn. No row above it is needed as cells any more. */
void cells_show(const raster_t *raster, int32_t y);

#endif
