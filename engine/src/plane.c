/* Triangles of any size, anywhere: also beyond the sides of the screen. */
#include "fix.h"
#include "pixels.h"
#include "rows.h"

/* A side on its way down: as in raster.c, of any triangle, and on the whole screen. */
typedef struct {
    int64_t at, step;
} long_side_t;

static long_side_t long_side(const yb_spot_t *from, const yb_spot_t *to, int32_t y)
{
    const int32_t dx = to->x_q4 - (int32_t)from->x_q4;
    const int32_t dy = to->y_q4 - (int32_t)from->y_q4;
    int64_t slope;
    if (dy <= RASTER_HIGH_Q4 && raster_is_within(dx, 2 * RASTER_WIDE_Q4)) {
        slope = rows_small_slope(dx, dy);
    } else {
        slope = (int64_t)(((uint64_t)fix_abs(dx) << ROWS_FRACTION) / (uint32_t)dy);
        slope = dx < 0 ? -slope : slope;
    }
    const int64_t start = (int64_t)(from->x_q4 + 8) * ((int32_t)1 << ROWS_FRACTION) - 1;
    return (long_side_t){start + slope * (y * 16 + 8 - from->y_q4), slope * 16};
}

void raster_plane(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut)
{
    const yb_spot_t *const *p = shape->p;
    int32_t y = fix_max(shape->top, raster->first_row);
    int32_t end_y = fix_min(shape->bottom, raster->end_row);
    if (y >= end_y)
        return;
    const bool colours = pixels_have_colours(raster->screen);
    const int32_t width = raster->screen->width;
    uint32_t value = cut != NULL ? rows_value(cut, y) : 0;
    const int32_t left_end = raster_pixel(p[1]->y_q4);
    const int32_t right_end = raster_pixel(p[2]->y_q4);
    long_side_t left = long_side(p[y < left_end ? 0 : 1], p[y < left_end ? 1 : 2], y);
    long_side_t right = long_side(p[y < right_end ? 0 : 2], p[y < right_end ? 2 : 1], y);
    for (uint8_t *row = pixels_row(raster, y);; row += pixels_pitch(raster)) {
        int32_t x = fix_max((int32_t)(left.at >> ROWS_PIXEL), 0);
        int32_t end = fix_min((int32_t)(right.at >> ROWS_PIXEL), width);
        if (cut != NULL) {
            rows_cut(colours, row, x, end, value, cut);
            value += (uint32_t)cut->along_y;
        } else {
            rows_fill(colours, row, x, end, pixel);
        }
        if (++y == end_y)
            return;
        left.at += left.step;
        right.at += right.step;
        if (y == left_end)
            left = long_side(p[1], p[2], y);
        if (y == right_end)
            right = long_side(p[2], p[1], y);
    }
}
