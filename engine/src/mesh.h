/* What the stages of loading share: the mesh while it is being built.
 *
 *     code ─► border_close ─► mesh_triangulate ─► regions_find ─► relief_prepare
 *
 * A triangle is three vertices, counter-clockwise; its edge i runs from corner i to corner i + 1,
 * and neighbour[t][i] is the triangle across it. An edge of a contour is *fixed*: it is marked in
 * both neighbour entries and never flipped.
 */
#ifndef YB_MESH_H
#define YB_MESH_H

#include <yamabiko/yamabiko.h>

enum {
    UNKNOWN_HEIGHT = INT32_MIN,
    NO_TRIANGLE = 0x7fff, /* across the frame */
    FIXED = 0x8000        /* bit of a neighbour entry: a contour runs along this edge */
};

static inline int next3(int i)
{
    return i == 2 ? 0 : i + 1;
}

static inline int prev3(int i)
{
    return i == 0 ? 2 : i - 1;
}

static inline uint16_t neighbour_of(const yb_load_t *load, uint16_t t, int edge)
{
    return load->neighbour[t][edge] & NO_TRIANGLE;
}

/* Which corner of triangle t vertex v is; v is one of them. */
static inline int corner_of(const yb_map_t *map, uint16_t t, yb_index_t v)
{
    return map->triangle[t][0] == v ? 0 : map->triangle[t][1] == v ? 1 : 2;
}

static inline bool on_frame(const yb_map_t *map, const yb_vertex_t *v)
{
    return v->x_q8 == 0 || v->y_q8 == 0 || v->x_q8 == map->east_q8 || v->y_q8 == map->north_q8;
}

/* Twice the area of abc in square quarter steps, positive when counter-clockwise. Coordinates are
 * multiples of 64 below 2^16, so differences are within ±2^10 and the result within ±2^21.
 */
static inline int32_t orientation(const yb_map_t *map, yb_index_t a, yb_index_t b, yb_index_t c)
{
    const yb_vertex_t *v = map->vertex;
    int32_t abx = (v[b].x_q8 >> 6) - (v[a].x_q8 >> 6);
    int32_t aby = (v[b].y_q8 >> 6) - (v[a].y_q8 >> 6);
    int32_t acx = (v[c].x_q8 >> 6) - (v[a].x_q8 >> 6);
    int32_t acy = (v[c].y_q8 >> 6) - (v[a].y_q8 >> 6);
    return abx * acy - aby * acx;
}

/* Checks the contours against the frame, tells open from closed ones, adds the corners that no
 * line ends at, and gives every corner its height (SPEC 1.4, 2.1).
 */
YB_MUST_CHECK yb_status_t border_close(yb_map_t *map, yb_load_t *load);

/* The constrained Delaunay triangulation of all vertices and contour edges (SPEC 2.2); corrupt if
 * contours cross or touch.
 */
YB_MUST_CHECK yb_status_t mesh_triangulate(yb_map_t *map, yb_load_t *load);

/* The regions between the contours, and on which sides of each contour they lie (SPEC 2.3). */
YB_MUST_CHECK yb_status_t regions_find(const yb_map_t *map, yb_load_t *load);

/* Slopes, amplitude, and the tables of noise and reach (SPEC 3). */
void relief_prepare(yb_map_t *map, const yb_load_t *load);

/* The triangle after t (before t) in counter-clockwise order round vertex v, or NO_TRIANGLE. */
static inline uint16_t turn_left(const yb_map_t *map, const yb_load_t *load, uint16_t t,
                                 yb_index_t v)
{
    return neighbour_of(load, t, prev3(corner_of(map, t, v)));
}

static inline uint16_t turn_right(const yb_map_t *map, const yb_load_t *load, uint16_t t,
                                  yb_index_t v)
{
    return neighbour_of(load, t, corner_of(map, t, v));
}

/* The rightmost triangle at v: the first one counter-clockwise if v is on the frame, any if not. */
static inline uint16_t first_at(const yb_map_t *map, const yb_load_t *load, yb_index_t v)
{
    uint16_t start = load->star[v];
    for (uint16_t t = start;;) {
        uint16_t before = turn_right(map, load, t, v);
        if (before == NO_TRIANGLE || before == start)
            return t;
        t = before;
    }
}

#endif
