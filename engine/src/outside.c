#include "camera.h"
#include "fix.h"
#include "refine.h"
#include "relief.h"

/* --- What lies outside the picture ------------------------------------------------------------ */

/* A slope of the picture's pyramid, in 1/256, for a line `off` sixteenths of a pixel from the
 * middle: off / focal, rounded up. The picture lies within a slope of 2.
 */
static int32_t slope_q8(const yb_frame_t *frame, int32_t off_q4)
{
    return off_q4 >= 0 ? (off_q4 * 256 + frame->focal_q4 - 1) / frame->focal_q4
                       : -(-off_q4 * 256 / frame->focal_q4);
}

enum {
    SPARE_Q4 = 25 /* by which spots may be off where they should be */
};

void refine_see(const yb_frame_t *frame, int32_t first_row, int32_t end_row, refine_view_t *view)
{
    /* What meets no pixel's centre draws nothing. */
    view->left_q4 = 9;
    view->top_q4 = first_row * 16 + 9;
    view->wide_q4 = (uint32_t)(frame->screen.width * 16 - 16);
    view->high_q4 = (uint32_t)((end_row - first_row) * 16 - 16);
    int32_t wide = slope_q8(frame, frame->screen.width * 8 + SPARE_Q4);
    int32_t middle = frame->screen.height * 8;
    const refine_plane_t planes[REFINE_PLANES] = {
        {.slope_q8 = 256, .near = frame->near},
        {.right = 1, .slope_q8 = wide},
        {.right = -1, .slope_q8 = wide},
        {.up = -1, .slope_q8 = slope_q8(frame, middle - first_row * 16 + SPARE_Q4)},
        {.up = 1, .slope_q8 = slope_q8(frame, end_row * 16 - middle + SPARE_Q4)},
    };
    int32_t up_q9 = (frame->up_z * frame->view.exaggerate_q8) >> 13;
    int32_t deep_q9 = (frame->depth_z * frame->view.exaggerate_q8) >> 13;
    for (int i = 0; i < REFINE_PLANES; i++) {
        refine_plane_t *plane = &view->plane[i];
        *plane = planes[i];
        int32_t lift = plane->up * up_q9 + ((plane->slope_q8 * deep_q9) >> 8);
        plane->lift_q9 = (fix_abs(lift) >> frame->eye_shift) + 2;
    }
}

/* For points without spots. Inside a plane is across . (right, up) + slope * depth - near >= 0;
 * depth < 2^18 and |slope| <= 2 * 2^8 make 2^27.
 */
static bool misses_planes(const yb_frame_t *frame, const refine_view_t *view,
                          const yb_point_t *const *p, int count, int32_t stray)
{
    camera_point_t at[REFINE_POINTS];
    for (int k = 0; k < count; k++)
        camera_view(frame, p[k]->place, p[k]->top_q8, &at[k]);
    for (int i = 0; i < REFINE_PLANES; i++) {
        const refine_plane_t *plane = &view->plane[i];
        int32_t most = INT32_MIN;
        for (int k = 0; k < count; k++)
            most = fix_max(most, plane->right * at[k].right + plane->up * at[k].up +
                                     ((at[k].depth * plane->slope_q8) >> 8) - plane->near);
        /* stray < 2^19 and lift < 2^14: within 2^29 after the shift by 4. */
        if (most < -((((stray >> 4) + 1) * plane->lift_q9 >> 5) + 12))
            return true;
    }
    return false;
}

/* The box on the screen that holds some points and what lies between them, 1/16 pixel. */
typedef struct {
    int32_t left, right, top, bottom;
    int32_t near; /* greatest 1/depth */
} box_t;

static inline void begin_box(box_t *box)
{
    box->near = 0;
    box->left = box->top = INT32_MAX;
    box->right = box->bottom = INT32_MIN;
}

static inline void widen_to(box_t *box, int32_t x_q4, int32_t y_q4, int32_t near)
{
    box->near = fix_max(box->near, near);
    box->left = fix_min(box->left, x_q4);
    box->right = fix_max(box->right, x_q4);
    box->top = fix_min(box->top, y_q4);
    box->bottom = fix_max(box->bottom, y_q4);
}

/* False: not all of them have spots. */
static bool find_box(const yb_point_t *const *p, int count, box_t *box)
{
    begin_box(box);
    for (int k = 0; k < count; k++) {
        const yb_spot_t *spot = &p[k]->spot;
        if (spot->near == 0)
            return false;
        widen_to(box, spot->x_q4, spot->y_q4, spot->near);
    }
    return true;
}

