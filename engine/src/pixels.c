#include "pixels.h"

#include <yamabiko/rom.h>

/* Which of every four pixels of a row are lit at a grey that reaches m of 16, [m][y & 3], the
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

#if !COPIES
void pixels_fill_colour(uint8_t *row, int32_t x, int32_t end, uint16_t colour)
{
    pixels_fill_colour_here(row, x, end, colour);
}

void pixels_fill_grey(uint8_t *row, int32_t x, int32_t end, unsigned grey)
{
    pixels_fill_grey_here(row, x, end, grey);
}
#endif

void pixels_clear(const raster_t *raster, int32_t y, uint16_t sky)
{
    const size_t bytes = yb_band_row_bytes(raster->screen);
    uint8_t *at = pixels_row(raster, y);
    uint8_t *const end = at + bytes;
    if (!raster->colours) {
        memset(at, 0, bytes);
        return;
    }
    const uint16_t swapped = pixels_swapped(sky);
    for (; at != end && ((uintptr_t)at & 2) != 0; at += 2)
        PIXELS_COPY(PIXELS_AT(at, 2), &swapped, 2);
    for (const uint32_t pair = swapped * (uint32_t)0x10001; end - at >= 16; at += 16) {
        for (int i = 0; i < 16; i += 4)
            PIXELS_COPY(PIXELS_AT(at + i, 4), &pair, 4);
    }
    for (; at != end; at += 2)
        PIXELS_COPY(PIXELS_AT(at, 2), &swapped, 2);
}

/* The darkest grey that is drawn, 1, lights none, the lightest, 15, all. */
static void show_mono(const uint8_t *grey, uint8_t *dots, size_t width, int32_t y)
{
    for (size_t x = 0; x < width; x += 8) {
        const size_t left = width - x < 8 ? width - x : 8;
        unsigned byte = 0;
        for (size_t i = 0; i < left; i++) {
            const unsigned shade = grey[(x + i) / 2] >> ((i & 1) != 0 ? 0 : 4) & 15;
            if (shade > 1)
                byte |= yb_rom_u8(&dither[shade + (shade >> 3)][y & 3]) & 0x80u >> i;
        }
        dots[x / 8] = (uint8_t)byte;
    }
}

void pixels_show(const raster_t *raster, int32_t y)
{
    const yb_band_t *band = raster->band;
    if (raster->screen->format == YB_MONO)
        show_mono(pixels_row(raster, y), band->pixels + (size_t)(y - band->y) * band->pitch,
                  raster->screen->width, y);
}
