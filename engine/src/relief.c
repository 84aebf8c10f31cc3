#include "relief.h"

#include <string.h>

#include "mesh.h"

enum {
    HASH_LOG2_Q11 = 14712, /* log2 of the standard deviation that remains, 145.37, in 1/2048 */
    LONGEST_CLASS = 48     /* 32 steps: longer edges move like these */
};

/* One in the units of fix_log2_q11. */
#define ONE_Q11 ((int32_t)2048)

/* The logarithm of nothing: what is added to it does not count. */
#define NOTHING_Q11 (-((int32_t)1 << 30))

/* --- The midpoint of an edge ------------------------------------------------------------------ */

int relief_square_class(uint32_t square)
{
    if (square < 2)
        return 0;
    int top = fix_log2_floor(square);
    return 2 * top + (int)(square >> (top - 1) & 1);
}

int relief_class(int32_t dx, int32_t dy)
{
    return relief_square_class(relief_half_square(dx, dy));
}

#if !COPIES
const yb_across_t *relief_across(const yb_map_t *map)
{
    return yb_map_across(map);
}

const yb_index_t *relief_triangle(const yb_map_t *map, yb_triangle_t triangle)
{
    return yb_map_triangle(map, triangle);
}
#endif

void relief_corners(const yb_map_t *map, yb_triangle_t triangle, const yb_vertex_t *corner[3])
{
    const yb_index_t *at = relief_triangle(map, triangle);
    for (int i = 0; i < 3; i++)
        corner[i] = &map->vertex[at[i]];
}

/* The differences of two vertices in plan, and relief_bulge of their edge. */
typedef struct {
    int32_t dx, dy, bulge;
} edge_t;

APART edge_t edge_of(const yb_vertex_t *a, const yb_vertex_t *b)
{
    int32_t dx = fix_minus(b->x_q8, a->x_q8);
    int32_t dy = fix_minus(b->y_q8, a->y_q8);
    return (edge_t){dx, dy, relief_bulge(a->gx_q11 - b->gx_q11, a->gy_q11 - b->gy_q11, dx, dy)};
}

#if !COPIES
int32_t relief_limit(int32_t noise, int32_t dx, int32_t dy, int32_t rise)
{
    return relief_limit_here(noise, dx, dy, rise);
}
#endif

void relief_middle(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b,
                   yb_vertex_t *middle)
{
    const edge_t edge = edge_of(a, b);
    const int32_t rise = b->z_q8 - a->z_q8;
    find_middle_of(a, b, middle);
    middle->z_q8 = (a->z_q8 + b->z_q8) >> 1;
    middle->gx_q11 = (int16_t)((a->gx_q11 + b->gx_q11) >> 1);
    middle->gy_q11 = (int16_t)((a->gy_q11 + b->gy_q11) >> 1);
    if (map->smooth)
        middle->z_q8 += edge.bulge;
    if (map->detail) {
        int32_t noise = relief_shake(map->noise[relief_class(edge.dx, edge.dy)],
                                     relief_place(middle), relief_salt(map->seed));
        middle->z_q8 += relief_limit(noise, edge.dx, edge.dy, rise);
    }
}

void relief_bound(const yb_vertex_t *const corner[3], relief_bound_t *bound)
{
    int32_t rise = 0;
    bound->longest = 0;
    const yb_vertex_t *q = corner[0];
    for (int i = 2; i >= 0; i--) {
        const yb_vertex_t *p = corner[i];
        const edge_t edge = edge_of(p, q);
        bound->longest = (int)fix_max(bound->longest, relief_class(edge.dx, edge.dy));
        rise = fix_max(rise, fix_abs(edge.bulge));
        q = p;
    }
    /* The parabola through the midpoints bulges at most 4/3 of the largest rise; rounding of 16
     * levels adds at most as many units. */
    bound->bulge_q8 = rise + (rise >> 1) + 16;
}

/* --- The constants of the map ----------------------------------------------------------------- */

/* The slope -sum / sum_z, with 11 bits, cut: sums count heights in 1/256 step and plan differences
 * in 1/64 step, 2 bits; 9 more make 2^58 in all. Counted from the steepest one downwards, so that
 * the division rounds down, like everything. 0 where it is flat all round.
 */
