#include "camera.h"
#include "fix.h"
#include "order.h"
#include "refine.h"
#include "relief.h"

/* --- What lies outside the picture ------------------------------------------------------------ */

enum {
    SPARE_Q4 = 25 /* by which spots may be off where they should be */
};

/* Planes but the first go through the eye and a line `off` sixteenths of a pixel from the middle: a
 * slope is off / focal in 1/256, rounded up. The picture lies within a slope of 2.
 */
void refine_see(const yb_frame_t *frame, int32_t first_row, int32_t end_row, refine_view_t *view)
{
    /* What meets no pixel's centre draws nothing. */
    view->left_q4 = 9;
    view->top_q4 = first_row * 16 + 9;
    view->wide_q4 = (uint32_t)(frame->screen.width * 16 - 16);
    view->high_q4 = (uint32_t)((end_row - first_row) * 16 - 16);
    const int32_t focal = frame->focal_q4;
    const int32_t aside = frame->screen.width * 8 + SPARE_Q4;
    const int32_t middle = frame->screen.height * 8;
    const int32_t off_q4[REFINE_PLANES] = {focal, aside, aside, middle - first_row * 16 + SPARE_Q4,
                                           end_row * 16 - middle + SPARE_Q4};
    const int32_t scale = frame->view.exaggerate_q8;
    for (int i = 0; i < REFINE_PLANES; i++) {
        refine_plane_t *plane = &view->plane[i];
        const int up = i < REFINE_TOP ? 0 : i == REFINE_TOP ? -1 : 1;
        const int32_t slope = (off_q4[i] * 256 + (off_q4[i] > 0 ? focal - 1 : 0)) / focal;
        plane->slope_q8 = slope;
        plane->near = i == REFINE_NEAR ? camera_least(frame) : 0;
        const int32_t lift =
            up * (frame->up_z * scale >> 13) + (slope * (frame->depth_z * scale >> 13) >> 8);
        plane->lift_q9 = (fix_abs(lift) >> frame->eye_shift) + 2;
    }
}

/* Is a point beyond a plane by more than it, or anything that moves by `stray` from it, may come
 * back? Points are inside where slope * depth plus or minus right or up is `near` or more; depth
 * < 2^18 and |slope| <= 2 * 2^8 make 2^27. stray < 2^19 and lift < 2^14: within 2^29 after the
 * shift by 4.
 */
static inline unsigned is_beyond(const refine_plane_t *plane, int32_t inside, int32_t stray)
{
    return inside - plane->near < -((((stray >> 4) + 1) * plane->lift_q9 >> 5) + 12);
}

TINY unsigned asked(const refine_plane_t *plane, int i, unsigned of, const camera_point_t *at,
                    int32_t off, int32_t stray)
{
    if ((of & 1u << i) == 0)
        return 0;
    return is_beyond(&plane[i], (at->depth * plane[i].slope_q8 >> 8) + off, stray) << i;
}

/* The planes for which that is so, a bit each, of those that are asked for. */
APART unsigned beyond_which(const yb_frame_t *frame, const refine_view_t *view, uint32_t place,
                            int32_t top_q8, int32_t stray, unsigned of)
{
    const refine_plane_t *plane = view->plane;
    camera_point_t at;
    camera_view(frame, place, top_q8, &at);
    return asked(plane, REFINE_NEAR, of, &at, 0, stray) |
           asked(plane, REFINE_LEFTMOST, of, &at, at.right, stray) |
           asked(plane, REFINE_RIGHTMOST, of, &at, -at.right, stray) |
           asked(plane, REFINE_TOP, of, &at, -at.up, stray) |
           asked(plane, REFINE_BOTTOM, of, &at, at.up, stray);
}

/* Are points all beyond one of some planes, whether they have spots or not? */
static bool misses_planes(const yb_frame_t *frame, const refine_view_t *view,
                          const yb_point_t *const *p, int count, int32_t stray, unsigned of)
{
    while (of != 0 && count-- > 0)
        of = beyond_which(frame, view, p[count]->place, p[count]->top_q8, stray, of);
    return of != 0;
}

/* The box on the screen that holds some points and what lies between them, 1/16 pixel. */
typedef struct {
    int32_t left, right, top, bottom;
    int32_t near; /* greatest 1/depth */
} box_t;

