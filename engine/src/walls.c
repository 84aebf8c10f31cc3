/* The sides of the block: below each edge of the mesh that lies on the frame, down to the base.
 *
 * An edge is refined by the same rules as in its triangle, so a wall's upper rim is the surface's
 * edge to the pixel.
 */
#include <string.h>

#include "camera.h"
#include "clip.h"
#include "fix.h"
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
    const yb_vertex_t *b = &map->vertex[corner[which == 2 ? 0 : which + 1]];
    const int32_t *eye = frame->view.eye_q8;
    return is_before(a->x_q8, b->x_q8, map->east_q8, eye[0]) ||
           is_before(a->y_q8, b->y_q8, map->north_q8, eye[1]);
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
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            if (faces(frame, t, i))
                frame->rim[t >> 3] = (uint8_t)(frame->rim[t >> 3] | 1 << (t & 7));
        }
    }
}

/* The wall below a piece of an edge from a to b: b, a and what lies straight below a and b. */
typedef struct {
    const yb_point_t *corner[4];
    yb_point_t foot[2];
} wall_t;

static void find_wall(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                      wall_t *wall)
{
    wall->corner[0] = b;
    wall->corner[1] = a;
    for (int i = 0; i < 2; i++) {
        camera_drop(frame, wall->corner[1 - i], frame->base_q8, &wall->foot[i]);
        wall->corner[2 + i] = &wall->foot[i];
    }
}

static void draw_wall(yb_frame_t *frame, const raster_t *raster, const wall_t *wall)
{
    const yb_point_t *const *corner = wall->corner;
    uint16_t pixel = shade_wall(frame, corner[1], corner[0]);
    frame->stats.refined += 2;
    for (int i = 1; i < 3; i++) {
        const yb_point_t *const p[3] = {corner[0], corner[i], corner[i + 1]};
        raster_look_t look = raster_draw(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot, pixel);
        if (look != RASTER_NOTHING && (look != RASTER_BEYOND || clip_draw(frame, raster, p, pixel)))
            frame->stats.drawn++;
    }
}

/* Refines one edge of a triangle from a to b, left to right: of the points where the parts to come
 * end, and of the edges to them, the last is the one in hand.
 */
static void draw_edge(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                      const yb_part_t *part, int which)
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
        wall_t wall;
        find_wall(frame, &from, to, &wall);
        /* Is it out of sight, however the edge is refined? */
        bool seen = (at != level && !split) || !refine_misses(frame, view, wall.corner, 4, stray);
        if (split && seen) {
            yb_edge_t half = refine_half(*edge);
            bool ask = *edge >= REFINE_AGAIN;
            refine_middle(frame, view, &from, to, *edge, &at->middle);
            at[1].rest.point[0] = &at->middle;
            at[1].rest.edge[0] = *edge = half;
            if (ask) {
                *edge = refine_ask(frame, &at->middle, to, half);
                at[1].rest.edge[0] = refine_ask(frame, &from, &at->middle, half);
            }
            at++;
            continue;
        }
        if (seen)
            draw_wall(frame, raster, &wall);
        if (at == level)
            return;
        from = *to;
        at--;
    }
}

void walls_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster)
{
    const int first_bin = refine_bin_of(frame, raster->first_row);
    const int last_bin = refine_bin_of(frame, raster->end_row - 1);
    const yb_triangle_t count = frame->map->triangle_count;
    for (yb_triangle_t t = 0; t < count; t++) {
        if (!walls_are_below(frame, t) || !refine_touches(frame, t, first_bin, last_bin))
            continue;
        yb_part_t part;
        refine_root(frame, view, t, &part);
        for (int i = 0; i < 3; i++) {
            if (faces(frame, t, i))
                draw_edge(frame, view, raster, &part, i);
        }
    }
}
