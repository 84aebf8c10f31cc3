/* Constrained Delaunay triangulation in exact integers.
 *
 * Three steps, all by flips: every vertex is inserted into the Delaunay triangulation of those
 * before it; every contour edge is forced in; what is not fixed is made Delaunay again. Nothing
 * needs a stack or a list: legalising walks round the new vertex, and forcing an edge in removes
 * the vertices of its channel one by one (see force_edge).
 *
 * The result does not depend on the order of work: where four points lie on a circle, the diagonal
 * goes through the one with the smallest index. That is the triangulation of points lifted to the
 * paraboloid and then lowered by infinitely small amounts, the first one most, so it is unique.
 */
#include "mesh.h"

/* A triangle, and what lies across its edges. */
typedef struct {
    yb_index_t v[3];
    yb_entry_t across[3];
} facet_t;

/* Triangle t as it is, its edge `edge` being the first. */
static void take_facet(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int edge,
                       facet_t *facet)
{
    yb_across_t word = load->across[t];
    for (int k = 0; k < 3; k++, edge = next3(edge)) {
        facet->v[k] = map->triangle[t][edge];
        facet->across[k] = (yb_entry_t)(word >> (edge * ENTRY_BITS)) & ENTRY_ALL;
    }
}

/* Makes it triangle t, at which those across then look back, with the same marks. Of some facets
 * that look at each other the last one puts right what the earlier ones could not know.
 */
static void put_facet(yb_map_t *map, yb_load_t *load, yb_triangle_t t, const facet_t *facet)
{
    yb_across_t word = 0;
    for (int k = 2; k >= 0; k--) {
        yb_entry_t entry = facet->across[k];
        yb_triangle_t u = entry & NO_TRIANGLE;
        word = word << ENTRY_BITS | entry;
        map->triangle[t][k] = facet->v[k];
        load->star[facet->v[k]] = t;
        if (u != NO_TRIANGLE)
            set_entry(load, u, corner_of(map, u, facet->v[next3(k)]),
                      (yb_entry_t)(t | (entry & ENTRY_MARK)));
    }
    load->across[t] = word;
}

/* Replaces the common edge ab of t and its neighbour by the other diagonal dc of their quad. With
 * t = (a b c) before, edge ab being edge i, t becomes (a d c) and the neighbour (d b c).
 */
static void flip(yb_map_t *map, yb_load_t *load, yb_triangle_t t, int i)
{
    facet_t p; /* a b c */
    facet_t q; /* b a d */
    take_facet(map, load, t, i, &p);
    yb_triangle_t u = p.across[0];
    yb_entry_t bc = p.across[1];
    take_facet(map, load, u, corner_of(map, u, p.v[1]), &q);
    p.v[1] = q.v[2];
    p.across[0] = q.across[1];
    p.across[1] = u;
    put_facet(map, load, t, &p);
    q.v[1] = q.v[0];
    q.v[0] = q.v[2];
    q.v[2] = p.v[2];
    q.across[0] = q.across[2];
    q.across[1] = bc;
    q.across[2] = t;
    put_facet(map, load, u, &q);
}

/* Does d lie inside the circle through a, b, c (counter-clockwise)? Differences in 1/64 steps are
 * within 2^14, squares of length 2^29, areas 2^29: each of the three terms is below 2^58.
 */
static bool in_circle(const yb_map_t *map, yb_index_t a, yb_index_t b, yb_index_t c, yb_index_t d)
{
    const yb_vertex_t *o = &map->vertex[d];
    const yb_index_t corner[3] = {a, b, c};
    int32_t x[3];
    int32_t y[3];
    for (int i = 0; i < 3; i++) {
        x[i] = fix_minus(map->vertex[corner[i]].x_q8, o->x_q8) >> 2;
        y[i] = fix_minus(map->vertex[corner[i]].y_q8, o->y_q8) >> 2;
    }
    int64_t sum = 0;
    for (int i = 0; i < 3; i++) {
        int j = next3(i);
        int k = prev3(i);
        sum += (int64_t)(x[i] * x[i] + y[i] * y[i]) * (x[j] * y[k] - x[k] * y[j]);
    }
    if (sum != 0)
        return sum > 0;
    yb_index_t least_kept = a < b ? a : b;
    yb_index_t least_new = c < d ? c : d;
    return least_new < least_kept;
}

