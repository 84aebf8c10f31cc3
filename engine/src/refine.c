#include "refine.h"

#include <yamabiko/rom.h>

#include "camera.h"
#include "clip.h"
#include "fix.h"
#include "relief.h"
#include "shade.h"

/* --- Edges ------------------------------------------------------------------------------------ */

static inline int32_t bulge_of(const yb_point_t *a, const yb_point_t *b)
{
    return relief_bulge(relief_dx(b->slope, a->slope), relief_dy(b->slope, a->slope),
                        relief_dx(a->place, b->place), relief_dy(a->place, b->place));
}

/* Under water all along, however it is refined? Then it is seen as a straight line on a plane. */
static bool drowned(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    int32_t rise = fix_abs(bulge_of(a, b));
    int class = relief_class(relief_dx(a->place, b->place), relief_dy(a->place, b->place));
    const relief_bound_t bound = {rise + (rise >> 1) + 16, class};
    return fix_max(a->z_q8, b->z_q8) + relief_reach(frame->map, &bound, 0) < frame->view.water_q8;
}

/* The nearest of an edge's ends, as 1/depth. Beyond the near distance, for what is behind it. */
static int32_t nearest(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    camera_point_t at[2];
    camera_view(frame, a->place, a->top_q8, &at[0]);
    camera_view(frame, b->place, b->top_q8, &at[1]);
    return camera_near(frame, fix_max(fix_min(at[0].depth, at[1].depth), frame->near));
}

/* Length and 1/depth have 16 bits each. With 1/depth from v to w > v, the middle of an edge of s
 * pixels is seen s/2 (w - v) / (w + v) from the middle of its spots. Where w - v is no more than a
 * quarter of w, nor s (w - v) more than 2 w, that is at most 16/7/4 pixel, and a quarter of it for
 * its halves: 0.77 in all (SPARE_Q4), and one number will do for all of the edge.
 */
yb_edge_t refine_ask(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                     yb_edge_t edge)
{
    int32_t change = fix_abs(fix_minus(a->spot.near, b->spot.near));
    int32_t near = fix_max(a->spot.near, b->spot.near);
    bool seen = change < near;
    if (!seen)
        near = nearest(frame, a, b);
    edge &= 0xffffff;
    uint32_t size = (edge & 0xffff) * (uint32_t)near;
    if (size <= frame->longest)
        return edge;
    uint32_t parity = a->place ^ b->place;
    parity |= parity >> 16;
    yb_edge_t asked = edge;
    for (; size > frame->longest && (parity & 1) == 0; size >>= 1, parity >>= 1)
        asked += REFINE_ONCE;
    if (asked == edge || (frame->even_water && fix_max(a->z_q8, b->z_q8) < frame->view.water_q8 &&
                          drowned(frame, a, b)))
        return edge;
    if (!seen || change << 2 > near) /* or there are no spots */
        return edge | REFINE_AGAIN;
    int32_t wide = fix_abs(a->spot.x_q4 - b->spot.x_q4);
    int32_t high = fix_abs(a->spot.y_q4 - b->spot.y_q4);
    return (fix_max(wide, high) >> 4) * change <= 2 * near ? asked : edge | REFINE_AGAIN;
}

/* Is an edge of this length left whole, as most are, by its nearer end? */
static inline bool looks_short(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                               yb_edge_t length)
{
    int32_t least = fix_min(a->spot.near, b->spot.near);
    int32_t most = fix_max(a->spot.near, b->spot.near);
    return least > 0 && length * (uint32_t)most <= frame->longest;
}

yb_edge_t refine_edge(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b)
{
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    /* Below 2^16 each, times 2^13, which has the length of a unit vector: below 2^30. */
    int32_t across = fix_abs(dx * frame->across_x + dy * frame->across_y) >> 14;
    int32_t along = fix_abs(dx * frame->along_x + dy * frame->along_y) >> 14;
    yb_edge_t edge = (yb_edge_t)fix_length(across, along);
    if (looks_short(frame, a, b, edge))
        return edge;
    edge = refine_ask(frame, a, b, edge);
    return edge < REFINE_ONCE ? edge : edge | (yb_edge_t)(relief_class(dx, dy) + 4) << 16;
}

