/* Draws the base triangles of a frame as what refinement makes of them. */
#include "clip.h"
#include "fix.h"
#include "kept.h"
#include "mesh.h"
#include "order.h"
#include "refine.h"
#include "shade.h"

/* What stays the same while base triangles are drawn. */
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
    if (!clip_draw(frame, raster, p, shade_ground(frame, p), frame->lines))
        return;
    frame->stats.drawn++;
    if (raster->band == NULL)
        hand_out(raster, p);
}

/* Draws a front that is not small, or that may have lines. */
SELDOM void draw_odd(const yb_frame_t *frame, const raster_t *raster, const yb_point_t *const p[3],
                     const raster_shape_t *shape, bool small)
{
    const shade_t shade = shade_ground(frame, p);
    raster_cut_t cut;
    const bool cuts = frame->lines && (COPIES ? shade_cut_here(frame, p, shade, &cut)
                                              : shade_cut(frame, p, shade, &cut));
    if (COPIES && small && !cuts)
        raster_plain(raster, shape, shade_pixel(shade));
    else if (small)
        raster_level(raster, shape, shade_pixel(shade), cuts ? &cut : NULL);
    else
        raster_plane(raster, shape, shade_pixel(shade), cuts ? &cut : NULL);
}

/* Draws a leaf whose corners are beyond some sides of the band, or none. */
COPIED void draw_leaf(const walk_t *walk, const yb_point_t *const p[3], int some)
{
    yb_frame_t *frame = walk->frame;
    const raster_t *raster = walk->raster;
    if ((some & REFINE_NOWHERE) != 0) {
        draw_clipped(frame, walk->view, raster, p);
        return;
    }
    raster_shape_t shape;
    const raster_look_t look = raster_front(&p[0]->spot, &p[1]->spot, &p[2]->spot, &shape);
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
    const bool small = look == RASTER_SMALL && (some & (REFINE_LEFT | REFINE_RIGHT)) == 0;
    if (!COPIES || !small || frame->lines) {
        draw_odd(frame, raster, p, &shape, small);
        return;
    }
    raster_plain(raster, &shape, shade_pixel(shade_ground(frame, p)));
}

/* A leaf that is beyond some sides of the band in part. */
SELDOM void leaf_partly(const walk_t *walk, const yb_point_t *a, const yb_point_t *b,
                        const yb_point_t *c)
{
    const yb_point_t *const p[3] = {a, b, c};
    draw_leaf(walk, p, a->spot.out | b->spot.out | c->spot.out);
}

/* A leaf: draws it, if some of it may be in the band. Most are all within it. */
static void leaf(const walk_t *walk, const yb_point_t *a, const yb_point_t *b, const yb_point_t *c)
{
    if (!COPIES || !USUAL((a->spot.out | b->spot.out | c->spot.out) == 0)) {
        if ((a->spot.out & b->spot.out & c->spot.out & REFINE_SIDES) == 0)
            leaf_partly(walk, a, b, c);
        return;
    }
    const yb_point_t *const p[3] = {a, b, c};
    draw_leaf(walk, p, 0);
}

/* A triangle of which one or two edges are split, once: as refine_split, and its parts in the order
 * of refine_next, none of which needs a place on the stack. False: all three are, which is rare.
 */
APART bool draw_last(const walk_t *walk, const yb_part_t *part, yb_level_t *level)
{
    yb_frame_t *frame = walk->frame;
    const refine_view_t *view = walk->view;
    const int i = refine_first_corner(part);
    const int j = next3(i);
    const int k = next3(j);
    const bool two = part->edge[j] >= REFINE_ONCE;
    if (two && part->edge[k] >= REFINE_ONCE)
        return false;
    frame->stats.refined += two ? 3 : 2;
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
    const bool b_first = part->eye[j] > refine_half_way(part);
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
    yb_part_t root;
    yb_part_t *part = &root;
    kept_root(frame, walk->view, triangle, part);
    for (;;) {
        for (yb_edge_t edges; (edges = refine_edges(part)) >= REFINE_ONCE;) {
            if (refine_part_misses(frame, walk->view, part))
                goto next;
            kept_make_room(frame, top);
            if (edges < 2 * REFINE_ONCE && draw_last(walk, part, top))
                goto next;
            from = top = refine_split(frame, walk->view, part, top);
        }
        frame->stats.refined++;
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
    const bool binned = frame->binned;
    const int first_bin = refine_bin_of(frame, raster->first_row);
    const int last_bin = refine_bin_of(frame, raster->end_row - 1);
    if (binned)
        kept_begin(frame, raster->first_row, raster->end_row);
    for (yb_triangle_t i = 0; i < count; i++) {
        const yb_triangle_t triangle = frame->order[i];
        if (binned ? refine_touches(frame, triangle, first_bin, last_bin)
                   : order_shows(frame, triangle))
            draw_root(&walk, triangle);
    }
}

/* --- Counting --------------------------------------------------------------------------------- */

static uint32_t power_of_3(int32_t often)
{
    uint32_t power = 1;
    while (often-- > 0)
        power *= 3;
    return power;
}

/* The leaves of a triangle by how often its edges are halved, by the rules of refine_split. As long
 * as all three are, there are four parts, and all are alike. Where two are, x times and, next to
 * it, y times, two parts are halved x - 1 and y - 1 times, and one twice y - 1, which are 3^(y - 1)
 * leaves. Where one is, there are two parts.
 */
static uint32_t leaves_of(const yb_part_t *part)
{
    int32_t often[3];
    for (int i = 0; i < 3; i++)
        often[i] = refine_often(part->edge[i]);
    const int32_t least = fix_min(often[0], fix_min(often[1], often[2]));
    int i = 2;
    while (often[i] != least)
        i--;
    int32_t x = often[next3(i)] - least;
    int32_t y = often[next3(next3(i))] - least;
    uint32_t parts = (uint32_t)1 << 2 * least;
    uint32_t leaves = 0;
    for (; x > 0 && y > 0; x--, y--, parts *= 2)
        leaves += parts * power_of_3(y - 1);
    return leaves + (parts << (x + y));
}

/* Counts what a base triangle becomes, or somewhat more: what is in sight in part is counted whole
 * if all its edges know how often they are halved.
 */
static uint32_t count_root(yb_frame_t *frame, const refine_view_t *view, yb_triangle_t triangle,
                           uint64_t enough)
{
    yb_level_t *top = frame->level;
    yb_level_t *from = top;
    yb_part_t root;
    yb_part_t *part = &root;
    uint32_t leaves = 0;
    refine_root(frame, view, triangle, NULL, part);
    for (;;) {
        const yb_edge_t edges = refine_edges(part);
        const bool seen = edges < REFINE_ONCE || !refine_part_misses(frame, view, part);
        if (seen && (edges >= REFINE_AGAIN || refine_is_sliver(frame, part))) {
            kept_make_room(frame, top);
            from = top = refine_split(frame, view, part, top);
            continue;
        }
        if (seen)
            leaves += leaves_of(part);
        from = refine_next(frame->level, from, part);
        if (from == NULL || leaves > enough)
            return leaves;
        part = &from->rest;
        top = refine_top(from);
    }
}

uint32_t refine_count(yb_frame_t *frame, const refine_view_t *whole, uint64_t enough)
{
    uint32_t leaves = 0;
    for (yb_triangle_t t = 0; t < frame->map->triangle_count && leaves <= enough; t++)
        leaves += order_shows(frame, t) ? count_root(frame, whole, t, enough) : 0;
    return leaves;
}
