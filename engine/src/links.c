/* The edges that the papers want, and the points between peaks (faithful paper, 4, 5 and 7).
 *
 * All rules of a region speak of *peaks*: the spot heights beyond its lines, each behind one line
 * of the region. A peak may as well be the bottom of a pit: what counts is that the ground goes on
 * in the direction in which it crosses the region. Links are wishes: one that would cross a line or
 * an earlier link is not granted.
 */
#include "mesh.h"

enum {
    NOWHERE = YB_MAX_CONTOURS, /* no line leads to this region */
    OUTSIDE = 3                /* of a triangle */
};

/* A region while its rules are applied; load->scratch[r] is the line that leads to region r. */
typedef struct {
    yb_map_t *map;
    yb_load_t *load;
    yb_index_t region;
} place_t;

static const yb_vertex_t *first_of(const place_t *place, int contour)
{
    return &place->map->vertex[place->load->contour[contour].first];
}

static bool is_line(const yb_contour_t *contour)
{
    return contour->count > 1;
}

static bool bounds(const place_t *place, int contour)
{
    const yb_contour_t *c = &place->load->contour[contour];
    return is_line(c) && (c->left == place->region || c->right == place->region);
}

/* Spot heights: those of the code and those that were added. */
static int all_contours(const yb_load_t *load)
{
    return load->contour_count + load->summit_count;
}

/* Finds for every other region which line of this one leads to it. */
static void look_beyond(const place_t *place)
{
    yb_load_t *load = place->load;
    for (int r = 0; r < load->region_count; r++)
        load->scratch[r] = NOWHERE;
    for (int c = 0; c < load->contour_count; c++) {
        if (bounds(place, c)) {
            const yb_contour_t *line = &load->contour[c];
            load->scratch[line->left == place->region ? line->right : line->left] = (yb_index_t)c;
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int c = 0; c < load->contour_count; c++) {
            const yb_contour_t *line = &load->contour[c];
            if (!is_line(line) || bounds(place, c))
                continue;
            yb_index_t l = load->scratch[line->left];
            yb_index_t r = load->scratch[line->right];
            if (l == r)
                continue;
            load->scratch[l == NOWHERE ? line->left : line->right] = l == NOWHERE ? r : l;
            changed = true;
        }
    }
}

/* The line of the region behind which spot height s lies, or NOWHERE. */
static int line_before(const place_t *place, int s)
{
    const yb_contour_t *spot = &place->load->contour[s];
    if (is_line(spot) || spot->left == place->region)
        return NOWHERE;
    return place->load->scratch[spot->left];
}

/* --- 5.1, 7: link points between neighbouring peaks ------------------------------------------- */

/* The height of the region's other lines, or frame corners, that is nearest to h; h if none. */
static int32_t other_height(const place_t *place, int32_t h)
{
    const yb_load_t *load = place->load;
    int32_t nearest = h;
    for (int c = 0; c < load->contour_count + 4; c++) {
        int32_t z = h;
        if (c < load->contour_count) {
            if (bounds(place, c))
                z = first_of(place, c)->z_q8;
        } else {
            yb_index_t corner = load->corner[c - load->contour_count];
            if (load->region[load->star[corner]] == place->region)
                z = place->map->vertex[corner].z_q8;
        }
        if (z != h && (nearest == h || fix_abs(z - h) < fix_abs(nearest - h)))
            nearest = z;
    }
    return nearest;
}

/* Two peaks behind two lines of one height, and how far they are apart. */
typedef struct {
    int a, b; /* spot heights */
    int32_t apart;
} pair_t;

/* Where the segment between two peaks leaves the line of the first and enters that of the second,
 * in 1/65536 of its length. False: something else is in between.
 */
static bool find_gap(const place_t *place, yb_index_t a, yb_index_t b, int line_a, int line_b,
                     uint32_t *leaves, uint32_t *enters)
{
    const yb_load_t *load = place->load;
    const yb_map_t *map = place->map;
    bool inside = false; /* the region */
    mesh_walk_t walk;
    mesh_step_t step = mesh_walk_begin(map, load, a, b, &walk);
    for (; step == WALK_CROSSES; step = mesh_walk_on(map, load, &walk)) {
        if (mark_of(load, walk.t, walk.edge) != YB_RULE_CONTOUR)
            continue;
        yb_index_t p = map->triangle[walk.t][walk.edge];
        yb_index_t q = map->triangle[walk.t][next3(walk.edge)];
        int64_t from = orientation(map, p, q, a);
        int64_t to = orientation(map, p, q, b);
        uint32_t at = (uint32_t)((from << 16) / (from - to));
        if (!inside && load->region[neighbour_of(load, walk.t, walk.edge)] == place->region) {
            inside = true;
            *leaves = at;
        } else if (inside) {
            int line = load->scratch[load->region[neighbour_of(load, walk.t, walk.edge)]];
            *enters = at;
            if (line == line_b)
                return true;
            if (line != line_a)
                return false;
            inside = false;
        }
    }
    return false;
}

