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
    int64_t slope;
    int32_t start = -1;
    if (dy <= RASTER_HIGH_Q4 && raster_is_within(dx, 2 * RASTER_WIDE_Q4)) {
        slope = rows_small_slope(dx, dy);
        start = -ROWS_HALF;
    } else {
        slope = (int64_t)(((uint64_t)fix_abs(dx) << ROWS_FRACTION) / (uint32_t)dy);
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
    const int32_t y = shape->top;
    const bool turns_left = p[1]->y_q4 < p[2]->y_q4;
    const int32_t turn = raster_pixel(p[turns_left ? 1 : 2]->y_q4);
    const bool turned = y >= turn;
    const bool left_turned = turned && turns_left;
    const bool right_turned = turned && !turns_left;
    long_side_t left = long_side(p[left_turned ? 1 : 0], p[left_turned ? 2 : 1], y);
    long_side_t right = long_side(p[right_turned ? 2 : 0], p[right_turned ? 1 : 2], y);
    int32_t rest = turned ? 0 : shape->bottom - turn;
    int32_t rows = rest > 0 ? turn - y : shape->bottom - y;
    uint32_t value = cut != NULL ? rows_value(cut, y) : 0;
    for (uint8_t *row = pixels_row(raster, y);; row += pitch) {
        const int32_t x = fix_max((int32_t)(left.at >> 32), 0);
        const int32_t end = fix_min((int32_t)(right.at >> 32), width);
        if (cut != NULL) {
            rows_cut(colours, row, x, end, value, cut);
            value += (uint32_t)cut->along_y;
        } else {
            rows_fill(colours, row, x, end, pixel);
        }
        left.at += left.step;
        right.at += right.step;
        if (--rows == 0) {
            if (rest <= 0)
                return;
            if (turns_left)
                left = long_side(p[1], p[2], turn);
            else
                right = long_side(p[2], p[1], turn);
            rows = rest;
            rest = 0;
        }
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