/* Is edge i of t to be flipped? */
static bool illegal(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int i)
{
    yb_entry_t entry = entry_of(load, t, i);
    if (entry >= NO_TRIANGLE) /* the frame, or marked */
        return false;
    const yb_index_t *v = map->triangle[t];
    return in_circle(map, v[i], v[next3(i)], v[prev3(i)], apex_across(map, load, t, i));
}

/* Legalises all edges opposite the new vertex p: once round it, counter-clockwise. A flip gives p
 * one more triangle, whose edge is looked at next; a spoke of p is never flipped, so the walk ends
 * when it comes to the spoke it started with.
 */
void mesh_legalise(yb_map_t *map, yb_load_t *load, yb_index_t p)
{
    yb_triangle_t t = first_at(map, load, p);
    yb_index_t first_spoke = corner_after(map, t, p);
    for (;;) {
        int opposite = next3(corner_of(map, t, p));
        if (illegal(map, load, t, opposite)) {
            flip(map, load, t, opposite); /* t = (a d p): the first of the two new ones */
            continue;
        }
        yb_triangle_t left = turn_left(map, load, t, p);
        if (left == NO_TRIANGLE || corner_after(map, left, p) == first_spoke)
            return;
        t = left;
    }
}

/* Finds the triangle that holds vertex p by walking towards it from t. In a Delaunay triangulation
 * such a walk never goes in circles. *edge: the edge p lies on, or -1.
 */
static yb_triangle_t locate(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t,
                            yb_index_t p, int *edge)
{
    for (;;) {
        *edge = -1;
        int out = -1;
        for (int i = 0; i < 3 && out < 0; i++) {
            int32_t side = orientation(map, map->triangle[t][i], map->triangle[t][next3(i)], p);
            if (side < 0)
                out = i;
            else if (side == 0)
                *edge = i;
        }
        if (out < 0)
            return t;
        t = neighbour_of(load, t, out); /* p is in the frame: there is one */
    }
}

static bool same_place(const yb_map_t *map, yb_index_t a, yb_index_t b)
{
    return map->vertex[a].x_q8 == map->vertex[b].x_q8 && map->vertex[a].y_q8 == map->vertex[b].y_q8;
}

/* Splits t = (a b c) at p into (a b p), (b c p), (c a p); edge 0 of t is `edge`, where p may lie
 * on it. Then ab p is flat: it is flipped away, or, on the frame, left out.
 */
void mesh_split(yb_map_t *map, yb_load_t *load, yb_triangle_t t, int edge, yb_index_t p)
{
    facet_t f;
    take_facet(map, load, t, edge < 0 ? 0 : edge, &f);
    bool on_side = edge >= 0 && f.across[0] == NO_TRIANGLE;
    yb_triangle_t part[3] = {NO_TRIANGLE, t, map->triangle_count++};
    if (!on_side)
        part[0] = map->triangle_count++;
    for (int k = on_side ? 1 : 0; k < 3; k++) {
        facet_t facet;
        facet.v[0] = f.v[k];
        facet.v[1] = f.v[next3(k)];
        facet.v[2] = p;
        facet.across[0] = f.across[k];
        facet.across[1] = part[next3(k)];
        facet.across[2] = part[prev3(k)];
        load->region[part[k]] = load->region[t];
        put_facet(map, load, part[k], &facet);
    }
    if (edge >= 0 && !on_side)
        flip(map, load, part[0], 0);
}

