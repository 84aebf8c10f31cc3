/* The sides of the block: below each edge of the mesh that lies on the frame, down to the base.
 *
 * An edge is refined by the same rules as in its triangle, so a wall's upper rim is the surface's
 * edge to the pixel.
 */
#include "camera.h"
#include "clip.h"
#include "refine.h"
#include "shade.h"

/* Both ends on one side of the frame: then the whole edge is, with the ground to its left. */
static bool on_one_side(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b)
{
    return (a->x_q8 == b->x_q8 && (a->x_q8 == 0 || a->x_q8 == map->east_q8)) ||
           (a->y_q8 == b->y_q8 && (a->y_q8 == 0 || a->y_q8 == map->north_q8));
}

static void draw_half(yb_frame_t *frame, const raster_t *raster, const yb_point_t *const p[3],
                      uint16_t pixel)
{
    raster_point_t corner[3];
    raster_setup_t setup;
    if (clip_needs(frame, p, corner)) {
        frame->stats.drawn += clip_draw(frame, raster, p, pixel) ? 1 : 0;
    } else if (raster_setup(raster, corner, &setup)) {
        raster_fill(raster, &setup, pixel);
        frame->stats.drawn++;
    }
}

static void draw_piece(yb_frame_t *frame, const raster_t *raster, const yb_point_t *a,
                       const yb_point_t *b)
{
    uint16_t pixel = shade_wall(frame, &a->at, &b->at);
    yb_point_t a_foot;
    yb_point_t b_foot;
    camera_drop(frame, a, frame->base_q8, &a_foot);
    camera_drop(frame, b, frame->base_q8, &b_foot);
    const yb_point_t *const upper[3] = {b, a, &a_foot};
    const yb_point_t *const lower[3] = {b, &a_foot, &b_foot};
    frame->stats.refined += 2;
    draw_half(frame, raster, upper, pixel);
    draw_half(frame, raster, lower, pixel);
}

/* Is the wall below the edge ab out of sight, however the edge is refined? */
static bool hidden(const yb_frame_t *frame, const refine_view_t *view, const yb_point_t *a,
                   const yb_point_t *b)
{
    yb_point_t a_foot;
    yb_point_t b_foot;
    camera_drop(frame, a, frame->base_q8, &a_foot);
    camera_drop(frame, b, frame->base_q8, &b_foot);
    const yb_point_t *const edge[3] = {a, b, b};
    const yb_point_t *const wall[4] = {a, b, &a_foot, &b_foot};
    uint8_t planes = REFINE_ALL_PLANES;
    return refine_misses(view, wall, 4, refine_stray(frame, edge), &planes);
}

/* Refines one edge from a to b, left to right: to[depth] is the point where the part in hand ends.
 */
static void draw_edge(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster)
{
    const yb_point_t *to[YB_MAX_LEVELS + 1];
    int depth = 0;
    to[0] = &frame->root[1];
    yb_point_t from = frame->root[0];
    for (;;) {
        bool split = depth < YB_MAX_LEVELS && refine_splits(frame, &from, to[depth]);
        if (split && !hidden(frame, view, &from, to[depth])) {
            yb_point_t *middle = &frame->level[depth].middle[0];
            refine_middle(frame, &from, to[depth], middle);
            to[++depth] = middle;
            continue;
        }
        if (!split)
            draw_piece(frame, raster, &from, to[depth]);
        if (depth == 0)
            return;
        from = *to[depth--];
    }
}

void walls_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster)
{
    const yb_map_t *map = frame->map;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            yb_index_t a = map->triangle[t][i];
            yb_index_t b = map->triangle[t][i == 2 ? 0 : i + 1];
            if (!on_one_side(map, &map->vertex[a], &map->vertex[b]))
                continue;
            refine_root(frame, a, &frame->root[0]);
            refine_root(frame, b, &frame->root[1]);
            draw_edge(frame, view, raster);
        }
    }
}