APART int32_t slope_q11(int64_t sum, uint32_t sum_z)
{
    const int32_t most = YB_MAX_SLOPE_Q11;
    int64_t above = ((int64_t)sum_z * 16 - sum) * 512;
    if (sum_z == 0)
        return 0;
    return above < 0 ? -most
                     : (int32_t)fix_share((uint64_t)above, sum_z, 2 * YB_MAX_SLOPE_Q11) - most;
}

/* Slope of the smooth surface at v: the area-weighted mean over the triangles that meet there, flat
 * ones left out. The upward normals n of triangles twice their area long are just summed: the slope
 * is -(sum of n_x) / (sum of n_z). Plan differences are within 2^14 1/64 steps and heights
 * within 2^17: a product is within 2^31, a normal 2^32, and a star of 2^17 triangles 2^49; n_z,
 * twice the area, within that of the frame: 2^29.
 */
static void find_slope(const yb_load_t *load, int v, int32_t slope[2])
{
    int64_t sum[3] = {0, 0, 0};
    for (half_t e = first_spoke(load, v); e != NO_HALF; e = spoke_after(load, e)) {
        int32_t right[3];
        int32_t left[3];
        find_way(load, v, end_of(load, e), right);
        find_way(load, v, apex_of(load, e), left);
        int j = 1;
        int k = 2;
        for (int i = 0; i < 3 && (right[2] | left[2]) != 0; i++) {
            sum[i] = fix_add(fix_add(sum[i], right[j], left[k]), -right[k], left[j]);
            j = k;
            k = i;
        }
    }
    for (int i = 0; i < 2; i++)
        slope[i] = slope_q11(sum[i], (uint32_t)sum[2]);
}

/* Keeps the parabolas on the edges at v from overshooting: none may begin more than half as steep
 * again as its chord, in the chord's direction (one up to twice as steep would still be monotone).
 * Slopes are at most 2^13 and plan differences below 2^14 1/64 steps: s is within 2^28, in 1/512
 * height units; rises are within 2^18, so 1.5 · 512 times that is below 2^28.
 */
static void limit_slope(const yb_load_t *load, int v, int32_t slope[2])
{
    int32_t share_q15 = 32768;
    half_t e = first_spoke(load, v);
    for (int q = end_of(load, e); q >= 0; q = neighbour_after(load, &e)) {
        int32_t way[3];
        find_way(load, v, q, way);
        int32_t s = slope[0] * way[0] + slope[1] * way[1];
        int32_t most = way[2] * 768;
        if (most < 0) {
            s = -s;
            most = -most;
        }
        if (most > 0 && s > most)
            share_q15 = fix_min(share_q15, fix_scale(most, 32768, s));
    }
    for (int i = 0; i < 2; i++)
        slope[i] = (slope[i] * share_q15) >> 15;
}

/* log2 of the mean over all edges of rise^2 / L^2H, in 1/2048 and q8 heights, or NOTHING_Q11 if
 * no edge rises. Each term is 2^(2 log2 rise - H log2 L^2): at most 2^34, as rise is below 2^18,
 * and kept with 8 more bits where it is small enough; 1020 terms.
 */
static int32_t log2_roughness(const yb_load_t *load, int32_t hurst_q8)
{
    uint64_t sum = 0;
    uint32_t edges = 0;
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        if ((entry_of(load, e) & NO_TRIANGLE) < triangle_of(e))
            continue; /* each edge once; those of the frame too */
        edges++;
        /* In steps, of which a square has 2^12 square 1/64 steps. */
        int32_t way[3];
        find_way(load, origin_of(load, e), end_of(load, e), way);
        uint32_t rise = (uint32_t)fix_abs(way[2]);
        if (rise == 0)
            continue;
        int32_t square = fix_log2_q11((uint32_t)(way[0] * way[0] + way[1] * way[1])) - 12 * ONE_Q11;
        int32_t term = 2 * fix_log2_q11(rise) - ((hurst_q8 * square) >> 8);
        sum += term < 24 * ONE_Q11 ? fix_exp2_q11(term + 8 * ONE_Q11)
                                   : (uint64_t)fix_exp2_q11(term) << 8;
    }
    if (sum < edges)
        return NOTHING_Q11;
    return fix_log2_q11(sum / edges) - 8 * ONE_Q11;
}