/* Links m to the nearest point of a line that it sees. */
static yb_status_t link_to_line(const place_t *place, yb_index_t m, int line)
{
    yb_load_t *load = place->load;
    const yb_contour_t *contour = &load->contour[line];
    int nearest = -1;
    int32_t least = INT32_MAX;
    for (int k = 0; k < contour->count; k++) {
        yb_index_t p = (yb_index_t)(contour->first + k);
        int32_t length = edge_length(place->map, m, p);
        if (length < least && mesh_sees(place->map, load, m, p)) {
            nearest = p;
            least = length;
        }
    }
    return nearest < 0 ? YB_OK
                       : mesh_force_edge(place->map, load, m, (yb_index_t)nearest, YB_RULE_SADDLE);
}

static bool has_corner_on(const place_t *place, yb_triangle_t t, int line)
{
    const yb_contour_t *c = &place->load->contour[line];
    for (int i = 0; i < 3; i++) {
        int v = place->map->triangle[t][i];
        if (v >= c->first && v < c->first + c->count)
            return true;
    }
    return false;
}

/* Where p lies in triangle t: -1: inside, 0 to 2: on this edge, which is not marked, OUTSIDE. */
static int side_in(const place_t *place, yb_triangle_t t, const yb_vertex_t *p)
{
    const yb_vertex_t *v = place->map->vertex;
    int on = -1;
    for (int i = 0; i < 3; i++) {
        int32_t side =
            area_of(&v[place->map->triangle[t][i]], &v[place->map->triangle[t][next3(i)]], p);
        if (side < 0 || (side == 0 && (on >= 0 || mark_of(place->load, t, i) != YB_RULE_NONE)))
            return OUTSIDE;
        if (side == 0)
            on = i;
    }
    return on;
}

/* The triangle between two lines that holds point p. */
static bool find_between(const place_t *place, const yb_vertex_t *p, int line_a, int line_b,
                         yb_triangle_t *at, int *edge)
{
    for (yb_triangle_t t = 0; t < place->map->triangle_count; t++) {
        *at = t;
        *edge = side_in(place, t, p);
        if (*edge != OUTSIDE && has_corner_on(place, t, line_a) && has_corner_on(place, t, line_b))
            return true;
    }
    return false;
}

/* The link point of two peaks (5.1): where their slopes meet. With the segment between them leaving
 * one line at `leaves` and entering the other at `enters`, and s = rise / run the slope of each
 * from its peak to its line, it divides the gap as s_b : s_a. Only where the mesh joins the two
 * lines, though: with a third line in between they are no neighbours.
 */
static yb_status_t join(const place_t *place, const pair_t *pair, int32_t z, bool *joined)
{
    yb_map_t *map = place->map;
    yb_load_t *load = place->load;
    int line_a = line_before(place, pair->a);
    int line_b = line_before(place, pair->b);
    const yb_vertex_t *a = first_of(place, pair->a);
    const yb_vertex_t *b = first_of(place, pair->b);
    uint32_t leaves = 0;
    uint32_t enters = 0;
    *joined = false;
    if (!find_gap(place, load->contour[pair->a].first, load->contour[pair->b].first, line_a, line_b,
                  &leaves, &enters))
        return YB_OK;
    /* Rises are below 2^18 and runs at most 2^16: each product below 2^34. */
    int32_t h = first_of(place, line_a)->z_q8;
    int64_t weight_a = (int64_t)fix_abs(a->z_q8 - h) * (65536 - enters);
    int64_t weight_b = (int64_t)fix_abs(b->z_q8 - h) * leaves;
    int64_t gap = enters - leaves;
    int64_t at = leaves + gap * weight_b / (weight_a + weight_b + 1);
    at = at < leaves + gap / 8 ? leaves + gap / 8 : at;
    at = at > enters - gap / 8 ? enters - gap / 8 : at;
    /* On the quarter-step lattice. */
    int64_t x = a->x_q8 + (((b->x_q8 - a->x_q8) * at + 32768) >> 16);
    int64_t y = a->y_q8 + (((b->y_q8 - a->y_q8) * at + 32768) >> 16);
    yb_vertex_t link = {.x_q8 = (uint16_t)((x + 32) & ~63), .y_q8 = (uint16_t)((y + 32) & ~63)};
    yb_triangle_t t = 0;
    int edge = -1;
    if (!find_between(place, &link, line_a, line_b, &t, &edge))
        return YB_OK;
    yb_index_t m = (yb_index_t)map->vertex_count;
    if (mesh_add_vertex(map, load, link.x_q8, link.y_q8, z) != YB_OK)
        return YB_ERR_LIMIT;
    *joined = true;
    mesh_split(map, load, t, edge, m);
    mesh_legalise(map, load, m);
    yb_status_t status = link_to_line(place, m, line_a);
    if (status == YB_OK)
        status = link_to_line(place, m, line_b);
    mesh_make_delaunay(map, load); /* so that the next one finds the one and only mesh */
    return status;
}