/* The edge ab between two midpoints, from a half that is as long. */
static yb_edge_t inner_edge(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                            yb_edge_t half)
{
    return looks_short(frame, a, b, half & 0xffff) ? half & 0xffffff
                                                   : refine_ask(frame, a, b, half);
}

/* Each half's mean of two numbers, rounded down. */
static inline uint32_t mean2(uint32_t a, uint32_t b)
{
    return (a & b) + ((a ^ b) >> 1 & 0x7fff7fff);
}

void refine_middle(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                   yb_edge_t edge, yb_point_t *middle)
{
    const yb_map_t *map = frame->map;
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    int32_t z = (a->z_q8 + b->z_q8) >> 1;
    if (map->smooth)
        z += relief_bulge(relief_dx(b->slope, a->slope), relief_dy(b->slope, a->slope), dx, dy);
    middle->place = mean2(a->place, b->place);
    middle->slope = mean2(a->slope, b->slope);
    z += relief_rough(map, middle->place, refine_class(edge), dx, dy, b->z_q8 - a->z_q8);
    middle->z_q8 = z;
    middle->top_q8 = fix_max(z, frame->view.water_q8);
    int32_t rise = middle->top_q8 - ((a->top_q8 + b->top_q8) >> 1);
    /* Half way between the ends' spots, and up by the rise. What needs more than that, and what
     * comes to lie more than a screen size off, is placed exactly. */
    if (edge < REFINE_AGAIN && a->spot.near > 0 && b->spot.near > 0 && fix_abs(rise) < 1 << 14) {
        int32_t near = fix_middle(a->spot.near, b->spot.near);
        int32_t turn = rise * near; /* below 2^30 */
        int32_t y = ((a->spot.y_q4 + b->spot.y_q4) >> 1) -
                    ((turn >> 10) * frame->lift >> frame->lift_shift);
        uint32_t high = frame->screen.height * (uint32_t)16;
        if (fix_abs(turn) <= frame->most_bend && (uint32_t)y + high <= 3 * high) {
            middle->spot.x_q4 = (a->spot.x_q4 + b->spot.x_q4) >> 1;
            middle->spot.y_q4 = y;
            middle->spot.near = (uint16_t)near;
            return;
        }
    }
    camera_see(frame, middle);
}

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
    SPARE_Q4 = 14 /* by which spots may be off where they should be */
};

