/* Triangles of any size, anywhere: also beyond the sides of the screen. */
#include "fix.h"
#include "pixels.h"
#include "rows.h"

/* A side on its way down: as in raster.c, of any triangle, and on the whole screen. The upper half
 * of `at` is the pixel.
 */
typedef struct {
    int64_t at, step;
} long_side_t;

static long_side_t long_side(const yb_spot_t *from, const yb_spot_t *to, int32_t y)
{
    const int32_t dx = to->x_q4 - (int32_t)from->x_q4;
    const int32_t dy = to->y_q4 - (int32_t)from->y_q4;
    const uint32_t size = (uint32_t)fix_abs(dx);
    int32_t start = -1;
    int64_t slope;
    if (dy <= RASTER_HIGH_Q4 && size <= 2 * RASTER_WIDE_Q4) { /* as a small triangle may have it */
        slope = rows_small_slope(dx, dy);
        start = -ROWS_HALF;
    } else {
        slope = size < (uint32_t)1 << 12
                    ? (int64_t)((size << ROWS_FRACTION) / (uint32_t)dy)
                    : (int64_t)(((uint64_t)size << ROWS_FRACTION) / (uint32_t)dy);
        slope = dx < 0 ? -slope : slope;
    }
    const int64_t at = (int64_t)(from->x_q4 + 8) * ((int32_t)1 << ROWS_FRACTION) + start +
                       slope * (y * 16 + 8 - from->y_q4);
    return (long_side_t){at * (1 << (32 - ROWS_PIXEL)), slope * (16 << (32 - ROWS_PIXEL))};
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
        for (; y < bottom; y++) {
            const int32_t x = fix_max((int32_t)(left.at >> 32), 0);
            const int32_t end = fix_min((int32_t)(right.at >> 32), width);
            if (cut != NULL)
                rows_cut(colours, row, x, end, rows_value(cut, y), cut);
            else
                rows_fill(colours, row, x, end, pixel);
            row += pitch;
            left.at += left.step;
            right.at += right.step;
        }
        if (bottom == shape->bottom)
            return;
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
