#include "shade.h"

#include <yamabiko/rom.h>

#include "colour.h"
#include "cosine.h"
#include "fix.h"
#include "lines.h"
#include "relief.h"
#include "shadow.h"

enum {
    WALL_DIM = 3, /* shades by which a wall is darker than ground would be */
    WATER_DIM = 4 /* and water, where there is no colour to tell it by */
};

#define SHORE_SCALE ((uint32_t)1 << 15)

/* A direction. */
typedef struct {
    int32_t x, y, z;
} normal_t;

/* Brings the greatest of three numbers below 2^31 to 13 bits. The third, which has 32, is above 0.
 */
static inline normal_t to_13_bits(int32_t x, int32_t y, uint32_t z)
{
    const int shift = fix_log2_floor(fix_size(x) | fix_size(y) | z) - 12;
    if (USUAL(shift >= 0))
        return (normal_t){x >> shift, y >> shift, (int32_t)(z >> shift)};
    return (normal_t){x * (1 << -shift), y * (1 << -shift), (int32_t)(z << -shift)};
}

/* The square of a direction's length: of components of up to 15 bits, whose squares are below 2^32.
 * It is at least 2^22: one of 13 bits, x, may become x - 3 z when smooth_normal makes 7/4 z of z,
 * which is shortest, by a half, where z is a quarter of it.
 */
static inline uint32_t square_of(normal_t n)
{
    return (uint32_t)(n.x * n.x) + (uint32_t)(n.y * n.y) + (uint32_t)(n.z * n.z);
}

/* The light of the sun, a unit vector of 14 bits, on a surface with this outward normal, of 12 to
 * 15 bits (Lambert). The dot product is within 3 * 2^29, and a 2^14th of it no more than the
 * normal's length, below 2^16.
 */
static inline int32_t sun_light(const yb_frame_t *frame, normal_t n)
{
    const int16_t *sun = frame->view.sun_q14;
    int32_t dot = n.x * sun[0] + n.y * sun[1] + n.z * sun[2];
    return dot <= 0 ? DARKEST : cosine_shade((uint32_t)dot >> 15, square_of(n) >> 14);
}

/* A number of 32 bits times so many powers of four is above 2^30. */
static inline int room_above(uint32_t square)
{
    return (31 - fix_log2_floor(square)) >> 1;
}

/* The light of the lamp at a point, which may stand for a small triangle. */
static int32_t lamp_light(const yb_frame_t *frame, const yb_point_t *at, normal_t n)
{
    const int32_t *lamp = frame->view.lamp_q8;
    int32_t x = lamp[0] - (int32_t)(at->place & 0xffff);
    int32_t y = lamp[1] - (int32_t)(at->place >> 16);
    int32_t z = lamp[2] - ((at->top_q8 * (frame->view.exaggerate_q8 >> 3)) >> 5);
    normal_t way = to_13_bits(x, y, fix_size(z) | 1); /* at the lamp itself: from above */
    way.z = z < 0 ? -way.z : way.z;
    int32_t dot = n.x * way.x + n.y * way.y + n.z * way.z; /* within 3 * 2^28 */
    if (dot <= 0)
        return DARKEST;
    uint32_t square = square_of(n);
    uint32_t way_square = square_of(way);
    int more = room_above(square);
    int way_more = room_above(way_square);
    /* No more than the lengths' product, below 2^32. */
    uint32_t along = (uint32_t)dot << (more + way_more);
    uint32_t whole = (square << 2 * more >> 16) * (way_square << 2 * way_more >> 16);
    return cosine_shade(along >> 17, whole >> 14);
}

/* A triangle's upward normal, where the vertical scale is true.
 *
 * Twice the plan area is above 0 and below 2^32, whatever its products are. With plan differences
 * below 2^16 and rises within 2^14, the other products are below 2^30.
 */
static inline normal_t normal_of(const yb_point_t *const p[3])
{
    int32_t x1 = relief_dx(p[0]->place, p[1]->place);
    int32_t y1 = relief_dy(p[0]->place, p[1]->place);
    int32_t x2 = relief_dx(p[0]->place, p[2]->place);
    int32_t y2 = relief_dy(p[0]->place, p[2]->place);
    uint32_t area = (uint32_t)x1 * (uint32_t)y2 - (uint32_t)y1 * (uint32_t)x2;
    int32_t z1 = p[1]->top_q8 - p[0]->top_q8;
    int32_t z2 = p[2]->top_q8 - p[0]->top_q8;
    const uint32_t rise = fix_size(z1) | fix_size(z2);
    if (!USUAL(rise < (uint32_t)1 << 14)) {
        const int shift = fix_log2_floor(rise) - 13;
        z1 >>= shift;
        z2 >>= shift;
        area = area >> shift | 1;
    }
    return to_13_bits(y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, area);
}

