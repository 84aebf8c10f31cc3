#include "raster.h"

#include <string.h>

#include <yamabiko/rom.h>

#include "fix.h"

/* --- Pixels ----------------------------------------------------------------------------------- */

/* dither_table[m][y]: which of every four pixels of a row are lit at a shade that reaches m of 16,
 * the leftmost in the highest bit, twice: Bayer's order of four by four.
 */
static const uint8_t dither_table[17][4] YB_ROM = {
    {0x00, 0x00, 0x00, 0x00}, {0x88, 0x00, 0x00, 0x00}, {0x88, 0x00, 0x22, 0x00},
    {0xaa, 0x00, 0x22, 0x00}, {0xaa, 0x00, 0xaa, 0x00}, {0xaa, 0x44, 0xaa, 0x00},
    {0xaa, 0x44, 0xaa, 0x11}, {0xaa, 0x55, 0xaa, 0x11}, {0xaa, 0x55, 0xaa, 0x55},
    {0xee, 0x55, 0xaa, 0x55}, {0xee, 0x55, 0xbb, 0x55}, {0xff, 0x55, 0xbb, 0x55},
    {0xff, 0x55, 0xff, 0x55}, {0xff, 0xdd, 0xff, 0x55}, {0xff, 0xdd, 0xff, 0x77},
    {0xff, 0xff, 0xff, 0x77}, {0xff, 0xff, 0xff, 0xff},
};

/* What a pixel value is in one row: where a pixel is a bit, eight of them side by side. Shade 15 is
 * all of them.
 */
static inline uint16_t in_row(const raster_t *raster, uint16_t pixel, int32_t y)
{
    if (raster->screen->format != YB_MONO)
        return pixel;
    return yb_rom_u8(&dither_table[pixel + (pixel >> 3)][y & 3]);
}

/* `pixel` as of in_row. */
static inline void put_pixel(const raster_t *raster, uint8_t *row, int32_t x, uint16_t pixel)
{
    if (raster->screen->format == YB_RGB565) {
        row[2 * x] = (uint8_t)(pixel >> 8);
        row[2 * x + 1] = (uint8_t)pixel;
    } else if (raster->screen->format == YB_MONO) {
        uint8_t bit = (uint8_t)(0x80 >> (x & 7));
        row[x >> 3] = (uint8_t)((row[x >> 3] & ~bit) | (pixel & bit));
    } else if ((x & 1) == 0) {
        row[x >> 1] = (uint8_t)((row[x >> 1] & 0x0f) | pixel << 4);
    } else {
        row[x >> 1] = (uint8_t)((row[x >> 1] & 0xf0) | pixel);
    }
}

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

/* --- The plane of 1/depth --------------------------------------------------------------------- */

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
    int32_t x1 = p[2]->x_q4 - p[0]->x_q4;
    int32_t y1 = p[2]->y_q4 - p[0]->y_q4;
    int32_t x2 = p[1]->x_q4 - p[0]->x_q4;
    int32_t y2 = p[1]->y_q4 - p[0]->y_q4;
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

/* --- Edges ------------------------------------------------------------------------------------ */

enum {
    CHUNK = 16 /* rows of a triangle that are drawn at once */
};

/* Of each row, the first pixel on its left side or right of it, and that of its right side: the
 * first that is not drawn any more.
 */
typedef struct {
    int16_t left[CHUNK], right[CHUNK];
} chunk_t;

/* Where an edge of a triangle crosses the rows from first up to end: the first pixel whose centre
 * is on the edge or right of it. It goes with the edge from row to row, in whole pixels: no
 * division, and exact. Both triangles at an edge come to the same pixel, which is where the one
 * ends and the other begins. Counter-clockwise, an edge down is on the left.
 */
static void trace(const yb_spot_t *a, const yb_spot_t *b, int32_t first, int32_t end,
                  chunk_t *chunk)
{
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
    int32_t dx = b->x_q4 - a->x_q4;
    int32_t dy = b->y_q4 - a->y_q4;
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

/* --- Triangles -------------------------------------------------------------------------------- */

typedef struct {
    uint32_t at_q14; /* the value at a pixel */
    int32_t along_x, along_y;
} plane_t;

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

static inline uint16_t depth_of(uint32_t near_q14)
{
    return (uint16_t)fix_clamp((int32_t)near_q14 >> 14, 1, 65535);
}

/* The pixels from x up to end of a row. */
static void draw_span(const raster_t *raster, uint16_t *depth, uint8_t *row, int32_t x, int32_t end,
                      const plane_t *plane, uint16_t pixel)
{
    uint32_t near = plane->at_q14 + (uint32_t)plane->along_x * (uint32_t)x;
    for (; x < end; x++, near += (uint32_t)plane->along_x) {
        if (depth_of(near) > depth[x]) {
            depth[x] = depth_of(near);
            put_pixel(raster, row, x, pixel);
        }
    }
}

/* As draw_span, at one depth. */
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
    for (; x < end; x++) {
        if (near > depth[x]) {
            depth[x] = near;
            put_pixel(raster, row, x, pixel);
        }
    }
}

