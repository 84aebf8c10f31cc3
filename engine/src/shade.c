#include "shade.h"

#include <yamabiko/rom.h>

#include "colour.h"
#include "fix.h"
#include "relief.h"
#include "shadow.h"

enum {
    WALL_DIM = 3, /* shades by which a wall is darker than ground would be */
    WATER_DIM = 4 /* and water, where there is no colour to tell it by */
};

/* round(2^31 / sqrt(i 2^26)) - 1 for i from 16 to 64 */
static const uint16_t root_table[49] YB_ROM = {
    65535, 63578, 61787, 60139, 58616, 57204, 55888, 54660, 53509, 52428, 51410, 50449, 49540,
    48678, 47860, 47081, 46340, 45632, 44956, 44309, 43690, 43095, 42524, 41976, 41448, 40939,
    40449, 39976, 39519, 39077, 38650, 38237, 37836, 37448, 37072, 36707, 36352, 36007, 35672,
    35346, 35029, 34721, 34420, 34127, 33842, 33563, 33291, 33026, 32767};

/* 2^31 / sqrt(a) for 2^30 <= a < 2^32, within a thousandth: above 2^15, at most 2^16. */
static uint32_t reciprocal_root(uint32_t a)
{
    uint32_t i = a >> 26;
    uint32_t root = yb_rom_u16(&root_table[i - 16]);
    uint32_t step = root - yb_rom_u16(&root_table[i - 15]);
    return root + 1 - (step * (a >> 18 & 255) >> 8);
}

/* A direction. */
typedef struct {
    int32_t x, y, z;
} normal_t;

/* The size of a number below 2^30, but that a negative one counts as one less: one instruction. */
static inline uint32_t size_of(int32_t a)
{
    return (uint32_t)(a ^ a >> 30);
}

/* Brings the greatest of three numbers to 13 bits. */
static inline void to_13_bits(normal_t *n)
{
    uint32_t all = size_of(n->x) | size_of(n->y) | size_of(n->z);
    int shift = fix_log2_floor(all | 1) - 12;
    if (shift >= 0) {
        n->x >>= shift;
        n->y >>= shift;
        n->z >>= shift;
    } else {
        n->x *= 1 << -shift;
        n->y *= 1 << -shift;
        n->z *= 1 << -shift;
    }
}

/* 2^31 over the length of a direction that is not zero, times the power of two that brings it to 16
 * bits: 2^*more. Components of up to 15 bits: three squares are below 2^32.
 */
static inline uint32_t reciprocal_length(const normal_t *n, int *more)
{
    uint32_t square = (uint32_t)(n->x * n->x) + (uint32_t)(n->y * n->y) + (uint32_t)(n->z * n->z);
    *more = (31 - fix_log2_floor(square)) >> 1;
    return reciprocal_root(square << 2 * *more);
}

/* The shade of a surface by the cosine between its outward normal, of up to 15 bits, and a unit
 * vector of 14 bits to the light (Lambert). The dot product is within 3 * 2^29.
 */
static inline int32_t lambert(const normal_t *n, const int16_t light[3])
{
    int32_t dot = n->x * light[0] + n->y * light[1] + n->z * light[2];
    if (dot <= 0)
        return DARKEST;
    int more = 0;
    uint32_t root = reciprocal_length(n, &more);
    /* The cosine times 2^31, for a unit vector to the sun: any other is cut. */
    uint32_t along = (uint32_t)dot >> 14 << more;
    along = along < 65535 ? along : 65535;
    uint32_t cosine_q12 = along * root >> 19;
    /* Rounded up a little, so that level ground and water below a sun 30 degrees high, a half on
     * the dot, have one shade whatever triangles they are made of. */
    uint32_t shade = (cosine_q12 * (SHADES - DARKEST) + 1024) >> 12;
    return fix_min(DARKEST + (int32_t)shade, SHADES - 1);
}

/* Towards the lamp. */
static void find_lamp(const yb_frame_t *frame, const yb_point_t *at, int32_t raised_q8,
                      int16_t light[3])
{
    const int32_t *lamp = frame->view.lamp_q8;
    normal_t to_lamp = {lamp[0] - (int32_t)(at->place & 0xffff),
                        lamp[1] - (int32_t)(at->place >> 16), lamp[2] - raised_q8};
    to_13_bits(&to_lamp);
    to_lamp.z |= to_lamp.x == 0 && to_lamp.y == 0 ? 1 : 0; /* at the lamp itself: from above */
    int more = 0;
    int32_t root = (int32_t)(reciprocal_length(&to_lamp, &more) >> 1);
    light[0] = (int16_t)(to_lamp.x * root >> (16 - more));
    light[1] = (int16_t)(to_lamp.y * root >> (16 - more));
    light[2] = (int16_t)(to_lamp.z * root >> (16 - more));
}

/* A height, or a slope, as the view's scale raises it: below 2^20 * 2^8. */
static inline int32_t raised(const yb_frame_t *frame, int32_t height)
{
    int32_t scale = frame->view.exaggerate_q8;
    return scale == 256 ? height : (height * (scale >> 3)) >> 5;
}