/* How far on the screen points of up to 1/depth `near` go that move by `stray` in height. */
typedef struct {
    int32_t x, y;
} spare_t;

/* False: they may come nearer by more than an eighth. */
static inline bool find_spare(const yb_frame_t *frame, int32_t stray, int32_t near, spare_t *spare)
{
    if (stray >= 1 << 14 || (stray * near) >> 3 > frame->most_bend)
        return false;
    int32_t sway = ((stray * near) >> 10) + 1;
    int32_t least = SPARE_Q4 + (near * frame->spare_q4 >> 16);
    spare->x = (sway * frame->sway_x_q4 >> frame->lift_shift) + least;
    spare->y = (sway * frame->sway_y_q4 >> frame->lift_shift) + least;
    return true;
}

static void widen_box(const spare_t *spare, box_t *box)
{
    box->left -= spare->x;
    box->right += spare->x;
    box->top -= spare->y;
    box->bottom += spare->y;
}

static inline int32_t right_of(const refine_view_t *view)
{
    return view->left_q4 + (int32_t)view->wide_q4 - 1;
}

static inline int32_t bottom_of(const refine_view_t *view)
{
    return view->top_q4 + (int32_t)view->high_q4 - 1;
}

static inline bool box_misses(const refine_view_t *view, const box_t *box)
{
    return box->bottom < view->top_q4 || box->top > bottom_of(view) || box->right < view->left_q4 ||
           box->left > right_of(view);
}

bool refine_misses(const yb_frame_t *frame, const refine_view_t *view, const yb_point_t *const *p,
                   int count, int32_t stray)
{
    box_t box;
    spare_t spare;
    if (!find_box(p, count, &box) || !find_spare(frame, stray, box.near, &spare))
        return misses_planes(frame, view, p, count, stray);
    widen_box(&spare, &box);
    return box_misses(view, &box);
}

/* --- How far triangles may go ----------------------------------------------------------------- */

/* How far the smooth surface rises or falls at the middle of an edge. */
static inline int32_t bend_of(const yb_vertex_t *a, const yb_vertex_t *b)
{
    return fix_abs(relief_bulge((int32_t)b->gx_q11 - a->gx_q11, (int32_t)b->gy_q11 - a->gy_q11,
                                fix_minus(a->x_q8, b->x_q8), fix_minus(a->y_q8, b->y_q8)));
}

/* A surface of the second degree bulges from its plane at most 4/3 of what it does on an edge; a
 * line from a corner to a midpoint at most 5/4 of its triangle's edges, and of two such lines at
 * most one is split on.
 */
int32_t refine_bulge(const yb_map_t *map, const yb_vertex_t *const corner[3])
{
    if (!map->smooth)
        return 0;
    const int32_t bulge =
        fix_max(bend_of(corner[0], corner[1]),
                fix_max(bend_of(corner[1], corner[2]), bend_of(corner[2], corner[0])));
    return 2 * bulge + (bulge >> 1);
}

/* Rounding moves a point by one unit of height more at each level that it is split by. */
enum {
    MOST_LEVELS = 16
};

/* How far refinement can move a point of a triangle of which some edges are split. Each part of an
 * edge is of a class four lower and halved once less, and so is what is split inside the triangle:
 * a point moves by the noise of each class once. (relief_reach counts it twice.)
 */
static inline int32_t limited_stray(const yb_frame_t *frame, const yb_part_t *part)
{
    const yb_map_t *map = frame->map;
    const yb_edge_t often = refine_edges(part);
    yb_edge_t longest = 0; /* or one that is left whole, and shorter */
    for (int i = 0; i < 3; i++) {
        const yb_edge_t class = part->edge[i] & 0xff0000;
        longest = class > longest ? class : longest;
    }
    int class = refine_class(longest);
    const int32_t levels = fix_min((int32_t)(often >> 24), MOST_LEVELS); /* or more */
    const int32_t stray = part->bulge + levels + 1;
    if (levels < 2)
        return stray + (map->noise[class] * (int32_t)RELIEF_HASH_MOST >> RELIEF_NOISE_SHIFT);
    const relief_bound_t bound = {0, class};
    return stray + (relief_reach(map, &bound, class + 4 - 4 * (int)levels) >> 1);
}

/* What of a triangle strays so far in height, when some of it may be in the water: what is above
 * may sink to it where the ground between dips under it.
 */
