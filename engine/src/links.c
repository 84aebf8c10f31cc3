/* Links: the edges that the papers want (faithful paper, 4 to 5.2).
 *
 * All rules of a region speak of *peaks*: the spot heights beyond its lines, each behind one line
 * of the region. A peak may as well be the bottom of a pit: what counts is that the ground goes on
 * in the direction in which it crosses the region. Links are wishes: one that would cross a line or
 * an earlier link is not granted, and the constrained Delaunay triangulation fills the rest.
 */
#include "links.h"

enum {
    MOST_TRIES = 4 /* of next nearest points, before one stays unlinked */
};

int32_t height_of(const yb_load_t *load, const yb_contour_t *contour)
{
    return height_at(load, contour->first);
}

bool bounds(const yb_load_t *load, const yb_contour_t *contour)
{
    return is_line(contour) && (contour->left == load->here || contour->right == load->here);
}

const yb_contour_t *line_after(const yb_load_t *load, const yb_contour_t *line)
{
    line = line == NULL ? load->contour : line + 1;
    for (; line < load->contour + load->contour_count; line++) {
        if (bounds(load, line))
            return line;
    }
    return NULL;
}

/* Finds for every other region which line of this one leads to it. */
static void look_beyond(yb_load_t *load)
{
    for (int r = 0; r < load->region_count; r++)
        load->scratch->way_to[r] = NOWHERE;
    const yb_contour_t *line = NULL;
    while ((line = line_after(load, line)) != NULL) {
        int beyond = line->left == load->here ? line->right : line->left;
        load->scratch->way_to[beyond] = (yb_index_t)number_of(load, line);
    }
    /* From line to line, to and fro: lines that lie in a row are in the code in a row, mostly. */
    bool changed = true;
    for (bool back = false; changed; back = !back) {
        changed = false;
        for (int k = 0; k < load->contour_count; k++) {
            line = &load->contour[back ? load->contour_count - 1 - k : k];
            if (!is_line(line) || bounds(load, line))
                continue;
            yb_index_t *left = &load->scratch->way_to[line->left];
            yb_index_t *right = &load->scratch->way_to[line->right];
            if (*left == *right)
                continue;
            if (*left == NOWHERE)
                *left = *right;
            else
                *right = *left;
            changed = true;
        }
    }
}

const yb_contour_t *line_before(const yb_load_t *load, const yb_contour_t *spot)
{
    int line = load->scratch->way_to[spot->left];
    bool here = is_line(spot) || spot->left == load->here;
    return here || line == NOWHERE ? NULL : &load->contour[line];
}

/* --- 4.1: fans -------------------------------------------------------------------------------- */

/* The peak whose slope rules point p: the steepest way up from p, or down to a pit (tan θ, 5.1). In
 * a leaf (line NULL) one of those in it; else one beyond another line, if the ground goes on there
 * the way it goes to that line. NULL: none.
 */
static const yb_contour_t *ruler_of(const yb_load_t *load, int p, const yb_contour_t *line)
{
    int32_t z = height_at(load, p);
    const yb_contour_t *ruler = NULL;
    const yb_contour_t *end = load->contour + load->all_contours;
    int32_t rise = 0;
    int32_t run = 1;
    for (const yb_contour_t *spot = load->contour; spot < end; spot++) {
        if (is_line(spot) || (line == NULL) != (spot->left == load->here))
            continue;
        int32_t up = height_of(load, spot) - z;
        if (line != NULL) {
            const yb_contour_t *before = line_before(load, spot);
            int32_t way = before == NULL ? 0 : height_of(load, before) - z;
            if (before == line || way == 0 || up == way || (way ^ (up - way)) < 0)
                continue;
        }
        int32_t along = edge_length(load, p, spot->first);
        up = fix_abs(up);
        if (fix_wide(up, run) > fix_wide(rise, along)) {
            ruler = spot;
            rise = up;
            run = along;
        }
    }
    return ruler;
}

/* Is the leaf narrower at point p than the summit is far: is a point of the same height across it
 * nearer? Then p stands by a ridge, which the skeleton will follow.
 */
static bool by_a_ridge(const yb_load_t *load, int p, int summit)
{
    int32_t far = edge_length(load, p, summit);
    for (half_t e = first_spoke(load, p); e != NO_HALF; e = spoke_after(load, e)) {
        if (region_of(load, e) == load->here && entry_of(load, e) < NO_TRIANGLE &&
            rise_of(load, e) == 0 && half_length(load, e) < far)
            return true;
    }
    return false;
}

/* All of a leaf's points to its summit. First all wishes, then all links: a wish sees the mesh that
 * the others saw.
 */
static void fan(yb_load_t *load, const yb_contour_t *line)
{
    int end = line->first + line->count;
    for (int p = line->first; p < end; p++) {
        const yb_contour_t *ruler = ruler_of(load, p, NULL);
        bool linked = ruler != NULL && !by_a_ridge(load, p, ruler->first);
        load->scratch->partner[p] = (yb_index_t)(linked ? ruler->first : p);
    }
    for (int p = line->first; p < end; p++) {
        if (load->scratch->partner[p] != p)
            mesh_link(load, p, load->scratch->partner[p]);
    }
}

/* --- 4.2, 5.1 (3), 5.2: links down the slope ------------------------------------------------- */

