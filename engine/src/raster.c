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
    for (int32_t x = 0; x < screen->width; x++)
        put_pixel(raster, row, x, pixel);
}

/* --- Edges ------------------------------------------------------------------------------------ */

/* Where an edge of a triangle crosses the rows from first up to end: the first pixel whose centre
 * is on the edge or right of it. It goes with the edge from row to row, in whole pixels: no
 * division, and exact. Both triangles at an edge come to the same pixel, which is where the one
 * ends and the other begins. Counter-clockwise, an edge down is on the left.
 */
static void trace(const yb_spot_t *a, const yb_spot_t *b, int32_t first, int32_t end,
                  chunk_t *chunk)
{
    /* cppcheck-suppress ctuuninitvar ; it is what is filled in here */
    int16_t *to = chunk->left;
    if (a->y_q4 > b->y_q4) {
        const yb_spot_t *upper = b;
        b = a;
        a = upper;
        to = chunk->right;
    }
    int32_t y = fix_max(raster_pixel(a->y_q4), first);
    int32_t rows = fix_min(raster_pixel(b->y_q4), end) - y;
    if (rows <= 0)
        return;
    to += y - first;
    int32_t dx = (int32_t)b->x_q4 - a->x_q4;
    int32_t dy = (int32_t)b->y_q4 - a->y_q4;
    int32_t x = raster_pixel(a->x_q4);
    /* Of the pixel x: a step right adds `across`, a step down takes off `down`. */
    raster_area_t side =
        (raster_area_t)(x * 16 + 8 - a->x_q4) * dy - (raster_area_t)(y * 16 + 8 - a->y_q4) * dx;
    raster_area_t across = (raster_area_t)dy * 16;
    raster_area_t down = (raster_area_t)dx * 16;
    for (;;) {
        for (; side < 0; side += across)
            x++;
        for (; side >= across; side -= across)
            x--;
        *to++ = (int16_t)x;
        if (--rows == 0)
            return;
        side -= down;
    }
}

void rows_trace(const yb_spot_t *const p[3], int32_t first, int32_t end, chunk_t *chunk)
{
    trace(p[0], p[1], first, end, chunk);
    trace(p[1], p[2], first, end, chunk);
    trace(p[2], p[0], first, end, chunk);
}

/* --- Triangles -------------------------------------------------------------------------------- */

/* The pixels from x up to end of a row, at one depth. */
static inline void draw_level(const raster_t *raster, uint16_t *depth, uint8_t *row, int32_t x,
                              int32_t end, uint16_t near, uint16_t pixel)
{
    if (raster->screen->format == YB_RGB565) {
        for (; x < end; x++) {
            if (near > depth[x]) {
                depth[x] = near;
                row[2 * x] = (uint8_t)(pixel >> 8);
                row[2 * x + 1] = (uint8_t)pixel;
            }
        }
        return;
    }
    if (raster->screen->format == YB_GREY4) {
        for (; x < end; x++) {
            if (near > depth[x]) {
                uint8_t *at = &row[x >> 1];
                depth[x] = near;
                *at = (uint8_t)((x & 1) != 0 ? (*at & 0xf0) | pixel : (*at & 0x0f) | pixel << 4);
            }
        }
        return;
    }
    for (; x < end; x++) {
        if (near > depth[x]) {
            depth[x] = near;
            put_pixel(raster, row, x, pixel);
        }
    }
}

void raster_level(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b,
                  const yb_spot_t *c, uint16_t pixel)
{
    const yb_spot_t *const p[3] = {a, b, c};
    int32_t y = rows_first(raster, p);
    int32_t end_y = rows_end(raster, p);
    chunk_t chunk;
    rows_trace(p, y, end_y, &chunk);
    uint16_t near = mean_near(p);
    int32_t width = raster->screen->width;
    int32_t line = y - raster->first_row;
    uint16_t *depth = raster->band->depth + line * width;
    size_t pitch = raster->band->pitch;
    uint8_t *row = raster->band->pixels + (size_t)line * pitch;
    for (int32_t rows = end_y - y, i = 0; i < rows; i++) {
        /* Two edges have set both sides. NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage) */
        draw_level(raster, depth, row, fix_max(chunk.left[i], 0), fix_min(chunk.right[i], width),
                   near, in_row(raster, pixel, y + i));
        depth += width;
        row += pitch;
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
    raster_look_t look = raster_front(a, b, c);
    if (raster->band != NULL && (look == RASTER_FRONT || look == RASTER_SMALL))
        raster_fill(raster, a, b, c, look, pixel);
    return look;
}
