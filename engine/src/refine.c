#include "refine.h"

#include <yamabiko/rom.h>

#include "camera.h"
#include "clip.h"
#include "fix.h"
#include "order.h"
#include "relief.h"
#include "shade.h"

/* --- Edges ------------------------------------------------------------------------------------ */

static inline int32_t bulge_of(const yb_point_t *a, const yb_point_t *b)
{
    const uint32_t bend = a->slope - b->slope;
    return relief_bulge(relief_way_x(bend), relief_way_y(bend), relief_dx(a->place, b->place),
                        relief_dy(a->place, b->place));
}

/* An edge, left whole if it is under water all along, however it is refined: then it is seen as a
 * straight line on a plane.
 */
APART yb_edge_t unless_drowned(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                               yb_edge_t edge)
{
    int32_t rise = fix_abs(bulge_of(a, b));
    int class = relief_class(relief_dx(a->place, b->place), relief_dy(a->place, b->place));
    const relief_bound_t bound = {rise + (rise >> 1) + 16, class};
    int32_t most = fix_max(a->z_q8, b->z_q8) + relief_reach(frame->map, &bound, 0);
    return most < frame->view.water_q8 ? edge & 0xffffff : edge;
}

static inline yb_edge_t unless_under_water(const yb_frame_t *frame, const yb_point_t *a,
                                           const yb_point_t *b, yb_edge_t edge)
{
    const int32_t water = frame->view.water_q8;
    if (a->z_q8 < water && b->z_q8 < water && frame->even_water)
        return unless_drowned(frame, a, b, edge);
    return edge;
}

/* Of the differences of an edge's ends: the lowest bit says whether it cannot be split, the next
 * one whether its halves cannot, and so on.
 */
static inline uint32_t parity_of(const yb_point_t *a, const yb_point_t *b)
{
    const uint32_t parity = a->place ^ b->place;
    return parity | parity >> 16;
}

/* An edge of which not both ends have a spot. The nearer of them counts, as 1/depth, beyond the
 * near distance for what is behind it.
 */
APART yb_edge_t ask_unseen(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                           yb_edge_t edge)
{
    if ((parity_of(a, b) & 1) != 0)
        return edge;
    const int32_t depth = fix_max(
        fix_min(camera_depth(frame, a->place, a->top_q8), camera_depth(frame, b->place, b->top_q8)),
        frame->near);
    if ((edge & 0xffff) * (uint32_t)camera_near(frame, depth) <= frame->longest)
        return edge;
    return unless_under_water(frame, a, b, edge | REFINE_AGAIN);
}

/* Length and 1/depth have 16 bits each. With 1/depth from v to w > v, the middle of an edge of s
 * pixels is seen s/2 (w - v) / (w + v) from the middle of its spots. Where w - v is no more than a
 * quarter of w, nor s (w - v) more than 2 w, that is at most 16/7/4 pixel, and a quarter of it for
 * its halves: 0.77 in all (SPARE_Q4), and one number will do for all of the edge.
 */
yb_edge_t refine_ask(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                     yb_edge_t edge)
{
    const int32_t a_near = a->spot.near;
    const int32_t b_near = b->spot.near;
    edge &= 0xffffff;
    if (a_near == 0 || b_near == 0)
        return ask_unseen(frame, a, b, edge);
    const int32_t change = fix_abs(a_near - b_near);
    const int32_t near = fix_max(a_near, b_near);
    uint32_t size = (edge & 0xffff) * (uint32_t)near;
    uint32_t parity = parity_of(a, b);
    if (size <= frame->longest || (parity & 1) != 0)
        return edge;
    const int32_t wide = fix_abs((int32_t)a->spot.x_q4 - b->spot.x_q4);
    const int32_t high = fix_abs((int32_t)a->spot.y_q4 - b->spot.y_q4);
    if (change << 2 > near || (fix_max(wide, high) >> 4) * change > 4 * near) {
        edge |= REFINE_AGAIN;
    } else {
        do {
            edge += REFINE_ONCE;
            size >>= 1;
            parity >>= 1;
        } while (size > frame->longest && (parity & 1) == 0);
    }
    return unless_under_water(frame, a, b, edge);
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
    yb_edge_t edge = refine_ask(frame, a, b, (yb_edge_t)fix_length(across, along));
    if (edge < REFINE_ONCE)
        return edge;
    dx >>= 1; /* both are even: relief_class without signs */
    dy >>= 1;
    const uint32_t square = (uint32_t)(dx * dx) + (uint32_t)(dy * dy);
    return edge | (yb_edge_t)(relief_square_class(square) + 4) << 16;
}

