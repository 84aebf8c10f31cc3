/* Light and colour: 14 shades of a hue that depends on the height (colour paper). */
#ifndef YB_SHADE_H
#define YB_SHADE_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

/* What a triangle looks like: its pixel value, and in the upper half its shade without cast
 * shadows. As one number it is handed on in a register, and made in one instruction.
 */
typedef uint32_t shade_t;

static inline shade_t shade_of(uint16_t pixel, int32_t light)
{
    return pixel | (uint32_t)light << 16;
}

static inline uint16_t shade_pixel(shade_t shade)
{
    return (uint16_t)(shade & 0xffff);
}

/* Of a triangle of the ground (or of the water, where all three corners are in it). */
shade_t shade_ground(const yb_frame_t *frame, const yb_point_t *const corner[3]);

/* The shore of a triangle that looks like this, or its contour lines. */
bool shade_lines(const yb_frame_t *frame, const yb_point_t *const p[3], shade_t shade, bool shore,
                 raster_cut_t *cut);

/* The line that a triangle that looks like this is cut by, if there is one: the shore, or contour
 * lines.
 */
TINY bool shade_cut_here(const yb_frame_t *frame, const yb_point_t *const p[3], shade_t shade,
                         raster_cut_t *cut)
{
    const int32_t z = p[0]->z_q8;
    const int32_t rise_b = p[1]->z_q8 - z;
    const int32_t rise_c = p[2]->z_q8 - z;
    const int32_t low = fix_min(fix_min(rise_b, 0), rise_c);
    const int32_t high = fix_max(fix_max(rise_b, 0), rise_c);
    const uint32_t range = (uint32_t)(high - low);
    if (range >= (uint32_t)1 << 16)
        return false;
    if (z + low < frame->view.water_q8)
        return z + high > frame->view.water_q8 && shade_lines(frame, p, shade, true, cut);
    /* A line is a pixel wide: half of it may lie in a triangle beside the one it runs through. That
     * is no more than a quarter of a triangle that has pixels. What is above the highest line below
     * the top is less than all. */
    const uint32_t span = range * frame->contour_inverse;
    const uint32_t top = (uint32_t)(z + high) * frame->contour_inverse + frame->contour_zero;
    if (range < frame->contour_few && top + (span >> 2) > span + (span >> 1))
        return false;
    return shade_lines(frame, p, shade, false, cut);
}

/* The same, where a call is good enough. */
bool shade_cut(const yb_frame_t *frame, const yb_point_t *const p[3], shade_t shade,
               raster_cut_t *cut);

/* The pixel value of the wall below the edge ab of the frame, ground to its left. */
uint16_t shade_wall(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b);

#endif