/* Amplitude by SPEC 3.3: log2 of the standard deviation, in q8 height, of the displacement of an
 * edge one step long.
 */
static int32_t log2_amplitude(const yb_load_t *load, int32_t hurst_q8)
{
    /* A midpoint of fractional Brownian motion strays by L^H 2^-H sqrt(1 - 2^(2H-2)). */
    uint32_t rest = 65536 - fix_exp2_q11((2 * hurst_q8 - 512) * 8 + 16 * ONE_Q11);
    if (rest == 0 || load->gain == 0)
        return NOTHING_Q11;
    int32_t variance =
        log2_roughness(load, hurst_q8) + fix_log2_q11(rest) - 16 * ONE_Q11 - hurst_q8 * 16;
    return (variance >> 1) + fix_log2_q11(load->gain) - 5 * ONE_Q11;
}

/* How far noise may move the midpoint of an edge of class c: by its largest hash, and by gravity
 * not beyond the length of the longest edge of the class. Its squared half length is below 1.061 ·
 * 2^((c + 1) / 2), so fix_length is below 2 · 1.03 · 1.068 · 2^((c + 1) / 4).
 */
static uint32_t most_move(uint32_t scale, int c)
{
    uint32_t length = (fix_exp2_q11((int32_t)(c + 1) * 512) + 1) * 9 / 4;
    uint32_t move = (scale * RELIEF_HASH_MOST >> RELIEF_NOISE_SHIFT) + 1;
    return move < length ? move : length;
}

/* The table of noise scales per length class, and from it how far a point can be moved in all. The
 * children of a triangle have no edge longer than half its longest after at most two splits that
 * move a point, each by the noise of the longest class or less: twice that, and on with the class
 * of half the length, four classes down.
 */
static void fill_tables(yb_map_t *map, int32_t amplitude, int32_t hurst_q8)
{
    for (int c = 0; c < YB_LENGTH_CLASSES; c++) {
        /* The class stands for the geometric middle of its lengths: log2 (L/2)^2 = c/2 + 1/4. */
        int32_t length = (fix_min(c, LONGEST_CLASS) * 1024 + 512 - 14 * ONE_Q11) >> 1;
        uint32_t scale = fix_exp2_q11(amplitude + ((hurst_q8 * length) >> 8) +
                                      RELIEF_NOISE_SHIFT * ONE_Q11 - HASH_LOG2_Q11);
        map->noise[c] = (uint16_t)(scale > 65535 ? 65535 : scale);
        uint32_t move = most_move(map->noise[c], c);
        uint32_t reach = scale == 0 ? 0 : 2 * move + (c >= 4 ? map->reach_q8[c - 4] : 0u);
        map->reach_q8[c] = (uint16_t)(reach > 65535 ? 65535 : reach);
    }
}

/* How far refinement moves any point, at most: here, once, because every frame asks. */
static int32_t most_stray(const yb_map_t *map)
{
    int32_t farthest = 0;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        const yb_vertex_t *corner[3];
        relief_bound_t bound;
        relief_corners(map, t, corner);
        relief_bound(corner, &bound);
        farthest = fix_max(farthest, relief_reach(map, &bound, 0));
    }
    return farthest;
}

void relief_prepare(const yb_load_t *load)
{
    yb_map_t *map = load->map;
    int32_t low = INT32_MAX;
    int32_t high = INT32_MIN;
    for (int i = 0; i < map->vertex_count; i++) {
        yb_vertex_t *v = &load->vertex[i];
        int32_t slope[2];
        low = fix_min(low, v->z_q8);
        high = fix_max(high, v->z_q8);
        find_slope(load, i, slope);
        limit_slope(load, i, slope);
        v->gx_q11 = (int16_t)slope[0];
        v->gy_q11 = (int16_t)slope[1];
    }
    map->low_q8 = low;
    map->high_q8 = high;
    int32_t hurst_q8 = map->hurst_q8m1 + 1;
    fill_tables(map, log2_amplitude(load, hurst_q8), hurst_q8);
    map->stray_q8 = most_stray(map);
}
