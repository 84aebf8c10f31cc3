#include "raster.h"

#include <string.h>

#include "fix.h"
#include "rows.h"

const uint8_t rows_dither[17][4] YB_ROM = {
    {0x00, 0x00, 0x00, 0x00}, {0x88, 0x00, 0x00, 0x00}, {0x88, 0x00, 0x22, 0x00},
    {0xaa, 0x00, 0x22, 0x00}, {0xaa, 0x00, 0xaa, 0x00}, {0xaa, 0x44, 0xaa, 0x00},
    {0xaa, 0x44, 0xaa, 0x11}, {0xaa, 0x55, 0xaa, 0x11}, {0xaa, 0x55, 0xaa, 0x55},
    {0xee, 0x55, 0xaa, 0x55}, {0xee, 0x55, 0xbb, 0x55}, {0xff, 0x55, 0xbb, 0x55},
    {0xff, 0x55, 0xff, 0x55}, {0xff, 0xdd, 0xff, 0x55}, {0xff, 0xdd, 0xff, 0x77},
    {0xff, 0xff, 0xff, 0x77}, {0xff, 0xff, 0xff, 0xff},
};

void raster_clear(const raster_t *raster)
{
    size_t rows = (size_t)(raster->end_row - raster->first_row);
    memset(raster->band->depth, 0, rows * raster->screen->width * sizeof *raster->band->depth);
}

void raster_row(const raster_t *raster, int32_t y, uint16_t pixel)
{
    const yb_screen_t *screen = raster->screen;
    uint8_t *row = raster->band->pixels + (size_t)(y - raster->first_row) * raster->band->pitch;
    if (screen->format != YB_RGB565) {
        memset(row, screen->format == YB_MONO ? in_row(raster, pixel, y) : pixel * 17,
               yb_screen_pitch(screen));
        return;
    }
    const uint8_t high = (uint8_t)(pixel >> 8);
    const uint8_t low = (uint8_t)pixel;
    uint8_t *const end = row + 2 * (size_t)screen->width;
    for (; end - row >= 8; row += 8) {
        row[0] = row[2] = row[4] = row[6] = high;
        row[1] = row[3] = row[5] = row[7] = low;
    }
    for (; row != end; row += 2) {
        row[0] = high;
        row[1] = low;
    }
}

/* --- Small triangles -------------------------------------------------------------------------- */

/* A side of a small triangle on its way down: where it crosses a row, right of some pixel, rounded
 * so that its whole pixels are the first whose centre is on the side or right of it.
 */
typedef struct {
    uint32_t at, step; /* it may wrap after the last row */
} side_t;

/* The side down from one corner to another at row y. It lies within 135 + 3 RASTER_WIDE_Q4 of the
 * base: below 2^31 with its 20 fractional bits.
 */
static inline side_t begin_side(const yb_spot_t *from, const yb_spot_t *to, int32_t base_q4,
                                int32_t y)
{
    const int32_t slope =
        rows_small_slope(to->x_q4 - (int32_t)from->x_q4, to->y_q4 - (int32_t)from->y_q4);
    const int32_t at = (from->x_q4 - base_q4) * ((int32_t)1 << ROWS_FRACTION) - 1 +
                       slope * (y * 16 + 8 - from->y_q4);
    return (side_t){(uint32_t)at, (uint32_t)slope << 4};
}

static inline int32_t crossing_of(const side_t *side)
{
    return (int32_t)side->at >> ROWS_PIXEL;
}

/* The pixels from x up to end of a row. */
static inline void fill_row(yb_format_t format, uint16_t *depth, uint8_t *row, int32_t x,
                            int32_t end, uint16_t near, uint16_t pixel)
{
    uint16_t *const depth_end = depth + end;
    depth += x;
    if (format == YB_GREY4) {
        for (; depth < depth_end; depth++, x++) {
            if (near > *depth) {
                put_grey4(row, x, pixel);
                *depth = near;
            }
        }
    } else if (format == YB_RGB565) {
        for (row += 2 * x; depth < depth_end; depth++, row += 2) {
            if (near > *depth) {
                put_rgb565(row, 0, pixel);
                *depth = near;
            }
        }
    } else {
        for (; depth < depth_end; depth++, x++) {
            if (near > *depth) {
                put_mono(row, x, pixel);
                *depth = near;
            }
        }
    }
}

/* Where speed counts more than size, each format, and lines, has a copy of its own: branching on
 * that would be a seventh of what a triangle costs.
 */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define COPIED static inline __attribute__((always_inline))
