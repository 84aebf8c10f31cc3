/* Constrained Delaunay triangulation in exact integers.
 *
 * Three steps, all by flips: every vertex is inserted into the Delaunay triangulation of those
 * before it; every contour edge is forced in; what is not fixed is made Delaunay again. Nothing
 * needs a stack or a list: legalising walks round the new vertex, and forcing an edge in removes
 * the vertices of its channel one by one (see mesh_reach).
 *
 * The result does not depend on the order of work: where four points lie on a circle, the diagonal
 * goes through the one with the smallest index. That is the triangulation of points lifted to the
 * paraboloid and then lowered by infinitely small amounts, the first one most, so it is unique.
 */
#include "mesh.h"

/* A triangle, and what lies across its edges. */
typedef struct {
    int v[3];
    int across[3];
} facet_t;

/* The triangle of e as it is, e being its first edge. */
static void take_facet(const yb_load_t *load, half_t e, facet_t *facet)
{
    for (int k = 0; k < 3; k++, e = next_of(e)) {
        facet->v[k] = origin_of(load, e);
        facet->across[k] = entry_of(load, e);
    }
}

/* Sets what lies across a half, and makes that look back, with the same mark. */
static void link_half(yb_load_t *load, half_t e, int entry)
{
    int u = entry & NO_TRIANGLE;
    set_entry(load, e, entry);
    if (u != NO_TRIANGLE)
        set_entry(load, half_at(load, u, end_of(load, e)), triangle_of(e) | (entry & ENTRY_MARK));
}

/* Makes it triangle t. Of some facets that look at each other the last one puts right what the
 * earlier ones could not know.
 */
static void put_facet(yb_load_t *load, int t, const facet_t *facet)
{
    for (int k = 0; k < 3; k++) {
        load->corners[3 * t + k] = (yb_index_t)facet->v[k];
        load->star[facet->v[k]] = (yb_triangle_t)t;
    }
    load->across[t] = 0;
    for (int k = 0; k < 3; k++)
        link_half(load, 4 * t + k, facet->across[k]);
}

/* Replaces the common edge ab of the triangle of e and its neighbour by the other diagonal dc of
 * their quad. With (a b c) before, e being ab, it becomes (a d c) and the neighbour (d b c).
 */
static void flip(yb_load_t *load, half_t e)
{
    facet_t p; /* a b c */
    facet_t q; /* b a d */
    take_facet(load, e, &p);
    take_facet(load, twin_of(load, e), &q);
    int t = triangle_of(e);
    int u = p.across[0];
    int bc = p.across[1];
    p.v[1] = q.v[2];
    p.across[0] = q.across[1];
    p.across[1] = u;
    put_facet(load, t, &p);
    q.v[1] = q.v[0];
    q.v[0] = q.v[2];
    q.v[2] = p.v[2];
    q.across[0] = q.across[2];
    q.across[1] = bc;
    q.across[2] = t;
    put_facet(load, u, &q);
}

/* Is an edge to be flipped? It is if the circle through the corners of either triangle holds the
 * other one's apex: if the angles at the two of them are more than two right ones together, which
 * is what the sum of their cotangents tells. Products are below 2^58.
 */
static bool illegal(const yb_load_t *load, half_t e)
{
    if (entry_of(load, e) >= NO_TRIANGLE) /* the frame, or marked */
        return false;
    half_t twin = twin_of(load, e);
    angle_t here;
    angle_t there;
    find_angle(load, e, &here);
    find_angle(load, twin, &there);
    int64_t outside = fix_add(fix_wide(here.dot, there.area), there.dot, here.area);
    if (outside != 0)
        return outside < 0;
    return fix_min(apex_of(load, e), apex_of(load, twin)) < lower_end(load, e);
}

/* Legalises all edges opposite the new vertex p: once round it, counter-clockwise. A flip gives p
 * one more triangle, whose edge is looked at next; a spoke of p is never flipped, so the walk ends
 * when it comes to the spoke it started with.
 */