/* Distance of point p from the segment ab, in 1/64 steps. */
static int32_t distance(const yb_load_t *load, int p, int a, int b)
{
    int32_t ab[3];
    int32_t ap[3];
    find_way(load, a, b, ab);
    find_way(load, a, p, ap);
    int32_t along = ab[0] * ap[0] + ab[1] * ap[1];
    int32_t square = ab[0] * ab[0] + ab[1] * ab[1];
    if (along <= 0)
        return edge_length(load, a, p) >> 2;
    if (along >= square)
        return edge_length(load, b, p) >> 2;
    return fix_abs(ab[0] * ap[1] - ab[1] * ap[0]) / (int32_t)fix_sqrt((uint32_t)square);
}

/* A search among the points of the region's lines of height h. */
typedef struct {
    int32_t h;
    int from, peak; /* the slope line: from this point to its peak; none, if it is the point */
    int32_t far;    /* points farther from the first one do not count */
    int32_t off;    /* what was found last: how far it is from the slope line, or from the point, */
    int point;      /* and which it is; -1: none */
} search_t;

/* The nearest point that comes after the last one found. */
static void find_next(const yb_load_t *load, search_t *search)
{
    int32_t off = INT32_MAX;
    int point = -1;
    const yb_contour_t *line = NULL;
    while ((line = line_after(load, line)) != NULL) {
        if (height_of(load, line) != search->h)
            continue;
        int end = line->first + line->count;
        for (int q = line->first; q < end; q++) {
            int32_t d = edge_length(load, search->from, q);
            if (d > search->far)
                continue;
            if (search->peak != search->from)
                d = distance(load, q, search->from, search->peak);
            if ((d > search->off || (d == search->off && q > search->point)) && d < off) {
                off = d;
                point = q;
            }
        }
    }
    search->off = off;
    search->point = point;
}

/* Links p to the next line where the segment to its peak comes nearest to a point of it. Only to
 * points that are at most a quarter farther than the nearest: where there is none, the slope leads
 * elsewhere, whatever the peak. Nor if it sees none of the first few.
 */
static void link_down(yb_load_t *load, int p, const yb_contour_t *line)
{
    const yb_contour_t *ruler = ruler_of(load, p, line);
    if (ruler == NULL)
        return;
    search_t search = {.h = height_of(load, line_before(load, ruler)),
                       .from = p,
                       .peak = p,
                       .far = INT32_MAX,
                       .off = -1};
    find_next(load, &search);
    search.far = search.off + (search.off >> 2);
    search.peak = ruler->first;
    search.off = -1;
    for (int tries = 0; tries < MOST_TRIES; tries++) {
        find_next(load, &search);
        if (search.point < 0 || mesh_link(load, p, search.point))
            return;
    }
}

/* Does the line go from frame to frame, or lie round the region? Then it leads to the frame. */
static bool is_outer(const yb_load_t *load, const yb_contour_t *line)
{
    int outside = region_at(load, load->corner[0]);
    return is_open(load, line) || load->scratch->way_to[outside] == number_of(load, line);
}

/* All rules of a region, of which this is the first line. */
static bool apply_rules(yb_load_t *load, const yb_contour_t *line)
{
    if (line_after(load, line) == NULL) {
        fan(load, line);
        return true;
    }
    look_beyond(load);
    if (!saddles_add(load))
        return false;
    for (; line != NULL; line = line_after(load, line)) {
        if (!is_outer(load, line))
            continue;
        int end = line->first + line->count;
        for (int p = line->first; p < end; p++)
            link_down(load, p, line);
    }
    return true;
}

bool links_add(yb_load_t *load)
{
    load->first_saddle = load->vertex_count;
    /* Regions in the order of the lines that bound them, the left one first. */
    for (int side = 0; side < 2 * load->contour_count; side++) {
        load->here = region_beside(load, side);
        const yb_contour_t *line = line_after(load, NULL);
        if (line == &load->contour[side >> 1] && !apply_rules(load, line))
            return false;
    }
    mesh_make_delaunay(load);
    return true;
}

yb_rule_t yb_vertex_rule(const yb_load_t *load, yb_index_t vertex)
{
    return vertex >= load->first_skeleton ? YB_RULE_SKELETON
           : vertex >= load->first_saddle ? YB_RULE_SADDLE
           : vertex >= load->first_summit ? YB_RULE_SUMMIT
                                          : YB_RULE_CONTOUR;
}

/* The contour of a coded point. */
static const yb_contour_t *contour_of(const yb_load_t *load, yb_index_t v)
{
    int from = 0;
    for (int end = load->contour_count; end - from > 1;) {
        int middle = (from + end) / 2;
        *(load->contour[middle].first <= v ? &from : &end) = middle;
    }
    return &load->contour[from];
}

/* Why an edge is marked follows from its ends: each rule links another pair of kinds. */
static yb_rule_t rule_of_marked(const yb_load_t *load, yb_index_t low, yb_index_t high)
{
    if (high >= load->point_count)
        return yb_vertex_rule(load, high);
    const yb_contour_t *a = contour_of(load, low);
    const yb_contour_t *b = contour_of(load, high);
    if (!is_line(a) || !is_line(b))
        return YB_RULE_SUMMIT;
    return a == b ? YB_RULE_CONTOUR : YB_RULE_SLOPE;
}

yb_rule_t yb_edge_rule(const yb_map_t *map, const yb_load_t *load, yb_triangle_t triangle, int edge)
{
    const yb_index_t *corner = yb_map_triangle(map, triangle);
    yb_index_t a = corner[edge];
    yb_index_t b = corner[next3(edge)];
    /* As is_marked, wherever the map has its triangles by now. */
    if ((yb_map_across(map)[triangle] >> edge * ENTRY_BITS & ENTRY_MARK) != 0)
        return rule_of_marked(load, a < b ? a : b, a < b ? b : a);
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