/* The sums of the slopes at a triangle's corners, within 3 * 2^13: east, signed, in the lower half,
 * and north in the upper one, which is one less where east is negative.
 */
static inline uint32_t slopes_of(const yb_point_t *const p[3])
{
    return p[0]->slope + p[1]->slope + p[2]->slope - 3 * (uint32_t)0x8000 -
           3 * ((uint32_t)0x8000 << 16);
}

/* Turns a triangle's normal towards that of the smooth surface, which the slopes at its corners
 * tell, by three parts of seven: the facets of a coarse mesh vanish, the fractal detail stays.
 */
TINY void smooth_normal(uint32_t slopes, normal_t *n)
{
    int32_t east = (int16_t)(slopes & 0xffff);
    int32_t north = (int32_t)slopes >> 16;
    /* Three quarters of the mean: products are below 2^13 * 3 * 2^13, what is added to 13 bits is
     * below 3 * 2^13. */
    n->x -= n->z * east >> 13;
    n->y -= n->z * north >> 13;
    n->z += 3 * n->z >> 2;
}

/* Of ground with another vertical scale: up to 2^11, times components of 15 bits. */
static normal_t raised(const yb_frame_t *frame, normal_t n)
{
    int32_t scale = frame->view.exaggerate_q8;
    return to_13_bits(n.x * scale, n.y * scale, (uint32_t)n.z << 8 | 1);
}

static inline int32_t light_on(const yb_frame_t *frame, const yb_point_t *at, const normal_t *n)
{
    return frame->view.lamp ? lamp_light(frame, at, *n) : sun_light(frame, *n);
}

/* A shade, where a cast shadow may lie: in it, a quarter of what the sun gives is left, so that it
 * does not hide the relief.
 */