static yb_index_t group_of(const yb_load_t *load, int line)
{
    while (load->group[line] != line)
        line = load->group[line];
    return (yb_index_t)line;
}

/* May these two peaks be joined: behind two lines of one height that are not joined yet, both on
 * the far side of the region's other height?
 */
static bool may_join(const place_t *place, int a, int b, int32_t *between)
{
    const yb_load_t *load = place->load;
    int line_a = line_before(place, a);
    int line_b = line_before(place, b);
    if (line_a == NOWHERE || line_b == NOWHERE || line_a == line_b)
        return false;
    int32_t h = first_of(place, line_a)->z_q8;
    if (first_of(place, line_b)->z_q8 != h || group_of(load, line_a) == group_of(load, line_b))
        return false;
    int32_t other = other_height(place, h);
    int32_t up_a = first_of(place, a)->z_q8 - h;
    int32_t up_b = first_of(place, b)->z_q8 - h;
    *between = (h + other) / 2;
    return h > other ? up_a > 0 && up_b > 0 : h < other && up_a < 0 && up_b < 0;
}

/* The nearest pair that may be joined and comes after `last`, in the order of distance, then of
 * the spot heights' numbers.
 */
static bool next_pair(const place_t *place, const pair_t *last, pair_t *next, int32_t *between)
{
    bool found = false;
    for (int a = 0; a < all_contours(place->load); a++) {
        if (line_before(place, a) == NOWHERE)
            continue;
        for (int b = a + 1; b < all_contours(place->load); b++) {
            int32_t z = 0;
            if (!may_join(place, a, b, &z))
                continue;
            int32_t apart = edge_length(place->map, place->load->contour[a].first,
                                        place->load->contour[b].first);
            bool after = apart > last->apart ||
                         (apart == last->apart && (a > last->a || (a == last->a && b > last->b)));
            if (!after || (found && apart >= next->apart))
                continue;
            found = true;
            next->a = a;
            next->b = b;
            next->apart = apart;
            *between = z;
        }
    }
    return found;
}

/* Nearest pairs first, until all are joined or nothing more can be (7). */
static yb_status_t join_peaks(const place_t *place)
{
    yb_load_t *load = place->load;
    pair_t last = {.apart = -1};
    pair_t pair = last;
    int32_t z = 0;
    for (int c = 0; c < load->contour_count; c++)
        load->group[c] = (yb_index_t)c;
    while (next_pair(place, &last, &pair, &z)) {
        bool joined = false;
        if (join(place, &pair, z, &joined) != YB_OK)
            return YB_ERR_LIMIT;
        if (joined)
            load->group[group_of(load, line_before(place, pair.a))] =
                group_of(load, line_before(place, pair.b));
        last = pair;
    }
    return YB_OK;
}

/* --- 4.1: fans -------------------------------------------------------------------------------- */

/* The peak whose slope rules point p: the steepest way up from p, or down to a pit (tan θ, 5.1). In
 * a leaf (line < 0) one of those in it; else one beyond another line, if the ground goes on there
 * the way it goes to that line. -1: none.
 */
static int ruler_of(const place_t *place, yb_index_t p, int line)
{
    const yb_load_t *load = place->load;
    int32_t z = place->map->vertex[p].z_q8;
    int ruler = -1;
    int64_t rise = 0;
    int64_t run = 1;
    for (int s = 0; s < all_contours(load); s++) {
        const yb_contour_t *spot = &load->contour[s];
        int32_t top = first_of(place, s)->z_q8;
        if (is_line(spot) || (line < 0) != (spot->left == place->region))
            continue;
        if (line >= 0) {
            int before = line_before(place, s);
            int32_t h = before == NOWHERE ? z : first_of(place, before)->z_q8;
            if (before == line || h == z || top == h || (h > z) != (top > h))
                continue;
        }
        int64_t up = fix_abs(top - z);
        int64_t along = edge_length(place->map, p, spot->first);
        if (up * run > rise * along) {
            ruler = s;
            rise = up;
            run = along;
        }
    }
    return ruler;
}

