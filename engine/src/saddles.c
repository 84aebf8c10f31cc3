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
    const yb_contour_t *line = line_after(load, NULL);
    for (int k = 0; k < 4;) {
        int p = load->corner[k];
        if (line != NULL) {
            p = line->first;
            line = line_after(load, line);
        } else {
            k++;
            if (region_at(load, p) != load->here)
                continue;
        }
        int32_t z = height_at(load, p);
        if (z != h && (nearest == h || fix_abs(z - h) < fix_abs(nearest - h)))
            nearest = z;
    }
    return nearest;
}

/* Two peaks, the lines that they stand behind, and the part of the segment between them, in
 * 1/65536, from where it leaves the line of the first for good to where it enters that of the
 * second.
 */
typedef struct {
    int peak[2];
    const yb_contour_t *line[2];
    int32_t leaves, enters;
} gap_t;

/* Where edge pq crosses the segment ab, in 1/65536 of its length; -1: it does not. An end of pq
 * that lies on ab counts as lying to the right of it. Areas are within 2^29, their difference 2^30.
 */
static int32_t crossing(const yb_load_t *load, int a, int b, int p, int q)
{
    int32_t from = orientation(load, p, q, a);
    int32_t to = orientation(load, p, q, b);
    if (!fix_parted(from, to) ||
        !fix_parted(orientation(load, a, b, p), orientation(load, a, b, q)))
        return -1;
    return fix_scale(from, 65536, from - to);
}

/* Of all places between its ends at which the gap crosses a line, the first one, or the last; -1:
 * there is none.
 */
static int32_t find_crossing(const yb_load_t *load, const yb_contour_t *line, const gap_t *gap,
                             bool last)
{
    int32_t found = -1;
    int p = line->first + line->count - 1;
    for (int k = 0; k < line->count; k++) {
        int q = line->first + k;
        int32_t at =
            k == 0 && is_open(load, line) ? -1 : crossing(load, gap->peak[0], gap->peak[1], p, q);
        if (at > gap->leaves && at < gap->enters && (found < 0 || (at > found) == last))
            found = at;
        p = q;
    }
    return found;
}

/* Finds the gap between two peaks; false: another line is in between. */
static bool find_gap(const yb_load_t *load, gap_t *gap)
{
    gap->leaves = -1;
    gap->enters = 65537;
    gap->enters = find_crossing(load, gap->line[1], gap, false);
    gap->leaves = find_crossing(load, gap->line[0], gap, true);
    const yb_contour_t *line = NULL;
    while ((line = line_after(load, line)) != NULL) {
        if (find_crossing(load, line, gap, false) >= 0)
            return false;
    }
    return gap->leaves >= 0;
}

/* Links m to the nearest point of a line that it sees. */
static void link_to_line(yb_load_t *load, int m, const yb_contour_t *line)
{
    int nearest = m;
    int32_t least = INT32_MAX;
    int end = line->first + line->count;
    for (int p = line->first; p < end; p++) {
        int32_t length = edge_length(load, m, p);
        if (length < least && mesh_sees(load, m, p)) {
            nearest = p;
            least = length;
        }
    }
    if (nearest != m)
        mesh_force_edge(load, m, nearest);
}

/* Is a corner of the triangle that begins with half e a point of a line? */
static bool has_corner_on(const yb_load_t *load, half_t e, const yb_contour_t *line)
{
    for (; !is_inside(e); e++) {
        int point = origin_of(load, e) - line->first;
        if (point >= 0 && point < line->count)
            return true;
    }
    return false;
}

/* The place of p in the triangle that begins with half e: inside or on an edge that is not marked;
 * else NO_HALF.
 */
static half_t place_in(const yb_load_t *load, half_t e, const yb_vertex_t *p)
{
    half_t place = place_inside(e);
    for (; !is_inside(e); e++) {
        int32_t side = side_of(load, e, p);
        if (side < 0 || (side == 0 && (!is_inside(place) || is_marked(load, e))))
            return NO_HALF;
        if (side == 0)
            place = e;
    }
    return place;
}

