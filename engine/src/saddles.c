/* Saddles: link points between neighbouring peaks (faithful paper, 5.1 and 7).
 *
 * Two lines of one height that hold a peak each, side by side in one region, have a pass between
 * them. The paper joins the two peaks by a straight segment, and where the slopes from both sides
 * meet on it there is a link point, half way in height to the region's other lines.
 */
#include "links.h"

enum {
    MOST_REFUSALS = 16 /* of pairs of peaks in one region */
};

/* The height of the region's other lines, or frame corners, that is nearest to h; h if none. */
static int32_t other_height(const yb_load_t *load, int32_t h)
{
    int32_t nearest = h;
    for (int c = 0; c < load->contour_count + 4; c++) {
        int32_t z = h;
        if (c < load->contour_count) {
            if (bounds(load, c))
                z = height_of(load, c);
        } else {
            int corner = load->corner[c - load->contour_count];
            if (load->region[load->star[corner]] == load->here)
                z = height_at(load, corner);
        }
        if (z != h && (nearest == h || fix_abs(z - h) < fix_abs(nearest - h)))
            nearest = z;
    }
    return nearest;
}

/* Two peaks behind two of these lines, and how far they are apart. */
typedef struct {
    int a, b; /* spot heights */
    int32_t apart;
} pair_t;

/* Where edge pq crosses the segment ab, in 1/65536 of its length; -1: it does not. An end of pq
 * that lies on ab counts as lying to the right of it. Areas are within 2^29, their difference 2^30.
 */
static int32_t crossing(const yb_load_t *load, int a, int b, int p, int q)
{
    int32_t from = orientation(load, p, q, a);
    int32_t to = orientation(load, p, q, b);
    if ((from > 0) == (to > 0) ||
        (orientation(load, a, b, p) > 0) == (orientation(load, a, b, q) > 0))
        return -1;
    return fix_scale(from, 65536, from - to);
}

/* Of all places between `after` and `before` at which the segment ab crosses a line, the first one,
 * or the last; -1: there is none.
 */
static int32_t find_crossing(const yb_load_t *load, int line, int a, int b,
                             int32_t after, int32_t before, bool last)
{
    const yb_contour_t *c = &load->contour[line];
    int32_t found = -1;
    for (int k = c->open ? 1 : 0; k < c->count; k++) {
        int p = c->first + (k == 0 ? c->count : k) - 1;
        int32_t at = crossing(load, a, b, p, c->first + k);
        if (at > after && at < before && (found < 0 || (at > found) == last))
            found = at;
    }
    return found;
}

/* Where the segment between two peaks leaves the line of the first for good and enters that of the
 * second. False: another line is in between.
 */
static bool find_gap(const yb_load_t *load, int a, int b, int line_a, int line_b,
                     int32_t *leaves, int32_t *enters)
{
    *enters = find_crossing(load, line_b, a, b, -1, 65537, false);
    *leaves = find_crossing(load, line_a, a, b, -1, *enters, true);
    for (int c = 0; c < load->contour_count; c++) {
        if (bounds(load, c) && find_crossing(load, c, a, b, *leaves, *enters, false) >= 0)
            return false;
    }
    return *leaves >= 0;
}

/* Links m to the nearest point of a line that it sees. */
static yb_status_t link_to_line(yb_load_t *load, int m, int line)
{
    const yb_contour_t *contour = &load->contour[line];
    int nearest = -1;
    int32_t least = INT32_MAX;
    for (int k = 0; k < contour->count; k++) {
        int p = contour->first + k;
        int32_t length = edge_length(load, m, p);
        if (length < least && mesh_sees(load, m, p)) {
            nearest = p;
            least = length;
        }
    }
    return nearest < 0 ? YB_OK : mesh_force_edge(load, m, nearest);
}

/* Is vertex v a point of a line? */
static bool is_on(const yb_load_t *load, int v, int line)
{
    const yb_contour_t *c = &load->contour[line];
    return v >= c->first && v < c->first + c->count;
}

static bool has_corner_on(const yb_load_t *load, half_t e, int line)
{
    return is_on(load, origin_of(load, e), line) || is_on(load, end_of(load, e), line) ||
           is_on(load, apex_of(load, e), line);
}

/* Where p lies in the triangle that begins with half e: the half that it lies on, which is not
 * marked; e, not *on_edge: inside; NO_HALF: outside.
 */