static inline int32_t stray_in_water(const yb_frame_t *frame, const yb_point_t *const p[3],
                                     int32_t stray)
{
    int32_t water = frame->view.water_q8;
    if (water == YB_NO_WATER)
        return stray;
    if (p[0]->z_q8 < water || p[1]->z_q8 < water || p[2]->z_q8 < water)
        stray = fix_max(stray, fix_max(p[0]->top_q8, fix_max(p[1]->top_q8, p[2]->top_q8)) - water);
    return stray;
}

int32_t refine_stray(const yb_frame_t *frame, const yb_part_t *part)
{
    int32_t stray = refine_edges(part) >= REFINE_ONCE ? limited_stray(frame, part) : 0;
    return stray_in_water(frame, part->point, stray);
}

/* The map's bound is by other midpoints. Twice that is as much as limited_stray: three times the
 * bulge of an edge to two and a half, four times what noise does to once; and that is below 2^19.
 */
bool refine_root_misses(const yb_frame_t *frame, const refine_view_t *view,
                        const yb_point_t *const p[3])
{
    const int32_t stray = fix_min(2 * frame->map->stray_q8, (int32_t)1 << 19);
    return misses_planes(frame, view, p, 3, stray_in_water(frame, p, stray));
}

/* find_spare, of a triangle all of whose corners, and walls' feet, have spots. Feet are where they
 * should be but for the rounding of their own, as corners are. If none of it changes its depth by
 * more than a 64th, all midpoints are made from the spots of their ends: what they may be off from
 * where they should be does not matter, only the rounding of each level.
 */
static inline bool find_part_spare(const yb_frame_t *frame, int often, int32_t stray, int32_t near,
                                   spare_t *spare)
{
    if (stray >= 1 << 14 || stray * near > frame->most_bend)
        return find_spare(frame, stray, near, spare);
    int32_t levels = fix_min(often, MOST_LEVELS) + 1;
    spare->x = levels;
    spare->y = (((stray * near >> 10) + levels) * frame->lift >> frame->lift_shift) + levels;
    return true;
}

/* Are three spots that are `beyond` some sides of the view farther away than `spare` from one? */
static bool farther(const refine_view_t *view, const yb_point_t *const p[3], int beyond,
                    const spare_t *spare)
{
    const yb_spot_t *a = &p[0]->spot;
    const yb_spot_t *b = &p[1]->spot;
    const yb_spot_t *c = &p[2]->spot;
    return ((beyond & REFINE_ABOVE) != 0 &&
            view->top_q4 - fix_max(a->y_q4, fix_max(b->y_q4, c->y_q4)) > spare->y) ||
           ((beyond & REFINE_BELOW) != 0 &&
            fix_min(a->y_q4, fix_min(b->y_q4, c->y_q4)) - bottom_of(view) > spare->y) ||
           ((beyond & REFINE_LEFT) != 0 &&
            view->left_q4 - fix_max(a->x_q4, fix_max(b->x_q4, c->x_q4)) > spare->x) ||
           ((beyond & REFINE_RIGHT) != 0 &&
            fix_min(a->x_q4, fix_min(b->x_q4, c->x_q4)) - right_of(view) > spare->x);
}

/* Is nothing that a triangle can become in the view? Most lie in it as they are. Of one whose
 * corners are all beyond one side, such a side is enough: is it farther away than any of it can
 * come?
 */
bool refine_far_off(const yb_frame_t *frame, const refine_view_t *view, const yb_part_t *part,
                    int beyond)
{
    const yb_point_t *const *p = part->point;
    if (beyond >= REFINE_NOWHERE)
        return refine_misses(frame, view, p, 3, refine_stray(frame, part));
    int32_t near = fix_max(p[0]->spot.near, fix_max(p[1]->spot.near, p[2]->spot.near));
    int32_t stray = stray_in_water(frame, p, limited_stray(frame, part));
    spare_t spare;
    if (!find_part_spare(frame, (int)(refine_edges(part) >> 24), stray, near, &spare))
        return misses_planes(frame, view, p, 3, stray);
    return farther(view, p, beyond, &spare);
}

/* --- Rows ------------------------------------------------------------------------------------- */

/* How far refinement can move a point of a base triangle, as limited_stray: no edge is longer than
 * its box in plan is across, nor any point nearer than `near`, a 1/depth, so that none is halved
 * more often than that line would be there. A refine_edge is at most 6.8 % longer than it should
 * be, and this line at most 2.8 % shorter: an eighth more, halved, is below 2^16, and near is.
 */
