/* The surface between the vertices, as a function of the edge alone (SPEC 3).
 *
 * Whether an edge can be split, where its midpoint lies and how high: all of it follows from the
 * edge's two ends and the map's constants, and is bit-equal for (a, b) and (b, a). So two triangles
 * that share an edge always agree, and neither asks for the other.
 */
#ifndef YB_RELIEF_H
#define YB_RELIEF_H

#include <yamabiko/yamabiko.h>

#include "fix.h"

/* The square of an edge's half length: below 2^31, with |dx|, |dy| below 2^16. */
static inline uint32_t relief_half_square(int32_t dx, int32_t dy)
{
    dx = fix_abs(dx) >> 1;
    dy = fix_abs(dy) >> 1;
    return (uint32_t)(dx * dx) + (uint32_t)(dy * dy);
}

/* The length class of an edge by that: two to an octave, at most 61. */
int relief_square_class(uint32_t square);

int relief_class(int32_t dx, int32_t dy);

/* Is the midpoint of an edge of these differences on the 1/256 lattice? */
static inline bool relief_splits(int32_t dx, int32_t dy)
{
    return ((dx | dy) & 1) == 0;
}

/* A plan position as one number, and the differences of two: |dx|, |dy| < 2^16. */
static inline uint32_t relief_place(const yb_vertex_t *v)
{
    return v->x_q8 | (uint32_t)v->y_q8 << 16;
}

static inline int32_t relief_dx(uint32_t a, uint32_t b)
{
    return (int32_t)(b & 0xffff) - (int32_t)(a & 0xffff);
}

static inline int32_t relief_dy(uint32_t a, uint32_t b)
{
    return (int32_t)(b >> 16) - (int32_t)(a >> 16);
}

/* A place less another, or a slope less another, as one number: the difference of their lower
 * halves and 2^16 that of the upper ones. Where both differences have 16 bits these are they.
 */
static inline int32_t relief_way_x(uint32_t way)
{
    return (int16_t)way;
}

static inline int32_t relief_way_y(uint32_t way)
{
    return (int32_t)(way - (uint32_t)relief_way_x(way)) >> 16;
}

/* The place of the midpoint of an edge that can be split: both differences are even. */
static inline uint32_t relief_half_way(uint32_t a, uint32_t b)
{
    return (a & b) + ((a ^ b) >> 1);
}

/* Noise of a place: the sum of the four bytes of a hash of where it is, less its mean. Nearly
 * Gaussian; its tails are cut, because bounds on what refinement can do are what makes bands cheap.
 */
enum {
    RELIEF_HASH_MEAN = 510, /* of the sum of four bytes */
    RELIEF_HASH_MOST = 320, /* the sum less its mean is cut to ± this, one time in 38 */
    RELIEF_NOISE_SHIFT = 9
};

/* What a map's seed adds to its places. */
static inline uint32_t relief_salt(uint8_t seed)
{
    return (seed + (uint32_t)1) * 0x9e3779b9u;
}

static inline int32_t relief_noise(uint32_t place, uint32_t salt)
{
    uint32_t h = place + salt;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    h ^= h >> 16;
    h = (h & 0xff00ff) + (h >> 8 & 0xff00ff); /* two sums of two bytes */
    int32_t noise = (int32_t)((h & 0xffff) + (h >> 16)) - RELIEF_HASH_MEAN;
    if ((uint32_t)(noise + RELIEF_HASH_MOST) > 2 * RELIEF_HASH_MOST)
        noise = noise < 0 ? -RELIEF_HASH_MOST : RELIEF_HASH_MOST;
    return noise;
}

/* The smooth part: half way between the ends, on the parabola that has their slopes, which differ
 * by (bend_x, bend_y), a's less b's. |slope| is at most 2^13 and |d| below 2^16 - 2^8, so each
 * product is at most 2^14 * 65280 < 2^30, and their sum with the rounding stays below 2^31.
 */
static inline int32_t relief_bulge(int32_t bend_x, int32_t bend_y, int32_t dx, int32_t dy)
{
    return (bend_x * dx + bend_y * dy + (1 << 13)) >> 14; /* slope 11 bits, and an eighth */
}

/* The same by the way from an end to the midpoint: dx and dy are even. */
static inline int32_t relief_half_bulge(int32_t bend_x, int32_t bend_y, int32_t half_x,
                                        int32_t half_y)
{
    return (bend_x * half_x + bend_y * half_y + (1 << 12)) >> 13;
}

