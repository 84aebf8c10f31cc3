/* The ink of a drawn sheet: a PNG of dark lines on light paper, pixel by pixel ink or paper.
 *
 * The paper's brightness is measured block by block, so that a shadow across the sheet or a yellow
 * edge is not taken for ink; what is darker than the paper around it by more than part of what the
 * ink is darker, is ink.
 */
#ifndef YB_INK_H
#define YB_INK_H

#include <stddef.h>
#include <stdint.h>

#include "error.h"

enum {
    YB_INK_LEAST_SIDE = 16,
    YB_INK_MOST_PIXELS = 64000000
};

/* Rows from the top. There is a rim of paper, one pixel wide, all round the picture: every pixel
 * has eight neighbours.
 */
typedef struct {
    int width, height;
    int left, top;    /* pixels of the file that were cut away there */
    double thickness; /* of the lines, in pixels; at least 1 */
    uint8_t *pixel;   /* (width + 2) * (height + 2): 1 ink, 0 paper */
} yb_ink_t;

/* Reads any PNG; transparent pixels are white paper. If a rectangle is drawn along all four sides,
 * the picture is cut to what lies inside it. Small bright holes in lines are filled. False with a
 * sentence: not readable, too small, too large, no ink at all, or far too much of it. Free it by
 * yb_ink_free in any case.
 */
bool yb_ink_read(yb_ink_t *ink, const char *path, yb_error_t *error);

void yb_ink_free(yb_ink_t *ink);

static inline int yb_ink_pitch(const yb_ink_t *ink)
{
    return ink->width + 2;
}

static inline int32_t yb_ink_index(const yb_ink_t *ink, int x, int y)
{
    return (y + 1) * yb_ink_pitch(ink) + x + 1;
}

static inline int yb_ink_x(const yb_ink_t *ink, int32_t index)
{
    return index % yb_ink_pitch(ink) - 1;
}

static inline int yb_ink_y(const yb_ink_t *ink, int32_t index)
{
    return index / yb_ink_pitch(ink) - 1;
}

/* Steps to the eight neighbours, clockwise from the north. */
static inline void yb_ink_around(const yb_ink_t *ink, int32_t step[8])
{
    const int pitch = yb_ink_pitch(ink);
    const int32_t steps[8] = {-pitch, -pitch + 1, 1, pitch + 1, pitch, pitch - 1, -1, -pitch - 1};
    for (int i = 0; i < 8; i++)
        step[i] = steps[i];
}

#endif
