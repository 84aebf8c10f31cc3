/* Canyons, spurs, curved contours: points along the middle of what would be flat (faithful paper,
 * 6.1 and 6.2).
 *
 * Where an edge of the mesh joins two points of one height and no contour runs along it, it bridges
 * a valley or cuts through a ridge. Its middle lies on the skeleton of the region, for the edges of
 * a Delaunay triangulation are chords of empty circles and the skeleton is where such circles have
 * their centres. So each of these edges is split at its middle, and the new points, from triangle
 * to triangle, are the skeleton. They are found by growing: from an edge with other ground on its
 * far side (the paper's canyon polygon: P there, Q and S its ends, M the middle of QS) into the
 * flat triangles behind it, which makes their other edges the next ones.
 *
 * Heights: from where a branch began it falls (or rises) evenly towards its dead end, the longest
 * way first, or, where two branches meet, to half way between the heights: a saddle.
 */
#include <string.h>

#include "mesh.h"

/* An edge that may be a bridge, and what its middle is reached from. */
typedef struct {
    half_t half;
    uint32_t key; /* its place in the order of edges */
    int parent, other;
} bridge_t;

/* Is it one to be split: of one height, and no contour or link? */
static bool is_bridge(const yb_load_t *load, const bridge_t *bridge)
{
    return (bridge->key & 0xffff) < load->first_skeleton && rise_of(load, bridge->half) == 0 &&
           !is_marked(load, bridge->half);
}

/* Splits a bridge; the height of its middle is that of the edge until heights are known. */
static bool split_bridge(yb_load_t *load, const bridge_t *bridge)
{
    yb_vertex_t middle;
    int m = load->vertex_count;
    yb_branch_t *branch = &load->branch[m];
    find_middle(load, bridge->half, &middle);
    if (!mesh_insert(load, bridge->half, &middle))
        return false;
    branch->parent = (yb_index_t)bridge->parent;
    branch->other = (yb_index_t)bridge->other;
    branch->end = (yb_index_t)m;
    branch->grown = 0;
    return true;
}

static bool meets(const yb_load_t *load, int m)
{
    return load->branch[m].other != m;
}

/* The first point of the branch that v belongs to. */
static int beginning_of(const yb_load_t *load, int v)
{
    while (load->branch[v].parent >= load->first_skeleton)
        v = load->branch[v].parent;
    return v;
}

/* How steep the ground rises, or, below 0, falls from a to b, in 1/256. Rises are within 2^18. */
static int32_t slope_to(const yb_load_t *load, int a, int b)
{
    return (height_at(load, b) - height_at(load, a)) * 256 / edge_length(load, a, b);
}

/* How steep the ground is from which the branch with the first point m comes, in 1/256: the
 * steepest edge that goes on beyond, or else that to m. Where branches from two peaks meet, ways
 * are as the slopes: s_a · way_a = s_b · way_b (6.2: the ratio of 5.1).
 */
static uint32_t steepness(const yb_load_t *load, int m)
{
    int p = load->branch[m].parent;
    bool falls = height_at(load, p) < height_at(load, m);
    int32_t steepest = 0;
    half_t e = first_spoke(load, p);
    for (int q = end_of(load, e); q >= 0; q = neighbour_after(load, &e)) {
        if (q < load->first_skeleton) {
            int32_t slope = slope_to(load, p, q);
            steepest = fix_max(steepest, falls ? -slope : slope);
        }
    }
    if (steepest == 0)
        steepest = fix_abs(slope_to(load, p, m));
    return (uint32_t)fix_clamp(steepest, 1, 1 << 14);
}

/* A way and one edge more, weighted, as far as 32 bits go. Weights are at most 2^14 and lengths
 * below 2^17: the edge adds less than 2^26.
 */
static uint32_t add_way(const yb_load_t *load, uint32_t way, uint32_t weight, int a, int b)
{
    uint32_t sum = way + weight * (uint32_t)(edge_length(load, a, b) >> 5);
    return sum < way ? UINT32_MAX : sum;
}

/* Finds what the middle of a bridge would be reached from: from its apex, and from across it;
 * `other` is the middle itself if that is flat ground, where the new point will grow on. A bridge
 * on the frame is met by its mirror image.
 *
 * Does a branch begin there, if that is the question? It does at a bridge that has a point of
 * another height on one side, which the middle is reached from, and on the other flat ground, or
 * another such point: then a bridge is all there is. But ground that goes on falling across the
 * bridge needs no point on it, and the frame's own corners, at one height, bridge nothing.
 */
static bool look_across(const yb_load_t *load, bridge_t *bridge, bool begins)
{
    int32_t h = height_at(load, origin_of(load, bridge->half));
    int p = apex_of(load, bridge->half);
    int q = p;
    half_t twin = twin_of(load, bridge->half);
    if (twin != NO_HALF)
        q = apex_of(load, twin);
    else if (begins && (bridge->key & 0xffff) >= load->point_count)
        return false;
    /* Points of this stage still have their edge's height. */
    int32_t up = height_at(load, p) - h;
    int32_t up_other = height_at(load, q) - h;
    bridge->parent = p;
    bridge->other = q;
    /* The lower number first; but flat ground last. */
    if (begins && (up == 0 || (q < p && up_other != 0))) {
        bridge->parent = q;
        bridge->other = p;
        int32_t up_q = up_other;
        up_other = up;
        up = up_q;
    }
    if (up_other == 0 && bridge->other < load->first_skeleton)
        bridge->other = load->vertex_count;
    return !begins || (up != 0 && (up_other == 0 || (up ^ up_other) >= 0));
}

/* The first bridge, in the order of edges, of the triangles at v: of those from v to higher numbers
 * at which a branch begins, or, if v is a point of a branch, of those that it looks at.
 */