/* Gravity (paper, 3.3): no half edge may become steeper than 2 by its noise; a chord that already
 * is gets none. Half edges are L/2 long and rise by half the chord's rise, plus or minus the noise.
 */
static inline int32_t relief_limit_here(int32_t noise, int32_t dx, int32_t dy, int32_t rise)
{
    int32_t limit = fix_max(fix_length(dx, dy) - (fix_abs(rise) >> 1), 0);
    return fix_clamp(noise, -limit, limit);
}

/* The same; a call where size counts more than speed, for noise is within its limit nearly always.
 */
#if COPIES
#define relief_limit relief_limit_here
#else
int32_t relief_limit(int32_t noise, int32_t dx, int32_t dy, int32_t rise);
#endif

/* The noise at a midpoint of an edge of a class: scale < 2^16, noise within 2^9, so the product is
 * within 2^25.
 */
static inline int32_t relief_shake(int32_t scale, uint32_t middle, uint32_t salt)
{
    int32_t noise = scale * relief_noise(middle, salt);
    return (noise + (1 << (RELIEF_NOISE_SHIFT - 1))) >> RELIEF_NOISE_SHIFT;
}

/* Is noise within its limit whatever the edge, of those of a class? Nearly always: none is shorter
 * than twice the root of its squared half length, which is at least 2^(class / 2), and fix_length
 * is at most 2.8 % and 1 below that: at least 31/16 2^(class / 4) - 1.
 */
static inline bool relief_keeps(int32_t noise, int class, int32_t rise)
{
    return fix_abs(noise) + (fix_abs(rise) >> 1) <= ((int32_t)31 << (class >> 2) >> 4) - 1;
}

/* And is all noise of this scale? At most that it is, as RELIEF_HASH_MOST is below
 * 2^RELIEF_NOISE_SHIFT; fix_size(rise) is |rise| or one less, and its half at most one less.
 */
static inline bool relief_keeps_all(int32_t scale, int class, int32_t rise)
{
    return (scale + (int32_t)(fix_size(rise) >> 1)) << 4 <= ((int32_t)31 << (class >> 2)) - 32;
}

/* yb_map_across and yb_map_triangle, which are long: in line only where speed counts more than
 * size.
 */
#if COPIES
static inline const yb_across_t *relief_across(const yb_map_t *map)
{
    return yb_map_across(map);
}

static inline const yb_index_t *relief_triangle(const yb_map_t *map, yb_triangle_t triangle)
{
    return yb_map_triangle(map, triangle);
}
#else
const yb_across_t *relief_across(const yb_map_t *map);
const yb_index_t *relief_triangle(const yb_map_t *map, yb_triangle_t triangle);
#endif

/* The corners of a triangle. */
void relief_corners(const yb_map_t *map, yb_triangle_t triangle, const yb_vertex_t *corner[3]);

/* The midpoint of the edge ab, which relief_splits. */
void relief_middle(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b,
                   yb_vertex_t *middle);

/* What bounds the refinement of a triangle: its smooth part, and the class of its longest edge. */
typedef struct {
    int32_t bulge_q8;
    int longest;
} relief_bound_t;

void relief_bound(const yb_vertex_t *const corner[3], relief_bound_t *bound);

/* What gravity leaves: see below. */
#define RELIEF_MOST_REACH_Q8 400000

/* How far refinement can move any point of the triangle from its plane, at most, if no edge of a
 * class below `shortest` is split.
 */
static inline int32_t relief_reach(const yb_map_t *map, const relief_bound_t *bound, int shortest)
{
    if (!map->detail || bound->longest < shortest)
        return bound->bulge_q8;
    /* A reach too large for its table is one that gravity limits: the noise of an edge is at most
     * its length L, below 98700 with fix_length's excess, and twice that at each level makes 4 L.
     */
    int32_t reach = map->reach_q8[bound->longest];
    if (reach == UINT16_MAX)
        return bound->bulge_q8 + RELIEF_MOST_REACH_Q8;
    if (shortest <= 0) /* all count */
        return bound->bulge_q8 + reach;
    /* Classes of the halved edges go down by four; those below the shortest do not count. */
    int uncounted = bound->longest - ((bound->longest - shortest) / 4 + 1) * 4;
    if (uncounted >= 0)
        reach -= map->reach_q8[uncounted];
    return bound->bulge_q8 + reach;
}

#endif