#else
#define COPIED static
#endif

/* Draws a small triangle. */
COPIED void draw_level(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                       yb_format_t format, cutter_t *cutter)
{
    const yb_spot_t *a = shape->p[0];
    const yb_spot_t *b = shape->p[1];
    const yb_spot_t *c = shape->p[2];
    int32_t y = fix_max(shape->top, raster->first_row);
    const int32_t end = fix_min(shape->bottom, raster->end_row);
    if (y >= end)
        return;
    const plane_t plane = {(uint32_t)mean_near(shape->p) << 14, 0, 0};
    /* Down the left side to b and on to c, down the right one to c and on to b: to the lower. */
    const int32_t left_end = raster_pixel(b->y_q4);
    const int32_t right_end = raster_pixel(c->y_q4);
    const int32_t base = a->x_q4 >> 7 << 3; /* whole bytes of pixels */
    const int32_t centre_q4 = base * 16 - 8;
    side_t left = begin_side(y < left_end ? a : b, y < left_end ? b : c, centre_q4, y);
    side_t right = begin_side(y < right_end ? a : c, y < right_end ? c : b, centre_q4, y);
    const size_t width = raster->screen->width;
    const size_t pitch = raster->band->pitch;
    uint16_t *depth = raster->band->depth + (size_t)(y - raster->first_row) * width;
    uint8_t *row = raster->band->pixels + (size_t)(y - raster->first_row) * pitch;
    if (cutter == NULL) {
        depth += base;
        row += format == YB_GREY4 ? base >> 1 : format == YB_RGB565 ? base << 1 : base >> 3;
    }
    for (;;) {
        if (cutter != NULL)
            draw_cut(raster, depth, row, y, base + crossing_of(&left), base + crossing_of(&right),
                     &plane, cutter);
        else
            fill_row(format, depth, row, crossing_of(&left), crossing_of(&right),
                     (uint16_t)(plane.at_q14 >> 14),
                     format == YB_MONO ? in_row(raster, pixel, y) : pixel);
        if (++y == end)
            return;
        depth += width;
        row += pitch;
        left.at += left.step;
        right.at += right.step;
        if (y == left_end)
            left = begin_side(b, c, centre_q4, y);
        if (y == right_end)
            right = begin_side(c, b, centre_q4, y);
        if (cutter != NULL)
            cutter->plane.at_q14 += (uint32_t)cutter->plane.along_y;
    }
}

/* False: the lines would lie so close together that nothing else would be left. */
static bool draw_lines(const raster_t *raster, const raster_shape_t *shape, const raster_cut_t *cut)
{
    cutter_t cutter;
    if (!rows_start_cut(&cutter, cut, shape, fix_max(shape->top, raster->first_row)))
        return false;
    draw_level(raster, shape, 0, raster->screen->format, &cutter);
    return true;
}

void raster_level(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel,
                  const raster_cut_t *cut)
{
    if (cut != NULL && draw_lines(raster, shape, cut))
        return;
    if (raster->screen->format == YB_GREY4)
        draw_level(raster, shape, pixel, YB_GREY4, NULL);
    else if (raster->screen->format == YB_RGB565)
        draw_level(raster, shape, pixel, YB_RGB565, NULL);
    else
        draw_level(raster, shape, pixel, YB_MONO, NULL);
}

/* --- Triangles -------------------------------------------------------------------------------- */

raster_look_t raster_draw(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                          const yb_spot_t *c, uint16_t pixel)
{
    if (a->near == 0 || b->near == 0 || c->near == 0)
        return RASTER_BEYOND;
    int32_t top = raster->first_row * 16 + 8;
    int32_t bottom = raster->end_row * 16 - 8;
    int32_t right = raster->screen->width * 16 - 8;
    if ((a->y_q4 <= top && b->y_q4 <= top && c->y_q4 <= top) ||
        (a->y_q4 > bottom && b->y_q4 > bottom && c->y_q4 > bottom) ||
        (a->x_q4 <= 8 && b->x_q4 <= 8 && c->x_q4 <= 8) ||
        (a->x_q4 > right && b->x_q4 > right && c->x_q4 > right))
        return RASTER_NOTHING;
    raster_shape_t shape;
    raster_look_t look = raster_front(a, b, c, &shape);
    if (raster->band != NULL && (look == RASTER_FRONT || look == RASTER_SMALL))
        raster_fill(raster, &shape, look, pixel, NULL);
    return look;
}
