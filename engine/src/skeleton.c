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
#include "mesh.h"

/* Is an edge one to be split: of one height, and no contour or link? */
static bool is_bridge(const yb_load_t *load, half_t e)
{
    int a = origin_of(load, e);
    int b = end_of(load, e);
    return !is_marked(load, e) && a < load->first_skeleton && b < load->first_skeleton &&
           height_at(load, a) == height_at(load, b);
}

/* A bridge, and what its middle is reached from. */
typedef struct {
    half_t half;
    uint32_t key; /* its place in the order of edges */
    int parent, other;
} bridge_t;

/* Splits a bridge; the height of its middle is that of the edge until heights are known. */
static yb_status_t split_bridge(yb_load_t *load, const bridge_t *bridge)
{
    const yb_vertex_t *a = vertex_of(load, origin_of(load, bridge->half));
    const yb_vertex_t *b = vertex_of(load, end_of(load, bridge->half));
    yb_index_t m = (yb_index_t)load->map->vertex_count;
    if (mesh_add_vertex(load, fix_middle(a->x_q8, b->x_q8), fix_middle(a->y_q8, b->y_q8),
                        a->z_q8) != YB_OK)
        return YB_ERR_LIMIT;
    load->branch[m] = (yb_branch_t){
        .parent = (yb_index_t)bridge->parent, .other = (yb_index_t)bridge->other, .end = m};
    mesh_split(load, bridge->half, true, m);
    return YB_OK;
}

static bool meets(const yb_load_t *load, int m)
{
    return load->branch[m].other != m;
}

/* The first point of the branch that v belongs to, and how far that is from v. */
static int beginning_of(const yb_load_t *load, int v,
                               int32_t *length)
{
    while (load->branch[v].parent >= load->first_skeleton) {
        *length += edge_length(load, load->branch[v].parent, v);
        v = load->branch[v].parent;
    }
    return v;
}

/* How steep the ground is from which the branch with the first point m comes, in 1/256: the
 * steepest edge that goes on beyond, or else that to m. Where branches from two peaks meet, ways
 * are as the slopes: s_a · way_a = s_b · way_b (6.2: the ratio of 5.1). Rises are within 2^18.
 */
static uint32_t steepness(const yb_load_t *load, int m)
{
    int p = load->branch[m].parent;
    int32_t up = height_at(load, p) - height_at(load, m);
    int32_t slope = 0;
    for (half_t e = first_spoke(load, p); e != NO_HALF; e = spoke_after(load, e)) {
        for (int k = 0; k < 2; k++) {
            int q = k == 0 ? end_of(load, e) : apex_of(load, e);
            int32_t on = height_at(load, q) - height_at(load, p);
            if (q < load->first_skeleton && on != 0 && (on > 0) == (up > 0)) {
                slope = fix_max(slope, (fix_abs(on) << 8) / edge_length(load, p, q));
            }
        }
    }
    if (slope == 0)
        slope = (fix_abs(up) << 8) / edge_length(load, p, m);
    return (uint32_t)fix_clamp(slope, 1, 1 << 14);
}

/* A way and one edge more, weighted, as far as 32 bits go. Weights are at most 2^14 and lengths
 * below 2^17: the edge adds less than 2^26.
 */
static uint32_t add_way(const yb_load_t *load, uint32_t way, uint32_t weight, int a,
                        int b)
{
    uint32_t sum = way + weight * (uint32_t)(edge_length(load, a, b) >> 5);
    return sum < way ? UINT32_MAX : sum;
}

/* Finds what the middle of a bridge would be reached from, if a branch began there; `other` is the
 * middle itself if that is one point only. On the frame a bridge between two points of lines is met
 * by its mirror image; the frame's own corners, at one height, bridge nothing. False: none begins.
 */