void refine_see(const yb_frame_t *frame, int32_t first_row, int32_t end_row, refine_view_t *view)
{
    /* What meets no pixel's centre draws nothing. */
    view->left_q4 = 9;
    view->right_q4 = frame->screen.width * 16 - 8;
    view->top_q4 = first_row * 16 + 9;
    view->bottom_q4 = end_row * 16 - 8;
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
    camera_point_t at[4];
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

/* False: not all of them have spots. */
static inline bool find_box(const yb_point_t *const *p, int count, box_t *box)
{
    box->near = p[0]->spot.near;
    box->left = box->right = p[0]->spot.x_q4;
    box->top = box->bottom = p[0]->spot.y_q4;
    for (int k = 1; k < count; k++) {
        const yb_spot_t *spot = &p[k]->spot;
        box->near = fix_max(box->near, spot->near);
        box->left = fix_min(box->left, spot->x_q4);
        box->right = fix_max(box->right, spot->x_q4);
        box->top = fix_min(box->top, spot->y_q4);
        box->bottom = fix_max(box->bottom, spot->y_q4);
    }
    return box->top != INT32_MIN;
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

static bool widen_box(const yb_frame_t *frame, int32_t stray, box_t *box)
{
    spare_t spare;
    if (!find_spare(frame, stray, box->near, &spare))
        return false;
    box->left -= spare.x;
    box->right += spare.x;
    box->top -= spare.y;
    box->bottom += spare.y;
    return true;
}

static inline bool box_misses(const refine_view_t *view, const box_t *box)
{
    return box->bottom < view->top_q4 || box->top > view->bottom_q4 || box->right < view->left_q4 ||
           box->left > view->right_q4;
}

bool refine_misses(const yb_frame_t *frame, const refine_view_t *view, const yb_point_t *const *p,
                   int count, int32_t stray)
{
    box_t box;
    if (!find_box(p, count, &box) || !widen_box(frame, stray, &box))
        return misses_planes(frame, view, p, count, stray);
    return box_misses(view, &box);
}

static inline int next_of(int i)
{
    return i == 2 ? 0 : i + 1;
}

/* The length class of the longest edge that is split. */
static inline int split_class(const yb_part_t *part)
{
    yb_edge_t class = 0;
    for (int i = 0; i < 3; i++) {
        yb_edge_t edge = part->edge[i];
        class = edge >= REFINE_ONCE && (edge & 0xff0000) > class ? edge & 0xff0000 : class;
    }
    return refine_class(class);
}

/* REFINE_ONCE or more if one of a triangle's edges is. */
static inline yb_edge_t edges_of(const yb_part_t *part)
{
    return part->edge[0] | part->edge[1] | part->edge[2];
}

/* How far refinement can move a point of a triangle of which some edges are split: by their
 * midpoints now, and by what its parts do then. None of them has an edge that is longer than the
 * mean of the longest of all and the longest that is left whole: halves are no longer, and a line
 * from a corner to a midpoint no longer than the mean of the sides beside it.
 *
 * None of it comes nearer by more than an eighth; else the caller has to know of no limit.
 */
static int32_t limited_stray(const yb_frame_t *frame, const yb_part_t *part, int32_t near)
{
    const yb_map_t *map = frame->map;
    yb_edge_t longest = 0;
    yb_edge_t whole = 0;
    uint32_t square = 0;
    int32_t bulge = 0;
    for (int i = 0; i < 3; i++) {
        const yb_point_t *a = part->point[i];
        const yb_point_t *b = part->point[next_of(i)];
        int32_t dx = relief_dx(a->place, b->place);
        int32_t dy = relief_dy(a->place, b->place);
        int32_t rise = fix_abs(
            relief_bulge(relief_dx(b->slope, a->slope), relief_dy(b->slope, a->slope), dx, dy));
        uint32_t half = relief_half_square(dx, dy);
        yb_edge_t length = part->edge[i] & 0xffff;
        bulge = rise > bulge ? rise : bulge;
        square = half > square ? half : square;
        longest = length > longest ? length : longest;
        whole = part->edge[i] < REFINE_ONCE && length > whole ? length : whole;
    }
    int class = split_class(part);
    int32_t now = (map->noise[class] * (int32_t)RELIEF_HASH_MOST >> RELIEF_NOISE_SHIFT) + 1;
    uint32_t size = (((longest + whole) >> 1) + 1) * (uint32_t)near;
    size += size >> 3;
    /* The parabola through the midpoints bulges at most 4/3 of the largest rise; rounding of 16
     * levels adds at most as many units. */
    bulge += (bulge >> 1) + 16;
    if (size <= frame->longest)
        return bulge + now;
    int often = 0;
    for (; size > frame->longest && often < 16; size >>= 1)
        often++;
    class = whole == 0 ? (int)fix_max(class - 4, 0) : relief_square_class(square);
    const relief_bound_t bound = {bulge, class};
    return now + relief_reach(map, &bound, class + 4 - 4 * often);
}

int32_t refine_stray(const yb_frame_t *frame, const yb_part_t *part)
{
    const yb_point_t *const *p = part->point;
    int32_t near = fix_max(p[0]->spot.near, fix_max(p[1]->spot.near, p[2]->spot.near));
    int32_t stray = 0;
    if (edges_of(part) >= REFINE_ONCE) {
        bool seen = p[0]->spot.near > 0 && p[1]->spot.near > 0 && p[2]->spot.near > 0;
        stray = limited_stray(frame, part, seen ? near : 65535);
        if (stray >= 1 << 14 || (stray * near) >> 3 > frame->most_bend)
            stray = limited_stray(frame, part, 65535);
    }
    /* What is above the water may sink to it where the ground between dips under it. */
    int32_t water = frame->view.water_q8;
    if (p[0]->z_q8 < water || p[1]->z_q8 < water || p[2]->z_q8 < water)
        stray = fix_max(stray, fix_max(p[0]->top_q8, fix_max(p[1]->top_q8, p[2]->top_q8)) - water);
    return stray;
}

/* The sides of the view that a point is beyond. */
static inline uint8_t out_of(const refine_view_t *view, const yb_spot_t *spot)
{
    if (spot->near == 0)
        return REFINE_NOWHERE;
    return (uint8_t)((spot->y_q4 < view->top_q4 ? REFINE_ABOVE : 0) |
                     (spot->y_q4 > view->bottom_q4 ? REFINE_BELOW : 0) |
                     (spot->x_q4 < view->left_q4 ? REFINE_LEFT : 0) |
                     (spot->x_q4 > view->right_q4 ? REFINE_RIGHT : 0));
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
            fix_min(a->y_q4, fix_min(b->y_q4, c->y_q4)) - view->bottom_q4 > spare->y) ||
           ((beyond & REFINE_LEFT) != 0 &&
            view->left_q4 - fix_max(a->x_q4, fix_max(b->x_q4, c->x_q4)) > spare->x) ||
           ((beyond & REFINE_RIGHT) != 0 &&
            fix_min(a->x_q4, fix_min(b->x_q4, c->x_q4)) - view->right_q4 > spare->x);
}

/* Is nothing that a triangle can become in the view? Most lie in it as they are. Of one whose
 * corners are all beyond one side, such a side is enough: is it farther away than any of it can
 * come?
 */
static bool part_misses(const yb_frame_t *frame, const refine_view_t *view, const yb_part_t *part)
{
    const yb_point_t *const *p = part->point;
    int beyond = p[0]->spot.out & p[1]->spot.out & p[2]->spot.out;
    if (((p[0]->spot.out | p[1]->spot.out | p[2]->spot.out) & REFINE_NOWHERE) != 0)
        return refine_misses(frame, view, p, 3, refine_stray(frame, part));
    if (beyond == 0)
        return false;
    int32_t near = fix_max(p[0]->spot.near, fix_max(p[1]->spot.near, p[2]->spot.near));
    spare_t spare;
    int32_t stray = refine_stray(frame, part);
    if (!find_spare(frame, stray, near, &spare))
        return misses_planes(frame, view, p, 3, stray);
    return farther(view, p, beyond, &spare);
}

/* --- Triangles -------------------------------------------------------------------------------- */

void refine_root(yb_frame_t *frame, const refine_view_t *view, yb_triangle_t triangle,
                 yb_part_t *part)
{
    for (int i = 0; i < 3; i++) {
        camera_root(frame, frame->map->triangle[triangle][i], &frame->root[i]);
        frame->root[i].spot.out = out_of(view, &frame->root[i].spot);
        part->point[i] = &frame->root[i];
    }
    for (int i = 0; i < 3; i++)
        part->edge[i] = refine_edge(frame, part->point[i], part->point[next_of(i)]);
}

bool refine_splits(const yb_frame_t *frame, yb_part_t *part)
{
    for (int i = 0; i < 3; i++) {
        if (part->edge[i] >= REFINE_ASK)
            part->edge[i] =
                refine_ask(frame, part->point[i], part->point[next_of(i)], part->edge[i]);
    }
    return edges_of(part) >= REFINE_ONCE;
}

/* The midpoint of an edge, in a place on the stack. */
static const yb_point_t *middle_in(const yb_frame_t *frame, const refine_view_t *view,
                                   yb_level_t *level, const yb_point_t *a, const yb_point_t *b,
                                   yb_edge_t edge)
{
    refine_middle(frame, a, b, edge, &level->middle);
    level->middle.spot.out = out_of(view, &level->middle.spot);
    return &level->middle;
}

/* As SPEC 3.4. A part that is laid aside needs no midpoint above its own place on the stack, or one
 * and the next place's as its last corner.
 */
yb_level_t *refine_split(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                         yb_level_t *level)
{
    const yb_point_t *a = part->point[0];
    const yb_point_t *b = part->point[1];
    const yb_point_t *c = part->point[2];
    yb_edge_t ab = part->edge[0];
    yb_edge_t bc = part->edge[1];
    yb_edge_t ca = part->edge[2];
    /* Turned so that of the edges that are split ab is the first. */
    while (ab < REFINE_ONCE || (bc < REFINE_ONCE && ca >= REFINE_ONCE)) {
        const yb_point_t *p = a;
        yb_edge_t edge = ab;
        a = b;
        b = c;
        c = p;
        ab = bc;
        bc = ca;
        ca = edge;
    }
    const yb_point_t *m = middle_in(frame, view, &level[0], a, b, ab);
    yb_edge_t am = refine_half(ab);
    if (bc < REFINE_ONCE) {
        yb_edge_t mc = refine_edge(frame, m, c);
        level[0].rest = (yb_part_t){{m, b, c}, {am, bc, mc}};
        *part = (yb_part_t){{a, m, c}, {am, mc, ca}};
        return level + 1;
    }
    const yb_point_t *n = middle_in(frame, view, &level[1], b, c, bc);
    yb_edge_t bn = refine_half(bc);
    if (ca < REFINE_ONCE) {
        yb_edge_t mc = refine_edge(frame, m, c);
        yb_edge_t mn = refine_edge(frame, m, n);
        level[0].rest = (yb_part_t){{c, a, m}, {ca, am, mc}};
        level[1].rest = (yb_part_t){{c, m, n}, {mc, mn, bn}};
        *part = (yb_part_t){{n, m, b}, {mn, am, bn}};
        return level + 2;
    }
    const yb_point_t *o = middle_in(frame, view, &level[2], c, a, ca);
    yb_edge_t co = refine_half(ca);
    /* Half as long as, and parallel to, the edges of the triangle. */
    yb_edge_t on = inner_edge(frame, o, n, am);
    yb_edge_t mo = inner_edge(frame, m, o, bn);
    yb_edge_t mn = inner_edge(frame, m, n, co);
    level[0].rest = (yb_part_t){{m, b, n}, {am, bn, mn}};
    level[1].rest = (yb_part_t){{m, n, o}, {mn, on, mo}};
    level[2].rest = (yb_part_t){{o, n, c}, {on, bn, co}};
    *part = (yb_part_t){{a, m, o}, {am, mo, co}};
    return level + 3;
}

bool refine_next(const yb_level_t *bottom, yb_level_t **top, yb_part_t *part)
{
    for (yb_level_t *level = *top; level-- != bottom;) {
        if (level->rest.point[0] == NULL)
            continue;
        *part = level->rest;
        level->rest.point[0] = NULL;
        *top = level + (part->point[2] == &level[1].middle ? 2 : 1);
        return true;
    }
    return false;
}

void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle)
{
    yb_part_t part;
    refine_root(frame, whole, triangle, &part);
    (void)refine_splits(frame, &part);
    int32_t stray = refine_stray(frame, &part);
    int32_t last = frame->screen.height - 1;
    int32_t first = 0;
    box_t box;
    if (refine_misses(frame, whole, part.point, 3, stray)) {
        first = last;
        last = 0;
    } else if (find_box(part.point, 3, &box) && widen_box(frame, stray, &box)) {
        first = fix_clamp(box.top >> 4, 0, last);
        last = fix_clamp(box.bottom >> 4, 0, last);
    }
    frame->rows[triangle] = (uint8_t)(first >> frame->row_shift << 4 | last >> frame->row_shift);
}