static bool find_bridge(const yb_load_t *load, int v, bridge_t *next)
{
    bool begins = v < load->first_skeleton;
    *next = (bridge_t){.key = UINT32_MAX};
    for (half_t e = first_spoke(load, v); e != NO_HALF; e = spoke_after(load, e)) {
        bridge_t bridge = {.half = e};
        for (int k = 0; k < 3; k++) {
            bridge.half = last_of(bridge.half);
            bridge.key = edge_key(load, bridge.half);
            if (bridge.key < next->key && (!begins || bridge.key >> 16 == (uint32_t)v) &&
                is_bridge(load, &bridge) && look_across(load, &bridge, begins))
                *next = bridge;
        }
    }
    return next->key != UINT32_MAX;
}

/* Splits all bridges at v where branches begin, or, if v is a point of a branch, that it looks at.
 */
static bool split_bridges(yb_load_t *load, int v)
{
    bridge_t bridge;
    while (find_bridge(load, v, &bridge)) {
        int m = load->vertex_count;
        int parent = bridge.parent;
        if (!split_bridge(load, &bridge))
            return false;
        uint32_t weight = steepness(load, beginning_of(load, m));
        load->scratch->way[m] = add_way(load, load->scratch->way[parent], weight, parent, m);
    }
    return true;
}

/* First the beginnings, in the order of their bridges' ends. Then always the shortest way, so that
 * branches meet where the slopes from both sides would.
 */
static bool grow(yb_load_t *load)
{
    for (int v = 0; v < load->first_skeleton; v++) {
        if (!split_bridges(load, v))
            return false;
    }
    for (;;) {
        int next = -1;
        uint32_t least = 0;
        for (int v = load->first_skeleton; v < load->vertex_count; v++) {
            if (!load->branch[v].grown && (next < 0 || load->scratch->way[v] < least)) {
                next = v;
                least = load->scratch->way[v];
            }
        }
        if (next < 0)
            return true;
        if (!split_bridges(load, next))
            return false;
        load->branch[next].grown = 1;
    }
}

/* How far the contour is on from a point with no branch beyond it. */
static uint32_t way_to_contour(const yb_load_t *load, int v)
{
    int32_t way = 0;
    for (half_t e = first_spoke(load, v); e != NO_HALF; e = spoke_after(load, e)) {
        if (end_of(load, e) < load->first_skeleton && rise_of(load, e) == 0)
            way = fix_max(way, half_length(load, e));
    }
    return (uint32_t)way;
}

/* From the ends back to the beginnings: how far the farthest end beyond each point is, and whether
 * that is a meeting point. A point has a higher number than its parent.
 */
static void measure_ways(yb_load_t *load)
{
    memset(load->scratch->way, 0, sizeof load->scratch->way);
    for (int v = load->vertex_count - 1; v >= load->first_skeleton; v--) {
        const yb_branch_t *branch = &load->branch[v];
        if (load->scratch->way[v] == 0 && !meets(load, v))
            load->scratch->way[v] = way_to_contour(load, v);
        for (int k = 0; k < 2; k++) {
            int p = k == 0 ? branch->parent : branch->other;
            if (p == v || p < load->first_skeleton || meets(load, p))
                continue;
            uint32_t way = load->scratch->way[v] + (uint32_t)edge_length(load, p, v);
            if (way > load->scratch->way[p]) {
                load->scratch->way[p] = way;
                load->branch[p].end = (yb_index_t)(meets(load, v)     ? v
                                                   : branch->end == v ? p
                                                                      : branch->end);
            }
        }
    }
}

/* The way back from v over a point beside it to where the branch began, and the height there. */
static int32_t way_back(const yb_load_t *load, int v, int to, int32_t *way)
{
    *way = edge_length(load, v, to);
    while (to >= load->first_skeleton) {
        v = to;
        to = load->branch[v].parent;
        *way += edge_length(load, v, to);
    }
    return height_at(load, to);
}

/* Where two branches meet: a saddle half way up to the height of the sides if both began at one
 * height, else on the even slope from one beginning to the other. All other points: on the even
 * slope from the point before to the end. Strictly on the side of its edge's height that the branch
 * came from.
 */
static int32_t height_on(const yb_load_t *load, int v)
{
    const yb_branch_t *branch = &load->branch[v];
    int32_t h = height_at(load, v);
    int32_t from = height_at(load, branch->parent);
    int32_t to = height_at(load, branch->end); /* h, if that is v itself */
    int32_t way = edge_length(load, branch->parent, v);
    int32_t rest = (int32_t)load->scratch->way[v];
    if (meets(load, v)) {
        from = way_back(load, v, branch->parent, &way);
        to = way_back(load, v, branch->other, &rest);
    }
    bool saddle = meets(load, v) && from == to;
    int32_t z = saddle ? (from + h) / 2 : from + fix_scale(to - from, way, way + rest);
    bool begins = meets(load, v) || branch->parent < load->first_skeleton;
    int32_t least = begins ? fix_max(fix_abs(h - from) / 8, 1) : 1;
    return from > h ? fix_max(z, h + least) : fix_min(z, h - least);
}

bool skeleton_add(yb_load_t *load)
{
    load->first_skeleton = load->vertex_count;
    memset(load->scratch->way, 0, sizeof load->scratch->way);
    if (!grow(load))
        return false;
    measure_ways(load);
    /* Meeting points first: slopes end there. */
    for (int k = 0; k < 2; k++) {
        for (int v = load->first_skeleton; v < load->vertex_count; v++) {
            if (meets(load, v) == (k == 0))
                load->vertex[v].z_q8 = height_on(load, v);
        }
    }
    return true;
}
