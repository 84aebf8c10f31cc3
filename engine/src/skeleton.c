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
#include "fix.h"
#include "mesh.h"

static int32_t length_between(const yb_map_t *map, yb_index_t a, yb_index_t b)
{
    const yb_vertex_t *v = map->vertex;
    return fix_length(v[b].x_q8 - v[a].x_q8, v[b].y_q8 - v[a].y_q8);
}

/* Is edge i of t one to be split: of one height, and no contour or link? */
static bool is_bridge(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int i)
{
    yb_index_t a = map->triangle[t][i];
    yb_index_t b = map->triangle[t][next3(i)];
    return mark_of(load, t, i) == YB_RULE_NONE && a < load->first_skeleton &&
           b < load->first_skeleton && map->vertex[a].z_q8 == map->vertex[b].z_q8;
}

/* The vertex across edge i of t; the edge is not on the frame. */
static yb_index_t across(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int i)
{
    yb_triangle_t u = neighbour_of(load, t, i);
    return map->triangle[u][prev3(corner_of(map, u, map->triangle[t][next3(i)]))];
}

/* Splits edge i of t; the new point's height is that of the edge until heights are known. */
static yb_status_t split_bridge(yb_map_t *map, yb_load_t *load, yb_triangle_t t, int i,
                                yb_index_t parent, yb_index_t other, uint32_t way)
{
    const yb_vertex_t *a = &map->vertex[map->triangle[t][i]];
    const yb_vertex_t *b = &map->vertex[map->triangle[t][next3(i)]];
    yb_index_t m = (yb_index_t)map->vertex_count;
    if (mesh_add_vertex(map, load, (uint16_t)((a->x_q8 + b->x_q8) >> 1),
                        (uint16_t)((a->y_q8 + b->y_q8) >> 1), a->z_q8) != YB_OK)
        return YB_ERR_LIMIT;
    yb_branch_t *branch = &load->branch[m];
    branch->parent = parent;
    branch->other = other;
    branch->way = way;
    branch->grown = false;
    branch->meets = other != m;
    mesh_split(map, load, t, i, m);
    return YB_OK;
}

/* Branches begin at bridges that have a point of another height on one side, and on the other flat
 * ground, or another such point: then a bridge is all there is.
 */
static yb_status_t begin_branches(yb_map_t *map, yb_load_t *load)
{
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            yb_index_t p = map->triangle[t][prev3(i)];
            if (!is_bridge(map, load, t, i) || neighbour_of(load, t, i) == NO_TRIANGLE)
                continue;
            int32_t h = map->vertex[map->triangle[t][i]].z_q8;
            int32_t up = p < load->first_skeleton ? map->vertex[p].z_q8 - h : 0;
            if (up == 0)
                continue;
            yb_index_t q = across(map, load, t, i);
            int32_t up_q = map->vertex[q].z_q8 - h;
            yb_index_t m = (yb_index_t)map->vertex_count;
            if (q < load->first_skeleton && up_q != 0) {
                if ((up > 0) != (up_q > 0))
                    continue; /* the ground goes on falling: no bridge */
            } else if (q < load->first_skeleton) {
                q = m;
            }
            if (split_bridge(map, load, t, i, p, q, 0) != YB_OK)
                return YB_ERR_LIMIT;
            load->branch[m].way = (uint32_t)length_between(map, p, m);
        }
    }
    return YB_OK;
}

/* The next bridge that point v looks at. */
static bool find_bridge(const yb_map_t *map, const yb_load_t *load, yb_index_t v, yb_triangle_t *at,
                        int *edge)
{
    yb_triangle_t first = first_at(map, load, v);
    yb_triangle_t t = first;
    do {
        int i = next3(corner_of(map, t, v));
        if (is_bridge(map, load, t, i)) {
            *at = t;
            *edge = i;
            return true;
        }
        t = turn_left(map, load, t, v);
    } while (t != NO_TRIANGLE && t != first);
    return false;
}

/* Splits all bridges that v looks at. */
static yb_status_t grow(yb_map_t *map, yb_load_t *load, yb_index_t v)
{
    yb_triangle_t t = 0;
    int i = 0;
    while (find_bridge(map, load, v, &t, &i)) {
        yb_index_t m = (yb_index_t)map->vertex_count;
        yb_index_t q = m; /* flat ground beyond */
        bool leaves = neighbour_of(load, t, i) == NO_TRIANGLE;
        if (!leaves) {
            q = across(map, load, t, i);
            if (q < load->first_skeleton &&
                map->vertex[q].z_q8 == map->vertex[map->triangle[t][i]].z_q8)
                q = m;
        }
        if (split_bridge(map, load, t, i, v, q, 0) != YB_OK)
            return YB_ERR_LIMIT;
        load->branch[m].way = load->branch[v].way + (uint32_t)length_between(map, v, m);
        load->branch[m].meets = load->branch[m].meets || leaves;
    }
    load->branch[v].grown = true;
    return YB_OK;
}