/* Is the leaf narrower at point p than the summit is far: is a point of the same height across it
 * nearer? Then p stands by a ridge, which the skeleton will follow.
 */
static bool by_a_ridge(const place_t *place, yb_index_t p, yb_index_t summit)
{
    const yb_map_t *map = place->map;
    const yb_load_t *load = place->load;
    int32_t far = edge_length(map, p, summit);
    yb_triangle_t first = first_at(map, load, p);
    for (yb_triangle_t t = first; t != NO_TRIANGLE; t = turn_on(map, load, t, p, first)) {
        int at = corner_of(map, t, p);
        yb_index_t q = map->triangle[t][next3(at)];
        if (load->region[t] == place->region && mark_of(load, t, at) == YB_RULE_NONE &&
            map->vertex[q].z_q8 == map->vertex[p].z_q8 && edge_length(map, p, q) < far)
            return true;
    }
    return false;
}

/* All of a leaf's points to its summit. First all wishes, then all links: a wish sees the mesh that
 * the others saw.
 */
static yb_status_t fan(const place_t *place, int line)
{
    yb_load_t *load = place->load;
    const yb_contour_t *contour = &load->contour[line];
    for (int k = 0; k < contour->count; k++) {
        yb_index_t p = (yb_index_t)(contour->first + k);
        int s = ruler_of(place, p, -1);
        yb_index_t summit = s < 0 ? p : load->contour[s].first;
        load->branch[p].parent = s < 0 || by_a_ridge(place, p, summit) ? p : summit;
    }
    for (int k = 0; k < contour->count; k++) {
        yb_index_t p = (yb_index_t)(contour->first + k);
        yb_index_t summit = load->branch[p].parent;
        if (summit != p && mesh_sees(place->map, load, p, summit) &&
            mesh_force_edge(place->map, load, p, summit, YB_RULE_SUMMIT) != YB_OK)
            return YB_ERR_LIMIT;
    }
    return YB_OK;
}

/* --- 4.2, 5.1 (3), 5.2: links down the slope ---------------------------------------------------
 */

/* Distance of point p from the segment ab, in 1/64 steps. */
static int32_t distance(const yb_map_t *map, yb_index_t p, yb_index_t a, yb_index_t b)
{
    const yb_vertex_t *v = map->vertex;
    int64_t abx = (v[b].x_q8 - v[a].x_q8) / 4;
    int64_t aby = (v[b].y_q8 - v[a].y_q8) / 4;
    int64_t apx = (v[p].x_q8 - v[a].x_q8) / 4;
    int64_t apy = (v[p].y_q8 - v[a].y_q8) / 4;
    int64_t along = abx * apx + aby * apy;
    int64_t square = abx * abx + aby * aby;
    if (along <= 0)
        return fix_length((int32_t)apx, (int32_t)apy);
    if (along >= square)
        return fix_length((int32_t)(apx - abx), (int32_t)(apy - aby));
    int32_t off = orientation(map, a, b, p);
    return (int32_t)(fix_abs(off) / (int32_t)(fix_sqrt((uint64_t)square)));
}

enum {
    TRIES = 4 /* of the next nearest points, before one stays unlinked */
};

/* The point of the region's lines of height h that is nearest to the segment from p to its peak,
 * after `last` in the order of distance and number; -1: none. And how near the nearest point is to
 * p itself.
 */
static int nearest_to_slope(const place_t *place, yb_index_t p, yb_index_t peak, int32_t h,
                            int32_t *last, int last_q, int32_t *shortest)
{
    const yb_load_t *load = place->load;
    int nearest = -1;
    int32_t least = INT32_MAX;
    for (int c = 0; c < load->contour_count; c++) {
        if (!bounds(place, c) || first_of(place, c)->z_q8 != h)
            continue;
        for (int k = 0; k < load->contour[c].count; k++) {
            yb_index_t q = (yb_index_t)(load->contour[c].first + k);
            int32_t off = distance(place->map, q, p, peak);
            *shortest = fix_min(*shortest, edge_length(place->map, p, q));
            if ((off > *last || (off == *last && q > last_q)) && off < least) {
                nearest = q;
                least = off;
            }
        }
    }
    *last = least;
    return nearest;
}

/* Links p to the next line where the segment to its peak comes nearest to a point of it. Not where
 * that is more than a quarter longer than the shortest way to the line: the slope then leads
 * elsewhere, whatever the peak.
 */
