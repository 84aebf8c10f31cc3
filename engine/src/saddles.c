/* Saddles: link points between neighbouring peaks (faithful paper, 5.1 and 7).
 *
 * Two lines of one height that hold a peak each, side by side in one region, have a pass between
 * them. The paper joins the two peaks by a straight segment, and where the slopes from both sides
 * meet on it there is a link point, half way in height to the region's other lines.
 */
#include "links.h"

enum {
    OUTSIDE = 3,       /* of a triangle */
    MOST_REFUSALS = 16 /* of pairs of peaks in one region */
};

/* The height of the region's other lines, or frame corners, that is nearest to h; h if none. */
static int32_t other_height(const place_t *place, int32_t h)
{
    const yb_load_t *load = place->load;
    int32_t nearest = h;
    for (int c = 0; c < load->contour_count + 4; c++) {
        int32_t z = h;
        if (c < load->contour_count) {
            if (bounds(place, c))
                z = height_of(place, c);
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

/* The lines of one height round a region, and the other height that the passes between go down to.
 */
typedef struct {
    const place_t *place;
    int32_t h, other;
} level_t;

/* Two peaks behind two of these lines, and how far they are apart. */
typedef struct {
    int a, b; /* spot heights */
    int32_t apart;
} pair_t;

/* Where edge pq crosses the segment ab, in 1/65536 of its length; -1: it does not. An end of pq
 * that lies on ab counts as lying to the right of it. Areas are within 2^29, their difference 2^30.
 */
static int32_t crossing(const yb_map_t *map, yb_index_t a, yb_index_t b, yb_index_t p, yb_index_t q)
{
    int32_t from = orientation(map, p, q, a);
    int32_t to = orientation(map, p, q, b);
    if ((from > 0) == (to > 0) ||
        (orientation(map, a, b, p) > 0) == (orientation(map, a, b, q) > 0))
        return -1;
    return fix_scale(from, 65536, from - to);
}

/* Of all places between `after` and `before` at which the segment ab crosses a line, the first one,
 * or the last; -1: there is none.
 */
static int32_t find_crossing(const place_t *place, int line, yb_index_t a, yb_index_t b,
                             int32_t after, int32_t before, bool last)
{
    const yb_contour_t *c = &place->load->contour[line];
    int32_t found = -1;
    for (int k = c->open ? 1 : 0; k < c->count; k++) {
        yb_index_t p = (yb_index_t)(c->first + (k == 0 ? c->count : k) - 1);
        int32_t at = crossing(place->map, a, b, p, (yb_index_t)(c->first + k));
        if (at > after && at < before && (found < 0 || (at > found) == last))
            found = at;
    }
    return found;
}

/* Where the segment between two peaks leaves the line of the first for good and enters that of the
 * second. False: another line is in between.
 */
static bool find_gap(const place_t *place, yb_index_t a, yb_index_t b, int line_a, int line_b,
                     int32_t *leaves, int32_t *enters)
{
    *enters = find_crossing(place, line_b, a, b, -1, 65537, false);
    *leaves = find_crossing(place, line_a, a, b, -1, *enters, true);
    for (int c = 0; c < place->load->contour_count; c++) {
        if (bounds(place, c) && find_crossing(place, c, a, b, *leaves, *enters, false) >= 0)
            return false;
    }
    return *leaves >= 0;
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
    return nearest < 0 ? YB_OK : mesh_force_edge(place->map, load, m, (yb_index_t)nearest);
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
        if (side < 0 || (side == 0 && (on >= 0 || is_marked(place->load, t, i))))
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

/* From a to b, in 1/65536 of the way, on the quarter-step lattice. Plan differences are multiples
 * of 4 below 2^16: a quarter of one, times 2^16, is below 2^30.
 */
static uint16_t part_way(uint16_t a, uint16_t b, int32_t at_q16)
{
    int32_t way = ((fix_minus(b, a) >> 2) * at_q16 + (1 << 13)) >> 14;
    return (uint16_t)((a + way + 32) & ~(int32_t)63);
}

/* The link point of two peaks (5.1): where their slopes meet. With the segment between them leaving
 * one line at `leaves` and entering the other at `enters`, and s = rise / run the slope of each
 * from its peak to its line, it divides the gap as s_b : s_a. Only where the mesh joins the two
 * lines, though: with a third line in between they are no neighbours.
 */
static yb_status_t join(const level_t *level, const pair_t *pair, bool *joined)
{
    const place_t *place = level->place;
    yb_map_t *map = place->map;
    yb_load_t *load = place->load;
    int line_a = line_before(place, pair->a);
    int line_b = line_before(place, pair->b);
    const yb_vertex_t *a = first_of(place, pair->a);
    const yb_vertex_t *b = first_of(place, pair->b);
    int32_t leaves = 0;
    int32_t enters = 0;
    *joined = false;
    if (!find_gap(place, load->contour[pair->a].first, load->contour[pair->b].first, line_a, line_b,
                  &leaves, &enters))
        return YB_OK;
    /* Rises are below 2^18 and runs at most 2^16: each product below 2^34. */
    int64_t weight_a = (int64_t)fix_abs(a->z_q8 - level->h) * (65536 - enters);
    int64_t weight_b = (int64_t)fix_abs(b->z_q8 - level->h) * leaves;
    int32_t gap = enters - leaves;
    int32_t at = leaves + (int32_t)(gap * weight_b / (weight_a + weight_b + 1));
    at = fix_clamp(at, leaves + gap / 8, enters - gap / 8);
    yb_vertex_t link = {.x_q8 = part_way(a->x_q8, b->x_q8, at),
                        .y_q8 = part_way(a->y_q8, b->y_q8, at)};
    yb_triangle_t t = 0;
    int edge = -1;
    if (!find_between(place, &link, line_a, line_b, &t, &edge))
        return YB_OK;
    yb_index_t m = (yb_index_t)map->vertex_count;
    if (mesh_add_vertex(map, load, link.x_q8, link.y_q8, (level->h + level->other) / 2) != YB_OK)
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

/* The line of this level that spot height s stands behind, if it is a peak: if it lies on the far
 * side of the line's height. Else NOWHERE.
 */
static int peak_behind(const level_t *level, int s)
{
    int line = line_before(level->place, s);
    if (line == NOWHERE || height_of(level->place, line) != level->h)
        return NOWHERE;
    int32_t up = height_of(level->place, s) - level->h;
    return up != 0 && (up > 0) == (level->h > level->other) ? line : NOWHERE;
}

static bool comes_after(const pair_t *pair, const pair_t *last)
{
    if (pair->apart != last->apart)
        return pair->apart > last->apart;
    return pair->a > last->a || (pair->a == last->a && pair->b > last->b);
}

/* The nearest pair of peaks (wish[s]: the line that spot height s stands behind) whose
 * lines are not joined yet and that comes after `last`, in the order of distance, then of the spot
 * heights' numbers.
 */
static bool next_pair(const level_t *level, const pair_t *last, pair_t *next)
{
    const yb_load_t *load = level->place->load;
    bool found = false;
    for (int a = 0; a < all_contours(load); a++) {
        int line_a = load->wish[a];
        for (int b = a + 1; b < all_contours(load) && line_a != NOWHERE; b++) {
            int line_b = load->wish[b];
            if (line_b == NOWHERE || line_b == line_a ||
                group_of(load, line_a) == group_of(load, line_b))
                continue;
            pair_t pair = {
                a, b,
                edge_length(level->place->map, load->contour[a].first, load->contour[b].first)};
            if (comes_after(&pair, last) && (!found || comes_after(next, &pair))) {
                found = true;
                *next = pair;
            }
        }
    }
    return found;
}

/* Nearest pairs first, until all are joined or too many could not be (7). What is left, the
 * skeleton joins.
 */
static yb_status_t join_level(const level_t *level)
{
    yb_load_t *load = level->place->load;
    pair_t last = {.apart = -1};
    pair_t pair = last;
    int refusals = 0;
    for (int s = 0; s < all_contours(load); s++)
        load->wish[s] = (yb_index_t)peak_behind(level, s);
    while (refusals < MOST_REFUSALS && next_pair(level, &last, &pair)) {
        bool joined = false;
        if (join(level, &pair, &joined) != YB_OK)
            return YB_ERR_LIMIT;
        if (joined)
            load->group[group_of(load, load->wish[pair.a])] = group_of(load, load->wish[pair.b]);
        else
            refusals++;
        last = pair;
    }
    return YB_OK;
}

yb_status_t saddles_add(const place_t *place)
{
    yb_load_t *load = place->load;
    for (int c = 0; c < load->contour_count; c++)
        load->group[c] = (yb_index_t)c;
    for (int c = 0; c < load->contour_count; c++) {
        if (!bounds(place, c))
            continue;
        level_t level = {place, height_of(place, c), 0};
        level.other = other_height(place, level.h);
        int first = 0;
        while (!bounds_at(place, first, level.h))
            first++;
        bool has_between = fix_abs(level.h - level.other) >= 2;
        if (first == c && has_between && join_level(&level) != YB_OK)
            return YB_ERR_LIMIT;
    }
    return YB_OK;
}
