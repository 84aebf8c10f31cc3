#include "mesh_check.h"

#include <stdlib.h>
#include <string.h>

#include "fnv.h"

enum {
    NONE = -1,
    MOST = 256
};

/* edge[a][b]: the triangle to the left of a → b. */
typedef struct {
    int left[MOST][MOST];
} edges_t;

static int64_t turn(const yb_vertex_t *a, const yb_vertex_t *b, const yb_vertex_t *c)
{
    return ((int64_t)b->x_q8 - a->x_q8) * ((int64_t)c->y_q8 - a->y_q8) -
           ((int64_t)b->y_q8 - a->y_q8) * ((int64_t)c->x_q8 - a->x_q8);
}

static bool along_frame(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b)
{
    return (a->x_q8 == 0 && b->x_q8 == 0) || (a->y_q8 == 0 && b->y_q8 == 0) ||
           (a->x_q8 == map->east_q8 && b->x_q8 == map->east_q8) ||
           (a->y_q8 == map->north_q8 && b->y_q8 == map->north_q8);
}

static const char *find_edges(const yb_map_t *map, edges_t *edges)
{
    memset(edges, 0xff, sizeof *edges);
    for (int t = 0; t < (int)map->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            int a = map->triangle[t][i];
            int b = map->triangle[t][(i + 1) % 3];
            if (a >= map->vertex_count || b >= map->vertex_count || a == b)
                return "a triangle without three vertices";
            if (edges->left[a][b] != NONE)
                return "two triangles on one side of an edge";
            edges->left[a][b] = t;
        }
    }
    return NULL;
}

/* --- Vertices --------------------------------------------------------------------------------- */

static int32_t height_of(const plan_t *plan, int coded)
{
    int64_t cell = (int64_t)(plan->cell & 0xfff) << (plan->cell >> 12);
    int64_t unit = (int64_t)(plan->unit & 0xfff) << (plan->unit >> 12);
    return (int32_t)((2 * 256 * coded * unit + cell) / (2 * cell));
}

const char *mesh_check_vertices(const yb_map_t *map, const plan_t *plan)
{
    int coded = plan_vertices(plan);
    if (map->vertex_count < coded)
        return "vertex count";
    if (map->east_q8 != plan->east * 256 || map->north_q8 != plan->north * 256)
        return "frame";
    for (int i = 0; i < plan->contours; i++) {
        const plan_contour_t *c = &plan->contour[i];
        for (int k = c->first; k < c->first + c->count; k++) {
            const yb_vertex_t *v = &map->vertex[k];
            if (v->x_q8 != plan->point[k].x * 256 || v->y_q8 != plan->point[k].y * 256 ||
                v->z_q8 != height_of(plan, c->height))
                return "a contour's point";
        }
    }
    for (int k = 0; k < 4; k++) {
        int found = 0;
        for (int i = 0; i < coded; i++) {
            const yb_vertex_t *v = &map->vertex[i];
            bool here = v->x_q8 == (k == 1 || k == 2 ? map->east_q8 : 0) &&
                        v->y_q8 == (k >= 2 ? map->north_q8 : 0);
            found += here;
            if (here && plan->corner_height[k] >= 0 &&
                v->z_q8 != height_of(plan, plan->corner_height[k]))
                return "height of a coded corner";
        }
        if (found != 1)
            return "a corner of the frame";
    }
    for (int i = coded; i < map->vertex_count; i++) {
        const yb_vertex_t *v = &map->vertex[i];
        if (v->x_q8 > map->east_q8 || v->y_q8 > map->north_q8)
            return "an added point outside the frame";
        for (int k = 0; k < i; k++) {
            if (map->vertex[k].x_q8 == v->x_q8 && map->vertex[k].y_q8 == v->y_q8)
                return "an added point at another's place";
        }
    }
    return NULL;
}

/* --- Tiling ----------------------------------------------------------------------------------- */