static yb_status_t link_down(const place_t *place, yb_index_t p, int line)
{
    yb_load_t *load = place->load;
    int s = ruler_of(place, p, line);
    if (s < 0)
        return YB_OK;
    yb_index_t peak = load->contour[s].first;
    int32_t h = first_of(place, line_before(place, s))->z_q8;
    int32_t shortest = INT32_MAX;
    int32_t last = -1;
    int q = -1;
    for (int tries = 0; tries < TRIES; tries++) {
        q = nearest_to_slope(place, p, peak, h, &last, q, &shortest);
        if (q < 0 || edge_length(place->map, p, (yb_index_t)q) > shortest + (shortest >> 2))
            return YB_OK;
        if (mesh_sees(place->map, load, p, (yb_index_t)q))
            return mesh_force_edge(place->map, load, p, (yb_index_t)q, YB_RULE_SLOPE);
    }
    return YB_OK;
}

/* Twice the area that a closed line goes round counter-clockwise. */
static bool turns_left(const yb_map_t *map, const yb_contour_t *line)
{
    int64_t area = 0;
    for (int k = 1; k + 1 < line->count; k++)
        area += orientation(map, line->first, (yb_index_t)(line->first + k),
                            (yb_index_t)(line->first + k + 1));
    return area > 0;
}

/* Does the line lie round the region, or does it go from frame to frame? */
static bool is_outer(const place_t *place, int line)
{
    const yb_contour_t *c = &place->load->contour[line];
    return c->open || (c->left == place->region) == turns_left(place->map, c);
}

/* -----------------------------------------------------------------------------------------------
 */

static yb_status_t apply_rules(const place_t *place)
{
    yb_load_t *load = place->load;
    int lines = 0;
    int line = 0;
    for (int c = 0; c < load->contour_count; c++) {
        if (bounds(place, c)) {
            lines++;
            line = c;
        }
    }
    if (lines == 1)
        return fan(place, line);
    look_beyond(place);
    if (join_peaks(place) != YB_OK)
        return YB_ERR_LIMIT;
    for (int c = 0; c < load->contour_count; c++) {
        if (!bounds(place, c) || !is_outer(place, c))
            continue;
        for (int k = 0; k < load->contour[c].count; k++) {
            if (link_down(place, (yb_index_t)(load->contour[c].first + k), c) != YB_OK)
                return YB_ERR_LIMIT;
        }
    }
    return YB_OK;
}

/* Does an earlier line, or the left side of this one, bound the region too? */
static bool seen_before(const yb_load_t *load, int side, yb_index_t region)
{
    for (int k = 0; k < side; k++) {
        const yb_contour_t *c = &load->contour[k >> 1];
        if (is_line(c) && ((k & 1) == 0 ? c->left : c->right) == region)
            return true;
    }
    return false;
}

yb_status_t links_add(yb_map_t *map, yb_load_t *load)
{
    /* Regions in the order of the lines that bound them, the left one first. */
    for (int side = 0; side < 2 * load->contour_count; side++) {
        const yb_contour_t *c = &load->contour[side >> 1];
        place_t place = {map, load, (side & 1) == 0 ? c->left : c->right};
        if (!is_line(c) || seen_before(load, side, place.region))
            continue;
        if (apply_rules(&place) != YB_OK)
            return YB_ERR_LIMIT;
    }
    mesh_make_delaunay(map, load);
    return YB_OK;
}

yb_rule_t yb_vertex_rule(const yb_load_t *load, yb_index_t vertex)
{
    return vertex >= load->first_skeleton ? YB_RULE_SKELETON
           : vertex >= load->first_saddle ? YB_RULE_SADDLE
           : vertex >= load->first_summit ? YB_RULE_SUMMIT
                                          : YB_RULE_CONTOUR;
}

yb_rule_t yb_edge_rule(const yb_map_t *map, const yb_load_t *load, yb_triangle_t triangle, int edge)
{
    yb_index_t a = map->triangle[triangle][edge];
    yb_index_t b = map->triangle[triangle][next3(edge)];
    if (mark_of(load, triangle, edge) != YB_RULE_NONE)
        return mark_of(load, triangle, edge);
    /* The way that a branch of a skeleton takes, its beginning included. */
    for (int k = 0; k < 2; k++) {
        yb_index_t v = k == 0 ? a : b;
        yb_index_t w = k == 0 ? b : a;
        if (v < load->first_skeleton)
            continue;
        const yb_branch_t *branch = &load->branch[v];
        if (branch->parent == w || branch->other == w)
            return YB_RULE_SKELETON;
    }
    return YB_RULE_NONE;
}
