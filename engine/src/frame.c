/* A frame: prepared once, drawn band by band. */
#include <string.h>

#include "camera.h"
#include "fix.h"
#include "refine.h"
#include "shade.h"

static bool on_screen(const yb_frame_t *frame, yb_triangle_t triangle)
{
    return frame->first_row[triangle] <= frame->last_row[triangle];
}

/* Raises the threshold of refinement until the frame keeps to its bound. The count depends on the
 * view alone, so every band comes to the same threshold.
 */
static void bound_leaves(yb_frame_t *frame, const refine_view_t *whole)
{
    while (frame->view.max_leaves > 0 && frame->split_q4 > 0) {
        frame->stats.refined = 0;
        for (yb_triangle_t t = 0; t < frame->map->triangle_count; t++) {
            if (on_screen(frame, t))
                refine_draw(frame, whole, NULL, t);
        }
        if (frame->stats.refined <= frame->view.max_leaves)
            break;
        frame->split_q4 = frame->split_q4 * 3 / 4; /* in the end 0: no edge is split */
    }
    memset(&frame->stats, 0, sizeof frame->stats);
}

void yb_frame_begin(yb_frame_t *frame, const yb_map_t *map, const yb_view_t *view,
                    const yb_screen_t *screen)
{
    memset(&frame->stats, 0, sizeof frame->stats);
    frame->map = map;
    frame->view = *view;
    frame->screen = *screen;
    camera_begin(frame);
    shade_begin(frame);
    refine_view_t whole;
    refine_see(frame, 0, screen->height, &whole);
    for (yb_triangle_t t = 0; t < map->triangle_count; t++)
        refine_bin(frame, &whole, t);
    bound_leaves(frame, &whole);
}

void yb_frame_band(yb_frame_t *frame, const yb_band_t *band)
{
    raster_t raster = {
        .screen = &frame->screen,
        .band = band,
        .first_row = fix_min(band->y, frame->screen.height),
        .end_row = fix_min(band->y + band->rows, frame->screen.height),
    };
    if (raster.first_row >= raster.end_row)
        return;
    refine_view_t view;
    refine_see(frame, raster.first_row, raster.end_row, &view);
    raster_clear(&raster, shade_background(frame));
    for (yb_triangle_t t = 0; t < frame->map->triangle_count; t++) {
        if (on_screen(frame, t) && frame->first_row[t] <= (raster.end_row - 1) >> YB_ROW_SHIFT &&
            frame->last_row[t] >= raster.first_row >> YB_ROW_SHIFT)
            refine_draw(frame, &view, &raster, t);
    }
    if (frame->view.walls)
        walls_draw(frame, &view, &raster);
}
