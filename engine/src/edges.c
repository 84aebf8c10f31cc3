/* The edges of a frame, and its base triangles, which begin with three: whether an edge is split,
 * and where its ends and its midpoint are seen.
 */
#include "camera.h"
#include "fix.h"
#include "mesh.h"
#include "order.h"
#include "refine.h"
#include "relief.h"

/* --- Is it split? ----------------------------------------------------------------------------- */

/* An edge, left whole if it is under water all along, however it is refined: then it is seen as a
 * straight line on a plane.
 */
APART yb_edge_t unless_drowned(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                               yb_edge_t edge)
{
    const uint32_t bend = a->slope - b->slope;
    const int32_t dx = relief_dx(a->place, b->place);
    const int32_t dy = relief_dy(a->place, b->place);
    int32_t rise = fix_abs(relief_bulge(relief_way_x(bend), relief_way_y(bend), dx, dy));
    int class = relief_class(dx, dy);
    const relief_bound_t bound = {rise + (rise >> 1) + 16, class};
    int32_t most = fix_max(a->z_q8, b->z_q8) + relief_reach(frame->map, &bound, 0);
    return most < frame->view.water_q8 ? edge & REFINE_WHOLE : edge;
}

static inline yb_edge_t unless_under_water(const yb_frame_t *frame, const yb_point_t *a,
                                           const yb_point_t *b, yb_edge_t edge)
{
    const int32_t water = frame->view.water_q8;
    if (a->z_q8 < water && b->z_q8 < water && frame->even_water)
        return unless_drowned(frame, a, b, edge);
    return edge;
}

/* An edge of which not both ends have a spot. The nearer of them counts, as 1/depth, beyond the
 * near distance for what is behind it.
 */
APART yb_edge_t ask_unseen(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                           yb_edge_t edge)
{
    if ((refine_parity(a, b) & 1) != 0 || refine_often(edge) == 0)
        return edge & REFINE_WHOLE;
    const int32_t depth = fix_max(
        fix_min(camera_depth(frame, a->place, a->top_q8), camera_depth(frame, b->place, b->top_q8)),
        frame->near);
    if ((edge & 0xffff) * (uint32_t)camera_near(frame, depth) <= frame->longest)
        return edge & REFINE_WHOLE;
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
    if (a_near == 0 || b_near == 0)
        return ask_unseen(frame, a, b, edge);
    const int32_t change = fix_abs(a_near - b_near);
    const int32_t near = fix_max(a_near, b_near);
    uint32_t size = (edge & 0xffff) * (uint32_t)near;
    uint32_t parity = refine_parity(a, b) | (uint32_t)1 << refine_often(edge);
    if (size <= frame->longest || (parity & 1) != 0)
        return edge & REFINE_WHOLE;
    const int32_t wide = fix_abs((int32_t)a->spot.x_q4 - b->spot.x_q4);
    const int32_t high = fix_abs((int32_t)a->spot.y_q4 - b->spot.y_q4);
    if (change << 2 > near || (fix_max(wide, high) >> 4) * change > 4 * near) {
        edge |= REFINE_AGAIN;
    } else {
        edge &= REFINE_WHOLE;
        do {
            edge += REFINE_ONCE;
            size >>= 1;
            parity >>= 1;
        } while (size > frame->longest && (parity & 1) == 0);
    }
    return unless_under_water(frame, a, b, edge);
}

yb_edge_t refine_edge(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                      int32_t open)
{
    int32_t dx = relief_dx(a->place, b->place);
    int32_t dy = relief_dy(a->place, b->place);
    /* Below 2^16 each, times 2^13, which has the length of a unit vector: below 2^30. */
    int32_t across = fix_abs(dx * frame->across_x + dy * frame->across_y) >> 14;
    int32_t along = fix_abs(dx * frame->along_x + dy * frame->along_y) >> 14;
    const int32_t length = fix_length(across, along) * open >> ORDER_OPEN_BITS;
    const yb_edge_t turned = open < ORDER_OPEN ? REFINE_TURNED : 0;
    yb_edge_t edge =
        refine_ask(frame, a, b, (yb_edge_t)length | turned | YB_MAX_HALVINGS * REFINE_ONCE);
    if (edge < REFINE_ONCE)
        return edge;
    dx >>= 1; /* both are even: relief_class without signs */
    dy >>= 1;
    const uint32_t square = (uint32_t)(dx * dx) + (uint32_t)(dy * dy);
    return edge | (yb_edge_t)(relief_square_class(square) + 4) << 16;
}

/* --- Where is it seen? ------------------------------------------------------------------------ */

/* The sides of the view that a place on the screen is beyond: of most, none. */
TINY uint8_t out_of(const refine_view_t *view, int32_t x_q4, int32_t y_q4)
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

void refine_corner(const yb_frame_t *frame, const refine_view_t *view, yb_index_t i,
                   yb_point_t *point)
{
    camera_root(frame, i, point);
    set_out(view, &point->spot);
}

/* --- Midpoints -------------------------------------------------------------------------------- */

/* A place on the screen, 1/16 pixel, and 1/depth there. */
typedef struct {
    int32_t x_q4, y_q4, near;
} seen_t;

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

/* --- Base triangles --------------------------------------------------------------------------- */

void refine_root(yb_frame_t *frame, const refine_view_t *view, yb_triangle_t triangle,
                 const yb_kept_t *known, yb_part_t *part)
{
    const yb_index_t *corner = relief_triangle(frame->map, triangle);
    const yb_vertex_t *v[3];
    WRITTEN_OUT
    for (int i = 0; i < 3; i++) {
        v[i] = &frame->map->vertex[corner[i]];
        refine_corner(frame, view, corner[i], &frame->root[i]);
        part->point[i] = &frame->root[i];
    }
    order_root(frame, corner, part);
    if (known != NULL) {
        part->edge[0] = known->edge[0];
        part->edge[1] = known->edge[1];
        part->edge[2] = known->edge[2];
        part->bulge = known->bulge;
        return;
    }
    yb_across_t across = yb_map_across(frame->map)[triangle];
    const int32_t open = frame->open[triangle];
    WRITTEN_OUT
    for (int i = 0; i < 3; i++, across >>= ENTRY_BITS)
        part->edge[i] = refine_edge(frame, &frame->root[i], &frame->root[next3(i)],
                                    order_open(frame, open, across));
    part->bulge = refine_splits(part) ? refine_bulge(frame->map, v) : 0;
}
