/* The sides of the block: below each edge of the mesh that lies on the frame, down to the base.
 *
 * An edge is refined by the same rules as in its triangle, so a wall's upper rim is the surface's
 * edge to the pixel.
 */
#include "camera.h"
#include "clip.h"
#include "fix.h"
#include "refine.h"
#include "shade.h"

/* Both ends on one side of the frame: then the whole edge is, with the ground to its left. */
static bool on_one_side(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b)
{
    return (a->x_q8 == b->x_q8 && (a->x_q8 == 0 || a->x_q8 == map->east_q8)) ||
           (a->y_q8 == b->y_q8 && (a->y_q8 == 0 || a->y_q8 == map->north_q8));
}

/* Does the wall below an edge on the frame show its outside? Only to an eye beyond that side. */
static bool faces(const yb_frame_t *frame, const yb_vertex_t *a, const yb_vertex_t *b)
{
    const yb_map_t *map = frame->map;
    const int32_t *eye = frame->view.eye_q8;
    if (a->x_q8 == b->x_q8 && (a->x_q8 == 0 ? eye[0] < 0 : eye[0] > map->east_q8))
        return on_one_side(map, a, b);
    if (a->y_q8 == b->y_q8 && (a->y_q8 == 0 ? eye[1] < 0 : eye[1] > map->north_q8))
        return on_one_side(map, a, b);
    return false;
}

void walls_bin(yb_frame_t *frame, yb_triangle_t triangle)
{
    const yb_map_t *map = frame->map;
    const yb_index_t *corner = map->triangle[triangle];
    for (int i = 0; i < 3; i++) {
        if (faces(frame, &map->vertex[corner[i]], &map->vertex[corner[i == 2 ? 0 : i + 1]]))
            frame->rim[triangle >> 3] = (uint8_t)(frame->rim[triangle >> 3] | 1 << (triangle & 7));
    }
}

static void draw_half(yb_frame_t *frame, const raster_t *raster, const yb_point_t *const p[3],
                      uint16_t pixel)
{
    raster_look_t look = raster_draw(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot, pixel);
    if (look != RASTER_NOTHING && (look != RASTER_BEYOND || clip_draw(frame, raster, p, pixel)))
        frame->stats.drawn++;
}

static void draw_piece(yb_frame_t *frame, const raster_t *raster, const yb_point_t *a,
                       const yb_point_t *b)
{
    uint16_t pixel = shade_wall(frame, a, b);
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
                   const yb_point_t *b, int32_t stray)
{
    yb_point_t a_foot;
    yb_point_t b_foot;
    camera_drop(frame, a, frame->base_q8, &a_foot);
    camera_drop(frame, b, frame->base_q8, &b_foot);
    const yb_point_t *const wall[4] = {a, b, &a_foot, &b_foot};
    return refine_misses(frame, view, wall, 4, stray);
}

/* Refines one edge of a triangle from a to b, left to right: of the points where the parts to come
 * end, and of the edges to them, the last is the one in hand.
 */
static void draw_edge(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                      yb_part_t *part, int which)
{
    yb_level_t *level = frame->level;
    const yb_level_t *last = level + YB_MAX_LEVELS - 1;
    int32_t stray = refine_stray(frame, part);
    yb_point_t from = *part->point[which];
    level->rest.point[0] = part->point[which == 2 ? 0 : which + 1];
    level->rest.edge[0] = part->edge[which];
    for (yb_level_t *at = level;;) {
        const yb_point_t *to = at->rest.point[0];
        yb_edge_t *edge = &at->rest.edge[0];
        bool split = *edge >= REFINE_ONCE && at != last;
        bool seen = (at != level && !split) || !hidden(frame, view, &from, to, stray);
        if (split && seen) {
            refine_middle(frame, view, &from, to, *edge, &at->middle);
            bool ask = *edge >= REFINE_AGAIN;
            yb_edge_t half = refine_half(*edge);
            *edge = ask ? refine_ask(frame, &at->middle, to, half) : half;
            at[1].rest.point[0] = &at->middle;
            at[1].rest.edge[0] = ask ? refine_ask(frame, &from, &at->middle, half) : half;
            at++;
            continue;
        }
        if (seen)
            draw_piece(frame, raster, &from, to);
        if (at == level)
            return;
        from = *to;
        at--;
    }
}

/* Does all that stands upright go down on the screen from top to foot? Straight below and above the
 * eye it does not: then these places, focal * up_z / |depth_z| from the middle, are not on it.
 */
static bool all_hangs(const yb_frame_t *frame)
{
    return frame->focal_q4 * frame->up_z > frame->screen.height * 8 * fix_abs(frame->depth_z);
}

void walls_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster)
{
    const yb_map_t *map = frame->map;
    /* Then no wall is seen above the rows of its triangle, if that is seen at all. */
    const int32_t last_bin = all_hangs(frame) ? (raster->end_row - 1) >> frame->row_shift : 15;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        if ((frame->rim[t >> 3] & 1 << (t & 7)) == 0)
            continue;
        const int bins = frame->rows[t];
        if (bins >> 4 > last_bin && bins >> 4 <= (bins & 15))
            continue;
        for (int i = 0; i < 3; i++) {
            const yb_vertex_t *a = &map->vertex[map->triangle[t][i]];
            const yb_vertex_t *b = &map->vertex[map->triangle[t][i == 2 ? 0 : i + 1]];
            if (!faces(frame, a, b))
                continue;
            yb_part_t part;
            refine_root(frame, view, t, &part);
            draw_edge(frame, view, raster, &part, i);
        }
    }
}
