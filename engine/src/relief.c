#include "relief.h"

#include <string.h>

#include "mesh.h"

enum {
    HASH_LOG2_Q11 = 14712, /* log2 of the standard deviation that remains, 145.37, in 1/2048 */
    LONGEST_CLASS = 48     /* 32 steps: longer edges move like these */
};

/* What gravity leaves: see relief_reach. */
#define MOST_REACH_Q8 400000

/* One in the units of fix_log2_q11. */
#define ONE_Q11 ((int32_t)2048)

/* The logarithm of nothing: what is added to it does not count. */
#define NOTHING_Q11 (-((int32_t)1 << 30))

/* --- The midpoint of an edge ------------------------------------------------------------------ */

static int32_t smooth_rise(const yb_vertex_t *a, const yb_vertex_t *b)
{
    return relief_bulge(a->gx_q11 - b->gx_q11, a->gy_q11 - b->gy_q11, fix_minus(b->x_q8, a->x_q8),
                        fix_minus(b->y_q8, a->y_q8));
}

void relief_middle(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b,
                   yb_vertex_t *middle)
{
    int32_t dx = fix_minus(b->x_q8, a->x_q8);
    int32_t dy = fix_minus(b->y_q8, a->y_q8);
    middle->x_q8 = fix_middle(a->x_q8, b->x_q8);
    middle->y_q8 = fix_middle(a->y_q8, b->y_q8);
    int32_t z = (a->z_q8 + b->z_q8) >> 1;
    if (map->smooth)
        z += smooth_rise(a, b);
    middle->z_q8 = z + relief_rough(map, relief_place(middle), relief_class(dx, dy), dx, dy,
                                    b->z_q8 - a->z_q8);
    middle->gx_q11 = (int16_t)((a->gx_q11 + b->gx_q11) >> 1);
    middle->gy_q11 = (int16_t)((a->gy_q11 + b->gy_q11) >> 1);
}

void relief_bound(const yb_vertex_t *a, const yb_vertex_t *b, const yb_vertex_t *c,
                  relief_bound_t *bound)
{
    const yb_vertex_t *corner[4] = {a, b, c, a};
    int32_t rise = 0;
    bound->longest = 0;
    for (int i = 0; i < 3; i++) {
        const yb_vertex_t *p = corner[i];
        const yb_vertex_t *q = corner[i + 1];
        int class = relief_class(fix_minus(q->x_q8, p->x_q8), fix_minus(q->y_q8, p->y_q8));
        bound->longest = (int)fix_max(bound->longest, class);
        rise = fix_max(rise, fix_abs(smooth_rise(p, q)));
    }
    /* The parabola through the midpoints bulges at most 4/3 of the largest rise; rounding of 16
     * levels adds at most as many units. */
    bound->bulge_q8 = rise + (rise >> 1) + 16;
}

int32_t relief_reach(const yb_map_t *map, const relief_bound_t *bound, int shortest)
{
    if (!map->detail || bound->longest < shortest)
        return bound->bulge_q8;
    /* A reach too large for its table is one that gravity limits: the noise of an edge is at most
     * its length L, below 98700 with fix_length's excess, and twice that at each level makes 4 L.
     */
    if (map->reach_q8[bound->longest] == UINT16_MAX)
        return bound->bulge_q8 + MOST_REACH_Q8;
    /* Classes of the halved edges go down by four; those below the shortest do not count. */
    int uncounted = bound->longest - ((bound->longest - shortest) / 4 + 1) * 4;
    return bound->bulge_q8 + map->reach_q8[bound->longest] -
           (uncounted >= 0 ? map->reach_q8[uncounted] : 0);
}

/* --- The constants of the map ----------------------------------------------------------------- */

/* The slope -sum / sum_z, with 11 bits, cut: sums count heights in 1/256 step and plan differences
 * in 1/64 step, 2 bits; 9 more make 2^58 in all, and the steepest slope less than 2^62. Counted
 * from the steepest one downwards, so that the division rounds down, like everything.
 */
static int16_t slope_q11(int64_t sum, int64_t sum_z)
{
    const int32_t most = YB_MAX_SLOPE_Q11;
    int64_t above = most * sum_z - sum * 512;
    int64_t slope = above < 0 ? 0 : above / sum_z;
    return (int16_t)((slope > 2 * most ? 2 * most : (int32_t)slope) - most);
}