static yb_status_t insert_all(yb_map_t *map, yb_load_t *load)
{
    const yb_index_t *corner = load->corner;
    map->triangle_count = 2;
    for (int t = 0; t < 2; t++) {
        facet_t half = {{corner[0], corner[t + 1], corner[t + 2]},
                        {NO_TRIANGLE, NO_TRIANGLE, NO_TRIANGLE}};
        half.across[t == 0 ? 2 : 0] = t == 0 ? 1 : 0;
        put_facet(map, load, (yb_triangle_t)t, &half);
    }
    mesh_legalise(map, load, corner[0]);
    mesh_legalise(map, load, corner[1]);
    yb_triangle_t t = 0;
    for (int i = 0; i < map->vertex_count; i++) {
        yb_index_t p = (yb_index_t)i;
        if (p == corner[0] || p == corner[1] || p == corner[2] || p == corner[3])
            continue;
        int edge = -1;
        t = locate(map, load, t, p, &edge);
        for (int k = 0; k < 3; k++) {
            if (same_place(map, map->triangle[t][k], p))
                return YB_ERR_CORRUPT;
        }
        mesh_split(map, load, t, edge, p);
        mesh_legalise(map, load, p);
        t = load->star[p];
    }
    return YB_OK;
}

/* Flips away all edges at v between the spokes to `from` and `to` (counter-clockwise), given that
 * the angle between them is convex and all vertices between lie beyond the line from-to. Those
 * form, with from and to, a polygon that always has a corner strictly bulging away from v: the edge
 * to it can be flipped. So each round of the loop removes one.
 */
static void clear_fan(yb_map_t *map, yb_load_t *load, yb_index_t v, yb_index_t from, yb_index_t to)
{
    yb_triangle_t first = first_at(map, load, v);
    while (corner_after(map, first, v) != from)
        first = turn_left(map, load, first, v);
    yb_triangle_t t = first;
    for (;;) {
        yb_index_t s = corner_after(map, t, v);
        yb_index_t e = corner_before(map, t, v);
        if (e == to) {
            if (t == first)
                return;
            t = first;
            continue;
        }
        yb_triangle_t after = turn_left(map, load, t, v);
        yb_index_t f = corner_before(map, after, v);
        if (orientation(map, s, e, f) <= 0) {
            t = after;
            continue;
        }
        /* Edge e-v of t; t = (e v s) becomes (e f s), its neighbour (f v s). */
        flip(map, load, t, corner_of(map, t, e));
        if (t == first)
            first = after;
        t = first;
    }
}

/* The triangle at a whose opposite edge the segment ab leaves through, or, with *is_edge, one that
 * has ab as an edge already. NO_TRIANGLE: ab runs through another vertex.
 */
static yb_triangle_t towards(const yb_map_t *map, const yb_load_t *load, yb_index_t a, yb_index_t b,
                             bool *is_edge)
{
    yb_triangle_t first = first_at(map, load, a);
    for (yb_triangle_t t = first; t != NO_TRIANGLE; t = turn_on(map, load, t, a, first)) {
        yb_index_t s = corner_after(map, t, a);
        yb_index_t e = corner_before(map, t, a);
        *is_edge = s == b || e == b;
        if (*is_edge)
            return t;
        if (orientation(map, a, s, b) > 0 && orientation(map, a, b, e) > 0)
            return t;
    }
    return NO_TRIANGLE;
}

/* Takes one vertex off the channel of ab: walks from t (at a) along ab and removes the first vertex
 * at which a side of the channel bulges away from ab. There is one: that farthest from ab.
 */
