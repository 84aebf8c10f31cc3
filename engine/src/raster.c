#include "raster.h"

#include <string.h>

#include "fix.h"

static inline void put_pixel(const raster_t *raster, uint8_t *row, int32_t x, uint16_t pixel)
{
    if (raster->screen->format == YB_RGB565) {
        row[2 * x] = (uint8_t)(pixel >> 8);
        row[2 * x + 1] = (uint8_t)pixel;
    } else if ((x & 1) == 0) {
        row[x >> 1] = (uint8_t)((row[x >> 1] & 0x0f) | pixel << 4);
    } else {
        row[x >> 1] = (uint8_t)((row[x >> 1] & 0xf0) | pixel);
    }
}

void raster_clear(const raster_t *raster, uint16_t pixel)
{
    const yb_band_t *band = raster->band;
    int32_t width = raster->screen->width;
    int32_t rows = raster->end_row - raster->first_row;
    memset(band->depth, 0, (size_t)(rows * width) * sizeof *band->depth);
    for (int32_t y = 0; y < rows; y++) {
        for (int32_t x = 0; x < width; x++)
            put_pixel(raster, band->pixels + (size_t)y * band->pitch, x, pixel);
    }
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

/* Change of 1/depth per pixel, 14 fractional bits, along x and y. Differences are scaled down until
 * they have 13 bits: 1/depth has 16, so each sum of two products is below 2^30. Accuracy is only
 * needed for hiding, and a pixel's value is cut to 16 bits in the end. A sliver seen so edge-on
 * that its gradient must be cut would get depths far from its own: it is taken as flat.
 */
static void depth_gradient(const raster_point_t p[3], raster_area_t area, int32_t *along_x,
                           int32_t *along_y)
{
    int32_t x1 = p[1].x_q4 - p[0].x_q4;
    int32_t y1 = p[1].y_q4 - p[0].y_q4;
    int32_t x2 = p[2].x_q4 - p[0].x_q4;
    int32_t y2 = p[2].y_q4 - p[0].y_q4;
    uint32_t all = (uint32_t)(fix_abs(x1) | fix_abs(y1) | fix_abs(x2) | fix_abs(y2));
    int shift = 0;
    while (all >> shift >= 1u << 13)
        shift++;
    int32_t d1 = p[1].near - p[0].near;
    int32_t d2 = p[2].near - p[0].near;
    int32_t size = (int32_t)(area >> shift);
    *along_x = *along_y = 0;
    if (size > 0) {
        *along_x = ratio_q18(d1 * (y2 >> shift) - d2 * (y1 >> shift), size);
        *along_y = ratio_q18(d2 * (x1 >> shift) - d1 * (x2 >> shift), size);
    }
    if (fix_abs(*along_x) >= STEEPEST_Q14 || fix_abs(*along_y) >= STEEPEST_Q14)
        *along_x = *along_y = 0;
}

/* --- The pixels ------------------------------------------------------------------------------- */

/* The side of an edge on which a point lies, as it changes along a row and from row to row. */
typedef struct {
    raster_area_t value; /* >= 0 inside */
    raster_area_t along_x, along_y;
} edge_t;

/* From p to q, at the centre of the pixel (x, y). */
static void edge_set(edge_t *edge, const raster_point_t *p, const raster_point_t *q, int32_t x,
                     int32_t y)
{
    int32_t dx = q->x_q4 - p->x_q4;
    int32_t dy = q->y_q4 - p->y_q4;
    bool top_left = dy < 0 || (dy == 0 && dx > 0);
    edge->value =
        (raster_area_t)dx * (y * 16 + 8 - p->y_q4) - (raster_area_t)dy * (x * 16 + 8 - p->x_q4);
    edge->value -= top_left ? 0 : 1;
    edge->along_x = -(raster_area_t)dy * 16;
    edge->along_y = (raster_area_t)dx * 16;
}

/* First pixel whose centre is at or right of (below) a coordinate. */
static inline int32_t first_pixel(int32_t q4)
{
    return (q4 + 7) >> 4;
}

static inline uint16_t depth_of(uint32_t near_q14)
{
    return (uint16_t)fix_clamp((int32_t)near_q14 >> 14, 1, 65535);
}

bool raster_setup(const raster_t *raster, const raster_point_t corner[3], raster_setup_t *setup)
{
    /* y points down, so a counter-clockwise triangle is clockwise here: swap two corners. */
    const raster_point_t *a = &corner[0];
    const raster_point_t *b = &corner[2];
    const raster_point_t *c = &corner[1];
    int32_t left = fix_min(a->x_q4, fix_min(b->x_q4, c->x_q4));
    int32_t right = fix_max(a->x_q4, fix_max(b->x_q4, c->x_q4));
    int32_t top = fix_min(a->y_q4, fix_min(b->y_q4, c->y_q4));
    int32_t bottom = fix_max(a->y_q4, fix_max(b->y_q4, c->y_q4));
    setup->x0 = fix_max(first_pixel(left), 0);
    setup->x1 = fix_min(first_pixel(right + 1), raster->screen->width);
    setup->y0 = fix_max(first_pixel(top), raster->first_row);
    setup->y1 = fix_min(first_pixel(bottom + 1), raster->end_row);
    if (setup->x0 >= setup->x1 || setup->y0 >= setup->y1)
        return false;
    setup->area = (raster_area_t)(b->x_q4 - a->x_q4) * (c->y_q4 - a->y_q4) -
                  (raster_area_t)(b->y_q4 - a->y_q4) * (c->x_q4 - a->x_q4);
    setup->p[0] = *a;
    setup->p[1] = *b;
    setup->p[2] = *c;
    return setup->area > 0;
}

void raster_fill(const raster_t *raster, const raster_setup_t *setup, uint16_t pixel)
{
    const raster_point_t *p = setup->p;
    edge_t edge[3];
    for (int i = 0; i < 3; i++)
        edge_set(&edge[i], &p[i], &p[i == 2 ? 0 : i + 1], setup->x0, setup->y0);
    int32_t near_x = 0;
    int32_t near_y = 0;
    depth_gradient(p, setup->area, &near_x, &near_y);
    /* From the first pixel of corner 0, whole pixels to where this band begins: the same depth in
     * every band. Unsigned: partial sums may wrap, the depth inside the triangle does not. */
    int32_t x = first_pixel(p[0].x_q4);
    int32_t y = first_pixel(p[0].y_q4);
    uint32_t near = ((uint32_t)p[0].near << 14) + (1u << 13) +
                    (uint32_t)(near_x >> 4) * (uint32_t)(x * 16 + 8 - p[0].x_q4) +
                    (uint32_t)(near_y >> 4) * (uint32_t)(y * 16 + 8 - p[0].y_q4) +
                    (uint32_t)near_x * (uint32_t)(setup->x0 - x) +
                    (uint32_t)near_y * (uint32_t)(setup->y0 - y);
    const yb_band_t *band = raster->band;
    for (y = setup->y0; y < setup->y1; y++) {
        int32_t line = y - raster->first_row;
        uint16_t *depth = band->depth + line * raster->screen->width;
        uint8_t *row = band->pixels + (size_t)line * band->pitch;
        raster_area_t a = edge[0].value;
        raster_area_t b = edge[1].value;
        raster_area_t c = edge[2].value;
        uint32_t here = near;
        for (x = setup->x0; x < setup->x1; x++) {
            if ((a | b | c) >= 0 && depth_of(here) > depth[x]) {
                depth[x] = depth_of(here);
                put_pixel(raster, row, x, pixel);
            }
            a += edge[0].along_x;
            b += edge[1].along_x;
            c += edge[2].along_x;
            here += (uint32_t)near_x;
        }
        for (int i = 0; i < 3; i++)
            edge[i].value += edge[i].along_y;
        near += (uint32_t)near_y;
    }
}
