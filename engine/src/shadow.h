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
 * every triangle of a frame with shadows asks; of most places, all four are alike.
 */
static inline int32_t shadow_light(const yb_shadow_t *shadow, int32_t x_q8, int32_t y_q8)
{
    const int shift = shadow_cell_shift(shadow) - 3;
    const int32_t side = shadow->side;
    const int32_t x = shadow_within((x_q8 >> shift) - 4, shadow->columns);
    const int32_t y = shadow_within((y_q8 >> shift) - 4, shadow->rows);
    /* A cell and the one to the east of it: two bits of one byte, or of two. */
    const int32_t cell = (y >> 3) * side + (x >> 3);
    const int32_t bit = cell & 7;
    const uint8_t *here = &shadow->lit[cell >> 3];
    const uint8_t *next = here + ((bit + 1) >> 3);
    const int32_t north_by = side >> 3;
    const int32_t south = (int32_t)((here[0] | (uint32_t)next[0] << 8) >> bit & 3);
    const int32_t north = (int32_t)((here[north_by] | (uint32_t)next[north_by] << 8) >> bit & 3);
    const int32_t four = south + 4 * north;
    if (four == 15)
        return SHADOW_NONE;
    if (four == 0)
        return 0;
    const int32_t east = x & 7;
    const int32_t south_row = (south & 1) * (8 - east) + (south >> 1) * east;
    const int32_t north_row = (north & 1) * (8 - east) + (north >> 1) * east;
    return south_row * (8 - (y & 7)) + north_row * (y & 7);
}

#endif
