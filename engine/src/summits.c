/* A summit for every region that has none (faithful paper, section 3: "every peak has its summit").
 *
 * A region all of whose points lie at one height (the inside of an innermost contour, a ring
 * between two contours of one height, a corner that a line cuts off the frame) would be a plateau.
 * It gets a spot height at its widest place: a summit if the ground rises towards it from outside,
 * the bottom of a pit if it falls.
 */
#include <string.h>

#include "mesh.h"

/* --- How high -------------------------------------------------------------------------------- */

/* What load->ground says of a region. */
enum {
    FLAT = 1,  /* of one height */
    BESIDE = 2 /* shares a line with the region in question */
};

/* Notes which regions lie beyond a region's lines; is one of them not flat? */
static bool look_beside(yb_load_t *load, int region)
{
    bool sloping = false;
    for (int r = 0; r < load->region_count; r++)
        load->ground[r] &= FLAT;
    for (int c = 0; c < load->contour_count; c++) {
        const yb_contour_t *line = &load->contour[c];
        if (line->left == line->right || (line->left != region && line->right != region))
            continue;
        yb_index_t other = line->left == region ? line->right : line->left;
        sloping = sloping || (load->ground[other] & FLAT) == 0;
        load->ground[other] |= BESIDE;
    }
    return sloping;
}

/* The smallest difference of height h from the ground in the regions beside, where all ground next
 * to the lines is flat as well. One of those regions has another height.
 */
static int32_t rise_farther_out(const yb_load_t *load, int32_t h)
{
    int32_t rise = 0;
    int32_t least = INT32_MAX;
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        if ((load->ground[region_of(load, e)] & BESIDE) == 0)
            continue;
        int32_t up = h - height_at(load, origin_of(load, e));
        int32_t size = up > 0 ? 2 * up - 1 : -2 * up; /* of two alike the one upwards */
        if (up != 0 && size < least) {
            rise = up;
            least = size;
        }
    }
    return rise;
}

/* What a flat region is like, and the ground that its lines look at on their outer sides. Lengths
 * are in 1/256 step: lines that do not cross, on a lattice of 1/16 step, stay below 2^30 all
 * together. Areas are twice as large, in square 1/64 steps: the frame's is below 2^29, and no
 * triangle is counted more than three times.
 */
typedef struct {
    int32_t area;
    int32_t length;  /* of its lines */
    int32_t sloping; /* of those of their segments beyond which there is another height */
    int32_t outside; /* area of the triangles beyond those segments */
    /* Sums of length times rise towards the region, and of length times fall: below 2^17 · 2^18 ·
     * 2^16. */
    int64_t change[2];
} surroundings_t;

/* Area of a half's triangle: see area_of. */
static int32_t area_at(const yb_load_t *load, half_t e)
{
    return side_of(load, e, vertex_of(load, apex_of(load, e)));
}

static void look_round(const yb_load_t *load, int region, surroundings_t *found)
{
    *found = (surroundings_t){0};
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        if (region_of(load, e) != region)
            continue;
        if ((e & 3) == 0)
            found->area += area_at(load, e);
        if (!is_marked(load, e))
            continue;
        half_t twin = twin_of(load, e);
        int32_t up = height_at(load, origin_of(load, e)) - height_at(load, apex_of(load, twin));
        int32_t length = half_length(load, e);
        found->length += length;
        if (up == 0)
            continue;
        int64_t *change = &found->change[up < 0];
        *change = fix_add(*change, length, fix_abs(up));
        found->sloping += length;
        found->outside += area_at(load, twin);
    }
}

/* How high a flat region of height h rises above its lines, or, negative, falls below them: as it
 * would as a paraboloid that begins with the mean slope s outside: s · area / length of the lines.
 * But between 1/8 and 7/8 of an interval, the mean rise outside; and by half of it where there is
 * no slope to go by. 0: there is no other height round about.
 */