/* A place on the screen, 1/16 pixel, and 1/depth there. */
typedef struct {
    int32_t x_q4, y_q4, near;
} seen_t;

/* The sides of the view that a place on the screen is beyond: of most, none. */
static inline uint8_t out_of(const refine_view_t *view, int32_t x_q4, int32_t y_q4)
{
    int32_t x = x_q4 - view->left_q4;
    int32_t y = y_q4 - view->top_q4;
    int out = 0;
    if ((uint32_t)y >= view->high_q4)
        out = y < 0 ? REFINE_ABOVE : REFINE_BELOW;
    if ((uint32_t)x >= view->wide_q4)
        out |= x < 0 ? REFINE_LEFT : REFINE_RIGHT;
    return (uint8_t)out;
}

/* A point that has been looked at. */
static inline void set_out(const refine_view_t *view, yb_spot_t *spot)
{
    spot->out = spot->near == 0 ? REFINE_NOWHERE : out_of(view, spot->x_q4, spot->y_q4);
}

/* Looks at a point for which there is no shorter way. */
APART void look(const yb_frame_t *frame, const refine_view_t *view, yb_point_t *point)
{
    camera_see(frame, point);
    set_out(view, &point->spot);
}

/* Where the middle of an edge is seen whose one end is much nearer, before it is moved: with
 * 1/depth w of the nearer end and v of the other, that is v / (v + w) of the way back from the
 * farther end, at most a half, by a table's reciprocal of 15 bits of the sum. The way on the screen
 * is below 3 * 16 * YB_MAX_SIDE + 80 < 2^18, and times 2^13 below 2^31.
 */
static inline seen_t see_between(const yb_spot_t *far, const yb_spot_t *close)
{
    if (far->near > close->near) {
        const yb_spot_t *other = far;
        far = close;
        close = other;
    }
    const uint32_t sum = (uint32_t)far->near + close->near;
    const int shift = 31 - fix_log2_floor(sum); /* 14 or more */
    const int32_t inverse = fix_reciprocal_here((int32_t)(sum << shift >> 17));
    const int32_t way_q14 = far->near * inverse >> (32 - shift);
    return (seen_t){
        .x_q4 = far->x_q4 + (((int32_t)close->x_q4 - far->x_q4) * way_q14 >> 14),
        .y_q4 = far->y_q4 + (((int32_t)close->y_q4 - far->y_q4) * way_q14 >> 14),
        .near = close->near * way_q14 >> 13,
    };
}

/* The spot of a midpoint between the ends' spots, and up by the rise: half way, or as the eye sees
 * it where one end is much nearer. False: the rise changes the depth too much for that, or it comes
 * to lie more than a screen size off.
 */
static inline bool see_middle(const yb_frame_t *frame, const refine_view_t *view,
                              const yb_spot_t *a, const yb_spot_t *b, yb_edge_t edge, int32_t rise,
                              yb_spot_t *middle)
{
    seen_t seen;
    if (edge < REFINE_AGAIN || a->near == b->near)
        seen = (seen_t){((int32_t)a->x_q4 + b->x_q4) >> 1, ((int32_t)a->y_q4 + b->y_q4) >> 1,
                        ((int32_t)a->near + b->near) >> 1};
    else
        seen = see_between(a, b);
    const int32_t turn = rise * seen.near; /* at most 2^30 */
    if ((uint32_t)(turn + frame->most_bend) > 2 * (uint32_t)frame->most_bend)
        return false;
    seen.y_q4 -= (turn >> 10) * frame->lift >> frame->lift_shift;
    const int out = out_of(view, seen.x_q4, seen.y_q4);
    if ((out & (REFINE_ABOVE | REFINE_BELOW)) != 0) {
        const uint32_t high = frame->screen.height * (uint32_t)16;
        if ((uint32_t)seen.y_q4 + high > 3 * high)
            return false;
    }
    middle->x_q4 = (yb_side_t)seen.x_q4;
    middle->y_q4 = (yb_side_t)seen.y_q4;
    middle->near = (uint16_t)seen.near;
    middle->out = (uint8_t)out;
    return true;
}

/* What gravity leaves of the noise at the midpoint of the edge ab. The class may be greater than
 * its own, as that of half another edge (cross_edge): what keeps to that is left.
 */