/* The place of p in the triangles between the lines of a gap, or NO_HALF. */
static half_t find_between(const yb_load_t *load, const yb_vertex_t *p, const gap_t *gap)
{
    for (half_t e = 0; triangle_of(e) < (int)load->map->triangle_count; e += 4) {
        half_t place = place_in(load, e, p);
        for (int k = 0; k < 2 && place != NO_HALF; k++) {
            if (!has_corner_on(load, e, gap->line[k]))
                place = NO_HALF;
        }
        if (place != NO_HALF)
            return place;
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

/* Two peaks behind two lines of the level: how far they are apart, and the numbers of the two spot
 * heights, the lower one's times 65536 and the other's.
 */
typedef struct {
    int32_t apart;
    uint32_t spots;
} pair_t;

/* The link point of two peaks (5.1): where their slopes meet. With the segment between them leaving
 * one line at `leaves` and entering the other at `enters`, and s = rise / run the slope of each
 * from its peak to its line, it divides the gap as s_b : s_a. Only where the mesh joins the two
 * lines, though: with a third line in between they are no neighbours. YB_MORE: they are not joined.
 */
static yb_status_t join(yb_load_t *load, const pair_t *pair)
{
    gap_t gap;
    for (int k = 0; k < 2; k++) {
        int spot = k == 0 ? (int)(pair->spots >> 16) : (int)(pair->spots & 0xffff);
        gap.peak[k] = load->contour[spot].first;
        gap.line[k] = line_before(load, &load->contour[spot]);
    }
    if (!find_gap(load, &gap))
        return YB_MORE;
    /* Rises are below 2^18 and runs at most 2^16: each product below 2^34. */
    const yb_vertex_t *a = vertex_of(load, gap.peak[0]);
    const yb_vertex_t *b = vertex_of(load, gap.peak[1]);
    int32_t wide = gap.enters - gap.leaves;
    uint64_t weight_a = (uint64_t)fix_wide(fix_abs(a->z_q8 - load->level_q8), 65536 - gap.enters);
    uint64_t weight_b = (uint64_t)fix_wide(fix_abs(b->z_q8 - load->level_q8), gap.leaves);
    int32_t at = (int32_t)((uint32_t)wide * weight_b / (weight_a + weight_b + 1));
    at = gap.leaves + fix_clamp(at, wide >> 3, wide - (wide >> 3));
    yb_vertex_t link;
    link.x_q8 = part_way(a->x_q8, b->x_q8, at);
    link.y_q8 = part_way(a->y_q8, b->y_q8, at);
    link.z_q8 = (load->level_q8 + load->other_q8) / 2;
    half_t place = find_between(load, &link, &gap);
    if (place == NO_HALF)
        return YB_MORE;
    int m = load->vertex_count;
    if (!mesh_insert(load, place, &link))
        return YB_ERR_LIMIT;
    mesh_legalise(load, m);
    for (int k = 0; k < 2; k++)
        link_to_line(load, m, gap.line[k]);
    mesh_make_delaunay(load); /* so that the next one finds the one and only mesh */
    return YB_OK;
}

/* The line of this level that a spot height stands behind, if it is a peak: if it lies on the far
 * side of the line's height. Else NOWHERE.
 */
static int peak_behind(const yb_load_t *load, const yb_contour_t *spot)
{
    const yb_contour_t *line = line_before(load, spot);
    if (line == NULL || height_of(load, line) != load->level_q8)
        return NOWHERE;
    int32_t up = height_of(load, spot) - load->level_q8;
    bool peak = up != 0 && (up ^ (load->level_q8 - load->other_q8)) >= 0;
    return peak ? number_of(load, line) : NOWHERE;
}

/* The nearest pair of peaks whose lines are not joined yet and that comes after the last one, in
 * the order of distance, then of the spot heights' numbers. False: there is none.
 */
static bool next_pair(const yb_load_t *load, pair_t *pair)
{
    pair_t next = {.apart = INT32_MAX};
    for (int a = 0; a < load->all_contours; a++) {
        for (int b = a + 1; b < load->all_contours && load->scratch->partner[a] != NOWHERE; b++) {
            if (load->scratch->partner[b] == NOWHERE ||
                load->scratch->partner[a] == load->scratch->partner[b])
                continue;
            int32_t apart = edge_length(load, load->contour[a].first, load->contour[b].first);
            uint32_t spots = (uint32_t)a << 16 | (uint32_t)b;
            if (apart < next.apart &&
                (apart > pair->apart || (apart == pair->apart && spots > pair->spots)))
                next = (pair_t){apart, spots};
        }
    }
    *pair = next;
    return next.apart < INT32_MAX;
}

static void join_groups(yb_load_t *load, yb_index_t from, yb_index_t to)
{
    for (int s = 0; s < load->all_contours; s++) {
        if (load->scratch->partner[s] == from)
            load->scratch->partner[s] = to;
    }
}

/* Nearest pairs first, until all are joined or too many could not be (7). What is left, the
 * skeleton joins. partner[s] is the line that spot height s stands behind, or one that is joined to
 * it.
 */
static bool join_level(yb_load_t *load)
{
    pair_t pair = {.apart = -1};
    int refusals = 0;
    for (int s = 0; s < load->all_contours; s++)
        load->scratch->partner[s] = (yb_index_t)peak_behind(load, &load->contour[s]);
    while (refusals < MOST_REFUSALS && next_pair(load, &pair)) {
        yb_status_t status = join(load, &pair);
        if (status < 0)
            return false;
        if (status == YB_MORE)
            refusals++;
        else
            join_groups(load, load->scratch->partner[pair.spots >> 16],
                        load->scratch->partner[pair.spots & 0xffff]);
    }
    return true;
}

bool saddles_add(yb_load_t *load)
{
    const yb_contour_t *line = NULL;
    while ((line = line_after(load, line)) != NULL) {
        load->level_q8 = height_of(load, line);
        load->other_q8 = other_height(load, load->level_q8);
        const yb_contour_t *first = line_after(load, NULL);
        while (height_of(load, first) != load->level_q8)
            first = line_after(load, first);
        bool has_between = fix_abs(load->level_q8 - load->other_q8) >= 2;
        if (first == line && has_between && !join_level(load))
            return false;
    }
    return true;
}
