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

/* How much of the sun reaches a place, in 64ths: blended between the four nearest cells. */
int32_t shadow_light(const yb_shadow_t *shadow, int32_t x_q8, int32_t y_q8);

#endif