static inline int32_t limited(int32_t noise, int class, const yb_point_t *a, const yb_point_t *b)
{
    const int32_t rise = b->z_q8 - a->z_q8;
    if (relief_keeps(noise, class, rise))
        return noise;
    return relief_limit(noise, relief_dx(a->place, b->place), relief_dy(a->place, b->place), rise);
}

/* The rough part at the midpoint of the edge ab that lies at a place and rises by so much. */
static inline int32_t rough(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                            yb_edge_t edge, uint32_t place, int32_t rise)
{
    const int class = refine_class(edge);
    const int32_t scale = frame->noise[class];
    const int32_t noise = relief_shake(scale, place, frame->salt);
    return relief_keeps_all(scale, class, rise) ? noise : limited(noise, class, a, b);
}

void refine_middle(const yb_frame_t *frame, const refine_view_t *view, const yb_point_t *a,
                   const yb_point_t *b, yb_edge_t edge, yb_point_t *middle)
{
    const uint32_t from = a->place;
    const uint32_t place = relief_half_way(from, b->place);
    const uint32_t half = place - from;
    const uint32_t slope = b->slope;
    const uint32_t bend = a->slope - slope;
    const int32_t bend_x = relief_way_x(bend);
    const int32_t bend_y = relief_way_y(bend);
    middle->slope = slope + (uint32_t)(bend_x >> 1) + ((uint32_t)(bend_y >> 1) << 16);
    middle->place = place;
    const int32_t up = b->z_q8 - a->z_q8;
    int32_t z = a->z_q8 + (up >> 1);
    if (frame->smooth)
        z += relief_half_bulge(bend_x, bend_y, relief_way_x(half), relief_way_y(half));
    if (frame->noise != NULL)
        z += rough(frame, a, b, edge, place, up);
    const int32_t top = fix_max(z, frame->view.water_q8);
    middle->z_q8 = z;
    middle->top_q8 = top;
    const int32_t rise = top - ((a->top_q8 + b->top_q8) >> 1);
    if (a->spot.near == 0 || b->spot.near == 0 ||
        (uint32_t)(rise + (1 << 14)) >= (uint32_t)1 << 15 ||
        !see_middle(frame, view, &a->spot, &b->spot, edge, rise, &middle->spot))
        look(frame, view, middle);
}

/* --- Triangles -------------------------------------------------------------------------------- */

/* A surface of the second degree bulges from its plane at most 4/3 of what it does on an edge; a
 * line from a corner to a midpoint at most 5/4 of its triangle's edges, and of two such lines at
 * most one is split on.
 */
int32_t refine_bulge(const yb_map_t *map, const yb_point_t *const p[3])
{
    if (!map->smooth)
        return 0;
    int32_t bulge = fix_max(fix_abs(bulge_of(p[0], p[1])),
                            fix_max(fix_abs(bulge_of(p[1], p[2])), fix_abs(bulge_of(p[2], p[0]))));
    return 2 * bulge + (bulge >> 1);
}

void refine_corner(const yb_frame_t *frame, const refine_view_t *view, yb_index_t i,
                   yb_point_t *point)
{
    camera_root(frame, i, point);
    set_out(view, &point->spot);
}

bool refine_root(yb_frame_t *frame, const refine_view_t *view, yb_triangle_t triangle,
                 yb_part_t *part, bool all)
{
    const yb_index_t *corner = yb_map_triangle(frame->map, triangle);
    int beyond = all ? 0 : REFINE_NOWHERE;
    for (int i = 0; i < 3; i++) {
        refine_corner(frame, view, corner[i], &frame->root[i]);
        part->point[i] = &frame->root[i];
        beyond &= frame->root[i].spot.out;
    }
    if (beyond != 0 && refine_root_misses(frame, view, part->point))
        return false;
    part->edge[0] = refine_edge(frame, &frame->root[0], &frame->root[1]);
    part->edge[1] = refine_edge(frame, &frame->root[1], &frame->root[2]);
    part->edge[2] = refine_edge(frame, &frame->root[2], &frame->root[0]);
    part->bulge = refine_splits(part) ? refine_bulge(frame->map, part->point) : 0;
    order_root(frame, corner, part);
    return true;
}

/* An edge that an edge to be asked anew has left: most are short. */
static inline yb_edge_t ask_anew(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                                 yb_edge_t edge)
{
    return looks_short(frame, a, b, edge & 0xffff) ? edge & 0xffffff
                                                   : refine_ask(frame, a, b, edge);
}

