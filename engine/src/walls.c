/* The sides of the block: below each edge of the mesh that lies on the frame, down to the base.
 *
 * An edge is refined by the same rules as in its triangle, so a wall's upper rim is the surface's
 * edge to the pixel.
 */
#include <string.h>

#include "camera.h"
#include "clip.h"
#include "fix.h"
#include "kept.h"
#include "mesh.h"
#include "refine.h"
#include "relief.h"
#include "shade.h"

/* The sides of the frame that the eye is beyond: the x that places on one have, and the y on the
 * other; -1: neither. False: from above the block none of its sides is seen.
 */
static bool find_sides(const yb_frame_t *frame, int32_t side[2])
{
    const int32_t end[2] = {frame->map->east_q8, frame->map->north_q8};
    for (int i = 0; i < 2; i++) {
        const int32_t eye = frame->view.eye_q8[i];
        side[i] = eye < 0 ? 0 : eye > end[i] ? end[i] : -1;
    }
    return (side[0] & side[1]) >= 0;
}

/* Is edge `which` of a triangle on such a side? */
static bool faces(const yb_map_t *map, const yb_index_t *corner, int which, const int32_t side[2])
{
    const yb_vertex_t *a = &map->vertex[corner[which]];
    const yb_vertex_t *b = &map->vertex[corner[next3(which)]];
    return (a->x_q8 == side[0] && b->x_q8 == side[0]) || (a->y_q8 == side[1] && b->y_q8 == side[1]);
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
    memset(frame->rim, 0, sizeof frame->rim);
    int32_t side[2];
    if (!frame->view.walls || !find_sides(frame, side))
        return;
    const yb_across_t *const across = relief_across(map);
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        if (!is_on_frame(across[t]))
            continue;
        const yb_index_t *corner = relief_triangle(map, t);
        for (int i = 0; i < 3; i++) {
            if (faces(map, corner, i, side))
                frame->rim[t >> 3] = (uint8_t)(frame->rim[t >> 3] | 1 << (t & 7));
        }
    }
}

/* The wall below an edge: right and left end, and their feet from left to right. */
typedef const yb_point_t *const wall_t[4];

static void draw_wall(yb_frame_t *frame, const raster_t *raster, wall_t corner)
{
    uint16_t pixel = shade_wall(frame, corner[1], corner[0]);
    frame->stats.refined += 2;
    for (int i = 1; i < 3; i++) {
        const yb_point_t *const p[3] = {corner[0], corner[i], corner[i + 1]};
        raster_look_t look =
            raster_draw(raster, &p[0]->spot, &p[1]->spot, &p[2]->spot, pixel, NULL);
        if (look != RASTER_NOTHING &&
            (look != RASTER_BEYOND || clip_draw(frame, raster, p, pixel, false)))
            frame->stats.drawn++;
    }
}

/* Refines an edge on the frame, from right to left: as a triangle whose third corner is its end, of
 * which the part at that end comes first. The edge is then its last one, and of the other part the
 * second.
 */
static void draw_edge(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                      yb_index_t a, yb_index_t b, int32_t open)
{
    const yb_vertex_t *const v = frame->map->vertex;
    yb_point_t *const end = frame->root;
    refine_corner(frame, view, a, &end[0]);
    refine_corner(frame, view, b, &end[1]);
    yb_point_t left;
    yb_point_t right;
    camera_drop(frame, &end[1], frame->base_q8, &right);
    yb_part_t root = {
        .point = {&end[0], &end[1], &end[1]},
        .edge = {refine_edge(frame, &end[0], &end[1], open), 0, 0},
        .bulge = refine_bulge(frame->map, (const yb_vertex_t *const[3]){&v[a], &v[b], &v[b]}),
    };
    const int32_t stray = refine_stray(frame, &root);
    yb_part_t *part = &root;
    yb_level_t *top = frame->level;
    yb_level_t *from = top;
    for (int i = 0;; i = 1) {
        for (;; i = 2) {
            wall_t wall = {part->point[next3(i)], part->point[i], &left, &right};
            const bool splits = refine_splits(part);
            camera_drop(frame, wall[1], frame->base_q8, &left);
            if ((splits || part == &root) && refine_misses(frame, view, wall, 4, stray))
                break;
            if (!splits) {
                draw_wall(frame, raster, wall);
                break;
            }
            kept_make_room(frame, top);
            from = top = refine_split(frame, view, part, top);
        }
        right = left;
        from = refine_next(frame->level, from, part);
        if (from == NULL)
            return;
        part = &from->rest;
        top = refine_top(from);
    }
}

void walls_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster)
{
    const int first_bin = refine_bin_of(frame, raster->first_row);
    const int last_bin = refine_bin_of(frame, raster->end_row - 1);
    const yb_triangle_t count = frame->map->triangle_count;
    int32_t side[2];
    (void)find_sides(frame, side);
    for (yb_triangle_t t = 0; t < count; t++) {
        if (frame->rim[t >> 3] == 0) {
            t |= 7;
            continue;
        }
        if (!walls_are_below(frame, t) ||
            (frame->binned && !refine_touches(frame, t, first_bin, last_bin)))
            continue;
        const yb_index_t *corner = relief_triangle(frame->map, t);
        for (int i = 0; i < 3; i++) {
            if (!faces(frame->map, corner, i, side))
                continue;
            draw_edge(frame, view, raster, corner[i], corner[next3(i)], frame->open[t]);
        }
    }
}