/* Slope of the smooth surface at v: the area-weighted mean over the triangles that meet there, flat
 * ones left out. The upward normals n of triangles twice their area long are just summed: the slope
 * is -(sum of n_x) / (sum of n_z). Plan differences are within 2^14 1/64 steps and heights
 * within 2^17: a product is within 2^31, a normal 2^32, and a star of 2^17 triangles 2^49.
 */
static void find_slope(const yb_load_t *load, int v)
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
            sum[i] += (int64_t)right[j] * left[k] - (int64_t)right[k] * left[j];
            j = k;
            k = i;
        }
    }
    yb_vertex_t *a = &load->map->vertex[v];
    bool level = sum[2] == 0; /* flat all round */
    a->gx_q11 = level ? 0 : slope_q11(sum[0], sum[2]);
    a->gy_q11 = level ? 0 : slope_q11(sum[1], sum[2]);
}

/* Keeps the parabolas on the edges at v from overshooting: none may begin more than half as steep
 * again as its chord, in the chord's direction (one up to twice as steep would still be monotone).
 * Slopes are at most 2^13 and plan differences below 2^16: s is within 2^30, in 1/2048 height
 * units; rises are within 2^18, so 1.5 · 2048 times that is below 2^30.
 */
static void limit_slope(const yb_load_t *load, int v)
{
    yb_vertex_t *a = &load->map->vertex[v];
    int32_t share_q15 = 32768;
    half_t next = first_spoke(load, v);
    while (next != NO_HALF) { /* from neighbour to neighbour: the last triangle may have two */
        half_t e = next;
        next = spoke_after(load, e);
        for (int i = next == NO_HALF ? 0 : 1; i < 2; i++) {
            const yb_vertex_t *b = vertex_of(load, i == 0 ? apex_of(load, e) : end_of(load, e));
            int32_t s =
                a->gx_q11 * fix_minus(b->x_q8, a->x_q8) + a->gy_q11 * fix_minus(b->y_q8, a->y_q8);
            int32_t most = (b->z_q8 - a->z_q8) * 3072;
            if ((s > 0) == (most > 0) && most != 0 && fix_abs(s) > fix_abs(most))
                share_q15 = fix_min(share_q15, fix_scale(most, 32768, s));
        }
    }
    a->gx_q11 = (int16_t)((a->gx_q11 * share_q15) >> 15);
    a->gy_q11 = (int16_t)((a->gy_q11 * share_q15) >> 15);
}

/* log2, in 1/2048, of the square of an edge's length in steps; from its squared half length in
 * 1/256 steps: 4 / 2^16.
 */
static int32_t log2_square_q11(uint32_t half_square)
{
    return fix_log2_q11(half_square) - 14 * ONE_Q11;
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
        const yb_vertex_t *a = vertex_of(load, origin_of(load, e));
        const yb_vertex_t *b = vertex_of(load, end_of(load, e));
        uint32_t rise = (uint32_t)fix_abs(b->z_q8 - a->z_q8);
        if (rise == 0)
            continue;
        int32_t square = log2_square_q11(
            relief_half_square(fix_minus(b->x_q8, a->x_q8), fix_minus(b->y_q8, a->y_q8)));
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
        const yb_index_t *corner = map->triangle[t];
        relief_bound_t bound;
        relief_bound(&map->vertex[corner[0]], &map->vertex[corner[1]], &map->vertex[corner[2]],
                     &bound);
        farthest = fix_max(farthest, relief_reach(map, &bound, 0));
    }
    return farthest;
}

void relief_prepare(const yb_load_t *load)
{
    yb_map_t *map = load->map;
    map->low_q8 = map->high_q8 = map->vertex[0].z_q8;
    for (int i = 0; i < map->vertex_count; i++) {
        map->low_q8 = fix_min(map->low_q8, map->vertex[i].z_q8);
        map->high_q8 = fix_max(map->high_q8, map->vertex[i].z_q8);
        find_slope(load, i);
        limit_slope(load, i);
    }
    int32_t hurst_q8 = map->hurst_q8m1 + 1;
    fill_tables(map, log2_amplitude(load, hurst_q8), hurst_q8);
    map->stray_q8 = most_stray(map);
}
