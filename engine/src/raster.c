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

/* --- Edges ------------------------------------------------------------------------------------ */

/* Where each edge of a triangle crosses the rows from first up to end: the first pixel whose centre
 * is on the edge or right of it. It goes with the edge from row to row, in whole pixels: no
 * division, and exact. Both triangles at an edge come to the same pixel, which is where the one
 * ends and the other begins. Counter-clockwise, an edge down is on the left.
 */
void rows_trace(const yb_spot_t *const p[3], int32_t first, int32_t end, raster_sides_t *sides)
{
    const yb_spot_t *from = p[2];
    for (int i = 0; i < 3; i++) {
        const yb_spot_t *a = from;
        const yb_spot_t *b = p[i];
        from = b;
        /* cppcheck-suppress ctuuninitvar ; it is what is filled in here */
        int16_t *to = sides->left;
        if (a->y_q4 > b->y_q4) {
            b = a;
            a = from;
            to = sides->right;
        }
        int32_t y = fix_max(raster_pixel(a->y_q4), first);
        int32_t rows = fix_min(raster_pixel(b->y_q4), end) - y;
        if (rows <= 0)
            continue;
        to += y - first;
        int32_t dx = b->x_q4 - (int32_t)a->x_q4;
        int32_t dy = b->y_q4 - (int32_t)a->y_q4;
        int32_t x = raster_pixel(a->x_q4);
        /* Of the pixel x: a step right adds `across`, a step down takes off `down`. */
        raster_area_t side =
            (raster_area_t)(x * 16 + 8 - a->x_q4) * dy - (raster_area_t)(y * 16 + 8 - a->y_q4) * dx;
        const raster_area_t across = (raster_area_t)dy * 16;
        const raster_area_t down = (raster_area_t)dx * 16;
        for (;;) {
            if (side < 0) { /* towards the right alone, or towards the left */
                do
                    x++;
                while ((side += across) < 0);
            } else if (side >= across) {
                do
                    x--;
                while ((side -= across) >= across);
            }
            *to++ = (int16_t)x;
            if (--rows == 0)
                break;
            side -= down;
        }
    }
}

/* --- Triangles -------------------------------------------------------------------------------- */

bool raster_covers(const raster_t *raster, const raster_shape_t *shape)
{
    const int32_t top = fix_max(shape->top, raster->first_row);
    const int32_t end = fix_min(shape->bottom, raster->end_row);
    const raster_sides_t *sides = raster->sides;
    rows_trace(shape->p, top, end, raster->sides);
    for (int32_t i = 0; i < end - top; i++) {
        if (sides->left[i] < sides->right[i])
            return true;
    }
    return false;
}

void raster_level(const raster_t *raster, const raster_shape_t *shape, uint16_t pixel)
{
    const size_t width = raster->screen->width;
    const int32_t top = fix_max(shape->top, raster->first_row);
    const int32_t end = fix_min(shape->bottom, raster->end_row);
    const raster_sides_t *sides = raster->sides;
    const uint16_t near = mean_near(shape->p);
    const size_t pitch = raster->band->pitch;
    const bool grey = raster->screen->format == YB_GREY4;
    uint16_t *depth = raster->band->depth + (size_t)(top - raster->first_row) * width;
    uint8_t *row = raster->band->pixels + (size_t)(top - raster->first_row) * pitch;
    for (int32_t i = 0; i < end - top; i++, depth += width, row += pitch) {
        int32_t x = sides->left[i];
        int32_t right = sides->right[i];
        if (grey) {
            for (; x < right; x++) {
                if (near > depth[x]) {
                    uint8_t *at = &row[x >> 1];
                    depth[x] = near;
                    *at =
                        (uint8_t)((x & 1) != 0 ? (*at & 0xf0) | pixel : (*at & 0x0f) | pixel << 4);
                }
            }
        } else {
            for (; x < right; x++) {
                if (near > depth[x]) {
                    depth[x] = near;
                    row[2 * x] = (uint8_t)(pixel >> 8);
                    row[2 * x + 1] = (uint8_t)pixel;
                }
            }
        }
    }
}

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
    raster_shape_t shape = {.p = {a, b, c}};
    raster_look_t look = raster_front(&shape);
    if (raster->band != NULL && (look == RASTER_FRONT || look == RASTER_SMALL))
        raster_fill(raster, &shape, look, pixel);
    return look;
}
