/* A summit for every region that has none (faithful paper, section 3: "every peak has its summit").
 *
 * A region all of whose points lie at one height (the inside of an innermost contour, a ring
 * between two contours of one height, a corner that a line cuts off the frame) would be a plateau.
 * It gets a spot height at its widest place: a summit if the ground rises towards it from outside,
 * the bottom of a pit if it falls.
 */
#include <string.h>

#include "mesh.h"

enum {
    ALL_FLAT = (yb_index_t)-1
};

/* Notes which regions lie beyond a region's lines; is one of them not flat? */
static bool look_beside(yb_load_t *load, int region)
{
    yb_index_t flat = ALL_FLAT;
    for (int side = 0; side < 2 * load->contour_count; side++) {
        if (region_beside(load, side) != region)
            continue;
        int other = region_beside(load, side ^ 1); /* that itself, of a spot height in it */
        flat &= load->scratch->flat[other];
        load->scratch->beside[other] = (yb_index_t)region;
    }
    return flat != ALL_FLAT;
}

/* The smallest difference of height h from the ground in the regions beside, of two alike the one
 * upwards: where all ground next to the lines is flat as well. One of those regions has another
 * height.
 */
static int32_t rise_farther_out(const yb_load_t *load, int region, int32_t h)
{
    int32_t rise = 0;
    uint32_t least = UINT32_MAX;
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        if (load->scratch->beside[region_of(load, e)] != region)
            continue;
        int32_t down = height_at(load, origin_of(load, e)) - h;
        /* 0 for -1, then 1, -2, 2 …; of none the largest. */
        uint32_t size = ((uint32_t)down << 1 ^ (0 - (uint32_t)(down < 0))) - 1;
        if (size < least) {
            rise = -down;
            least = size;
        }
    }
    return rise;
}

/* What a flat region is like: its widest place, and the ground that its lines look at on their
 * outer sides. Lengths are in 1/256 step: lines that do not cross, on a lattice of 1/16 step, stay
 * below 2^30 all together. Areas are twice as large, in square 1/64 steps: the frame's is below
 * 2^29, and no triangle is counted more than three times.
 */
typedef struct {
    half_t widest; /* edge */
    int32_t width; /* its length, and FREE if no line runs along it */
    uint32_t key;  /* see edge_key */
    int32_t area;
    int32_t length;  /* of its lines */
    int32_t sloping; /* of those of their segments beyond which there is another height */
    int32_t outside; /* area of the triangles beyond those segments */
    /* Sums of length times rise towards the region, and of length times fall: below 2^17 · 2^18 ·
     * 2^16. */
    int64_t change[2];
} flat_t;

/* More than any edge is long. */
#define FREE ((int32_t)1 << 20)

/* Takes in what lies beyond a segment of a line round a flat region of height h. */
static void look_out(const yb_load_t *load, half_t twin, int32_t length, int32_t h, flat_t *flat)
{
    angle_t beyond;
    int32_t up = h - height_at(load, apex_of(load, twin));
    flat->length += length;
    if (up == 0)
        return;
    int64_t *change = &flat->change[up < 0];
    *change = fix_add(*change, length, fix_abs(up));
    find_angle(load, twin, &beyond);
    flat->sloping += length;
    flat->outside += beyond.area;
}

static void survey(const yb_load_t *load, int region, int32_t h, flat_t *flat)
{
    *flat = (flat_t){.width = -1};
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        if (region_of(load, e) != region)
            continue;
        angle_t angle;
        int entry = entry_of(load, e);
        uint32_t key = edge_key(load, e);
        int32_t length = half_length(load, e);
        int32_t width = length + (entry < NO_TRIANGLE ? FREE : 0);
        if (width > flat->width || (width == flat->width && key < flat->key)) {
            flat->widest = e;
            flat->width = width;
            flat->key = key;
        }
        find_angle(load, e, &angle);
        if ((e & 3) == 0)
            flat->area += angle.area;
        if (entry > NO_TRIANGLE)
            look_out(load, twin_of(load, e), length, h, flat);
    }
}

/* --- How high -------------------------------------------------------------------------------- */