/* A triangle's upward normal, from differences of at most 14 bits: a product of two has 28. */
static inline void find_normal(const yb_frame_t *frame, const yb_point_t *const p[3],
                               normal_t *normal)
{
    int32_t x1 = relief_dx(p[0]->place, p[1]->place);
    int32_t y1 = relief_dy(p[0]->place, p[1]->place);
    int32_t x2 = relief_dx(p[0]->place, p[2]->place);
    int32_t y2 = relief_dy(p[0]->place, p[2]->place);
    int32_t z1 = raised(frame, p[1]->top_q8 - p[0]->top_q8);
    int32_t z2 = raised(frame, p[2]->top_q8 - p[0]->top_q8);
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
    *normal = (normal_t){y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2};
    to_13_bits(normal);
}

/* Turns a triangle's normal towards that of the smooth surface, which the slopes at its corners
 * tell, by three parts of seven: the facets of a coarse mesh vanish, the fractal detail stays.
 */
static inline void smooth_normal(const yb_frame_t *frame, const yb_point_t *const p[3],
                                 normal_t *normal)
{
    /* Three quarters of the mean slope, east in the lower half and north in the upper one: sums of
     * three have 16 bits, with 3 * 2^13 added. */
    uint32_t sum = (p[0]->slope >> 2 & 0x3fff3fff) + (p[1]->slope >> 2 & 0x3fff3fff) +
                   (p[2]->slope >> 2 & 0x3fff3fff);
    int32_t east = raised(frame, (int32_t)(sum & 0xffff) - 3 * 8192);
    int32_t north = raised(frame, (int32_t)(sum >> 16) - 3 * 8192);
    /* Below 2^13 * 2^13, raised by up to 2^3. */
    normal->x -= normal->z * east >> 11;
    normal->y -= normal->z * north >> 11;
    normal->z += 3 * normal->z >> 2;
    if (frame->view.exaggerate_q8 > 256) /* else they are at most 2^13 + 3 * 2^13 */
        to_13_bits(normal);
}

/* The shade of a surface at a point, which may stand for a small triangle. */
static int32_t lit(const yb_frame_t *frame, const yb_point_t *at, const normal_t *normal)
{
    if (!frame->view.lamp)
        return lambert(normal, frame->view.sun_q14);
    int16_t light[3];
    find_lamp(frame, at, raised(frame, at->top_q8), light);
    return lambert(normal, light);
}

/* Has a triangle no corner in the water? */
static inline bool all_dry(const yb_frame_t *frame, const yb_point_t *const p[3])
{
    int32_t water = frame->view.water_q8;
    return water == YB_NO_WATER || (p[0]->z_q8 > water && p[1]->z_q8 > water && p[2]->z_q8 > water);
}

/* The shade of a triangle of the ground, of the water, or between them. */
static int32_t shade_of(const yb_frame_t *frame, const yb_point_t *const p[3])
{
    normal_t normal;
    find_normal(frame, p, &normal);
    if (frame->map->smooth && all_dry(frame, p))
        smooth_normal(frame, p, &normal);
    return frame->view.lamp ? lit(frame, p[0], &normal) : lambert(&normal, frame->view.sun_q14);
}

/* A shade, where a cast shadow may lie: in it, a quarter of what the sun gives is left, so that it
 * does not hide the relief.
 */
static inline int32_t shadowed(const yb_frame_t *frame, const yb_point_t *const p[3], int32_t shade)
{
    const yb_shadow_t *shadow = frame->view.shadow;
    if (shadow == NULL || shade <= DARKEST)
        return shade;
    /* A third: 21845 / 2^16; a sum of three has 18 bits. */
    uint32_t x = (p[0]->place & 0xffff) + (p[1]->place & 0xffff) + (p[2]->place & 0xffff);
    uint32_t y = (p[0]->place >> 16) + (p[1]->place >> 16) + (p[2]->place >> 16);
    int32_t light =
        shadow_light(shadow, (int32_t)((x >> 2) * 21845 >> 14), (int32_t)((y >> 2) * 21845 >> 14));
    if (light == SHADOW_NONE)
        return shade;
    return DARKEST + (((shade - DARKEST) * (64 + 3 * light) + 128) >> 8);
}

/* 1/depth of the nearest corner: one that is not on the screen has 0. */
static int32_t nearest_of(const yb_point_t *const p[3])
{
    return fix_max(p[0]->spot.near, fix_max(p[1]->spot.near, p[2]->spot.near));
}

static uint16_t water_pixel(const yb_frame_t *frame, int32_t shade, int32_t near)
{
    if (frame->screen.format != YB_RGB565)
        shade = fix_max(shade - WATER_DIM, 1);
    return colour_pixel(frame, HUE_WATER, shade, near);
}

/* The hue of ground at this height. */
static int hue_of(const yb_frame_t *frame, int32_t z_q8)
{
    int32_t low = frame->map->low_q8;
    int32_t above = fix_clamp(z_q8 - low, 0, frame->map->high_q8 - low);
    return (int)fix_min((int32_t)(((uint32_t)above * (uint32_t)frame->tone_q16) >> 16), HUES - 1);
}