static half_t place_in(const yb_load_t *load, half_t e, const yb_vertex_t *p, bool *on_edge)
{
    half_t found = e;
    *on_edge = false;
    for (; (e & 3) != 3; e++) {
        int32_t side = side_of(load, e, p);
        if (side < 0 || (side == 0 && (*on_edge || is_marked(load, e))))
            return NO_HALF;
        if (side == 0) {
            found = e;
            *on_edge = true;
        }
    }
    return found;
}

/* The triangle between two lines that holds point p, as place_in. */
static half_t find_between(const yb_load_t *load, const yb_vertex_t *p, int line_a, int line_b,
                           bool *on_edge)
{
    for (half_t t = 0; t < halves_of(load); t += 4) {
        half_t e = place_in(load, t, p, on_edge);
        if (e != NO_HALF && has_corner_on(load, e, line_a) && has_corner_on(load, e, line_b))
            return e;
    }
    return NO_HALF;
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
static yb_status_t join(yb_load_t *load, const pair_t *pair, bool *joined)
{
    int line_a = line_before(load, pair->a);
    int line_b = line_before(load, pair->b);
    const yb_vertex_t *a = first_of(load, pair->a);
    const yb_vertex_t *b = first_of(load, pair->b);
    int32_t leaves = 0;
    int32_t enters = 0;
    *joined = false;
    if (!find_gap(load, load->contour[pair->a].first, load->contour[pair->b].first, line_a, line_b,
                  &leaves, &enters))
        return YB_OK;
    /* Rises are below 2^18 and runs at most 2^16: each product below 2^34. */
    int64_t weight_a = (int64_t)fix_abs(a->z_q8 - load->level_q8) * (65536 - enters);
    int64_t weight_b = (int64_t)fix_abs(b->z_q8 - load->level_q8) * leaves;
    int32_t gap = enters - leaves;
    int32_t at = leaves + (int32_t)(gap * weight_b / (weight_a + weight_b + 1));
    at = fix_clamp(at, leaves + gap / 8, enters - gap / 8);
    yb_vertex_t link = {.x_q8 = part_way(a->x_q8, b->x_q8, at),
                        .y_q8 = part_way(a->y_q8, b->y_q8, at)};
    bool on_edge = false;
    half_t e = find_between(load, &link, line_a, line_b, &on_edge);
    if (e == NO_HALF)
        return YB_OK;
    int m = load->map->vertex_count;
    if (mesh_add_vertex(load, link.x_q8, link.y_q8, (load->level_q8 + load->other_q8) / 2) != YB_OK)
        return YB_ERR_LIMIT;
    *joined = true;
    mesh_split(load, e, on_edge, m);
    mesh_legalise(load, m);
    yb_status_t status = link_to_line(load, m, line_a);
    if (status == YB_OK)
        status = link_to_line(load, m, line_b);
    mesh_make_delaunay(load); /* so that the next one finds the one and only mesh */
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
static int peak_behind(const yb_load_t *load, int s)
{
    int line = line_before(load, s);
    if (line == NOWHERE || height_of(load, line) != load->level_q8)
        return NOWHERE;
    int32_t up = height_of(load, s) - load->level_q8;
    return up != 0 && (up > 0) == (load->level_q8 > load->other_q8) ? line : NOWHERE;
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
static bool next_pair(const yb_load_t *load, const pair_t *last, pair_t *next)
{
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
                edge_length(load, load->contour[a].first, load->contour[b].first)};
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
static yb_status_t join_level(yb_load_t *load)
{
    pair_t last = {.apart = -1};
    pair_t pair = last;
    int refusals = 0;
    for (int s = 0; s < all_contours(load); s++)
        load->wish[s] = (yb_index_t)peak_behind(load, s);
    while (refusals < MOST_REFUSALS && next_pair(load, &last, &pair)) {
        bool joined = false;
        if (join(load, &pair, &joined) != YB_OK)
            return YB_ERR_LIMIT;
        if (joined)
            load->group[group_of(load, load->wish[pair.a])] = group_of(load, load->wish[pair.b]);
        else
            refusals++;
        last = pair;
    }
    return YB_OK;
}

yb_status_t saddles_add(yb_load_t *load)
{
    for (int c = 0; c < load->contour_count; c++)
        load->group[c] = (yb_index_t)c;
    for (int c = 0; c < load->contour_count; c++) {
        if (!bounds(load, c))
            continue;
        load->level_q8 = height_of(load, c);
        load->other_q8 = other_height(load, load->level_q8);
        int first = 0;
        while (!bounds_at(load, first, load->level_q8))
            first++;
        bool has_between = fix_abs(load->level_q8 - load->other_q8) >= 2;
        if (first == c && has_between && join_level(load) != YB_OK)
            return YB_ERR_LIMIT;
    }
    return YB_OK;
}
