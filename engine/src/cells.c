#include "cells.h"

#include <string.h>

#include <yamabiko/rom.h>

/* Which of every four pixels of a row are lit at a shade that reaches m of 16, [m][y & 3], the
 * leftmost in the highest bit, twice: Bayer's order of four by four.
 */
static const uint8_t dither[17][4] YB_ROM = {
    {0x00, 0x00, 0x00, 0x00}, {0x88, 0x00, 0x00, 0x00}, {0x88, 0x00, 0x22, 0x00},
    {0xaa, 0x00, 0x22, 0x00}, {0xaa, 0x00, 0xaa, 0x00}, {0xaa, 0x44, 0xaa, 0x00},
    {0xaa, 0x44, 0xaa, 0x11}, {0xaa, 0x55, 0xaa, 0x11}, {0xaa, 0x55, 0xaa, 0x55},
    {0xee, 0x55, 0xaa, 0x55}, {0xee, 0x55, 0xbb, 0x55}, {0xff, 0x55, 0xbb, 0x55},
    {0xff, 0x55, 0xff, 0x55}, {0xff, 0xdd, 0xff, 0x55}, {0xff, 0xdd, 0xff, 0x77},
    {0xff, 0xff, 0xff, 0x77}, {0xff, 0xff, 0xff, 0xff},
};

static void fill_colour(uint8_t *pixel, size_t width, uint16_t colour)
{
    uint8_t *const end = pixel + 2 * width;
    for (; end - pixel >= 8; pixel += 8) {
        cells_colour(pixel, colour);
        cells_colour(pixel + 2, colour);
        cells_colour(pixel + 4, colour);
        cells_colour(pixel + 6, colour);
    }
    for (; pixel != end; pixel += 2)
        cells_colour(pixel, colour);
}

void cells_clear(const raster_t *raster, int32_t y, uint16_t sky)
{
    const yb_screen_t *screen = raster->screen;
    const cells_row_t row = cells_row(raster, y);
    memset(row.cell, 0, screen->width * sizeof *row.cell);
    if (cells_have_colours(screen))
        fill_colour(row.pixel, screen->width, sky);
}

static void show_grey4(cells_row_t row, size_t width)
{
    for (const uint16_t *const end = row.cell + width; row.cell < end; row.cell += 2)
        *row.pixel++ = (uint8_t)(row.cell[0] << 4 | (row.cell[1] & 15));
}

/* Shade 15 lights all pixels. */
static void show_mono(cells_row_t row, size_t width, int32_t y)
{
    for (size_t x = 0; x < width; x += 8) {
        const size_t left = width - x < 8 ? width - x : 8;
        unsigned byte = 0;
        for (size_t i = 0; i < left; i++) {
            const unsigned shade = row.cell[x + i] & 15;
            byte |= yb_rom_u8(&dither[shade + (shade >> 3)][y & 3]) & 0x80u >> i;
        }
        *row.pixel++ = (uint8_t)byte;
    }
}

void cells_show(const raster_t *raster, int32_t y)
{
    const yb_screen_t *screen = raster->screen;
    const cells_row_t row = cells_row(raster, y);
    if (screen->format == YB_GREY4)
        show_grey4(row, screen->width);
    else if (screen->format == YB_MONO)
        show_mono(row, screen->width, y);
}