/* The shortest way first, so that branches meet half way. */
static yb_status_t grow_all(yb_map_t *map, yb_load_t *load)
{
    for (;;) {
        int next = -1;
        for (int v = load->first_skeleton; v < map->vertex_count; v++) {
            const yb_branch_t *branch = &load->branch[v];
            if (!branch->grown && (next < 0 || branch->way < load->branch[next].way))
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

/* The height at which the branch that v belongs to began, and how long it is from there to v. */
static int32_t began_at(const yb_map_t *map, const yb_load_t *load, yb_index_t v, int32_t *length)
{
    while (v >= load->first_skeleton) {
        yb_index_t parent = load->branch[v].parent;
        *length += length_between(map, parent, v);
        v = parent;
    }
    return map->vertex[v].z_q8;
}

/* Where two branches meet, or one leaves the frame: a saddle half way up to the height of the sides
 * if both began at one height, else on the even slope from one beginning to the other.
 */
static int32_t meeting_height(const yb_map_t *map, const yb_load_t *load, yb_index_t m)
{
    const yb_branch_t *branch = &load->branch[m];
    int32_t h = map->vertex[m].z_q8;
    int32_t way_a = 0;
    int32_t way_b = 0;
    int32_t a = began_at(map, load, m, &way_a);
    int32_t b = a;
    if (branch->other != m) {
        way_b = length_between(map, m, branch->other);
        b = began_at(map, load, branch->other, &way_b);
    }
    int32_t z = (a + h) / 2;
    if (a != b)
        z = a + (int32_t)((int64_t)(b - a) * way_a / fix_max(way_a + way_b, 1));
    return keep_off(z, h, a, fix_abs(h - a) / 8);
}

/* From a dead end back to its beginning: how far each point is from the farthest end beyond it
 * (way), and which meeting point that is (other; itself: a dead end).
 */
static void measure_ways(const yb_map_t *map, yb_load_t *load)
{
    for (int v = load->first_skeleton; v < map->vertex_count; v++)
        load->branch[v].way = 0;
    for (int i = map->vertex_count - 1; i >= load->first_skeleton; i--) {
        yb_index_t v = (yb_index_t)i;
        yb_branch_t *branch = &load->branch[v];
        if (!branch->meets && branch->way == 0) {
            /* A dead end: it goes on to the contour. */
            yb_triangle_t first = first_at(map, load, v);
            yb_triangle_t t = first;
            do {
                yb_index_t side = map->triangle[t][next3(corner_of(map, t, v))];
                if (side < load->first_skeleton && map->vertex[side].z_q8 == map->vertex[v].z_q8) {
                    uint32_t way = (uint32_t)length_between(map, v, side);
                    if (way > branch->way)
                        branch->way = way;
                }
                t = turn_left(map, load, t, v);
            } while (t != NO_TRIANGLE && t != first);
        }
        for (int k = 0; k < 2; k++) {
            if (k == 1 && (!branch->meets || branch->other == v))
                break;
            yb_index_t p = k == 0 ? branch->parent : branch->other;
            if (p < load->first_skeleton || load->branch[p].meets)
                continue;
            uint32_t way = branch->way + (uint32_t)length_between(map, p, v);
            if (way > load->branch[p].way) {
                load->branch[p].way = way;
                load->branch[p].other = branch->meets ? v : branch->other == v ? p : branch->other;
            }
        }
    }
}

/* Even slopes from the beginnings to the ends. */
static void set_heights(yb_map_t *map, const yb_load_t *load)
{
    for (int i = load->first_skeleton; i < map->vertex_count; i++) {
        yb_index_t v = (yb_index_t)i;
        const yb_branch_t *branch = &load->branch[v];
        if (branch->meets)
            continue;
        int32_t h = map->vertex[v].z_q8;
        int32_t from = map->vertex[branch->parent].z_q8;
        int32_t to = branch->other == v ? h : map->vertex[branch->other].z_q8;
        int32_t step = length_between(map, branch->parent, v);
        int32_t z = from + (int32_t)((int64_t)(to - from) * step / (step + (int64_t)branch->way));
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
    for (int v = load->first_skeleton; v < map->vertex_count; v++) {
        if (load->branch[v].meets)
            load->branch[v].way = (uint32_t)meeting_height(map, load, (yb_index_t)v);
    }
    for (int v = load->first_skeleton; v < map->vertex_count; v++) {
        if (load->branch[v].meets)
            map->vertex[v].z_q8 = (int32_t)load->branch[v].way;
    }
    set_heights(map, load);
    return YB_OK;
}