typedef struct {
    int32_t stray;
    int often; /* how often an edge may be halved */
} reach_t;

static inline int32_t spread(int32_t a, int32_t b, int32_t c)
{
    return fix_max(a, fix_max(b, c)) - fix_min(a, fix_min(b, c));
}

COPIED reach_t whole_reach(const yb_frame_t *frame, const yb_vertex_t *const v[3], int32_t near)
{
    const yb_map_t *map = frame->map;
    const int32_t wide = spread(v[0]->x_q8, v[1]->x_q8, v[2]->x_q8);
    const int32_t high = spread(v[0]->y_q8, v[1]->y_q8, v[2]->y_q8);
    const uint32_t length = (uint32_t)fix_length(wide, high);
    reach_t reach = {0, 0};
    uint32_t size = ((length + (length >> 3)) >> 1) * (uint32_t)near;
    for (; size > frame->longest; size >>= 1)
        reach.often++;
    if (reach.often == 0)
        return reach;
    const relief_bound_t bound = {0, relief_class(wide, high)};
    reach.stray = refine_bulge(map, v) + fix_min(reach.often, MOST_LEVELS) + 1 +
                  (relief_reach(map, &bound, bound.longest + 4 - 4 * reach.often) >> 1);
    return reach;
}

/* With the spare of a box nothing comes nearer by more than an eighth: 8/7. */
static inline int32_t nearest_in(const box_t *box)
{
    return fix_min(box->near + box->near / 7 + 1, 65535);
}

/* The rows that a base triangle may touch whose points go so far. False: it is not on the screen.
 */
static bool rows_of_box(const refine_view_t *whole, const spare_t *spare, box_t *box,
                        int32_t *first, int32_t *last)
{
    widen_box(spare, box);
    *first = fix_clamp(box->top >> 4, 0, *last);
    *last = fix_clamp(box->bottom >> 4, 0, *last);
    return !box_misses(whole, box);
}

/* The same of one that has a wall below it, or of which some has no spot, may be under water, or
 * goes too far for a box.
 */
APART bool rows_of_odd(const yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle,
                       const yb_vertex_t *const v[3], int32_t *first, int32_t *last)
{
    const yb_index_t *corner = yb_map_triangle(frame->map, triangle);
    yb_point_t root[REFINE_POINTS]; /* and the walls' feet */
    const yb_point_t *const p[REFINE_POINTS] = {&root[0], &root[1], &root[2],
                                                &root[3], &root[4], &root[5]};
    const bool walls = walls_are_below(frame, triangle);
    const int count = walls ? REFINE_POINTS : 3;
    for (int i = 0; i < 3; i++) {
        camera_root(frame, corner[i], &root[i]);
        if (walls)
            camera_drop(frame, &root[i], frame->base_q8, &root[3 + i]);
    }
    box_t box;
    const bool seen = find_box(p, count, &box);
    reach_t reach = whole_reach(frame, v, seen ? nearest_in(&box) : 65535);
    reach.stray = stray_in_water(frame, p, reach.stray);
    spare_t spare;
    if (seen && find_part_spare(frame, reach.often, reach.stray, box.near, &spare))
        return rows_of_box(whole, &spare, &box, first, last);
    return !misses_planes(frame, whole, p, count, reach.stray);
}

void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle)
{
    const yb_index_t *corner = yb_map_triangle(frame->map, triangle);
    const yb_vertex_t *v[3];
    bool plain = frame->view.water_q8 == YB_NO_WATER && !walls_are_below(frame, triangle);
    box_t box;
    begin_box(&box);
    for (int i = 0; i < 3; i++) {
        const yb_seen_t *seen = &frame->seen[corner[i]];
        v[i] = &frame->map->vertex[corner[i]];
        plain = plain && seen->near != 0;
        widen_to(&box, seen->x_q4, seen->y_q4, seen->near);
    }
    int32_t first = 0;
    int32_t last = frame->screen.height - 1;
    spare_t spare;
    if (plain) {
        const reach_t reach = whole_reach(frame, v, nearest_in(&box));
        plain = find_part_spare(frame, reach.often, reach.stray, box.near, &spare);
    }
    const bool shown = plain ? rows_of_box(whole, &spare, &box, &first, &last)
                             : rows_of_odd(frame, whole, triangle, v, &first, &last);
    if (!shown) {
        first = frame->screen.height - 1;
        last = 0;
    }
    frame->bins[triangle] = (uint8_t)(first >> frame->row_shift << 4 | last >> frame->row_shift);
}
