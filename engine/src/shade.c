#include "shade.h"

#include <yamabiko/rom.h>

#include "fix.h"

enum {
    SHADES = 16, /* of which the ground uses 2 .. 15: 14 shades */
    DARKEST = 2, /* what the sun does not reach: light of the sky */
    HUES = 16,
    WALL_DIM = 3 /* shades by which a wall is darker than ground would be */
};

/* Hues of the ground from the lowest to the highest: woods, meadows, bare soil, rock, snow. */
static const uint8_t ground_hue[HUES][3] YB_ROM = {
    {62, 112, 66},   {81, 125, 70},   {99, 139, 74},   {118, 152, 78},
    {137, 157, 87},  {157, 163, 95},  {176, 168, 104}, {169, 152, 97},
    {163, 136, 89},  {156, 120, 82},  {151, 123, 95},  {147, 127, 109},
    {142, 130, 122}, {169, 162, 157}, {196, 194, 192}, {248, 248, 252},
};
static const uint8_t water_hue[3] YB_ROM = {72, 116, 168};
static const uint8_t wall_hue[3] YB_ROM = {150, 132, 112};
static const uint8_t sky[3] YB_ROM = {206, 222, 236};

void shade_begin(yb_frame_t *frame)
{
    int32_t relief = fix_max(frame->map->high_q8 - frame->map->low_q8, 1);
    frame->tone_q16 = (int32_t)(((uint32_t)HUES << 16) / (uint32_t)relief);
}

static uint16_t rgb565(uint32_t red, uint32_t green, uint32_t blue)
{
    return (uint16_t)((red >> 3) << 11 | (green >> 2) << 5 | blue >> 3);
}

/* A hue at a shade. On a grey screen the shade alone is the picture. */
static uint16_t pixel_of(const yb_frame_t *frame, const uint8_t hue[3], uint32_t shade)
{
    if (frame->screen.format == YB_GREY4)
        return (uint16_t)shade;
    uint32_t light = shade + 1;
    return rgb565(yb_rom_u8(&hue[0]) * light >> 4, yb_rom_u8(&hue[1]) * light >> 4,
                  yb_rom_u8(&hue[2]) * light >> 4);
}

uint16_t shade_background(const yb_frame_t *frame)
{
    return frame->screen.format == YB_GREY4
               ? 0
               : rgb565(yb_rom_u8(&sky[0]), yb_rom_u8(&sky[1]), yb_rom_u8(&sky[2]));
}

/* The shade of a surface by the cosine between its upward normal n and the sun (Lambert). The
 * normal is first brought to 15 bits: its square then fits 32, and the dot product 31.
 */
static uint32_t lambert(const yb_frame_t *frame, const int32_t normal[3])
{
    int32_t n[3];
    uint32_t all = 0;
    for (int i = 0; i < 3; i++)
        all |= (uint32_t)fix_abs(normal[i]);
    if (all == 0)
        return DARKEST;
    int shift = fix_log2_floor(all) - 14;
    uint32_t square = 0;
    int32_t dot = 0;
    for (int i = 0; i < 3; i++) {
        n[i] = shift >= 0 ? normal[i] >> shift : normal[i] * (1 << -shift);
        square += (uint32_t)(n[i] * n[i]);
        dot += (n[i] * frame->view.sun_q14[i]) >> 2;
    }
    if (dot <= 0)
        return DARKEST;
    /* One Newton step from the largest component and half the others: within 1 %. */
    uint32_t length = (uint32_t)(fix_max(fix_max(fix_abs(n[0]), fix_abs(n[1])), fix_abs(n[2])));
    length += ((uint32_t)(fix_abs(n[0]) + fix_abs(n[1]) + fix_abs(n[2])) - length) * 3 >> 3;
    length = (length + square / length) >> 1;
    uint32_t cosine_q12 = (uint32_t)dot / length; /* dot has 12 fractional bits left */
    return (uint32_t)fix_min(DARKEST + (int32_t)((cosine_q12 * (SHADES - DARKEST)) >> 12),
                             SHADES - 1);
}

/* The upward normal of abc, from differences brought to 11 bits: a product of two has 22. */
static void normal_of(const yb_frame_t *frame, const yb_vertex_t *const p[3], int32_t normal[3])
{
    int32_t d[2][3];
    uint32_t all = 0;
    for (int k = 0; k < 2; k++) {
        int32_t rise = fix_max(p[k + 1]->z_q8, frame->view.water_q8) -
                       fix_max(p[0]->z_q8, frame->view.water_q8);
        d[k][0] = fix_minus(p[k + 1]->x_q8, p[0]->x_q8);
        d[k][1] = fix_minus(p[k + 1]->y_q8, p[0]->y_q8);
        d[k][2] = (rise * (frame->view.exaggerate_q8 >> 3)) >> 5; /* 2^19 * 2^8 */
        for (int i = 0; i < 3; i++)
            all |= (uint32_t)fix_abs(d[k][i]);
    }
    int shift = (int)fix_max(fix_log2_floor(all | 1) - 10, 0);
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 3; i++)
            d[k][i] >>= shift;
    }
    normal[0] = d[0][1] * d[1][2] - d[0][2] * d[1][1];
    normal[1] = d[0][2] * d[1][0] - d[0][0] * d[1][2];
    normal[2] = d[0][0] * d[1][1] - d[0][1] * d[1][0];
}

uint16_t shade_ground(const yb_frame_t *frame, const yb_vertex_t *a, const yb_vertex_t *b,
                      const yb_vertex_t *c)
{
    const yb_vertex_t *const p[3] = {a, b, c};
    int32_t normal[3];
    normal_of(frame, p, normal);
    uint32_t shade = lambert(frame, normal);
    int32_t water = frame->view.water_q8;
    if (a->z_q8 <= water && b->z_q8 <= water && c->z_q8 <= water)
        return pixel_of(frame, water_hue, shade);
    int32_t middle = (a->z_q8 + b->z_q8 + c->z_q8) / 3 - frame->map->low_q8;
    middle = fix_clamp(middle, 0, frame->map->high_q8 - frame->map->low_q8);
    int32_t hue =
        fix_min((int32_t)(((uint32_t)middle * (uint32_t)frame->tone_q16) >> 16), HUES - 1);
    return pixel_of(frame, ground_hue[hue], shade);
}

uint16_t shade_wall(const yb_frame_t *frame, const yb_vertex_t *a, const yb_vertex_t *b)
{
    /* Outward: to the right of the edge. */
    const int32_t normal[3] = {fix_minus(b->y_q8, a->y_q8), fix_minus(a->x_q8, b->x_q8), 0};
    int32_t shade = fix_max((int32_t)lambert(frame, normal) - WALL_DIM, DARKEST);
    int32_t water = frame->view.water_q8;
    bool flooded = a->z_q8 <= water && b->z_q8 <= water;
    return pixel_of(frame, flooded ? water_hue : wall_hue, (uint32_t)shade);
}
