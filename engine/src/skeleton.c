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

/* Is edge i of t one to be split: of one height, and no contour or link? */
static bool is_bridge(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int i)
{
    yb_index_t a = map->triangle[t][i];
    yb_index_t b = map->triangle[t][next3(i)];
    return !is_marked(load, t, i) && a < load->first_skeleton && b < load->first_skeleton &&
           map->vertex[a].z_q8 == map->vertex[b].z_q8;
}

/* A bridge, and what its middle is reached from. */
typedef struct {
    yb_triangle_t t;
    int edge;
    uint32_t key; /* its place in the order of edges */
    yb_index_t parent, other;
} bridge_t;

/* Splits a bridge; the height of its middle is that of the edge until heights are known. */
static yb_status_t split_bridge(yb_map_t *map, yb_load_t *load, const bridge_t *bridge)
{
    const yb_vertex_t *a = &map->vertex[map->triangle[bridge->t][bridge->edge]];
    const yb_vertex_t *b = &map->vertex[map->triangle[bridge->t][next3(bridge->edge)]];
    yb_index_t m = (yb_index_t)map->vertex_count;
    if (mesh_add_vertex(map, load, fix_middle(a->x_q8, b->x_q8), fix_middle(a->y_q8, b->y_q8),
                        a->z_q8) != YB_OK)
        return YB_ERR_LIMIT;
    load->branch[m] = (yb_branch_t){.parent = bridge->parent, .other = bridge->other, .end = m};
    mesh_split(map, load, bridge->t, bridge->edge, m);
    return YB_OK;
}

static bool meets(const yb_load_t *load, yb_index_t m)
{
    return load->branch[m].other != m;
}

/* The first point of the branch that v belongs to, and how far that is from v. */
static yb_index_t beginning_of(const yb_map_t *map, const yb_load_t *load, yb_index_t v,
                               int32_t *length)
{
    while (load->branch[v].parent >= load->first_skeleton) {
        *length += edge_length(map, load->branch[v].parent, v);
        v = load->branch[v].parent;
    }
    return v;
}

/* How steep the ground is from which the branch with the first point m comes, in 1/256: the
 * steepest edge that goes on beyond, or else that to m. Where branches from two peaks meet, ways
 * are as the slopes: s_a · way_a = s_b · way_b (6.2: the ratio of 5.1). Rises are within 2^18.
 */
static uint32_t steepness(const yb_map_t *map, const yb_load_t *load, yb_index_t m)
{
    yb_index_t p = load->branch[m].parent;
    int32_t up = map->vertex[p].z_q8 - map->vertex[m].z_q8;
    int32_t slope = 0;
    yb_triangle_t first = first_at(map, load, p);
    for (yb_triangle_t t = first; t != NO_TRIANGLE; t = turn_on(map, load, t, p, first)) {
        for (int i = 0; i < 3; i++) {
            yb_index_t q = map->triangle[t][i];
            int32_t on = map->vertex[q].z_q8 - map->vertex[p].z_q8;
            if (q < load->first_skeleton && on != 0 && (on > 0) == (up > 0)) {
                slope = fix_max(slope, (fix_abs(on) << 8) / edge_length(map, p, q));
            }
        }
    }
    if (slope == 0)
        slope = (fix_abs(up) << 8) / edge_length(map, p, m);
    return (uint32_t)fix_clamp(slope, 1, 1 << 14);
}

/* A way and one edge more, weighted, as far as 32 bits go. Weights are at most 2^14 and lengths
 * below 2^17: the edge adds less than 2^26.
 */
static uint32_t add_way(const yb_map_t *map, uint32_t way, uint32_t weight, yb_index_t a,
                        yb_index_t b)
{
    uint32_t sum = way + weight * (uint32_t)(edge_length(map, a, b) >> 5);
    return sum < way ? UINT32_MAX : sum;
}

/* Finds what the middle of a bridge would be reached from, if a branch began there; `other` is the
 * middle itself if that is one point only. On the frame a bridge between two points of lines is met
 * by its mirror image; the frame's own corners, at one height, bridge nothing. False: none begins.
 */