/* Both halves of the edge ab at its midpoint m. */
static inline void halve(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *m,
                         const yb_point_t *b, yb_edge_t edge, yb_edge_t *am, yb_edge_t *mb)
{
    *am = *mb = refine_half(edge);
    if (edge >= REFINE_AGAIN) {
        *am = ask_anew(frame, a, m, *am);
        *mb = ask_anew(frame, m, b, *mb);
    }
}

/* The corner after another one. */
static inline int after(int i)
{
    return i == 2 ? 0 : i + 1;
}

/* Is a triangle to become many and yet seen as little more than a line? What is inside it is left
 * whole: else a sliver that is to become n pieces along its sides would become n times n.
 */
static bool is_sliver(const yb_frame_t *frame, const yb_part_t *part)
{
    const yb_spot_t *a = &part->point[0]->spot;
    const yb_spot_t *b = &part->point[1]->spot;
    const yb_spot_t *c = &part->point[2]->spot;
    if (refine_edges(part) < 3 * REFINE_ONCE || a->near == 0 || b->near == 0 || c->near == 0)
        return false;
    const int32_t bx = (int32_t)b->x_q4 - a->x_q4;
    const int32_t by = (int32_t)b->y_q4 - a->y_q4;
    const int32_t cx = (int32_t)c->x_q4 - a->x_q4;
    const int32_t cy = (int32_t)c->y_q4 - a->y_q4;
    const raster_area_t twice = (raster_area_t)bx * cy - (raster_area_t)by * cx;
    const int32_t wide = fix_max(fix_abs(bx), fix_abs(cx));
    const int32_t high = fix_max(fix_abs(by), fix_abs(cy));
    return (twice < 0 ? -twice : twice) < (raster_area_t)fix_max(wide, high) * frame->thin_q4;
}

/* The edge between two midpoints, parallel to one that is split and as long as its half. */
static inline yb_edge_t inner_edge(const yb_frame_t *frame, const yb_point_t *a,
                                   const yb_point_t *b, yb_edge_t edge, bool ask)
{
    yb_edge_t half = refine_half(edge);
    return ask ? ask_anew(frame, a, b, half) : half;
}

/* The line from the midpoint m of ab to c, where bc is split but not ca: about half of bc, for ca
 * is short, and split as that is, as far as its midpoints are on the lattice.
 */
static yb_edge_t cross_edge(const yb_frame_t *frame, const yb_point_t *m, const yb_point_t *c,
                            yb_edge_t bc)
{
    yb_edge_t mc = refine_half(bc);
    if (bc >= REFINE_AGAIN) /* unless the half is so short that it has no class */
        return refine_class(mc) >= 0 ? ask_anew(frame, m, c, mc) : mc & 0xffffff;
    const uint32_t parity = parity_of(m, c);
    int often = 0;
    while (often < (int)(mc >> 24) && (parity >> often & 1) == 0)
        often++;
    return (mc & 0xffffff) | (yb_edge_t)often << 24;
}

/* Of a triangle that is to be split, the corner a from which of the edges that are split ab is the
 * first.
 */
static inline int first_corner(const yb_part_t *part)
{
    if (part->edge[0] < REFINE_ONCE)
        return part->edge[1] < REFINE_ONCE ? 2 : 1;
    return part->edge[1] < REFINE_ONCE && part->edge[2] >= REFINE_ONCE ? 2 : 0;
}

/* How far the eye would be from a side if it were half way to the corner. */
static inline int32_t half_way(const yb_part_t *part)
{
    return (part->eye[0] + part->eye[1] + part->eye[2]) >> 1;
}

/* Of a triangle whose edges are all split, the corner a that has the part with its corner b come
 * last: of the three outer parts at most two lie on the eye's side of their inner edges.
 */
static inline int corner_before_last(const yb_part_t *part, int32_t half)
{
    return part->eye[1] <= half ? 0 : part->eye[2] <= half ? 1 : 2;
}

/* Has a triangle begin with its corner i. */
APART void turn(yb_part_t *part, int i)
{
    while (i-- > 0) {
        const yb_point_t *p = part->point[0];
        const yb_edge_t edge = part->edge[0];
        const int32_t eye = part->eye[0];
        part->point[0] = part->point[1];
        part->point[1] = part->point[2];
        part->point[2] = p;
        part->edge[0] = part->edge[1];
        part->edge[1] = part->edge[2];
        part->edge[2] = edge;
        part->eye[0] = part->eye[1];
        part->eye[1] = part->eye[2];
        part->eye[2] = eye;
    }
}

