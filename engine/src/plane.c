/* Triangles with a value that is linear on the screen: 1/depth, or what lines are drawn by. */
#include "fix.h"
#include "pixels.h"
#include "rows.h"

/* --- Planes ----------------------------------------------------------------------------------- */

#define STEEPEST_Q14 ((int32_t)1 << 30)

/* a * 2^18 / b, for |a| < 2^30 and b > 0, cut to ±STEEPEST_Q14. */
static int32_t ratio_q18(int32_t a, int32_t b)
{
    uint32_t size = (uint32_t)fix_abs(a);
    if (size == 0)
        return 0;
    int shift = 30 - fix_log2_floor(size);
    uint32_t q = (size << shift) / (uint32_t)b;
    if (shift > 18)
        q >>= shift - 18;
    else
        q = q >= (uint32_t)1 << (12 + shift) ? (uint32_t)STEEPEST_Q14 : q << (18 - shift);
    return a < 0 ? -(int32_t)q : (int32_t)q;
}

/* Change of 1/depth, or of another value, per pixel, 14 fractional bits, along x and y. Differences
 * are scaled down until they have 13 bits: 1/depth has 16, so each sum of two products is below
 * 2^30. Accuracy is only needed for hiding, and a pixel's value is cut to 16 bits in the end. A
 * sliver seen so edge-on that its gradient must be cut would get depths far from its own: it is
 * taken as flat.
 */
static void find_gradient(const yb_spot_t *const p[3], const int32_t value[3], int32_t *along_x,
                          int32_t *along_y)
{
    /* Clockwise on the screen, where y points down: the area is positive. */
    int32_t x1 = (int32_t)p[2]->x_q4 - p[0]->x_q4;
    int32_t y1 = (int32_t)p[2]->y_q4 - p[0]->y_q4;
    int32_t x2 = (int32_t)p[1]->x_q4 - p[0]->x_q4;
    int32_t y2 = (int32_t)p[1]->y_q4 - p[0]->y_q4;
    uint32_t all = (uint32_t)(fix_abs(x1) | fix_abs(y1) | fix_abs(x2) | fix_abs(y2));
    int shift = 0;
    while (all >> shift >= 1u << 13)
        shift++;
    int32_t d1 = value[2] - value[0];
    int32_t d2 = value[1] - value[0];
    int32_t size = (int32_t)(((raster_area_t)x1 * y2 - (raster_area_t)y1 * x2) >> shift);
    *along_x = *along_y = 0;
    if (size > 0) {
        *along_x = ratio_q18(d1 * (y2 >> shift) - d2 * (y1 >> shift), size);
        *along_y = ratio_q18(d2 * (x1 >> shift) - d1 * (x2 >> shift), size);
    }
    if (fix_abs(*along_x) >= STEEPEST_Q14 || fix_abs(*along_y) >= STEEPEST_Q14)
        *along_x = *along_y = 0;
}

/* The value at the pixel (0, y), from values of 16 bits at the corners. */
static void plane_start(plane_t *plane, const yb_spot_t *const p[3], const int32_t value[3],
                        int32_t y)
{
    find_gradient(p, value, &plane->along_x, &plane->along_y);
    /* From corner 0, whole pixels to where this band begins: the same depth in every band.
     * Unsigned: partial sums may wrap, the depth inside the triangle does not. */
    int32_t x0 = raster_pixel(p[0]->x_q4);
    int32_t y0 = raster_pixel(p[0]->y_q4);
    plane->at_q14 = ((uint32_t)value[0] << 14) + ((uint32_t)1 << 13) +
                    (uint32_t)(plane->along_x >> 4) * (uint32_t)(x0 * 16 + 8 - p[0]->x_q4) +
                    (uint32_t)(plane->along_y >> 4) * (uint32_t)(y0 * 16 + 8 - p[0]->y_q4) -
                    (uint32_t)plane->along_x * (uint32_t)x0 +
                    (uint32_t)plane->along_y * (uint32_t)(y - y0);
}

/* --- Lines ------------------------------------------------------------------------------------ */

bool rows_start_cut(cutter_t *cutter, const raster_cut_t *cut, const raster_shape_t *shape,
                    int32_t y)
{
    cutter->cut = cut;
    plane_start(&cutter->plane, shape->p, &cut->value[shape->first], y);
    cutter->plane.at_q14 -= (uint32_t)cut->zero << 14;
    cutter->half = fix_max(fix_abs(cutter->plane.along_x), fix_abs(cutter->plane.along_y)) >> 1;
    cutter->half_interval = cut->interval << 13;
    return cut->interval == 0 || cutter->half < cutter->half_interval >> 2;
}

/* --- Triangles -------------------------------------------------------------------------------- */

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
ROWS_COPIED void draw_plane(bool colours, const raster_t *raster, const raster_shape_t *shape,
                            uint16_t pixel, cutter_t *cutter)
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
    for (uint8_t *row = pixels_row(raster, y);; row += pitch) {
        const int32_t x = fix_max((int32_t)(left.at >> 32), 0);
        const int32_t end = fix_min((int32_t)(right.at >> 32), width);
        if (cutter != NULL) {
            rows_cut(colours, row, x, end, cutter);
            cutter->plane.at_q14 += (uint32_t)cutter->plane.along_y;
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

void raster_plane(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut)
{
    cutter_t cutter;
    if (cut != NULL && rows_start_cut(&cutter, cut, shape, shape->top))
        ROWS_DRAW(draw_plane, raster, shape, 0, &cutter);
    else
        ROWS_DRAW(draw_plane, raster, shape, pixel, NULL);
}