static yb_status_t narrow_channel(yb_map_t *map, yb_load_t *load, yb_triangle_t t, yb_index_t a,
                                  yb_index_t b)
{
    yb_index_t right = corner_after(map, t, a);
    yb_index_t left = corner_before(map, t, a);
    int edge = corner_of(map, t, right);
    yb_index_t right_before = a;
    yb_index_t left_before = a;
    for (;;) {
        if (is_marked(load, t, edge))
            return YB_ERR_CORRUPT; /* two contours cross */
        int corner = 0;
        t = across(map, load, t, edge, &corner);
        yb_index_t apex = map->triangle[t][corner];
        int32_t side = apex == b ? 0 : orientation(map, a, b, apex);
        if (side == 0 && apex != b)
            return YB_ERR_CORRUPT; /* a contour runs through a point of another */
        if (side >= 0 && orientation(map, left_before, left, apex) < 0) {
            clear_fan(map, load, left, left_before, apex);
            return YB_OK;
        }
        if (side <= 0 && orientation(map, right_before, right, apex) > 0) {
            clear_fan(map, load, right, apex, right_before);
            return YB_OK;
        }
        /* t = (left, right, apex): go on through the edge from the apex to the other side. */
        if (side > 0) {
            left_before = left;
            left = apex;
            edge = prev3(corner);
        } else {
            right_before = right;
            right = apex;
            edge = corner;
        }
    }
}

/* Makes ab an edge and fixes it. The triangles it crosses form a channel; each round takes one
 * vertex off the channel's sides (those edges that it had across the channel are flipped to its
 * neighbours), until none is left between a and b. Each vertex leaves once: it always ends.
 */
yb_status_t mesh_force_edge(yb_map_t *map, yb_load_t *load, yb_index_t a, yb_index_t b)
{
    for (;;) {
        bool is_edge = false;
        yb_triangle_t t = towards(map, load, a, b, &is_edge);
        if (t == NO_TRIANGLE)
            return YB_ERR_CORRUPT;
        if (is_edge) {
            facet_t facet;
            int i = corner_of(map, t, a);
            take_facet(map, load, t, 0, &facet);
            facet.across[facet.v[next3(i)] == b ? i : prev3(i)] |= ENTRY_MARK;
            put_facet(map, load, t, &facet);
            return YB_OK;
        }
        if (narrow_channel(map, load, t, a, b) != YB_OK)
            return YB_ERR_CORRUPT;
    }
}

bool mesh_sees(const yb_map_t *map, const yb_load_t *load, yb_index_t a, yb_index_t b)
{
    bool is_edge = false;
    yb_triangle_t t = towards(map, load, a, b, &is_edge);
    if (t == NO_TRIANGLE || is_edge)
        return is_edge;
    int edge = next3(corner_of(map, t, a));
    while (!is_marked(load, t, edge)) {
        int corner = 0;
        t = across(map, load, t, edge, &corner);
        yb_index_t apex = map->triangle[t][corner];
        int32_t side = orientation(map, a, b, apex);
        if (apex == b || side == 0)
            return apex == b;
        /* t = (left, right, apex): on through right-apex or apex-left. */
        edge = side > 0 ? prev3(corner) : corner;
    }
    return false;
}

static yb_status_t force_contours(yb_map_t *map, yb_load_t *load)
{
    for (int i = 0; i < load->contour_count; i++) {
        const yb_contour_t *contour = &load->contour[i];
        int edges = contour->open ? contour->count - 1 : contour->count;
        for (int k = 0; k < edges && contour->count > 1; k++) {
            yb_index_t a = (yb_index_t)(contour->first + k);
            yb_index_t b = (yb_index_t)(contour->first + (k + 1) % contour->count);
            if (mesh_force_edge(map, load, a, b) != YB_OK)
                return YB_ERR_CORRUPT;
        }
    }
    return YB_OK;
}

/* Flips until no edge is illegal: each is looked at from its first triangle alone. Each flip lowers
 * the lifted surface, so this ends.
 */
void mesh_make_delaunay(yb_map_t *map, yb_load_t *load)
{
    bool flipped = true;
    while (flipped) {
        flipped = false;
        for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
            for (int i = 0; i < 3; i++) {
                if (entry_of(load, t, i) > t && illegal(map, load, t, i)) {
                    flip(map, load, t, i);
                    flipped = true;
                }
            }
        }
    }
}

yb_status_t mesh_triangulate(yb_map_t *map, yb_load_t *load)
{
    yb_status_t status = insert_all(map, load);
    if (status == YB_OK)
        status = force_contours(map, load);
    if (status == YB_OK)
        mesh_make_delaunay(map, load);
    return status;
}