/* As SPEC 3.4, the parts in the order of order.h. A part that is laid aside needs no midpoint above
 * its own place on the stack, or one and the next place's as its last corner.
 */
static yb_level_t *split_one(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                             yb_level_t *level)
{
    const yb_point_t *const a = part->point[0];
    const yb_point_t *const b = part->point[1];
    const yb_point_t *const c = part->point[2];
    const yb_edge_t bc = part->edge[1];
    const yb_edge_t ca = part->edge[2];
    const int32_t eye_a = part->eye[0];
    const int32_t eye_b = part->eye[1];
    const int32_t eye_c = part->eye[2] >> 1;
    const int32_t bulge = part->bulge;
    yb_point_t *const m = &level[0].middle;
    yb_edge_t am;
    yb_edge_t mb;
    refine_middle(frame, view, a, b, part->edge[0], m);
    halve(frame, a, m, b, part->edge[0], &am, &mb);
    const int32_t across = (eye_a - eye_b) >> 1;
    const bool a_first = eye_a > eye_b;
    yb_part_t *const with_a = a_first ? part : &level[0].rest;
    yb_part_t *const with_b = a_first ? &level[0].rest : part;
    /* The line mc is no edge to be split: it is no longer than the mean of bc and ca, which are
     * left whole. */
    *with_a = (yb_part_t){{c, a, m}, {ca, am, 0}, {eye_c, across, eye_b}, bulge};
    *with_b = (yb_part_t){{b, c, m}, {bc, 0, mb}, {-across, eye_c, eye_a}, bulge};
    return level + 1;
}

static yb_level_t *split_two(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                             yb_level_t *level, yb_edge_t inside)
{
    const yb_point_t *const a = part->point[0];
    const yb_point_t *const b = part->point[1];
    const yb_point_t *const c = part->point[2];
    const yb_edge_t bc = part->edge[1];
    const yb_edge_t ca = part->edge[2];
    const int32_t eye_a = part->eye[0];
    const int32_t eye_b = part->eye[1];
    const int32_t eye_c = part->eye[2];
    const int32_t half = half_way(part);
    const int32_t bulge = part->bulge;
    yb_point_t *const m = &level[0].middle;
    yb_point_t *const n = &level[1].middle;
    yb_edge_t am;
    yb_edge_t mb;
    yb_edge_t bn;
    yb_edge_t nc;
    refine_middle(frame, view, a, b, part->edge[0], m);
    refine_middle(frame, view, b, c, bc, n);
    halve(frame, a, m, b, part->edge[0], &am, &mb);
    halve(frame, b, n, c, bc, &bn, &nc);
    const yb_edge_t mc = cross_edge(frame, m, c, bc) & inside;
    yb_part_t *const with_b = eye_b > half ? part : &level[0].rest;
    yb_part_t *const first = eye_b > half ? &level[1].rest : part;
    yb_part_t *const second = eye_b > half ? &level[0].rest : &level[1].rest;
    yb_part_t *const with_a = eye_a > eye_b ? first : second;
    yb_part_t *const with_c = eye_a > eye_b ? second : first;
    *with_b = (yb_part_t){{m, b, n}, {mb, bn, 0}, {eye_a, eye_b - half, eye_c}, bulge};
    *with_a =
        (yb_part_t){{c, a, m}, {ca, am, mc}, {eye_c >> 1, (eye_a - eye_b) >> 1, eye_b}, bulge};
    *with_c = (yb_part_t){{c, m, n}, {mc, 0, nc}, {half - eye_b, eye_a, eye_b - eye_a}, bulge};
    return level + 2;
}