void mesh_legalise(yb_load_t *load, int p)
{
    half_t e = first_spoke(load, p);
    int first_end = end_of(load, e);
    do {
        for (half_t far = next_of(e); illegal(load, far); far = e - 2) {
            flip(load, far); /* its triangle is now (a d p): the first of the two new ones */
            e = place_inside(e) - 1;
        }
        e = spoke_left(load, e);
    } while (e != NO_HALF && end_of(load, e) != first_end);
}

/* Finds the place of p by walking towards it from the triangle that begins with e; NO_HALF: there
 * is a vertex. In a Delaunay triangulation such a walk never goes in circles.
 */
static half_t locate(const yb_load_t *load, half_t e, const yb_vertex_t *p)
{
    half_t place = place_inside(e);
    while (!is_inside(e)) {
        int32_t side = side_of(load, e, p);
        if (side < 0) { /* p is in the frame: there is a triangle beyond */
            place = place_inside(twin_of(load, e));
            e = place - 3;
            continue;
        }
        if (side == 0) {
            if (!is_inside(place))
                return NO_HALF;
            place = e;
        }
        e++;
    }
    return place;
}

/* Splits t = (a b c) at p into (a b p), (b c p), (c a p), where p may lie on ab. Then a b p is
 * flat: it is flipped away, or, on the frame, left out.
 */
static void split(yb_load_t *load, half_t place, int p)
{
    yb_map_t *map = load->map;
    facet_t f;
    take_facet(load, is_inside(place) ? place - 3 : place, &f);
    bool on_side = !is_inside(place) && f.across[0] == NO_TRIANGLE;
    int t = triangle_of(place);
    int part[3] = {NO_TRIANGLE, t, (int)map->triangle_count++};
    if (!on_side)
        part[0] = (int)map->triangle_count++;
    for (int k = 0, before = 2; k < 3; before = k++) {
        int after = 3 - before - k;
        facet_t facet = {{f.v[k], f.v[after], p}, {f.across[k], part[after], part[before]}};
        if (part[k] == NO_TRIANGLE)
            continue;
        load->region[part[k]] = load->region[t];
        put_facet(load, part[k], &facet);
    }
    if (!is_inside(place) && !on_side)
        flip(load, 4 * part[0]);
}

bool mesh_insert(yb_load_t *load, half_t place, const yb_vertex_t *at)
{
    int p = load->vertex_count;
    if (!mesh_add_vertex(load, at))
        return false;
    split(load, place, p);
    return true;
}

static bool is_corner(const yb_load_t *load, int p)
{
    int k = 0;
    while (k < 4 && load->corner[k] != p)
        k++;
    return k < 4;
}

static bool insert_all(yb_load_t *load)
{
    yb_map_t *map = load->map;
    const yb_index_t *corner = load->corner;
    facet_t half = {{corner[0], corner[1], corner[2]}, {NO_TRIANGLE, NO_TRIANGLE, NO_TRIANGLE}};
    map->triangle_count = 2;
    put_facet(load, 0, &half);
    half.v[1] = corner[2];
    half.v[2] = corner[3];
    half.across[0] = 0;
    put_facet(load, 1, &half);
    mesh_legalise(load, corner[1]); /* the diagonal */
    int t = 0;
    /* Those of the frame's corners that no line ends at are the last vertices. */
    for (int p = 0; p < load->point_count; p++) {
        if (is_corner(load, p))
            continue;
        half_t place = locate(load, 4 * t, vertex_of(load, p));
        if (place == NO_HALF)
            return false;
        split(load, place, p);
        mesh_legalise(load, p);
        t = (int)load->star[p];
    }
    return true;
}

/* Flips away all edges at v between the spokes to `from` and `to` (counter-clockwise), given that
 * the angle between them is convex and all vertices between lie beyond the line from-to. Those
 * form, with from and to, a polygon that always has a corner strictly bulging away from v: the edge
 * to it can be flipped. So each round removes one.
 */
static void clear_fan(yb_load_t *load, int v, int from, int to)
{
    half_t e = spoke_to(load, v, from);
    while (apex_of(load, e) != to) {
        half_t left = spoke_left(load, e);
        if (orientation(load, end_of(load, e), end_of(load, left), apex_of(load, left)) > 0) {
            flip(load, last_of(e));
            left = spoke_to(load, v, from);
        }
        e = left;
    }
}