static bool begins_branch(const yb_load_t *load, bridge_t *bridge)
{
    int32_t h = height_at(load, origin_of(load, bridge->half));
    int p = apex_of(load, bridge->half);
    int q = p;
    half_t twin = twin_of(load, bridge->half);
    if (twin != NO_HALF)
        q = apex_of(load, twin);
    else if ((bridge->key & 0xffff) >= load->point_count)
        return false;
    /* The lower number first; but flat ground last. */
    bool swap = height_at(load, p) == h || (q < p && height_at(load, q) != h);
    bridge->parent = swap ? q : p;
    bridge->other = swap ? p : q;
    int32_t up = height_at(load, bridge->parent) - h;
    int32_t up_other = height_at(load, bridge->other) - h;
    if (up_other == 0 && bridge->other < load->first_skeleton)
        bridge->other = load->map->vertex_count;
    /* Points of this stage still have their edge's height. Ground that goes on falling across the
     * bridge needs no point on it. */
    return up != 0 && (up_other == 0 || (up > 0) == (up_other > 0));
}

/* The bridge from v to the lowest higher number at which a branch begins. */
static bool find_beginning(const yb_load_t *load, int v, bridge_t *next)
{
    next->key = UINT32_MAX;
    for (half_t e = first_spoke(load, v); e != NO_HALF; e = spoke_after(load, e)) {
        for (int k = 0; k < 2; k++) {
            half_t side = k == 0 ? e : last_of(e);
            bridge_t bridge = {side, edge_key(load, side), v, v};
            if (bridge.key >> 16 == (uint32_t)v && bridge.key < next->key &&
                is_bridge(load, side) && begins_branch(load, &bridge))
                *next = bridge;
        }
    }
    return next->key != UINT32_MAX;
}

/* Branches begin at bridges that have a point of another height on one side, and on the other flat
 * ground, or another such point: then a bridge is all there is. In the order of their ends'
 * numbers.
 */
static yb_status_t begin_branches(yb_load_t *load)
{
    for (int v = 0; v < load->first_skeleton; v++) {
        bridge_t bridge;
        while (find_beginning(load, v, &bridge)) {
            int m = load->map->vertex_count;
            if (split_bridge(load, &bridge) != YB_OK)
                return YB_ERR_LIMIT;
            load->way[m] = add_way(load, 0, steepness(load, m), bridge.parent, m);
        }
    }
    return YB_OK;
}

/* The next bridge that point v looks at. */
static bool find_bridge(const yb_load_t *load, int v, bridge_t *next)
{
    next->key = UINT32_MAX;
    for (half_t e = first_spoke(load, v); e != NO_HALF; e = spoke_after(load, e)) {
        half_t opposite = next_of(e);
        uint32_t key = edge_key(load, opposite);
        if (key < next->key && is_bridge(load, opposite))
            *next = (bridge_t){opposite, key, v, v};
    }
    return next->key != UINT32_MAX;
}

/* Splits all bridges that v looks at. One on the frame counts as met by its mirror image. */
static yb_status_t grow(yb_load_t *load, int v)
{
    int32_t unused = 0;
    int32_t h =
        height_at(load, v); /* still that of the bridge that v splits, and of its flat ground */
    uint32_t weight = steepness(load, beginning_of(load, v, &unused));
    bridge_t bridge;
    while (find_bridge(load, v, &bridge)) {
        int m = load->map->vertex_count;
        half_t twin = twin_of(load, bridge.half);
        if (twin != NO_HALF) {
            int q = apex_of(load, twin);
            bool flat = q < load->first_skeleton && height_at(load, q) == h;
            bridge.other = flat ? m : q; /* flat ground: it will grow on */
        }
        if (split_bridge(load, &bridge) != YB_OK)
            return YB_ERR_LIMIT;
        load->way[m] = add_way(load, load->way[v], weight, v, m);
    }
    load->branch[v].grown = true;
    return YB_OK;
}

/* The shortest way first, so that branches meet where the slopes from both sides would. */
static yb_status_t grow_all(yb_load_t *load)
{
    for (;;) {
        int next = -1;
        for (int v = load->first_skeleton; v < load->map->vertex_count; v++) {
            const yb_branch_t *branch = &load->branch[v];
            if (!branch->grown && (next < 0 || load->way[v] < load->way[next]))
                next = v;
        }
        if (next < 0)
            return YB_OK;
        if (grow(load, next) != YB_OK)
            return YB_ERR_LIMIT;
    }
}