static yb_level_t *split_three(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                               yb_level_t *level, yb_edge_t inside)
{
    const int32_t half = half_way(part);
    turn(part, corner_before_last(part, half));
    const yb_point_t *const a = part->point[0];
    const yb_point_t *const b = part->point[1];
    const yb_point_t *const c = part->point[2];
    const yb_edge_t ab = part->edge[0];
    const yb_edge_t bc = part->edge[1];
    const yb_edge_t ca = part->edge[2];
    const int32_t eye_a = part->eye[0];
    const int32_t eye_b = part->eye[1];
    const int32_t eye_c = part->eye[2];
    const int32_t bulge = part->bulge >> 2;
    yb_point_t *const m = &level[0].middle;
    yb_point_t *const n = &level[1].middle;
    yb_point_t *const o = &level[2].middle;
    yb_edge_t am;
    yb_edge_t mb;
    yb_edge_t bn;
    yb_edge_t nc;
    yb_edge_t co;
    yb_edge_t oa;
    refine_middle(frame, view, a, b, ab, m);
    refine_middle(frame, view, b, c, bc, n);
    refine_middle(frame, view, c, a, ca, o);
    halve(frame, a, m, b, ab, &am, &mb);
    halve(frame, b, n, c, bc, &bn, &nc);
    halve(frame, c, o, a, ca, &co, &oa);
    const bool ask = (ab | bc | ca) >= REFINE_AGAIN;
    const yb_edge_t on = inner_edge(frame, o, n, ab, ask) & inside;
    const yb_edge_t mo = inner_edge(frame, m, o, bc, ask) & inside;
    const yb_edge_t mn = inner_edge(frame, m, n, ca, ask) & inside;
    const bool a_first = eye_a > half;
    const bool c_first = eye_c > half;
    yb_part_t *const second = &level[2].rest;
    yb_part_t *const third = &level[1].rest;
    yb_part_t *const with_a = a_first ? part : c_first ? third : second;
    yb_part_t *const with_c = !c_first ? third : a_first ? second : part;
    yb_part_t *const middle = a_first != c_first ? second : a_first ? third : part;
    *with_a = (yb_part_t){{a, m, o}, {am, mo, oa}, {eye_a - half, eye_b, eye_c}, bulge};
    *with_c = (yb_part_t){{n, c, o}, {nc, co, on}, {eye_b, eye_c - half, eye_a}, bulge};
    *middle =
        (yb_part_t){{m, n, o}, {mn, on, mo}, {half - eye_c, half - eye_a, half - eye_b}, bulge};
    level[0].rest = (yb_part_t){{m, b, n}, {mb, bn, mn}, {eye_a, eye_b - half, eye_c}, bulge};
    return level + 3;
}

yb_level_t *refine_split(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                         yb_level_t *level)
{
    turn(part, first_corner(part));
    if (part->edge[1] < REFINE_ONCE)
        return split_one(frame, view, part, level);
    const yb_edge_t inside = is_sliver(frame, part) ? REFINE_ONCE - 1 : ~(yb_edge_t)0;
    if (part->edge[2] < REFINE_ONCE)
        return split_two(frame, view, part, level, inside);
    return split_three(frame, view, part, level, inside);
}

/* --- Drawing ---------------------------------------------------------------------------------- */

/* What stays the same while base triangles are drawn; with raster NULL leaves are only counted. */
typedef struct {
    yb_frame_t *frame;
    const refine_view_t *view;
    const raster_t *raster;
} walk_t;

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
        refine_misses(frame, view, p, 3, 0))
        return;
    if (!clip_draw(frame, raster, p, shade_ground(frame, p).pixel))
        return;
    frame->stats.drawn++;
    if (raster->band == NULL)
        hand_out(raster, p);
}

/* A leaf: draws it, if some of it may be in the band. */
static void leaf(const walk_t *walk, const yb_point_t *a, const yb_point_t *b, const yb_point_t *c)
{
    const int beyond = a->spot.out & b->spot.out & c->spot.out;
    const int some = a->spot.out | b->spot.out | c->spot.out;
    if ((beyond & REFINE_SIDES) != 0)
        return;
    yb_frame_t *frame = walk->frame;
    const raster_t *raster = walk->raster;
    const yb_point_t *const p[3] = {a, b, c};
    if ((some & REFINE_NOWHERE) != 0) {
        draw_clipped(frame, walk->view, raster, p);
        return;
    }
    raster_shape_t shape;
    raster_look_t look = raster_front(&a->spot, &b->spot, &c->spot, &shape);
    if (look == RASTER_NOTHING)
        return;
    frame->stats.drawn++;
    if (raster->band == NULL) {
        hand_out(raster, p);
        return;
    }
    /* As raster_fill, by what is known of the corners already. */
    if (look == RASTER_BETWEEN ||
        ((some & (REFINE_ABOVE | REFINE_BELOW)) != 0 && !raster_clip(raster, &shape)))
        return;
    const shade_t shade = shade_ground(frame, p);
    raster_cut_t cut;
    const bool cuts = frame->lines && shade_cut(frame, p, shade, &cut);
    if (look == RASTER_SMALL && (some & (REFINE_LEFT | REFINE_RIGHT)) == 0)
        raster_level(raster, &shape, shade.pixel, cuts ? &cut : NULL);
    else
        raster_plane(raster, &shape, shade.pixel, cuts ? &cut : NULL);
}