static void mark(yb_load_t *load, half_t e)
{
    facet_t facet;
    int t = triangle_of(e);
    take_facet(load, 4 * t, &facet);
    facet.across[e & 3] |= ENTRY_MARK;
    put_facet(load, t, &facet);
}

/* Walks along the channel of ab, which is entered from a across e. To `narrow` it takes one vertex
 * off it: the first at which a side of the channel bulges away from ab. There is one: that farthest
 * from ab. False: a vertex or a marked edge is in the way.
 */
static bool walk_channel(yb_load_t *load, half_t e, int a, int b, bool narrow)
{
    int right_before = a;
    int left_before = a;
    while (!is_marked(load, e)) {
        int right = origin_of(load, e);
        int left = end_of(load, e);
        e = twin_of(load, e);
        int apex = apex_of(load, e);
        int32_t side = orientation(load, a, b, apex);
        if (side == 0 && apex != b)
            return false; /* a contour runs through a point of another */
        if (narrow && side >= 0 && orientation(load, left_before, left, apex) < 0) {
            clear_fan(load, left, left_before, apex);
            return true;
        }
        if (narrow && side <= 0 && orientation(load, right_before, right, apex) > 0) {
            clear_fan(load, right, apex, right_before);
            return true;
        }
        if (side == 0)
            return true;
        /* Now e is left-right: go on through the edge from the apex to the other side. */
        if (side > 0) {
            left_before = left;
            e = next_of(e);
        } else {
            right_before = right;
            e = last_of(e);
        }
    }
    return false; /* two contours cross */
}

/* To `force` ab, it is made an edge and marked: the triangles it crosses form a
 * channel; each round takes one vertex off the channel's sides (those edges that it had across the
 * channel are flipped to its neighbours), until none is left between a and b. Each vertex leaves
 * once: it always ends. What can be an edge can be forced.
 */
bool mesh_reach(yb_load_t *load, int a, int b, bool force)
{
    for (;;) {
        half_t e = first_spoke(load, a);
        for (; e != NO_HALF; e = spoke_after(load, e)) {
            /* Does a side of the triangle on the spoke's left lead to b, or back? */
            half_t edge = end_of(load, e) == b ? e : last_of(e);
            if (edge == e || origin_of(load, edge) == b) {
                if (force)
                    mark(load, edge);
                return true;
            }
            /* Does the segment leave on the left of this spoke? */
            if (orientation(load, a, end_of(load, e), b) > 0 &&
                orientation(load, a, b, apex_of(load, e)) > 0)
                break;
        }
        if (e == NO_HALF || !walk_channel(load, next_of(e), a, b, force))
            return false; /* another vertex is in the way, or a marked edge */
        if (!force)
            return true;
    }
}

bool mesh_link(yb_load_t *load, int a, int b)
{
    return mesh_sees(load, a, b) && mesh_force_edge(load, a, b);
}

static bool force_contours(yb_load_t *load)
{
    for (int i = 0; i < load->contour_count; i++) {
        const yb_contour_t *contour = &load->contour[i];
        int first = contour->first;
        int edges =
            is_open(load, contour) || contour->count == 1 ? contour->count - 1 : contour->count;
        for (int k = 1; k <= edges; k++) {
            if (!mesh_force_edge(load, first + k - 1, k < contour->count ? first + k : first))
                return false;
        }
    }
    return true;
}

/* Flips until no edge is illegal: each is looked at from its first triangle alone. Each flip lowers
 * the lifted surface, so this ends.
 */
void mesh_make_delaunay(yb_load_t *load)
{
    bool flipped = true;
    while (flipped) {
        flipped = false;
        for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
            if (entry_of(load, e) > triangle_of(e) && illegal(load, e)) {
                flip(load, e);
                flipped = true;
            }
        }
    }
}

bool mesh_triangulate(yb_load_t *load)
{
    if (!insert_all(load) || !force_contours(load))
        return false;
    mesh_make_delaunay(load);
    return true;
}