/* How high a flat region of height h rises above its lines, or, negative, falls below them: as it
 * would as a paraboloid that begins with the mean slope s outside: s · area / length of the lines.
 * But between 1/8 and 7/8 of an interval, the mean rise outside; and by half of it where there is
 * no slope to go by.
 */
static int32_t rise_inside(const yb_load_t *load, int region, int32_t h, const flat_t *flat)
{
    if (flat->sloping == 0) {
        int32_t interval = rise_farther_out(load, region, h);
        return interval / 2 != 0 ? interval / 2 : interval;
    }
    uint64_t change = (uint64_t)(flat->change[0] + flat->change[1]);
    uint32_t interval = fix_share(change, (uint32_t)flat->sloping, UINT32_MAX);
    uint32_t least = interval >> 3;
    /* In 1/2048, from 1/256 · 1/256 over 2 · 1/64 · 1/64: times 2^11 / 16. A slope of 512 is more
     * than enough; area / length is below 2^32, where a short line bounds much of the frame. */
    uint64_t slope_q11 = fix_share(change * 128, (uint32_t)flat->outside, (uint32_t)512 << 11);
    uint32_t wide = (uint32_t)flat->area * 8 / (uint32_t)flat->length;
    int32_t rise = (int32_t)fix_share(slope_q11 * wide, 1 << 11, interval - least);
    rise = fix_max(rise, fix_max((int32_t)least, 1));
    return flat->change[0] < flat->change[1] ? -rise : rise;
}

/* --- Where ----------------------------------------------------------------------------------- */

/* Adds a vertex at the widest place of a region: the middle of the longest edge that no line runs
 * along, for that is the chord of an empty circle. If just one of the two triangles at it is acute,
 * the circle's centre lies in that one, and so does the place: half way on to the third corner. A
 * region of one triangle has its place inside.
 */
static bool add_summit(yb_load_t *load, int region, const flat_t *flat, int32_t z)
{
    half_t e = flat->widest;
    int p = load->vertex_count;
    bool inside = true;
    yb_vertex_t summit;
    find_middle(load, e, &summit);
    summit.z_q8 = z;
    if (flat->width >= FREE) {
        angle_t here;
        angle_t there;
        half_t twin = twin_of(load, e);
        find_angle(load, e, &here);
        find_angle(load, twin, &there);
        inside = fix_parted(here.dot, there.dot);
        if (inside && there.dot > 0)
            e = twin;
    }
    if (inside) { /* half and quarter weights keep to the quarter-step lattice */
        find_middle_of(&summit, vertex_of(load, apex_of(load, e)), &summit);
        e = place_inside(e);
    }
    if (!mesh_insert(load, e, &summit))
        return false;
    mesh_legalise(load, p);
    yb_contour_t *contour = &load->contour[load->all_contours++];
    contour->first = (yb_index_t)p;
    contour->count = 1;
    contour->left = contour->right = (yb_index_t)region;
    return true;
}

bool summits_add(yb_load_t *load)
{
    load->first_summit = load->vertex_count;
    memset(load->scratch, 255, sizeof *load->scratch); /* all are flat, and beside none */
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        if (rise_of(load, e) != 0)
            load->scratch->flat[region_of(load, e)] = 0;
    }
    /* A region may have to wait until its neighbour has a second height: round and round until
     * nothing changes. What stays flat then is a map of one height. */
    for (bool changed = true; changed;) {
        changed = false;
        for (int side = 0; side < 2 * load->contour_count; side++) {
            int region = region_beside(load, side);
            if (!load->scratch->flat[region] || !look_beside(load, region))
                continue;
            flat_t flat;
            int32_t h = height_at(load, load->contour[side >> 1].first);
            survey(load, region, h, &flat);
            int32_t rise = rise_inside(load, region, h, &flat);
            if (fix_abs(h + rise) > YB_MAX_HEIGHT_Q8)
                rise = -rise;
            if (!add_summit(load, region, &flat, h + rise))
                return false;
            load->scratch->flat[region] = 0;
            changed = true;
        }
    }
    return true;
}