/* A triangle of which one or two edges are split, once: as refine_split, and its parts in the order
 * of refine_next, none of which needs a place on the stack. False: all three are, which is rare.
 */
APART bool draw_last(const walk_t *walk, const yb_part_t *part, yb_level_t *level)
{
    yb_frame_t *frame = walk->frame;
    const refine_view_t *view = walk->view;
    const int i = first_corner(part);
    const int j = after(i);
    const int k = after(j);
    const bool two = part->edge[j] >= REFINE_ONCE;
    if (two && part->edge[k] >= REFINE_ONCE)
        return false;
    frame->stats.refined += two ? 3 : 2;
    if (walk->raster == NULL)
        return true;
    const yb_point_t *const a = part->point[i];
    const yb_point_t *const b = part->point[j];
    const yb_point_t *const c = part->point[k];
    yb_point_t *const m = &level[0].middle;
    refine_middle(frame, view, a, b, part->edge[i], m);
    const bool a_first = part->eye[i] > part->eye[j];
    if (!two) {
        if (a_first)
            leaf(walk, c, a, m);
        leaf(walk, b, c, m);
        if (!a_first)
            leaf(walk, c, a, m);
        return true;
    }
    yb_point_t *const n = &level[1].middle;
    refine_middle(frame, view, b, c, part->edge[j], n);
    const bool b_first = part->eye[j] > half_way(part);
    if (b_first)
        leaf(walk, m, b, n);
    if (a_first)
        leaf(walk, c, a, m);
    leaf(walk, c, m, n);
    if (!a_first)
        leaf(walk, c, a, m);
    if (!b_first)
        leaf(walk, m, b, n);
    return true;
}

/* Refines a base triangle and draws what it becomes. */
static void draw_root(const walk_t *walk, yb_triangle_t triangle)
{
    yb_frame_t *frame = walk->frame;
    yb_level_t *top = frame->level;
    yb_level_t *from = top;
    const yb_level_t *last = &frame->level[YB_MAX_LEVELS - REFINE_PIECES];
    yb_part_t root;
    yb_part_t *part = &root;
    /* What is counted is counted whole: a bound on leaves is on all that refinement asks for. */
    if (!refine_root(frame, walk->view, triangle, part, walk->raster == NULL))
        return;
    for (;;) {
        for (yb_edge_t edges; (edges = refine_edges(part)) >= REFINE_ONCE;) {
            if (refine_part_misses(frame, walk->view, part))
                goto next;
            if (top > last) {
                frame->stats.depth_limited++;
                break;
            }
            if (edges < 2 * REFINE_ONCE && draw_last(walk, part, top))
                goto next;
            if (walk->raster == NULL && frame->stats.refined > frame->view.max_leaves)
                return; /* counted enough: too many */
            from = top = refine_split(frame, walk->view, part, top);
        }
        frame->stats.refined++;
        if (walk->raster != NULL)
            leaf(walk, part->point[0], part->point[1], part->point[2]);
    next:
        from = refine_next(frame->level, from, part);
        if (from == NULL)
            return;
        part = &from->rest;
        top = refine_top(from);
    }
}

void refine_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster)
{
    const walk_t walk = {frame, view, raster};
    const yb_triangle_t count = frame->map->triangle_count;
    if (!frame->binned) {
        for (yb_triangle_t i = 0; i < count; i++)
            draw_root(&walk, frame->order[i]);
        return;
    }
    const int first_bin = refine_bin_of(frame, raster->first_row);
    const int last_bin = refine_bin_of(frame, raster->end_row - 1);
    for (yb_triangle_t i = 0; i < count; i++) {
        if (refine_touches(frame, frame->order[i], first_bin, last_bin))
            draw_root(&walk, frame->order[i]);
    }
}

void refine_count(yb_frame_t *frame, const refine_view_t *whole)
{
    const walk_t walk = {frame, whole, NULL};
    for (yb_triangle_t t = 0; t < frame->map->triangle_count; t++)
        draw_root(&walk, t);
}