/* --- Refinement ------------------------------------------------------------------------------- */

static void hand_out(const raster_t *raster, const yb_point_t *const p[3])
{
    yb_vertex_t corner[3];
    for (int i = 0; i < 3; i++) {
        corner[i].x_q8 = (uint16_t)p[i]->place;
        corner[i].y_q8 = (uint16_t)(p[i]->place >> 16);
        corner[i].z_q8 = p[i]->top_q8;
        corner[i].gx_q11 = (int16_t)((int32_t)(p[i]->slope & 0xffff) - 32768);
        corner[i].gy_q11 = (int16_t)((int32_t)(p[i]->slope >> 16) - 32768);
    }
    raster->each(raster->context, &corner[0], &corner[1], &corner[2]);
}

/* Draws a triangle that is not split any more and has a corner without a spot. */
static void draw_clipped(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                         const yb_point_t *const p[3])
{
    /* Where corners with spots lie in view space is known less well. */
    if (p[0]->spot.near == 0 && p[1]->spot.near == 0 && p[2]->spot.near == 0 &&
        misses_planes(frame, view, p, 3, 0))
        return;
    if (!clip_draw(frame, raster, p, shade_ground(frame, p)))
        return;
    frame->stats.drawn++;
    if (raster->band == NULL)
        hand_out(raster, p);
}

