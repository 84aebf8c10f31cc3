#include "shade.h"

#include <yamabiko/rom.h>

#include "fix.h"
#include "relief.h"

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

/* round(2^31 / sqrt(i 2^26)) - 1 for i from 16 to 64 */
static const uint16_t root_table[49] YB_ROM = {
    65535, 63578, 61787, 60139, 58616, 57204, 55888, 54660, 53509, 52428, 51410, 50449, 49540,
    48678, 47860, 47081, 46340, 45632, 44956, 44309, 43690, 43095, 42524, 41976, 41448, 40939,
    40449, 39976, 39519, 39077, 38650, 38237, 37836, 37448, 37072, 36707, 36352, 36007, 35672,
    35346, 35029, 34721, 34420, 34127, 33842, 33563, 33291, 33026, 32767};

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

/* 2^31 / sqrt(a) for 2^30 <= a < 2^32, within a thousandth: above 2^15, at most 2^16. */
static uint32_t reciprocal_root(uint32_t a)
{
    uint32_t i = a >> 26;
    uint32_t root = yb_rom_u16(&root_table[i - 16]);
    uint32_t step = root - yb_rom_u16(&root_table[i - 15]);
    return root + 1 - (step * (a >> 18 & 255) >> 8);
}

/* The shade of a surface by the cosine between its upward normal n, of up to 30 bits, and the sun
 * (Lambert). The normal is first brought to 15 bits: its square then fits 32, and the dot product
 * is within 3 * 2^29.
 */
static int32_t lambert(const yb_frame_t *frame, int32_t x, int32_t y, int32_t z)
{
    uint32_t all = (uint32_t)(fix_abs(x) | fix_abs(y) | fix_abs(z));
    if (all == 0)
        return DARKEST;
    int shift = fix_log2_floor(all) - 14;
    if (shift >= 0) {
        x >>= shift;
        y >>= shift;
        z >>= shift;
    } else {
        x *= 1 << -shift;
        y *= 1 << -shift;
        z *= 1 << -shift;
    }
    const int16_t *sun = frame->view.sun_q14;
    int32_t dot = x * sun[0] + y * sun[1] + z * sun[2];
    if (dot <= 0)
        return DARKEST;
    uint32_t square = (uint32_t)(x * x) + (uint32_t)(y * y) + (uint32_t)(z * z);
    uint32_t along = (uint32_t)dot >> 14;
    while (square < (uint32_t)1 << 30) { /* from 2^28 on: once at most */
        square <<= 2;
        along <<= 1;
    }
    /* The cosine times 2^31, for a unit vector to the sun: any other is cut. */
    along = along < 65535 ? along : 65535;
    uint32_t cosine_q12 = along * reciprocal_root(square) >> 19;
    /* Rounded up a little, so that level ground and water below a sun 30 degrees high, a half on
     * the dot, have one shade whatever triangles they are made of. */
    uint32_t shade = (cosine_q12 * (SHADES - DARKEST) + 1024) >> 12;
    return fix_min(DARKEST + (int32_t)shade, SHADES - 1);
}

/* The shade of a triangle by its upward normal, from differences of at most 14 bits: a product of
 * two has 28.
 */
static int32_t shade_of(const yb_frame_t *frame, const yb_point_t *const p[3])
{
    int32_t x1 = relief_dx(p[0]->place, p[1]->place);
    int32_t y1 = relief_dy(p[0]->place, p[1]->place);
    int32_t x2 = relief_dx(p[0]->place, p[2]->place);
    int32_t y2 = relief_dy(p[0]->place, p[2]->place);
    int32_t z1 = p[1]->top_q8 - p[0]->top_q8;
    int32_t z2 = p[2]->top_q8 - p[0]->top_q8;
    if (frame->view.exaggerate_q8 != 256) { /* 2^20 * 2^8 */
        z1 = (z1 * (frame->view.exaggerate_q8 >> 3)) >> 5;
        z2 = (z2 * (frame->view.exaggerate_q8 >> 3)) >> 5;
    }
    const int32_t most = (int32_t)1 << 14;
    while ((uint32_t)((x1 + most) | (y1 + most) | (x2 + most) | (y2 + most) | (z1 + most) |
                      (z2 + most)) >= (uint32_t)1 << 15) {
        x1 >>= 1;
        y1 >>= 1;
        z1 >>= 1;
        x2 >>= 1;
        y2 >>= 1;
        z2 >>= 1;
    }
    return lambert(frame, y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2);
}

uint16_t shade_ground(const yb_frame_t *frame, const yb_point_t *const corner[3])
{
    uint32_t shade = (uint32_t)shade_of(frame, corner);
    if (frame->screen.format == YB_GREY4)
        return (uint16_t)shade;
    int32_t water = frame->view.water_q8;
    if (corner[0]->z_q8 <= water && corner[1]->z_q8 <= water && corner[2]->z_q8 <= water)
        return pixel_of(frame, water_hue, shade);
    /* A third: 5461 / 2^14. */
    int32_t low = frame->map->low_q8;
    int32_t middle =
        (((corner[0]->z_q8 + corner[1]->z_q8 + corner[2]->z_q8) >> 4) * 5461 >> 10) - low;
    middle = fix_clamp(middle, 0, frame->map->high_q8 - low);
    int32_t hue =
        fix_min((int32_t)(((uint32_t)middle * (uint32_t)frame->tone_q16) >> 16), HUES - 1);
    return pixel_of(frame, ground_hue[hue], shade);
}

uint16_t shade_wall(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    /* Outward: to the right of the edge. */
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    int32_t shade = fix_max(lambert(frame, dy, -dx, 0) - WALL_DIM, DARKEST);
    int32_t water = frame->view.water_q8;
    bool flooded = a->z_q8 <= water && b->z_q8 <= water;
    return pixel_of(frame, flooded ? water_hue : wall_hue, (uint32_t)shade);
}
