/* Triangles of any size, anywhere: also beyond the sides of the screen. */
#include "fix.h"
#include "pixels.h"
#include "rows.h"

/* A side on its way down: where it crosses a row, right of the screen's left side, in 2^-20 pixel
 * and half a pixel on, so that its whole pixels are the first whose centre is on the side or right
 * of it. It is a function of the side's two corners, whichever way it is drawn and from whichever
 * row on: both triangles at it come to the same pixels.
 *
 * How far it goes right in a sixteenth of a row is rounded to the nearest 2^-16 sixteenth. So over
 * 255 of them it is off by less than PLANE_HALF, and where it crosses a row is a multiple of 2^16 /
 * 255 = 257 or more of these: by PLANE_HALF less its whole pixels are right, as those of small
 * triangles are. From a corner 512 rows above a screen of as many to its last row they may be off
 * by an eighth of a sixteenth; what is up to 2048 pixels off fits.
 */
enum {
    PLANE_FRACTION = 16, /* of a sixteenth of a pixel */
    PLANE_PIXEL = PLANE_FRACTION + 4,
    PLANE_HALF = 128
};

#if YB_MAX_SIDE <= 512
typedef int32_t plane_t;
typedef uint32_t plane_wrap_t; /* the last step, beyond the corner, may wrap */
#else
typedef int64_t plane_t;
typedef uint64_t plane_wrap_t;
#endif

typedef struct {
    plane_wrap_t at, step;
} long_side_t;

/* size * 2^17 / dy, rounded down. A way of up to 24656 sixteenths times 2^17 is below 2^32 (see
 * raster_area_t).
 */
static inline plane_wrap_t twice_slope(uint32_t size, uint32_t dy)
{
#if !ROWS_DIVIDE
    /* As rows_small_slope: 2^20 / dy * 2^12 is below 2^32. What is left is below (2^9 + 1) dy, and
     * after its share, below 2 dy. */
    if (size < (uint32_t)1 << 12 && dy < 256) {
        const uint32_t inverse = (uint32_t)fix_inverse((int32_t)dy);
        const uint32_t whole = size << (PLANE_FRACTION + 1);
        uint32_t share = size * inverse >> (20 - PLANE_FRACTION - 1);
        share += (whole - share * dy) * inverse >> 20;
        return share + (whole - share * dy >= dy);
    }
#endif
    return ((plane_wrap_t)size << (PLANE_FRACTION + 1)) / dy;
}

/* The side down from one corner to another, at row y. */
static long_side_t long_side(const yb_spot_t *from, const yb_spot_t *to, int32_t y)
{
    const int32_t dx = to->x_q4 - (int32_t)from->x_q4;
    const int32_t dy = to->y_q4 - (int32_t)from->y_q4;
    const plane_wrap_t size = (twice_slope((uint32_t)fix_abs(dx), (uint32_t)dy) + 1) >> 1;
    const plane_wrap_t slope = dx < 0 ? 0 - size : size;
    const plane_wrap_t start = (plane_wrap_t)(plane_t)(from->x_q4 + (int32_t)8) << PLANE_FRACTION;
    return (long_side_t){
        start - PLANE_HALF + slope * (plane_wrap_t)(y * 16 + 8 - from->y_q4),
        slope << 4,
    };
}

static inline int32_t pixel_of(const long_side_t *side)
{
    return (int32_t)((plane_t)side->at >> PLANE_PIXEL);
}

/* Draws a triangle: in one pixel value, or with lines. */
COPIED void draw_plane(bool colours, const raster_t *raster, const raster_shape_t *shape,
                       uint16_t pixel, const raster_cut_t *cut)
{
    const yb_spot_t *const *p = shape->p;
    const int32_t width = raster->screen->width;
    const size_t pitch = raster->pitch;
    const bool turns_left = p[1]->y_q4 < p[2]->y_q4;
    const int32_t turn = raster_pixel(p[turns_left ? 1 : 2]->y_q4);
    int32_t y = shape->top;
    int32_t bottom = y < turn ? fix_min(turn, shape->bottom) : shape->bottom;
    const int l = y >= turn && turns_left;
    const int r = y >= turn && !turns_left;
    uint8_t *row = pixels_row(raster, y);
    long_side_t left = long_side(p[l], p[1 + l], y);
    long_side_t right = long_side(p[2 * r], p[2 - r], y);
    for (;;) {
        int32_t rows = bottom - y;
        do {
            const int32_t x = pixel_of(&left);
            const int32_t end = pixel_of(&right);
            if (x < end) { /* the rows of slivers often have no pixel */
                const int32_t from = fix_max(x, 0);
                const int32_t to = fix_min(end, width);
                if (cut != NULL)
                    rows_cut(colours, row, from, to, rows_value(cut, bottom - rows), cut);
                else
                    rows_fill(colours, row, from, to, pixel);
            }
            row += pitch;
            left.at += left.step;
            right.at += right.step;
        } while (--rows != 0);
        if (bottom == shape->bottom)
            return;
        y = bottom;
        bottom = shape->bottom;
        if (turns_left)
            left = long_side(p[1], p[2], y);
        else
            right = long_side(p[2], p[1], y);
    }
}

/* As draw_plane, with lines. */
SELDOM void lined_plane(const raster_t *raster, const raster_shape_t *shape,
                        const raster_cut_t *cut)
{
    draw_plane(raster->colours, raster, shape, 0, cut);
}

void raster_plane(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut)
{
    if (cut != NULL)
        lined_plane(raster, shape, cut);
    else
        ROWS_DRAW(draw_plane, raster, shape, pixel, NULL);
}
