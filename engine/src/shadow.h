/* Cast shadows: a bit for each cell of a grid over the map (idea of the colour paper's shadows). */
#ifndef YB_SHADOW_H
#define YB_SHADOW_H

#include <yamabiko/yamabiko.h>

#include "fix.h"

/* log2 of a cell's width in 1/256 step. */
static inline int shadow_cell_shift(const yb_shadow_t *shadow)
{
    return 16 - fix_log2_floor(shadow->side);
}

/* A place between the middles of the first and the last cell, in eighths of a cell: there, and at
 * all of them alike, the rest of the map has what the nearest of these has.
 */
static inline int32_t shadow_within(int32_t at, int32_t cells)
{
    const int32_t end = 8 * cells - 8;
    if ((uint32_t)at < (uint32_t)end)
        return at;
    return at < 0 || end == 0 ? 0 : end - 1;
}

enum {
    SHADOW_NONE = 64 /* all of the sun */
};

/* How much of the sun reaches a place, in 64ths: blended between the four nearest cells. Inline, as
 * every triangle of a frame with shadows asks; of most places, all four are alike. The place has so
 * many more bits than 1/256 step.
 */
static inline int32_t shadow_at(const yb_shadow_t *shadow, uint32_t x_q, uint32_t y_q, int more)
{
    const int shift = shadow_cell_shift(shadow) - 3 + more;
    const int32_t side = shadow->side;
    const int32_t x = shadow_within((int32_t)(x_q >> shift) - 4, shadow->columns);
    const int32_t y = shadow_within((int32_t)(y_q >> shift) - 4, shadow->rows);
    /* A cell and the one to the east of it are two bits of a byte, or one each of two bytes. The
     * cells to the north of these: 16 bits up. */
    const int32_t cell = (y >> 3) * side + (x >> 3);
    const uint8_t *south = &shadow->lit[cell >> 3];
    const uint8_t *north = south + (side >> 3);
    uint32_t bits = south[0] | (uint32_t)north[0] << 16;
    if ((cell & 7) == 7)
        bits |= (uint32_t)south[1] << 8 | (uint32_t)north[1] << 24;
    bits = bits >> (cell & 7) & 0x30003;
    if (bits == 0x30003)
        return SHADOW_NONE;
    const uint32_t east = (uint32_t)x & 7;
    const uint32_t up = (uint32_t)y & 7;
    const uint32_t rows = (bits & 0x10001) * (8 - east) + (bits >> 1 & 0x10001) * east;
    return (int32_t)((rows & 0xffff) * (8 - up) + (rows >> 16) * up);
}

/* The same of a place in 1/256 step. */
static inline int32_t shadow_light(const yb_shadow_t *shadow, int32_t x_q8, int32_t y_q8)
{
    return shadow_at(shadow, (uint32_t)x_q8, (uint32_t)y_q8, 0);
}

#endif