COPIED int32_t shadowed(const yb_frame_t *frame, const yb_point_t *const p[3], int32_t shade)
{
    const yb_shadow_t *shadow = frame->view.shadow;
    if (shadow == NULL || shade <= DARKEST)
        return shade;
    /* x and y at once, a quarter of each: sums of three have 16 bits. A third is 21845 / 2^16. */
    const uint32_t quarters = 0x3fff3fff;
    const uint32_t sum = (p[0]->place >> 2 & quarters) + (p[1]->place >> 2 & quarters) +
                         (p[2]->place >> 2 & quarters);
    const int32_t light = shadow_at(shadow, (sum & 0xffff) * 21845, (sum >> 16) * 21845, 14);
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

/* What ground that has this shade looks like where there are colours. */
APART shade_t coloured(const yb_frame_t *frame, const yb_point_t *const corner[3], int32_t shade,
                       int32_t light)
{
    /* A third: 5461 / 2^14. */
    const int32_t middle =
        ((corner[0]->z_q8 + corner[1]->z_q8 + corner[2]->z_q8) >> 4) * 5461 >> 10;
    const int32_t near = (frame->looks & LOOK_HAZE) == 0 ? 0 : nearest_of(corner);
    return shade_of(colour_pixel(frame, hue_of(frame, middle), shade, near), light);
}

/* How many corners of a triangle lie in the water. */
APART int wet_corners(const yb_frame_t *frame, const yb_point_t *const corner[3])
{
    int wet = 0;
    for (int i = 0; i < 3; i++)
        wet += corner[i]->z_q8 <= frame->view.water_q8;
    return wet;
}

/* The light where there is more to it than the sun's on ground, by a triangle's normal: x in the
 * lower half and y in the upper one, and z.
 */
APART int32_t odd_light(const yb_frame_t *frame, const yb_point_t *const corner[3],
                        uint32_t normal_xy, int32_t normal_z)
{
    normal_t normal = {(int16_t)(normal_xy & 0xffff), (int32_t)normal_xy >> 16, normal_z};
    if (wet_corners(frame, corner) == 0 && frame->smooth)
        smooth_normal(slopes_of(corner), &normal);
    if (frame->view.exaggerate_q8 != 256)
        normal = raised(frame, normal);
    return light_on(frame, corner[0], &normal);
}

/* What a triangle looks like that has this light. */
APART shade_t look_of(const yb_frame_t *frame, const yb_point_t *const corner[3], int32_t light)
{
    const uint32_t looks = frame->looks;
    const int32_t shade = shadowed(frame, corner, light);
    uint16_t pixel = (uint16_t)shade;
    if (!USUAL((looks & (LOOK_ODD | LOOK_COLOURS)) == 0)) {
        if ((looks & LOOK_ODD) != 0 && wet_corners(frame, corner) == 3)
            return shade_of(water_pixel(frame, shade, nearest_of(corner)), light);
        if ((looks & LOOK_COLOURS) != 0)
            return coloured(frame, corner, shade, light);
    }
    if ((looks & LOOK_HAZE) != 0)
        pixel = colour_grey(frame, shade, nearest_of(corner));
    return shade_of(pixel, light);
}

shade_t shade_ground(const yb_frame_t *frame, const yb_point_t *const corner[3])
{
    const uint32_t slopes = slopes_of(corner);
    normal_t normal = normal_of(corner);
    const uint32_t looks = frame->looks;
    int32_t light;
    if (USUAL((looks & LOOK_ODD) == 0)) {
        smooth_normal(slopes, &normal);
        light = sun_light(frame, normal);
    } else {
        light = odd_light(frame, corner, ((uint32_t)normal.x & 0xffff) | (uint32_t)normal.y << 16,
                          normal.z);
    }
    if (USUAL(looks == 0))
        return shade_of((uint16_t)light, light);
    if (looks == LOOK_COLOURS)
        return coloured(frame, corner, light, light);
    return look_of(frame, corner, light);
}

/* --- Lines ------------------------------------------------------------------------------------ */

/* What is darker on light ground and lighter on dark; a colour of its own where there are any. */
static inline uint16_t line_pixel(const yb_frame_t *frame, int hue, int32_t shade, int32_t near)
{
    const int32_t contrast = frame->screen.format == YB_MONO ? SHADES : SHADES / 3;
    if ((frame->looks & LOOK_COLOURS) != 0)
        return colour_pixel(frame, hue, shade, near);
    shade =
        shade > SHADES / 3 ? fix_max(shade - contrast, 0) : fix_min(shade + contrast, SHADES - 1);
    return colour_grey(frame, shade, near);
}

/* A triangle's shore, where it reaches into the water: heights less than 2^16 from that have values
 * within 2^31. Or its contour lines.
 */
COPIED bool cut_by(const yb_frame_t *frame, const yb_point_t *const p[3], shade_t shade, bool shore,
                   raster_cut_t *cut)
{
    static const normal_t level = {0, 0, 1 << 12};
    lines_scale_t scale = {frame->contour_inverse, frame->contour_zero, frame->contour_shift};
    if (shore)
        scale = (lines_scale_t){SHORE_SCALE, 0 - (uint32_t)frame->view.water_q8 * SHORE_SCALE, 0};
    if (!lines_find(&frame->screen, p, scale, cut))
        return false;
    const int32_t near = nearest_of(p);
    int hue = HUE_LINE;
    int32_t light = (int32_t)(shade >> 16);
    cut->below = cut->above = shade_pixel(shade);
    if (shore) {
        hue = HUE_SHORE;
        light = SHADES - 1;
        const int32_t flat = shadowed(frame, p, light_on(frame, p[0], &level));
        cut->below = water_pixel(frame, flat, near);
    }
    cut->line = line_pixel(frame, hue, light, near);
    return true;
}

SELDOM bool cut_shore(const yb_frame_t *frame, const yb_point_t *const p[3], shade_t shade,
                      raster_cut_t *cut)
{
    return cut_by(frame, p, shade, true, cut);
}

bool shade_lines(const yb_frame_t *frame, const yb_point_t *const p[3], shade_t shade, bool shore,
                 raster_cut_t *cut)
{
    return COPIES && shore ? cut_shore(frame, p, shade, cut)
                           : cut_by(frame, p, shade, !COPIES && shore, cut);
}

bool shade_cut(const yb_frame_t *frame, const yb_point_t *const p[3], shade_t shade,
               raster_cut_t *cut)
{
    return shade_cut_here(frame, p, shade, cut);
}

uint16_t shade_wall(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    /* Outward: to the right of the edge. */
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    normal_t outward = to_13_bits(dy * 4096, -dx * 4096, 1); /* of 17 bits */
    int32_t shade = fix_max(light_on(frame, a, &outward) - WALL_DIM, DARKEST);
    int32_t near = fix_max(a->spot.near, b->spot.near);
    int32_t water = frame->view.water_q8;
    if (a->z_q8 <= water && b->z_q8 <= water)
        return water_pixel(frame, shade, near);
    return colour_pixel(frame, HUE_WALL, shade, near);
}