static int32_t rise_inside(const yb_load_t *load, int region, int32_t h)
{
    surroundings_t round;
    look_round(load, region, &round);
    if (round.sloping == 0) {
        int32_t interval = rise_farther_out(load, h);
        return interval / 2 != 0 ? interval / 2 : interval;
    }
    uint64_t change = (uint64_t)(round.change[0] + round.change[1]);
    uint32_t interval = fix_share(change, (uint32_t)round.sloping, UINT32_MAX);
    uint32_t least = interval >> 3;
    /* In 1/2048, from 1/256 · 1/256 over 2 · 1/64 · 1/64: times 2^11 / 16. A slope of 512 is more
     * than enough; area / length is below 2^32, where a short line bounds much of the frame. */
    uint64_t slope_q11 = fix_share(change * 128, (uint32_t)round.outside, (uint32_t)512 << 11);
    uint32_t wide = (uint32_t)round.area * 8 / (uint32_t)round.length;
    int32_t rise = (int32_t)fix_share(slope_q11 * wide, 1 << 11, interval - least);
    rise = fix_max(rise, fix_max((int32_t)least, 1));
    return round.change[0] < round.change[1] ? -rise : rise;
}

/* --- Where ----------------------------------------------------------------------------------- */

/* A place in the mesh: the middle of an edge; or, with `beyond`, half way from there to the third
 * corner of the triangle.
 */
typedef struct {
    half_t half;
    bool beyond;
} spot_t;

/* Is the angle at the apex acute? */
static bool is_acute(const yb_load_t *load, half_t e)
{
    return dot(load, apex_of(load, e), origin_of(load, e), end_of(load, e)) > 0;
}

/* The widest place of a region: the middle of the longest edge that no line runs along, for that is
 * the chord of an empty circle. If just one of the two triangles at it is acute, the circle's
 * centre lies in that one, and so does the place. A region of one triangle has its place inside.
 */
static spot_t widest_place(const yb_load_t *load, int region)
{
    spot_t spot = {.beyond = true};
    uint32_t best = 0;
    int32_t widest = -1;
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        if (region_of(load, e) != region)
            continue;
        bool alone = entry_of(load, e) >= NO_TRIANGLE;
        if (alone && !spot.beyond)
            continue; /* there is a better kind of edge */
        uint32_t key = edge_key(load, e);
        int32_t wide = half_length(load, e);
        if (alone != spot.beyond || wide > widest || (wide == widest && key < best)) {
            spot = (spot_t){e, alone};
            best = key;
            widest = wide;
        }
    }
    if (spot.beyond)
        return spot;
    half_t twin = twin_of(load, spot.half);
    bool here = is_acute(load, spot.half);
    spot.beyond = here != is_acute(load, twin);
    if (spot.beyond && !here)
        spot.half = twin;
    return spot;
}

static bool add_summit(yb_load_t *load, int region, const spot_t *spot, int32_t z)
{
    half_t e = spot->half;
    int p = load->map->vertex_count;
    yb_vertex_t summit;
    find_middle(load, e, &summit);
    summit.z_q8 = z;
    if (spot->beyond) { /* half and quarter weights keep to the quarter-step lattice */
        find_middle_of(&summit, vertex_of(load, apex_of(load, e)), &summit);
        e = place_inside(e);
    }
    if (!mesh_insert(load, e, &summit))
        return false;
    mesh_legalise(load, p);
    yb_contour_t *contour = &load->contour[load->contour_count + load->summit_count++];
    contour->first = (yb_index_t)p;
    contour->count = 1;
    contour->left = contour->right = (yb_index_t)region;
    contour->open = false;
    return true;
}

bool summits_add(yb_load_t *load)
{
    load->first_summit = load->map->vertex_count;
    memset(load->ground, FLAT, load->region_count);
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        if (rise_of(load, e) != 0)
            load->ground[region_of(load, e)] = 0;
    }
    /* A region may have to wait until its neighbour has a second height: round and round until
     * nothing changes. What stays flat then is a map of one height. */
    for (bool changed = true; changed;) {
        changed = false;
        for (int c = 0; c < 2 * load->contour_count; c++) {
            int region = region_beside(load, c);
            if ((load->ground[region] & FLAT) == 0 || !look_beside(load, region))
                continue;
            int32_t h = height_at(load, load->contour[c >> 1].first);
            spot_t spot = widest_place(load, region);
            int32_t rise = rise_inside(load, region, h);
            if (fix_abs(h + rise) > YB_MAX_HEIGHT_Q8)
                rise = -rise;
            if (!add_summit(load, region, &spot, h + rise))
                return false;
            load->ground[region] = 0;
            changed = true;
        }
    }
    return true;
}