static bool begins_branch(const yb_map_t *map, const yb_load_t *load, bridge_t *bridge)
{
    yb_triangle_t t = bridge->t;
    int i = bridge->edge;
    int32_t h = map->vertex[map->triangle[t][i]].z_q8;
    yb_index_t p = map->triangle[t][prev3(i)];
    yb_index_t q = p;
    if (entry_of(load, t, i) != NO_TRIANGLE)
        q = apex_across(map, load, t, i);
    else if ((bridge->key & 0xffff) >= load->point_count)
        return false;
    /* The lower number first; but flat ground last. */
    bool swap = map->vertex[p].z_q8 == h || (q < p && map->vertex[q].z_q8 != h);
    bridge->parent = swap ? q : p;
    bridge->other = swap ? p : q;
    int32_t up = map->vertex[bridge->parent].z_q8 - h;
    int32_t up_other = map->vertex[bridge->other].z_q8 - h;
    if (up_other == 0 && bridge->other < load->first_skeleton)
        bridge->other = (yb_index_t)map->vertex_count;
    /* Points of this stage still have their edge's height. Ground that goes on falling across the
     * bridge needs no point on it. */
    return up != 0 && (up_other == 0 || (up > 0) == (up_other > 0));
}

/* The bridge from v to the lowest higher number at which a branch begins. */
static bool find_beginning(const yb_map_t *map, const yb_load_t *load, yb_index_t v, bridge_t *next)
{
    next->key = UINT32_MAX;
    yb_triangle_t first = first_at(map, load, v);
    for (yb_triangle_t t = first; t != NO_TRIANGLE; t = turn_on(map, load, t, v, first)) {
        int at = corner_of(map, t, v);
        for (int k = 0; k < 2; k++, at = prev3(at)) {
            bridge_t bridge = {t, at, mesh_edge_key(map, t, at), v, v};
            if (bridge.key >> 16 == v && bridge.key < next->key && is_bridge(map, load, t, at) &&
                begins_branch(map, load, &bridge))
                *next = bridge;
        }
    }
    return next->key != UINT32_MAX;
}

/* Branches begin at bridges that have a point of another height on one side, and on the other flat
 * ground, or another such point: then a bridge is all there is. In the order of their ends'
 * numbers.
 */
static yb_status_t begin_branches(yb_map_t *map, yb_load_t *load)
{
    for (int v = 0; v < load->first_skeleton; v++) {
        bridge_t bridge;
        while (find_beginning(map, load, (yb_index_t)v, &bridge)) {
            yb_index_t m = (yb_index_t)map->vertex_count;
            if (split_bridge(map, load, &bridge) != YB_OK)
                return YB_ERR_LIMIT;
            load->way[m] = add_way(map, 0, steepness(map, load, m), bridge.parent, m);
        }
    }
    return YB_OK;
}

/* The next bridge that point v looks at. */
static bool find_bridge(const yb_map_t *map, const yb_load_t *load, yb_index_t v, bridge_t *next)
{
    next->key = UINT32_MAX;
    yb_triangle_t first = first_at(map, load, v);
    for (yb_triangle_t t = first; t != NO_TRIANGLE; t = turn_on(map, load, t, v, first)) {
        int i = next3(corner_of(map, t, v));
        uint32_t key = mesh_edge_key(map, t, i);
        if (key < next->key && is_bridge(map, load, t, i))
            *next = (bridge_t){.t = t, .edge = i, .key = key, .parent = v, .other = v};
    }
    return next->key != UINT32_MAX;
}

/* Splits all bridges that v looks at. One on the frame counts as met by its mirror image. */
static yb_status_t grow(yb_map_t *map, yb_load_t *load, yb_index_t v)
{
    int32_t unused = 0;
    int32_t h =
        map->vertex[v].z_q8; /* still that of the bridge that v splits, and of its flat ground */
    uint32_t weight = steepness(map, load, beginning_of(map, load, v, &unused));
    bridge_t bridge;
    while (find_bridge(map, load, v, &bridge)) {
        yb_index_t m = (yb_index_t)map->vertex_count;
        if (neighbour_of(load, bridge.t, bridge.edge) != NO_TRIANGLE) {
            yb_index_t q = apex_across(map, load, bridge.t, bridge.edge);
            bool flat = q < load->first_skeleton && map->vertex[q].z_q8 == h;
            bridge.other = flat ? m : q; /* flat ground: it will grow on */
        }
        if (split_bridge(map, load, &bridge) != YB_OK)
            return YB_ERR_LIMIT;
        load->way[m] = add_way(map, load->way[v], weight, v, m);
    }
    load->branch[v].grown = true;
    return YB_OK;
}