/* If not all of them have spots it has no `near`, and its sides are any. */
COPIED void find_box(const yb_point_t *const *p, int count, box_t *box)
{
    box->near = 0;
    box->left = box->top = INT32_MAX;
    box->right = box->bottom = INT32_MIN;
    for (int k = 0; k < count; k++) {
        const yb_spot_t *spot = &p[k]->spot;
        if (spot->near == 0) {
            box->near = 0;
            return;
        }
        box->near = fix_max(box->near, spot->near);
        box->left = fix_min(box->left, spot->x_q4);
        box->right = fix_max(box->right, spot->x_q4);
        box->top = fix_min(box->top, spot->y_q4);
        box->bottom = fix_max(box->bottom, spot->y_q4);
    }
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

/* --- How far triangles may go ----------------------------------------------------------------- */

/* How far the smooth surface rises or falls at the middle of an edge. */
static inline int32_t bend_of(const yb_vertex_t *a, const yb_vertex_t *b)
{
    return fix_abs(relief_bulge((int32_t)b->gx_q11 - a->gx_q11, (int32_t)b->gy_q11 - a->gy_q11,
                                fix_minus(a->x_q8, b->x_q8), fix_minus(a->y_q8, b->y_q8)));
}

/* Slopes are linear on a base triangle, so that its smooth surface is of the second degree. Such a
 * surface bulges from the plane of a triangle at most 4/3 of what it does on that one's edges, and
 * on any line within another triangle at most 5/4 of what it does on the edges of that: 5/3 in all.
 */
int32_t refine_bulge(const yb_map_t *map, const yb_vertex_t *const corner[3])
{
    if (!map->smooth)
        return 0;
    const int32_t bulge =
        fix_max(bend_of(corner[0], corner[1]),
                fix_max(bend_of(corner[1], corner[2]), bend_of(corner[2], corner[0])));
    return 7 * bulge >> 2;
}

/* How far refinement can move a point of a triangle whose longest edge is of a class and halved so
 * often. Each part of an edge is of a class four lower and halved once less, and so is what is
 * split inside the triangle: a point moves by the noise of each class once. (relief_reach counts it
 * twice.) Rounding moves it by one unit of height more at each level, and one in all; slopes are
 * rounded by half a unit at each level, so that those of an edge of level n differ by n - 1 more or
 * less than they should: on both axes 2 * 2^16 / 2^14 * (0/1 + 1/2 + 2/4 + 3/8 …), which is at most
 * 4 a level after the first, and 16.
 */
COPIED int32_t stray_of(const yb_map_t *map, int32_t bulge, int class, int often)
{
    int32_t reach = map->reach_q8[class];
    const int rest = class - 4 * often;
    if (reach == UINT16_MAX)
        reach = RELIEF_MOST_REACH_Q8;
    else if (rest >= 0)
        reach -= map->reach_q8[rest];
    return bulge + fix_min(5 * often, REFINE_LEVELS + 20) - 3 + (reach >> 1);
}

/* Of a triangle of which some edges are split. */
static inline int32_t limited_stray(const yb_frame_t *frame, const yb_part_t *part)
{
    yb_edge_t longest = 0; /* or one that is left whole, and shorter */
    for (int i = 0; i < 3; i++) {
        const yb_edge_t class = part->edge[i] & REFINE_CLASS;
        longest = class > longest ? class : longest;
    }
    return stray_of(frame->map, part->bulge, refine_class(longest),
                    refine_often(refine_edges(part))); /* or less often */
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

COPIED int32_t part_stray(const yb_frame_t *frame, const yb_part_t *part)
{
    int32_t stray = refine_edges(part) >= REFINE_ONCE ? limited_stray(frame, part) : 0;
    return stray_in_water(frame, part->point, stray);
}

int32_t refine_stray(const yb_frame_t *frame, const yb_part_t *part)
{
    return part_stray(frame, part);
}

/* The map's bound is by other midpoints. Twice that is more than any point moves: three times the
 * bulge of an edge, four times what noise does; and that is below 2^19. Or all the ground that is
 * above the water sinks to it.
 */
void refine_see_vertices(yb_frame_t *frame, const refine_view_t *whole)
{
    const yb_map_t *map = frame->map;
    const int32_t water = frame->view.water_q8;
    int32_t stray = fix_min(2 * map->stray_q8, (int32_t)1 << 19);
    if (map->low_q8 < water)
        stray = fix_max(stray, map->high_q8 - water);
    for (int i = 0; i < map->vertex_count; i++) {
        const yb_vertex_t *v = &map->vertex[i];
        if (frame->seen[i].near == 0)
            frame->seen[i].x_q4 = (yb_side_t)beyond_which(
                frame, whole, relief_place(v), fix_max(v->z_q8, water), stray, REFINE_ALL);
    }
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
    int32_t levels = fix_min(often, REFINE_LEVELS) + 1;
    spare->x = levels;
    spare->y = (((stray * near >> 10) + levels) * frame->lift >> frame->lift_shift) + levels;
    return true;
}

/* Points that a triangle, or a wall, can become: a box, if all have spots, and how far they go. */
typedef struct {
    const yb_point_t *const *p;
    int count;
    int often; /* how often an edge may be halved */
    int32_t stray;
    box_t box;
} crowd_t;

/* Is it not in the view? Its box is widened, or, where a pyramid must do, has no end. */
COPIED bool misses(const yb_frame_t *frame, const refine_view_t *view, crowd_t *crowd)
{
    box_t *box = &crowd->box;
    spare_t spare;
    if (box->near == 0 || !find_part_spare(frame, crowd->often, crowd->stray, box->near, &spare)) {
        box->top = INT32_MIN;
        box->bottom = INT32_MAX;
        return misses_planes(frame, view, crowd->p, crowd->count, crowd->stray, REFINE_ALL);
    }
    widen_box(&spare, box);
    return box_misses(view, box);
}

bool refine_halved_misses(const yb_frame_t *frame, const refine_view_t *view,
                          const yb_point_t *const *p, int count, int often, int32_t stray)
{
    crowd_t crowd; /* field by field: small compilers would clear it first */
    crowd.p = p;
    crowd.count = count;
    crowd.often = often;
    crowd.stray = stray;
    find_box(p, count, &crowd.box);
    return misses(frame, view, &crowd);
}

#if COPIES
/* Are three coordinates all before a way on the screen, or all behind it, by more than `spare`? */
static inline bool are_off(int32_t a, int32_t b, int32_t c, int32_t from, uint32_t size,
                           int32_t spare)
{
    const int32_t first = from - spare;
    const int32_t last = from + (int32_t)size - 1 + spare;
    return (((a - first) & (b - first) & (c - first)) | ((last - a) & (last - b) & (last - c))) < 0;
}

/* The planes that the corners may all be beyond: by their spots, of those that have one. */
static inline unsigned in_question(const yb_point_t *const p[3])
{
    unsigned beyond = REFINE_ALL;
    WRITTEN_OUT
    for (int i = 0; i < 3; i++)
        beyond &= p[i]->spot.near != 0 ? p[i]->spot.out : (unsigned)REFINE_ALL;
    return beyond;
}

/* Where speed counts more than size: only the sides of the box, and the planes, are looked at that
 * it is beyond.
 */
bool refine_far_off(const yb_frame_t *frame, const refine_view_t *view, const yb_part_t *part,
                    int beyond)
{
    const yb_point_t *const *p = part->point;
    const int often = refine_often(refine_edges(part));
    const int32_t stray = part_stray(frame, part);
    const yb_spot_t *a = &p[0]->spot;
    const yb_spot_t *b = &p[1]->spot;
    const yb_spot_t *c = &p[2]->spot;
    const int32_t near = fix_max(a->near, fix_max(b->near, c->near));
    spare_t spare;
    if ((beyond & REFINE_NOWHERE) != 0 || !find_part_spare(frame, often, stray, near, &spare))
        return misses_planes(frame, view, p, 3, stray, in_question(p));
    return ((beyond & (REFINE_ABOVE | REFINE_BELOW)) != 0 &&
            are_off(a->y_q4, b->y_q4, c->y_q4, view->top_q4, view->high_q4, spare.y)) ||
           ((beyond & (REFINE_LEFT | REFINE_RIGHT)) != 0 &&
            are_off(a->x_q4, b->x_q4, c->x_q4, view->left_q4, view->wide_q4, spare.x));
}
#else
bool refine_far_off(const yb_frame_t *frame, const refine_view_t *view, const yb_part_t *part,
                    int beyond)
{
    (void)beyond;
    return refine_halved_misses(frame, view, part->point, 3, refine_often(refine_edges(part)),
                                part_stray(frame, part));
}
#endif

/* --- Rows ------------------------------------------------------------------------------------- */

COPIED int32_t spread(int32_t a, int32_t b, int32_t c)
{
    return fix_max(a, fix_max(b, c)) - fix_min(a, fix_min(b, c));
}

/* How far refinement can move a point of a base triangle, as limited_stray: no edge is longer than
 * its box in plan is across, nor any point nearer than `near`, a 1/depth, so that none is halved
 * more often than that line would be there. A refine_edge is at most 6.8 % longer than it should
 * be, and this line at most 2.8 % shorter: an eighth more, halved, is below 2^16, and near is.
 */
COPIED void find_reach(const yb_frame_t *frame, const yb_vertex_t *const v[3], int32_t near,
                       crowd_t *crowd)
{
    const int32_t wide = spread(v[0]->x_q8, v[1]->x_q8, v[2]->x_q8);
    const int32_t high = spread(v[0]->y_q8, v[1]->y_q8, v[2]->y_q8);
    const uint32_t length = (uint32_t)fix_length(wide, high);
    uint32_t size = ((length + (length >> 3)) >> 1) * (uint32_t)near;
    crowd->stray = 0;
    crowd->often = 0;
    for (; size > frame->longest; size >>= 1)
        crowd->often++;
    if (crowd->often > 0)
        crowd->stray = stray_of(frame->map, refine_bulge(frame->map, v), relief_class(wide, high),
                                crowd->often);
}

/* With the spare of a box nothing comes nearer by more than an eighth: 8/7, or a little more. */
static inline int32_t nearest_in(const box_t *box)
{
    return fix_min(box->near + (box->near >> 3) + (box->near >> 5) + 1, 65535);
}

/* The box of what a base triangle away from water and walls can become, as most are, by what is
 * seen of its corners. False: that does not tell.
 */
static inline bool find_seen_box(const yb_frame_t *frame, const yb_index_t *corner,
                                 const yb_vertex_t *const v[3], box_t *box)
{
    const yb_seen_t *a = &frame->seen[corner[0]];
    const yb_seen_t *b = &frame->seen[corner[1]];
    const yb_seen_t *c = &frame->seen[corner[2]];
    if (a->near == 0 || b->near == 0 || c->near == 0 || frame->view.water_q8 != YB_NO_WATER)
        return false;
    box->near = fix_max(a->near, fix_max(b->near, c->near));
    box->left = fix_min(a->x_q4, fix_min(b->x_q4, c->x_q4));
    box->right = fix_max(a->x_q4, fix_max(b->x_q4, c->x_q4));
    box->top = fix_min(a->y_q4, fix_min(b->y_q4, c->y_q4));
    box->bottom = fix_max(a->y_q4, fix_max(b->y_q4, c->y_q4));
    crowd_t crowd;
    spare_t spare;
    find_reach(frame, v, nearest_in(box), &crowd);
    if (!find_part_spare(frame, crowd.often, crowd.stray, box->near, &spare))
        return false;
    widen_box(&spare, box);
    return true;
}

/* Is nothing of a base triangle, and of the walls below it, in the view? Else what its box is. */
SELDOM bool root_misses(const yb_frame_t *frame, const refine_view_t *whole,
                        const yb_index_t *corner, const yb_vertex_t *const v[3], bool walls,
                        box_t *box)
{
    yb_point_t root[3];
    yb_point_t foot[3];
    const yb_point_t *p[REFINE_POINTS];
    for (int i = 0; i < 3; i++) {
        p[i] = &root[i];
        p[3 + i] = &foot[i];
        camera_root(frame, corner[i], &root[i]);
        if (walls)
            camera_drop(frame, &root[i], frame->base_q8, &foot[i]);
    }
    crowd_t crowd;
    crowd.p = p;
    crowd.count = walls ? REFINE_POINTS : 3;
    find_box(p, crowd.count, &crowd.box);
    find_reach(frame, v, crowd.box.near == 0 ? 65535 : nearest_in(&crowd.box), &crowd);
    crowd.stray = stray_in_water(frame, p, crowd.stray);
    const bool missed = misses(frame, whole, &crowd);
    *box = crowd.box;
    return missed;
}

void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle)
{
    const yb_index_t *corner = relief_triangle(frame->map, triangle);
    const bool walls = walls_are_below(frame, triangle);
    const int32_t last = frame->screen.height - 1;
    frame->bins[triangle] = (uint8_t)(last >> frame->row_shift << 4);
    if (!walls && !order_shows(frame, triangle))
        return;
    const yb_vertex_t *v[3];
    for (int i = 0; i < 3; i++)
        v[i] = &frame->map->vertex[corner[i]];
    box_t box;
    const bool missed = COPIES && !walls && find_seen_box(frame, corner, v, &box)
                            ? box_misses(whole, &box)
                            : root_misses(frame, whole, corner, v, walls, &box);
    if (missed)
        return;
    /* From the first row whose pixels' centres it may cover to the last. */
    const int32_t first_bin = fix_clamp(raster_pixel(box.top), 0, last) >> frame->row_shift;
    const int32_t last_bin = fix_clamp(raster_pixel(box.bottom - 16), 0, last) >> frame->row_shift;
    frame->bins[triangle] = (uint8_t)(first_bin << 4 | last_bin);
}