const char *mesh_check_tiling(const yb_map_t *map, const plan_t *plan)
{
    static edges_t edges;
    const char *wrong = find_edges(map, &edges);
    if (wrong != NULL)
        return wrong;
    int64_t area = 0;
    for (int t = 0; t < (int)map->triangle_count; t++) {
        const yb_index_t *v = map->triangle[t];
        int64_t twice = turn(&map->vertex[v[0]], &map->vertex[v[1]], &map->vertex[v[2]]);
        if (twice <= 0)
            return "a triangle that is not counter-clockwise";
        area += twice;
    }
    if (area != 2 * (int64_t)map->east_q8 * map->north_q8)
        return "areas do not add up to the frame";
    int count = 0;
    for (int a = 0; a < map->vertex_count; a++) {
        int used = 0;
        for (int b = 0; b < map->vertex_count; b++) {
            bool one = edges.left[a][b] != NONE;
            bool other = edges.left[b][a] != NONE;
            used += one || other;
            count += a < b && (one || other);
            if (one != other && !along_frame(map, &map->vertex[a], &map->vertex[b]))
                return "an inner edge with one triangle";
            if (one && other && along_frame(map, &map->vertex[a], &map->vertex[b]))
                return "a triangle outside the frame";
        }
        if (used < 2)
            return "an unused vertex";
    }
    if (map->vertex_count - count + (int)map->triangle_count != 1)
        return "Euler's count";
    for (int i = 0; i < plan->contours; i++) {
        for (int k = 0; k < plan_edges(plan, i); k++) {
            int a, b;
            plan_edge(plan, i, k, &a, &b);
            if (edges.left[a][b] == NONE || edges.left[b][a] == NONE)
                return "an edge of a contour is no edge of the mesh";
        }
    }
    return NULL;
}

/* --- Delaunay --------------------------------------------------------------------------------- */

static void find_fixed(const plan_t *plan, uint8_t fixed[MOST][MOST])
{
    memset(fixed, 0, (size_t)MOST * MOST);
    for (int i = 0; i < plan->contours; i++) {
        for (int k = 0; k < plan_edges(plan, i); k++) {
            int a, b;
            plan_edge(plan, i, k, &a, &b);
            fixed[a][b] = fixed[b][a] = 1;
        }
    }
}