/* Keeps z strictly on the side of h that the branch came from, by `least` at the least. */
static int32_t keep_off(int32_t z, int32_t h, int32_t from, int32_t least)
{
    least = fix_max(least, 1);
    return from > h ? fix_max(z, h + least) : fix_min(z, h - least);
}

/* Where two branches meet: a saddle half way up to the height of the sides if both began at one
 * height, else on the even slope from one beginning to the other.
 */
static int32_t meeting_height(const yb_load_t *load, int m)
{
    int32_t h = height_at(load, m);
    int side[2] = {load->branch[m].parent, load->branch[m].other};
    int32_t way[2];
    int32_t z[2];
    for (int k = 0; k < 2; k++) {
        int from = side[k];
        way[k] = edge_length(load, m, from);
        if (from >= load->first_skeleton) {
            int first = beginning_of(load, from, &way[k]);
            from = load->branch[first].parent;
            way[k] += edge_length(load, first, from);
        }
        z[k] = height_at(load, from);
    }
    int32_t at =
        z[0] == z[1] ? (z[0] + h) / 2 : z[0] + fix_scale(z[1] - z[0], way[0], way[0] + way[1]);
    return keep_off(at, h, z[0], fix_abs(h - z[0]) / 8);
}

/* How far the contour is on from a point with no branch beyond it. */
static uint32_t way_to_contour(const yb_load_t *load, int v)
{
    int32_t way = 0;
    for (half_t e = first_spoke(load, v); e != NO_HALF; e = spoke_after(load, e)) {
        int side = end_of(load, e);
        if (side < load->first_skeleton && height_at(load, side) == height_at(load, v))
            way = fix_max(way, edge_length(load, v, side));
    }
    return (uint32_t)way;
}

/* From the ends back to the beginnings: how far the farthest end beyond each point is, and whether
 * that is a meeting point. A point has a higher number than its parent.
 */
static void measure_ways(yb_load_t *load)
{
    for (int v = load->first_skeleton; v < load->map->vertex_count; v++)
        load->way[v] = 0;
    for (int i = load->map->vertex_count - 1; i >= load->first_skeleton; i--) {
        int v = i;
        yb_branch_t *branch = &load->branch[v];
        if (load->way[v] == 0 && !meets(load, v))
            load->way[v] = way_to_contour(load, v);
        for (int k = 0; k < 2; k++) {
            int p = k == 0 ? branch->parent : branch->other;
            if (p == v || p < load->first_skeleton || meets(load, p))
                continue;
            uint32_t way = load->way[v] + (uint32_t)edge_length(load, p, v);
            if (way > load->way[p]) {
                load->way[p] = way;
                load->branch[p].end =
                    (yb_index_t)(meets(load, v) ? v : branch->end == v ? p : branch->end);
            }
        }
    }
}

/* Meeting points first, then even slopes from the beginnings to the ends. */
static void set_heights(yb_load_t *load)
{
    for (int i = load->first_skeleton; i < load->map->vertex_count; i++) {
        if (meets(load, i))
            load->map->vertex[i].z_q8 = meeting_height(load, i);
    }
    for (int i = load->first_skeleton; i < load->map->vertex_count; i++) {
        int v = i;
        const yb_branch_t *branch = &load->branch[v];
        if (meets(load, v))
            continue;
        int32_t h = height_at(load, v);
        int32_t from = height_at(load, branch->parent);
        int32_t to = height_at(load, branch->end); /* h, if that is v itself */
        int32_t step = edge_length(load, branch->parent, v);
        int32_t z = from + fix_scale(to - from, step, step + (int32_t)load->way[v]);
        bool begins = branch->parent < load->first_skeleton;
        load->map->vertex[v].z_q8 = keep_off(z, h, from, begins ? fix_abs(h - from) / 8 : 0);
    }
}

yb_status_t skeleton_add(yb_load_t *load)
{
    load->first_skeleton = load->map->vertex_count;
    yb_status_t status = begin_branches(load);
    if (status == YB_OK)
        status = grow_all(load);
    if (status != YB_OK)
        return status;
    measure_ways(load);
    set_heights(load);
    return YB_OK;
}
