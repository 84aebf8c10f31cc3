/* The pixels of a band, while it is drawn: what is drawn stays, and what is free shows the sky.
 *
 * Without colours they are 16 greys, two a byte, the left one in the high nibble, of which those of
 * YB_MONO become dots when all is drawn; the sky is 0, and nothing else is. With colours they are
 * 16 bits, high byte first, of which the lowest of green tells: it is set in what is drawn.
 */
#ifndef YB_PIXELS_H
#define YB_PIXELS_H

#include <string.h>

#include <yamabiko/yamabiko.h>

#include "compiler.h"
#include "fix.h"
#include "raster.h"

/* A band of a screen to be drawn on. */
static inline raster_t pixels_open(const yb_screen_t *screen, const yb_band_t *band)
{
    const bool mono = screen->format == YB_MONO;
    return (raster_t){
        .screen = screen,
        .band = band,
        .first_row = fix_min(band->y, screen->height),
        .end_row = fix_min(band->y + band->rows, screen->height),
        .pixels = mono ? band->greys : band->pixels,
        .pitch = mono ? yb_band_row_bytes(screen) : band->pitch,
        .top = band->y,
        .colours = screen->format == YB_RGB565,
    };
}

/* Row y of the screen. */
static inline uint8_t *pixels_row(const raster_t *raster, int32_t y)
{
    return raster->pixels + (size_t)(y - raster->top) * raster->pitch;
}

/* The bit of a colour that tells what is drawn. */
#define PIXELS_DRAWN ((uint16_t)0x20)

/* A colour as it lies in memory, for one load or store. */
static inline uint16_t pixels_swapped(uint16_t colour)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return (uint16_t)(colour << 8 | colour >> 8);
#else
    return colour;
#endif
}

/* A pixel with colours, or a pair of them that lies at a multiple of four, is read or written in
 * one instruction, where the compiler is told so.
 */
#if defined(__GNUC__)
#define PIXELS_AT(at, bytes) __builtin_assume_aligned((at), (bytes))
#define PIXELS_COPY __builtin_memcpy
#else
#define PIXELS_AT(at, bytes) (at)
#define PIXELS_COPY memcpy
#endif

static inline void pixels_put_colour(uint8_t *at, uint16_t swapped)
{
    uint16_t there;
    PIXELS_COPY(&there, PIXELS_AT(at, 2), 2);
    if ((there & pixels_swapped(PIXELS_DRAWN)) == 0)
        PIXELS_COPY(PIXELS_AT(at, 2), &swapped, 2);
}

static inline void pixels_put_pair(uint8_t *at, uint32_t pair)
{
    const uint32_t drawn = pixels_swapped(PIXELS_DRAWN) * (uint32_t)0x10001;
    uint32_t there;
    PIXELS_COPY(&there, PIXELS_AT(at, 4), 4);
    if ((there & drawn) == 0) {
        PIXELS_COPY(PIXELS_AT(at, 4), &pair, 4);
    } else if ((there & drawn) != drawn) {
        pixels_put_colour(at, (uint16_t)pair);
        pixels_put_colour(at + 2, (uint16_t)pair);
    }
}

/* Draws on what is free of the pixels from x up to end of a row. */
TINY void pixels_fill_colour_here(uint8_t *row, int32_t x, int32_t end, uint16_t colour)
{
    const uint16_t swapped = pixels_swapped(colour);
    uint8_t *at = row + 2 * x;
    int32_t left = end - x;
    if (left >= 4) {
        const uint32_t pair = swapped * (uint32_t)0x10001;
        if (((uintptr_t)at & 2) != 0) {
            pixels_put_colour(at, swapped);
            at += 2;
            left--;
        }
        for (; left >= 2; left -= 2) {
            pixels_put_pair(at, pair);
            at += 4;
        }
    }
    for (; left > 0; left--) {
        pixels_put_colour(at, swapped);
        at += 2;
    }
}

static inline void pixels_put_grey(uint8_t *row, int32_t x, unsigned grey)
{
    uint8_t *const at = row + (x >> 1);
    const unsigned high = (x & 1) != 0 ? 0 : 4;
    if ((*at & 15u << high) == 0)
        *at = (uint8_t)(*at | grey << high);
}

TINY void pixels_fill_grey_here(uint8_t *row, int32_t x, int32_t end, unsigned grey)
{
    if (x >= end)
        return;
    uint8_t *at = row + (x >> 1);
    uint8_t *const to = row + (end >> 1);
    if ((x & 1) != 0) {
        if ((*at & 15) == 0)
            *at = (uint8_t)(*at | grey);
        at++;
    }
    const unsigned high = grey << 4;
    for (; at != to; at++) {
        unsigned both = *at;
        if ((both & 0xf0) == 0)
            both |= high;
        if ((both & 15) == 0)
            both |= grey;
        *at = (uint8_t)both;
    }
    if ((end & 1) != 0 && (*to & 0xf0) == 0)
        *to = (uint8_t)(*to | high);
}

/* The same, where a call takes less room. */
#if COPIES
#define pixels_fill_colour pixels_fill_colour_here
#define pixels_fill_grey pixels_fill_grey_here
#else
void pixels_fill_colour(uint8_t *row, int32_t x, int32_t end, uint16_t colour);
void pixels_fill_grey(uint8_t *row, int32_t x, int32_t end, unsigned grey);
#endif

/* Nothing but the sky in row y. */
void pixels_clear(const raster_t *raster, int32_t y, uint16_t sky);

/* Row y as it is to be shown, when all is drawn. No row above it is drawn on any more. */
void pixels_show(const raster_t *raster, int32_t y);

#endif