/* > 0: d inside the circle of a, b, c; whole steps, so 2^9 · 2^9 · 2^18 at most. */
static int64_t circle(const yb_map_t *map, int a, int b, int c, int d)
{
    const int corner[3] = {a, b, c};
    int64_t m[3][3];
    for (int i = 0; i < 3; i++) {
        m[i][0] = (map->vertex[corner[i]].x_q8 - map->vertex[d].x_q8) / 64;
        m[i][1] = (map->vertex[corner[i]].y_q8 - map->vertex[d].y_q8) / 64;
        m[i][2] = m[i][0] * m[i][0] + m[i][1] * m[i][1];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static int apex(const yb_map_t *map, int t, int a, int b)
{
    for (int i = 0; i < 3; i++) {
        if (map->triangle[t][i] != a && map->triangle[t][i] != b)
            return map->triangle[t][i];
    }
    return NONE;
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

const char *mesh_check_delaunay(const yb_map_t *map, const yb_load_t *load, const plan_t *plan)
{
    static edges_t edges;
    static uint8_t fixed[MOST][MOST];
    const char *wrong = find_edges(map, &edges);
    if (wrong != NULL)
        return wrong;
    find_fixed(plan, fixed);
    for (int t = 0; t < 3 * (int)map->triangle_count && load != NULL; t++) {
        const yb_index_t *v = map->triangle[t / 3];
        if (yb_edge_rule(map, load, (yb_triangle_t)(t / 3), t % 3) != YB_RULE_NONE)
            fixed[v[t % 3]][v[(t % 3 + 1) % 3]] = fixed[v[(t % 3 + 1) % 3]][v[t % 3]] = 1;
    }
    for (int a = 0; a < map->vertex_count; a++) {
        for (int b = 0; b < a; b++) {
            if (edges.left[a][b] == NONE || edges.left[b][a] == NONE || fixed[a][b] != 0)
                continue;
            int c = apex(map, edges.left[a][b], a, b);
            int d = apex(map, edges.left[b][a], a, b);
            int64_t in = circle(map, a, b, c, d);
            if (in > 0)
                return "an edge that is not Delaunay";
            if (in == 0 && least(c, d) < least(a, b))
                return "the wrong diagonal of four points on a circle";
        }
    }
    return NULL;
}

/* --- Regions ---------------------------------------------------------------------------------- */

/* Is (x, y), in 1/3 of 1/256 step, inside the contour, an open one closed along the frame
 * counter-clockwise from its end to its start?
 */
static bool inside(const plan_t *plan, int contour, int64_t x, int64_t y)
{
    plan_point_t ring[PLAN_MAX_POINTS + 4];
    int count = 0;
    const plan_contour_t *c = &plan->contour[contour];
    for (int k = 0; k < c->count; k++)
        ring[count++] = plan->point[c->first + k];
    if (plan_open(plan, contour)) {
        const int e = plan->east;
        const int n = plan->north;
        const plan_point_t corner[4] = {{0, 0}, {e, 0}, {e, n}, {0, n}};
        const int way_of_corner[4] = {0, e, e + n, 2 * e + n};
        int way[2];
        for (int k = 0; k < 2; k++) {
            plan_point_t p = ring[k == 0 ? c->count - 1 : 0];
            way[k] = p.y == 0   ? p.x
                     : p.x == e ? e + p.y
                     : p.y == n ? e + n + e - p.x
                                : 2 * e + n + n - p.y;
        }
        int round = 2 * (e + n);
        int span = (way[1] - way[0] + round) % round;
        for (int k = 0; k < 8; k++) {
            int from_end = way_of_corner[k % 4] + (k >= 4 ? round : 0) - way[0];
            if (from_end > 0 && from_end < span)
                ring[count++] = corner[k % 4];
        }
    }
    bool in = false;
    for (int i = 0; i < count; i++) {
        int64_t ax = (int64_t)ring[i].x * 768 - x;
        int64_t ay = (int64_t)ring[i].y * 768 - y;
        int64_t bx = (int64_t)ring[(i + 1) % count].x * 768 - x;
        int64_t by = (int64_t)ring[(i + 1) % count].y * 768 - y;
        if ((ay > 0) == (by > 0))
            continue;
        int64_t side = ax * by - ay * bx;
        in ^= by > ay ? side > 0 : side < 0;
    }
    return in;
}

typedef struct {
    uint8_t in[PLAN_MAX_CONTOURS];
    int region;
} side_t;

/* Which contours the middle of triangle t lies in. */
static void find_side(const yb_map_t *map, const plan_t *plan, int t, side_t *side)
{
    int64_t x = 0;
    int64_t y = 0;
    for (int i = 0; i < 3; i++) {
        x += map->vertex[map->triangle[t][i]].x_q8;
        y += map->vertex[map->triangle[t][i]].y_q8;
    }
    for (int i = 0; i < plan->contours; i++)
        side->in[i] = plan->contour[i].count > 1 && inside(plan, i, x, y);
}

/* All regions hang together by contours: regions are one more than lines, so it is a tree. */
static bool connected(const yb_load_t *load, const plan_t *plan)
{
    bool reached[MOST] = {true};
    int count = 1;
    for (int pass = 0; pass < load->region_count; pass++) {
        for (int i = 0; i < plan->contours; i++) {
            int a = load->contour[i].left;
            int b = load->contour[i].right;
            if (reached[a] != reached[b]) {
                reached[a] = reached[b] = true;
                count++;
            }
        }
    }
    return count == load->region_count;
}

const char *mesh_check_regions(const yb_map_t *map, const yb_load_t *load, const plan_t *plan)
{
    static edges_t edges;
    static side_t side[2 * PLAN_MAX_CONTOURS];
    const char *wrong = find_edges(map, &edges);
    if (wrong != NULL)
        return wrong;
    int lines = 0;
    int sides = 0;
    for (int i = 0; i < plan->contours; i++) {
        const plan_contour_t *c = &plan->contour[i];
        const yb_contour_t *found = &load->contour[i];
        if (found->first != c->first || found->count != c->count ||
            yb_contour_is_open(map, found) != plan_open(plan, i))
            return "a contour's record";
        int t[2] = {NONE, NONE};
        if (c->count > 1) {
            lines++;
            t[0] = edges.left[c->first][c->first + 1];
            t[1] = edges.left[c->first + 1][c->first];
        } else {
            for (int b = 0; b < map->vertex_count; b++) {
                if (edges.left[c->first][b] != NONE)
                    t[0] = t[1] = edges.left[c->first][b];
            }
        }
        for (int k = 0; k < 2; k++) {
            if (t[k] == NONE)
                return "a contour without triangles at its side";
            find_side(map, plan, t[k], &side[sides]);
            side[sides++].region = k == 0 ? found->left : found->right;
        }
    }
    if (load->region_count != lines + 1 || load->contour_count != plan->contours)
        return "count of regions";
    for (int i = 0; i < sides; i++) {
        for (int j = 0; j < i; j++) {
            bool same = memcmp(side[i].in, side[j].in, (size_t)plan->contours) == 0;
            if (same != (side[i].region == side[j].region))
                return "a region";
        }
    }
    return connected(load, plan) ? NULL : "regions that are no tree";
}

const char *mesh_check(const yb_map_t *map, const yb_load_t *load, const plan_t *plan)
{
    const char *wrong = mesh_check_vertices(map, plan);
    if (wrong == NULL)
        wrong = mesh_check_tiling(map, plan);
    if (wrong == NULL)
        wrong = mesh_check_regions(map, load, plan);
    return wrong;
}

const char *mesh_check_bare(const yb_map_t *map, const yb_load_t *load, const plan_t *plan)
{
    const char *wrong = mesh_check(map, load, plan);
    if (wrong == NULL && map->vertex_count != plan_vertices(plan))
        wrong = "vertex count";
    return wrong == NULL ? mesh_check_delaunay(map, NULL, plan) : wrong;
}

/* --- Hash ------------------------------------------------------------------------------------- */

static int by_number(const void *a, const void *b)
{
    uint32_t p = *(const uint32_t *)a;
    uint32_t q = *(const uint32_t *)b;
    return p < q ? -1 : p > q;
}

uint64_t mesh_hash(const yb_map_t *map)
{
    uint32_t triangle[2 * MOST];
    for (int t = 0; t < (int)map->triangle_count; t++) {
        const yb_index_t *v = map->triangle[t];
        int first = v[0] < v[1] && v[0] < v[2] ? 0 : v[1] < v[2] ? 1 : 2;
        triangle[t] =
            (uint32_t)v[first] << 16 | (uint32_t)v[(first + 1) % 3] << 8 | v[(first + 2) % 3];
    }
    qsort(triangle, map->triangle_count, sizeof *triangle, by_number);
    uint64_t hash = fnv_number(FNV_START, map->vertex_count);
    for (int i = 0; i < map->vertex_count; i++) {
        const yb_vertex_t *v = &map->vertex[i];
        hash = fnv_number(fnv_number(hash, v->x_q8), v->y_q8);
        hash = fnv_number(hash, v->z_q8);
        hash = fnv_number(fnv_number(hash, v->gx_q11), v->gy_q11);
    }
    hash = fnv_number(hash, map->triangle_count);
    for (int t = 0; t < (int)map->triangle_count; t++)
        hash = fnv_number(hash, triangle[t]);
    for (int c = 0; c < YB_LENGTH_CLASSES; c++)
        hash = fnv_number(hash, map->noise[c]);
    return hash;
}