/* The pixel value of a triangle that has this much light, but for shadows. */
static inline uint16_t pixel_of(const yb_frame_t *frame, const yb_point_t *const corner[3],
                                int32_t light)
{
    int32_t shade = shadowed(frame, corner, light);
    int32_t water = frame->view.water_q8;
    bool drowned = corner[0]->z_q8 <= water && corner[1]->z_q8 <= water && corner[2]->z_q8 <= water;
    if (colour_is_shade(frame) && !drowned)
        return (uint16_t)shade;
    int32_t near = nearest_of(corner);
    if (drowned)
        return water_pixel(frame, shade, near);
    if (frame->screen.format != YB_RGB565)
        return colour_pixel(frame, 0, shade, near);
    /* A third: 5461 / 2^14. */
    int32_t middle = ((corner[0]->z_q8 + corner[1]->z_q8 + corner[2]->z_q8) >> 4) * 5461 >> 10;
    return colour_pixel(frame, hue_of(frame, middle), shade, near);
}

shade_t shade_ground(const yb_frame_t *frame, const yb_point_t *const corner[3])
{
    const int32_t light = shade_of(frame, corner);
    return (shade_t){pixel_of(frame, corner, light), (uint16_t)light};
}

/* --- Lines ------------------------------------------------------------------------------------ */

/* Heights of a triangle as values of a cut, from `zero` on. False: too high for that. */
static bool cut_values(const yb_point_t *const p[3], int32_t zero, raster_cut_t *cut)
{
    for (int i = 0; i < 3; i++) {
        int32_t value = p[i]->z_q8 - zero;
        if (value < 0 || value > 65535)
            return false;
        cut->value[i] = value;
    }
    cut->value[3] = cut->value[0];
    cut->value[4] = cut->value[1];
    return true;
}

/* What is darker on light ground and lighter on dark; a colour of its own where there are any. */
static uint16_t line_pixel(const yb_frame_t *frame, int hue, int32_t shade, int32_t near)
{
    const int32_t contrast = frame->screen.format == YB_MONO ? SHADES : SHADES / 3;
    if (frame->screen.format != YB_RGB565)
        shade = shade > SHADES / 3 ? fix_max(shade - contrast, 0)
                                   : fix_min(shade + contrast, SHADES - 1);
    return colour_pixel(frame, hue, shade, near);
}

/* The shore, where a triangle reaches into the water. */
static bool cut_shore(const yb_frame_t *frame, const yb_point_t *const p[3], uint16_t above,
                      raster_cut_t *cut)
{
    static const normal_t level = {0, 0, 1 << 12};
    const int32_t near = nearest_of(p);
    const int32_t flat = shadowed(frame, p, lit(frame, p[0], &level));
    cut->interval = 0;
    cut->zero = (int32_t)1 << 15;
    cut->below = water_pixel(frame, flat, near);
    cut->above = above;
    cut->line = line_pixel(frame, HUE_SHORE, SHADES - 1, near);
    return cut_values(p, frame->view.water_q8 - cut->zero, cut);
}

bool shade_cut(const yb_frame_t *frame, const yb_point_t *const p[3], shade_t shade,
               raster_cut_t *cut)
{
    const yb_view_t *view = &frame->view;
    int32_t low = fix_min(p[0]->z_q8, fix_min(p[1]->z_q8, p[2]->z_q8));
    int32_t high = fix_max(p[0]->z_q8, fix_max(p[1]->z_q8, p[2]->z_q8));
    if (low < view->water_q8)
        return high > view->water_q8 && cut_shore(frame, p, shade.pixel, cut);
    if (frame->contour_inverse == 0)
        return false;
    /* A line is a pixel wide: half of it may lie in a triangle beside the one it runs through. */
    int32_t margin = ((high - low) >> 2) + 1;
    low -= margin;
    high += margin;
    /* The line below: 2^21 / 2^4 times 2^20 / YB_LEAST_CONTOUR_Q8 is below 2^32, and the quotient
     * is at most 4 too small. */
    uint32_t above = (uint32_t)(low - frame->contour_low);
    uint32_t interval = (uint32_t)view->contour_q8;
    uint32_t line = ((above >> 4) * frame->contour_inverse >> 16) * interval;
    while (above - line >= interval)
        line += interval;
    if ((uint32_t)(high - frame->contour_low) < line + interval)
        return false;
    cut->interval = (int32_t)interval;
    cut->zero = 0;
    cut->below = cut->above = shade.pixel;
    cut->line = line_pixel(frame, HUE_LINE, shade.light, nearest_of(p));
    return cut_values(p, frame->contour_low + (int32_t)line, cut);
}

uint16_t shade_wall(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    /* Outward: to the right of the edge. */
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    normal_t outward = {dy, -dx, 0};
    to_13_bits(&outward);
    int32_t shade = fix_max(lit(frame, a, &outward) - WALL_DIM, DARKEST);
    int32_t near = fix_max(a->spot.near, b->spot.near);
    int32_t water = frame->view.water_q8;
    if (a->z_q8 <= water && b->z_q8 <= water)
        return water_pixel(frame, shade, near);
    return colour_pixel(frame, HUE_WALL, shade, near);
}
