/* The sides of the block: below each edge of the mesh that lies on the frame, down to the base.
 *
 * An edge is refined by the same rules as in its triangle, so a wall's upper rim is the surface's
 * edge to the pixel.
 */
#include <string.h>

#include "camera.h"
#include "clip.h"
#include "fix.h"
#include "mesh.h"
#include "refine.h"
#include "shade.h"

/* Does an edge that has one coordinate at its ends lie on a side of the frame, and the eye beyond?
 */
static bool is_before(uint16_t a, uint16_t b, uint16_t end, int32_t eye)
{
    return a == b && ((a == 0 && eye < 0) || (a == end && eye > end));
}

/* Is edge `which` of a triangle on the frame, and does the wall below it show its outside? */
static bool faces(const yb_frame_t *frame, yb_triangle_t triangle, int which)
{
    const yb_map_t *map = frame->map;
    const yb_index_t *corner = yb_map_triangle(map, triangle);
    const yb_vertex_t *a = &map->vertex[corner[which]];
    const yb_vertex_t *b = &map->vertex[corner[next3(which)]];
    const int32_t *eye = frame->view.eye_q8;
    return is_before(a->x_q8, b->x_q8, map->east_q8, eye[0]) ||
           is_before(a->y_q8, b->y_q8, map->north_q8, eye[1]);
}

/* Has a triangle an edge on the frame? Of its three entries NO_TRIANGLE, and no other, carries into
 * its mark's place when one is added.
 */
static inline bool is_on_frame(yb_across_t across)
{
    const yb_across_t each = 1 | (yb_across_t)1 << ENTRY_BITS | (yb_across_t)1 << 2 * ENTRY_BITS;
    return (((across & NO_TRIANGLE * each) + each) & ENTRY_MARK * each) != 0;
}

void walls_begin(yb_frame_t *frame)
{
    const yb_map_t *map = frame->map;
    const int32_t *eye = frame->view.eye_q8;
    memset(frame->rim, 0, sizeof frame->rim);
    /* From above the block none of its sides is seen. */
    if (!frame->view.walls ||
        (eye[0] >= 0 && eye[0] <= map->east_q8 && eye[1] >= 0 && eye[1] <= map->north_q8))
        return;
    const yb_across_t *const across = yb_map_across(map);
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        if (!is_on_frame(across[t]))
            continue;
        for (int i = 0; i < 3; i++) {
            if (faces(frame, t, i))
                frame->rim[t >> 3] = (uint8_t)(frame->rim[t >> 3] | 1 << (t & 7));
        }
    }
}

/* A point of the rim, and what lies straight below it on the base. */
typedef struct {
    const yb_point_t *top;
    yb_point_t foot;
} post_t;

static void set_post(const yb_frame_t *frame, const yb_point_t *top, post_t *post)
{
    post->top = top;
    camera_drop(frame, top, frame->base_q8, &post->foot);
}

/* The wall between two posts, a to the left of b. */
static void draw_wall(yb_frame_t *frame, const raster_t *raster, const post_t *a, const post_t *b)
{
    const yb_point_t *const corner[4] = {b->top, a->top, &a->foot, &b->foot};
    uint16_t pixel = shade_wall(frame, a->top, b->top);
    frame->stats.refined += 2;
    for (int i = 1; i < 3; i++) {
        const yb_point_t *const p[3] = {corner[0], corner[i], corner[i + 1]};
        raster_look_t look = raster_draw(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot, pixel);
        if (look != RASTER_NOTHING && (look != RASTER_BEYOND || clip_draw(frame, raster, p, pixel)))
            frame->stats.drawn++;
    }
}

/* Is a wall out of sight, however its rim is refined? */
static bool wall_misses(const yb_frame_t *frame, const refine_view_t *view, const post_t *a,
                        const post_t *b, int32_t stray)
{
    const yb_point_t *const corner[4] = {b->top, a->top, &a->foot, &b->foot};
    return refine_misses(frame, view, corner, 4, stray);
}

/* Refines an edge on the frame, left to right: of the points where the parts to come end, and of
 * the edges to them, the last is the one in hand.
 */
static void draw_edge(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                      yb_index_t a, yb_index_t b)
{
    refine_corner(frame, view, a, &frame->root[0]);
    refine_corner(frame, view, b, &frame->root[1]);
    yb_level_t *level = frame->level;
    const yb_level_t *last = level + YB_MAX_LEVELS - 1;
    yb_point_t left = frame->root[0];
    post_t from;
    set_post(frame, &left, &from);
    yb_edge_t first = refine_edge(frame, &frame->root[0], &frame->root[1]);
    /* As a triangle without a third corner it moves no farther than its own. */
    yb_part_t part = {
        .point = {&frame->root[0], &frame->root[1], &frame->root[1]},
        .edge = {first, 0, 0},
    };
    const yb_vertex_t *const vertex = frame->map->vertex;
    if (first >= REFINE_ONCE)
        part.bulge = refine_bulge(
            frame->map, (const yb_vertex_t *const[3]){&vertex[a], &vertex[b], &vertex[b]});
    const int32_t stray = refine_stray(frame, &part);
    level->rest.point[0] = &frame->root[1];
    level->rest.edge[0] = first;
    for (yb_level_t *at = level;;) {
        yb_edge_t *edge = &at->rest.edge[0];
        const bool split = *edge >= REFINE_ONCE && at != last;
        post_t to;
        set_post(frame, at->rest.point[0], &to);
        const bool seen = (at != level && !split) || !wall_misses(frame, view, &from, &to, stray);
        if (split && seen) {
            yb_edge_t half = refine_half(*edge);
            bool ask = *edge >= REFINE_AGAIN;
            refine_middle(frame, view, &left, to.top, *edge, &at->middle);
            at[1].rest.point[0] = &at->middle;
            at[1].rest.edge[0] = *edge = half;
            if (ask) {
                *edge = refine_ask(frame, &at->middle, to.top, half);
                at[1].rest.edge[0] = refine_ask(frame, &left, &at->middle, half);
            }
            at++;
            continue;
        }
        if (seen)
            draw_wall(frame, raster, &from, &to);
        if (at == level)
            return;
        left = *to.top;
        from.foot = to.foot;
        at--;
    }
}

void walls_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster)
{
    const int first_bin = refine_bin_of(frame, raster->first_row);
    const int last_bin = refine_bin_of(frame, raster->end_row - 1);
    const yb_triangle_t count = frame->map->triangle_count;
    for (yb_triangle_t t = 0; t < count; t++) {
        if (frame->rim[t >> 3] == 0) {
            t |= 7;
            continue;
        }
        if (!walls_are_below(frame, t) ||
            (frame->binned && !refine_touches(frame, t, first_bin, last_bin)))
            continue;
        const yb_index_t *corner = yb_map_triangle(frame->map, t);
        for (int i = 0; i < 3; i++) {
            if (!faces(frame, t, i))
                continue;
            draw_edge(frame, view, raster, corner[i], corner[next3(i)]);
        }
    }
}
