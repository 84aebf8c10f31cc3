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

/* A cell, and the one `step` further on: none, one or both of two bits. */
static inline uint32_t shadow_pair(const yb_shadow_t *shadow, int32_t cell, int32_t step)
{
    const int32_t next = cell + step;
    return (uint32_t)(shadow->lit[cell >> 3] >> (cell & 7) & 1) |
           (uint32_t)(shadow->lit[next >> 3] >> (next & 7) & 1) << 1;
}

enum {
    SHADOW_NONE = 64 /* all of the sun */
};

/* How much of the sun reaches a place, in 64ths: blended between the four nearest cells. Inline, as
 * every triangle of a frame with shadows asks; of most places, all four are alike.
 */
static inline int32_t shadow_light(const yb_shadow_t *shadow, int32_t x_q8, int32_t y_q8)
{
    int shift = shadow_cell_shift(shadow);
    /* From the middle of a cell to the middle of the next, in eighths; from the grid's rim on,
     * none.
     */
    int32_t x = fix_max((x_q8 - ((int32_t)1 << (shift - 1))) >> (shift - 3), 0);
    int32_t y = fix_max((y_q8 - ((int32_t)1 << (shift - 1))) >> (shift - 3), 0);
    int32_t i = fix_min(x >> 3, shadow->columns - 1);
    int32_t j = fix_min(y >> 3, shadow->rows - 1);
    int32_t to_east = i < shadow->columns - 1 ? 1 : 0;
    int32_t to_north = j < shadow->rows - 1 ? shadow->side : 0;
    int32_t cell = j * shadow->side + i;
    uint32_t south = shadow_pair(shadow, cell, to_east);
    uint32_t north = shadow_pair(shadow, cell + to_north, to_east);
    if (south == north && (south == 0 || south == 3))
        return south == 0 ? 0 : SHADOW_NONE;
    int32_t east = x & 7;
    int32_t south_row = (int32_t)(south & 1) * (8 - east) + (int32_t)(south >> 1) * east;
    int32_t north_row = (int32_t)(north & 1) * (8 - east) + (int32_t)(north >> 1) * east;
    return south_row * (8 - (y & 7)) + north_row * (y & 7);
}

#endif