/* Draws a triangle that a line crosses, of the shore or of a contour; false: none does. */
static bool draw_lines(const yb_frame_t *frame, const raster_t *raster,
                       const yb_point_t *const p[3], raster_look_t look, uint16_t pixel)
{
    raster_cut_t cut;
    if (!shade_cut(frame, p, pixel, &cut))
        return false;
    raster_plane(raster, (const yb_spot_t *const[3]){&p[0]->spot, &p[1]->spot, &p[2]->spot}, look,
                 pixel, &cut);
    return true;
}

static inline void leaf(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                        const yb_point_t *const p[3])
{
    frame->stats.refined++;
    if (raster == NULL || (p[0]->spot.out & p[1]->spot.out & p[2]->spot.out & REFINE_SIDES) != 0)
        return;
    if (((p[0]->spot.out | p[1]->spot.out | p[2]->spot.out) & REFINE_NOWHERE) != 0) {
        draw_clipped(frame, view, raster, p);
        return;
    }
    raster_look_t look = raster_front(&p[0]->spot, &p[1]->spot, &p[2]->spot);
    if (look == RASTER_NOTHING)
        return;
    frame->stats.drawn++;
    if (raster->band == NULL) {
        hand_out(raster, p);
        return;
    }
    uint16_t pixel = shade_ground(frame, p);
    if (frame->lines && draw_lines(frame, raster, p, look, pixel))
        return;
    raster_fill(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot, look, pixel);
}

void refine_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                 yb_triangle_t triangle)
{
    yb_level_t *top = frame->level;
    const yb_level_t *last = &frame->level[YB_MAX_LEVELS - REFINE_PIECES];
    yb_part_t part;
    refine_root(frame, view, triangle, &part);
    do {
        if (raster == NULL && frame->stats.refined > frame->view.max_leaves)
            return; /* counted enough: too many */
        while (edges_of(&part) >= REFINE_ONCE &&
               (edges_of(&part) < REFINE_ASK || refine_splits(frame, &part))) {
            if (part_misses(frame, view, &part))
                goto next;
            if (top > last) {
                frame->stats.depth_limited++;
                break;
            }
            top = refine_split(frame, view, &part, top);
        }
        leaf(frame, view, raster, part.point);
    next:;
    } while (refine_next(frame->level, &top, &part));
}
