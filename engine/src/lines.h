/* Lines across a triangle: contour lines and the shore, by a value that is linear on the screen. */
#ifndef YB_LINES_H
#define YB_LINES_H

#include "fix.h"
#include "raster.h"

/* The value of a height: times so much, and so much more, modulo 2^32. That of a contour line is 0,
 * and so is the next one's.
 */
typedef struct {
    uint32_t scale; /* 2^15 to 2^27 */
    uint32_t zero;
    int shift; /* which leaves 16 bits of the scale */
} lines_scale_t;

/* In line where speed counts more than size. */
#if COPIES
#define LINES_RECIPROCAL fix_reciprocal_here
#else
#define LINES_RECIPROCAL fix_reciprocal
#endif

/* 2^30 of a value in a pixel, of 16 sixteenths, and a 64th more. */
#define LINES_STEEP ((int32_t)0x4100000)

enum {
    LINES_NARROW = 168 /* pixels: on a screen no larger, differences are below 2^13 */
};

/* Finds a cut's values of a triangle, counter-clockwise, whose heights differ by less than 2^16.
 * False: it has no area, or a line is a quarter of the way from one to the next, or more; where
 * there is one only, the triangle is a sliver.
 *
 * Twice the area is below 2^27, and the determinants of rises and sides below 2^30. Of these
 * numbers the leading bits will do: lines are off by less than 2^-11 of where they begin.
 */
COPIED bool lines_find(const yb_screen_t *screen, const yb_point_t *const p[3], lines_scale_t by,
                       raster_cut_t *cut)
{
    const yb_spot_t *a = &p[0]->spot;
    const yb_spot_t *b = &p[1]->spot;
    const yb_spot_t *c = &p[2]->spot;
    int32_t x1 = (int32_t)b->x_q4 - a->x_q4;
    int32_t y1 = (int32_t)b->y_q4 - a->y_q4;
    int32_t x2 = (int32_t)c->x_q4 - a->x_q4;
    int32_t y2 = (int32_t)c->y_q4 - a->y_q4;
    int coarse = 0;
    if (screen->width > LINES_NARROW || screen->height > LINES_NARROW) {
        const uint32_t most = fix_size(x1) | fix_size(y1) | fix_size(x2) | fix_size(y2);
        coarse = fix_log2_floor(most | (uint32_t)1 << 12) - 12;
        x1 >>= coarse;
        y1 >>= coarse;
        x2 >>= coarse;
        y2 >>= coarse;
    }
    const int32_t area = y1 * x2 - x1 * y2;
    if (area <= 0)
        return false;
    const int32_t rise_b = p[1]->z_q8 - p[0]->z_q8;
    const int32_t rise_c = p[2]->z_q8 - p[0]->z_q8;
    int32_t along_x = rise_c * y1 - rise_b * y2;
    int32_t along_y = rise_b * x2 - rise_c * x1;
    int32_t steepest = fix_max(fix_abs(along_x), fix_abs(along_y));
#if COPIES /* where there is more than enough of it, nothing is divided */
    if ((int64_t)steepest * (int32_t)by.scale >= (int64_t)area * (LINES_STEEP << coarse))
        return false;
#endif
    /* Over the area: 2^29 over 15 bits of it. The least of 15 bits times 16 is below 2^31. */
    const int up = 31 - fix_log2_floor((uint32_t)area);
    const uint32_t inverse = (uint32_t)LINES_RECIPROCAL((int32_t)((uint32_t)area << up >> 17));
    const int32_t factor = (int32_t)(inverse * (by.scale >> by.shift) >> 15);
    /* 14 bits times 16 are below 2^30. */
    const int down = fix_log2_floor((uint32_t)steepest | (uint32_t)1 << 13) - 13;
    along_x = (along_x >> down) * factor;
    along_y = (along_y >> down) * factor;
    steepest = (steepest >> down) * factor;
    const int power = up + down + by.shift - coarse - 27;
    if (power > 0) {
        if (steepest >= ((int32_t)1 << 30) >> power)
            return false;
        along_x *= (int32_t)1 << power;
        along_y *= (int32_t)1 << power;
        steepest <<= power;
    } else {
        along_x >>= -power;
        along_y >>= -power;
        steepest >>= -power;
    }
    /* To the middle of the pixel (0, 0), and half a line on. Values far off the triangle may wrap.
     */
    cut->at = (uint32_t)p[0]->z_q8 * by.scale + by.zero + ((uint32_t)steepest >> 1) +
              (uint32_t)(along_x >> 4) * (uint32_t)(8 - a->x_q4) +
              (uint32_t)(along_y >> 4) * (uint32_t)(8 - a->y_q4);
    cut->along_x = along_x;
    cut->along_y = along_y;
    cut->width = (uint32_t)steepest;
    return true;
}

#endif