/* A triangle's cut, as it goes from row to row. */
typedef struct {
    const raster_cut_t *cut;
    plane_t plane;
    int32_t half; /* of a line's width in value, and of the interval, 14 fractional bits */
    int32_t half_interval;
} cutter_t;

/* False: the lines would lie so close together that nothing else would be left. */
static bool cutter_start(cutter_t *cutter, const yb_spot_t *const p[3], int32_t y)
{
    const raster_cut_t *cut = cutter->cut;
    plane_start(&cutter->plane, p, cut->value, y);
    cutter->plane.at_q14 -= (uint32_t)cut->zero << 14;
    cutter->half = fix_max(fix_abs(cutter->plane.along_x), fix_abs(cutter->plane.along_y)) >> 1;
    cutter->half_interval = cut->interval << 13;
    return cut->interval == 0 || cutter->half < cutter->half_interval >> 2;
}

/* As draw_span, with lines. Values are below 2^16, and the interval is: within 2^30. */
static void draw_cut(const raster_t *raster, uint16_t *depth, uint8_t *row, int32_t y, int32_t x,
                     int32_t end, const plane_t *plane, const cutter_t *cutter)
{
    const raster_cut_t *cut = cutter->cut;
    uint32_t near = plane->at_q14 + (uint32_t)plane->along_x * (uint32_t)x;
    uint32_t value = cutter->plane.at_q14 + (uint32_t)cutter->plane.along_x * (uint32_t)x;
    const uint16_t below = in_row(raster, cut->below, y);
    const uint16_t above = in_row(raster, cut->above, y);
    const uint16_t line = in_row(raster, cut->line, y);
    for (; x < end; x++, near += (uint32_t)plane->along_x) {
        int32_t off = (int32_t)value;
        while (cut->interval > 0 && off >= cutter->half_interval)
            off -= 2 * cutter->half_interval;
        value += (uint32_t)cutter->plane.along_x;
        if (depth_of(near) > depth[x]) {
            depth[x] = depth_of(near);
            put_pixel(raster, row, x,
                      fix_abs(off) <= cutter->half ? line
                      : off < 0                    ? below
                                                   : above);
        }
    }
}

/* A triangle's own sides, of the rows from first up to end. */
static inline void trace_all(const yb_spot_t *const p[3], int32_t first, int32_t end,
                             chunk_t *chunk)
{
    trace(p[0], p[1], first, end, chunk);
    trace(p[1], p[2], first, end, chunk);
    trace(p[2], p[0], first, end, chunk);
}

/* A third of three times 16 bits, exact for three equal ones: 98303 * 43691 < 2^32. */
static inline uint16_t mean_near(const yb_spot_t *const p[3])
{
    uint32_t sum = (uint32_t)(p[0]->near + p[1]->near + p[2]->near) + 1;
    return (uint16_t)((sum >> 1) * (uint32_t)43691 >> 16);
}

/* A triangle of any size, on its plane if it is not small, with lines if it has any. */
static void fill_plane(const raster_t *raster, const yb_spot_t *const p[3], raster_look_t look,
                       int32_t y, int32_t end_y, uint16_t pixel)
{
    int32_t width = raster->screen->width;
    int32_t line = y - raster->first_row;
    uint16_t *depth = raster->band->depth + line * width;
    uint8_t *row = raster->band->pixels + (size_t)line * raster->band->pitch;
    plane_t plane = {(uint32_t)mean_near(p) << 14, 0, 0};
    const int32_t near[3] = {p[0]->near, p[1]->near, p[2]->near};
    if (look == RASTER_FRONT)
        plane_start(&plane, p, near, y);
    cutter_t cutter = {.cut = raster->cut};
    bool cuts = raster->cut != NULL && cutter_start(&cutter, p, y);
    chunk_t chunk;
    for (int32_t i = CHUNK; y < end_y; y++, i++) {
        if (i == CHUNK) {
            trace_all(p, y, fix_min(y + CHUNK, end_y), &chunk);
            i = 0;
        }
        int32_t x = fix_max(chunk.left[i], 0);
        int32_t end = fix_min(chunk.right[i], width);
        if (cuts)
            draw_cut(raster, depth, row, y, x, end, &plane, &cutter);
        else
            draw_span(raster, depth, row, x, end, &plane, in_row(raster, pixel, y));
        plane.at_q14 += (uint32_t)plane.along_y;
        cutter.plane.at_q14 += (uint32_t)cutter.plane.along_y;
        depth += width;
        row += raster->band->pitch;
    }
}

void raster_fill(const raster_t *raster, const yb_spot_t *a, const yb_spot_t *b, const yb_spot_t *c,
                 raster_look_t look, uint16_t pixel)
{
    const yb_spot_t *const p[3] = {a, b, c};
    int32_t top = fix_min(a->y_q4, fix_min(b->y_q4, c->y_q4));
    int32_t bottom = fix_max(a->y_q4, fix_max(b->y_q4, c->y_q4));
    int32_t y = fix_max(raster_pixel(top), raster->first_row);
    int32_t end_y = fix_min(raster_pixel(bottom), raster->end_row);
    if (look == RASTER_FRONT || raster->cut != NULL) {
        fill_plane(raster, p, look, y, end_y, pixel);
        return;
    }
    chunk_t chunk;
    trace_all(p, y, end_y, &chunk);
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