/* The shortest way first, so that branches meet where the slopes from both sides would. */
static yb_status_t grow_all(yb_map_t *map, yb_load_t *load)
{
    for (;;) {
        int next = -1;
        for (int v = load->first_skeleton; v < map->vertex_count; v++) {
            const yb_branch_t *branch = &load->branch[v];
            if (!branch->grown && (next < 0 || load->way[v] < load->way[next]))
                next = v;
        }
        if (next < 0)
            return YB_OK;
        if (grow(map, load, (yb_index_t)next) != YB_OK)
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
static int32_t meeting_height(const yb_map_t *map, const yb_load_t *load, yb_index_t m)
{
    int32_t h = map->vertex[m].z_q8;
    yb_index_t side[2] = {load->branch[m].parent, load->branch[m].other};
    int32_t way[2];
    int32_t z[2];
    for (int k = 0; k < 2; k++) {
        yb_index_t from = side[k];
        way[k] = edge_length(map, m, from);
        if (from >= load->first_skeleton) {
            yb_index_t first = beginning_of(map, load, from, &way[k]);
            from = load->branch[first].parent;
            way[k] += edge_length(map, first, from);
        }
        z[k] = map->vertex[from].z_q8;
    }
    int32_t at =
        z[0] == z[1] ? (z[0] + h) / 2 : z[0] + fix_scale(z[1] - z[0], way[0], way[0] + way[1]);
    return keep_off(at, h, z[0], fix_abs(h - z[0]) / 8);
}

/* How far the contour is on from a point with no branch beyond it. */
static uint32_t way_to_contour(const yb_map_t *map, const yb_load_t *load, yb_index_t v)
{
    int32_t way = 0;
    yb_triangle_t first = first_at(map, load, v);
    for (yb_triangle_t t = first; t != NO_TRIANGLE; t = turn_on(map, load, t, v, first)) {
        yb_index_t side = corner_after(map, t, v);
        if (side < load->first_skeleton && map->vertex[side].z_q8 == map->vertex[v].z_q8)
            way = fix_max(way, edge_length(map, v, side));
    }
    return (uint32_t)way;
}

/* From the ends back to the beginnings: how far the farthest end beyond each point is, and whether
 * that is a meeting point. A point has a higher number than its parent.
 */
static void measure_ways(const yb_map_t *map, yb_load_t *load)
{
    for (int v = load->first_skeleton; v < map->vertex_count; v++)
        load->way[v] = 0;
    for (int i = map->vertex_count - 1; i >= load->first_skeleton; i--) {
        yb_index_t v = (yb_index_t)i;
        yb_branch_t *branch = &load->branch[v];
        if (load->way[v] == 0 && !meets(load, v))
            load->way[v] = way_to_contour(map, load, v);
        for (int k = 0; k < 2; k++) {
            yb_index_t p = k == 0 ? branch->parent : branch->other;
            if (p == v || p < load->first_skeleton || meets(load, p))
                continue;
            uint32_t way = load->way[v] + (uint32_t)edge_length(map, p, v);
            if (way > load->way[p]) {
                load->way[p] = way;
                load->branch[p].end = meets(load, v) ? v : branch->end == v ? p : branch->end;
            }
        }
    }
}

/* Meeting points first, then even slopes from the beginnings to the ends. */
static void set_heights(yb_map_t *map, yb_load_t *load)
{
    for (int i = load->first_skeleton; i < map->vertex_count; i++) {
        if (meets(load, (yb_index_t)i))
            map->vertex[i].z_q8 = meeting_height(map, load, (yb_index_t)i);
    }
    for (int i = load->first_skeleton; i < map->vertex_count; i++) {
        yb_index_t v = (yb_index_t)i;
        const yb_branch_t *branch = &load->branch[v];
        if (meets(load, v))
            continue;
        int32_t h = map->vertex[v].z_q8;
        int32_t from = map->vertex[branch->parent].z_q8;
        int32_t to = map->vertex[branch->end].z_q8; /* h, if that is v itself */
        int32_t step = edge_length(map, branch->parent, v);
        int32_t z = from + fix_scale(to - from, step, step + (int32_t)load->way[v]);
        bool begins = branch->parent < load->first_skeleton;
        map->vertex[v].z_q8 = keep_off(z, h, from, begins ? fix_abs(h - from) / 8 : 0);
    }
}

yb_status_t skeleton_add(yb_map_t *map, yb_load_t *load)
{
    load->first_skeleton = map->vertex_count;
    yb_status_t status = begin_branches(map, load);
    if (status == YB_OK)
        status = grow_all(map, load);
    if (status != YB_OK)
        return status;
    measure_ways(map, load);
    set_heights(map, load);
    return YB_OK;
}
