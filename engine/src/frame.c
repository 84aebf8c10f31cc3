/* A frame: prepared once, drawn band by band. */
#include <stddef.h>
#include <string.h>

#include "camera.h"
#include "colour.h"
#include "fix.h"
#include "kept.h"
#include "order.h"
#include "pixels.h"
#include "refine.h"
#include "relief.h"

/* Raises the threshold of refinement until the frame keeps to its bound, by most of the share that
 * is too much, as leaves go by a power of it between one, for slivers, and two; and by more from
 * count to count, as there may be more triangles than that which are not split at all. The count
 * depends on the view alone, so every band comes to the same threshold.
 */
static void bound_leaves(yb_frame_t *frame, const refine_view_t *whole)
{
    const uint32_t most = frame->view.max_leaves;
    uint64_t spare_q7 = 4;
    uint32_t leaves;
    while (most > 0 && (leaves = refine_count(frame, whole, (uint64_t)3 * most)) > most &&
           frame->longest != UINT32_MAX) {
        const uint64_t share_q7 = fix_share((uint64_t)(leaves - most) * 96, most, 192) + spare_q7;
        const uint64_t raised = frame->longest + (frame->longest * share_q7 >> 7) + 1;
        frame->longest = raised < UINT32_MAX ? (uint32_t)raised : UINT32_MAX;
        spare_q7 *= 2;
    }
}

/* Farthest that anything drawn is from the mesh in height: refined ground, walls, water. */
static int32_t farthest_stray(yb_frame_t *frame)
{
    const yb_map_t *map = frame->map;
    int32_t farthest = map->stray_q8;
    /* The block stands on a quarter of its relief. */
    int32_t relief = map->high_q8 - map->low_q8;
    frame->base_q8 = map->low_q8 - (relief >> 2) - 256;
    if (frame->view.walls)
        farthest += map->high_q8 - frame->base_q8;
    return fix_max(frame->view.water_q8, map->low_q8 + farthest) - map->low_q8;
}

/* Heights, in intervals of contour lines, are counted in numbers of 32 bits, which leave no more of
 * them than what is above a line. What is within 9 YB_MAX_HEIGHT_Q8 of the given one is off by less
 * than a 2^10th of an interval.
 */
static void begin_lines(yb_frame_t *frame)
{
    const yb_view_t *view = &frame->view;
    frame->lines = view->water_q8 != YB_NO_WATER || view->contour_q8 > 0;
    if (view->contour_q8 <= 0) { /* as if all heights were half an interval above a line */
        frame->contour_few = UINT32_MAX;
        frame->contour_inverse = 0;
        frame->contour_zero = (uint32_t)1 << 31;
        return;
    }
    int32_t interval = fix_clamp(view->contour_q8, YB_LEAST_CONTOUR_Q8, YB_MOST_CONTOUR_Q8);
    int32_t at = fix_clamp(view->contour_at_q8, -8 * YB_MAX_HEIGHT_Q8, 8 * YB_MAX_HEIGHT_Q8);
    frame->contour_inverse = UINT32_MAX / (uint32_t)interval + 1;
    frame->contour_few = 2 * (uint32_t)interval / 3;
    frame->contour_zero = 0 - (uint32_t)at * frame->contour_inverse;
    frame->contour_shift = (uint8_t)(fix_log2_floor(frame->contour_inverse) - 15);
}

/* Moves the triangles to behind the last vertex. */
static void pack(yb_map_t *map)
{
    const size_t count = map->triangle_count;
    uint8_t *to = (uint8_t *)map + yb_map_packed_at(map);
    if (!map->packed) {
        memmove(to, map->across, count * sizeof *map->across);
        memmove(to + count * sizeof *map->across, map->triangle, count * sizeof *map->triangle);
    }
    map->packed = true;
}

/* The first place from an offset on where a frame may begin. */
static size_t aligned(const yb_map_t *map, size_t offset)
{
    return offset + (size_t)(0 - ((uintptr_t)map + offset)) % _Alignof(yb_frame_t);
}

yb_frame_t *yb_frame_place(yb_map_t *map, size_t bytes, const yb_screen_t *screen, yb_band_t *band)
{
    const size_t vertices = map->vertex_count;
    const size_t triangles = map->triangle_count;
    const size_t at_frame = aligned(
        map, yb_map_packed_at(map) + triangles * (sizeof *map->across + sizeof *map->triangle));
    const size_t at_band =
        aligned(map, at_frame + offsetof(yb_frame_t, seen) + vertices * sizeof(yb_seen_t) +
                         triangles * (sizeof(yb_triangle_t) + 2));
    const size_t row = yb_band_row_bytes(screen);
    if (row == 0 || bytes < at_band + row)
        return NULL;
    const size_t fit = (bytes - at_band) / row;
    const size_t rows = fit < screen->height ? fit : screen->height;
    uint8_t *memory = (uint8_t *)map;
    pack(map);
    *band = (yb_band_t){
        .rows = (uint16_t)rows,
        .pixels = memory + at_band,
        .pitch = yb_screen_pitch(screen),
        .greys = memory + at_band,
    };
    return (yb_frame_t *)(void *)(memory + at_frame);
}

void yb_frame_begin(yb_frame_t *frame, const yb_map_t *map, const yb_view_t *view,
                    const yb_screen_t *screen)
{
    memset(&frame->stats, 0, sizeof frame->stats);
    frame->map = map;
    frame->view = *view;
    frame->screen = *screen;
    frame->order = (yb_triangle_t *)(void *)&frame->seen[map->vertex_count];
    frame->bins = (uint8_t *)&frame->order[map->triangle_count];
    frame->open = frame->bins + map->triangle_count;
    camera_clamp(frame);
    int32_t stray = farthest_stray(frame);
    camera_begin(frame, stray);
    begin_lines(frame);
    frame->smooth = map->smooth;
    frame->noise = map->detail ? map->noise : NULL;
    frame->salt = relief_salt(map->seed);
    frame->even_water = view->shadow == NULL && view->haze_q8 <= 0 && !view->lamp;
    colour_begin(frame);
    frame->row_shift = (uint8_t)(fix_log2_floor((screen->height - (uint32_t)1) | 8) - 3);
    refine_view_t whole;
    refine_see(frame, 0, screen->height, &whole);
    refine_see_vertices(frame, &whole);
    walls_begin(frame);
    order_begin(frame);
    frame->binned = false;
    kept_forget(frame);
    bound_leaves(frame, &whole);
}

/* The rows of base triangles, if some bands show only some of them. */
static void bin_all(yb_frame_t *frame)
{
    refine_view_t whole;
    refine_see(frame, 0, frame->screen.height, &whole);
    for (yb_triangle_t t = 0; t < frame->map->triangle_count; t++)
        refine_bin(frame, &whole, t);
    frame->binned = true;
}

/* Draws rows, from the nearest triangle on. */
static void draw_rows(yb_frame_t *frame, const raster_t *raster)
{
    const bool all = raster->first_row == 0 && raster->end_row == frame->screen.height;
    if (!all && !frame->binned)
        bin_all(frame);
    refine_view_t view;
    refine_see(frame, raster->first_row, raster->end_row, &view);
    if (frame->view.walls && raster->band != NULL)
        walls_draw(frame, &view, raster);
    refine_draw(frame, &view, raster);
}

/* Rows up to one that wants its triangles in another order are drawn first. It leaves the raster
 * without any.
 */
static void draw_in_order(yb_frame_t *frame, raster_t *raster)
{
    const int32_t end = raster->end_row;
    for (; raster->first_row < end; raster->first_row = raster->end_row) {
        raster->end_row = order_rows(frame, raster->first_row, end);
        draw_rows(frame, raster);
    }
}

void yb_frame_band(yb_frame_t *frame, const yb_band_t *band)
{
    raster_t raster = pixels_open(&frame->screen, band);
    const int32_t first = raster.first_row;
    for (int32_t y = first; y < raster.end_row; y++)
        pixels_clear(&raster, y, colour_sky(frame, y));
    draw_in_order(frame, &raster);
    for (int32_t y = first; y < raster.end_row; y++)
        pixels_show(&raster, y);
}

void yb_frame_triangles(yb_frame_t *frame, yb_triangle_fn fn, void *context)
{
    raster_t raster = {
        .screen = &frame->screen,
        .end_row = frame->screen.height,
        .each = fn,
        .context = context,
    };
    yb_stats_t stats = frame->stats;
    draw_in_order(frame, &raster);
    frame->stats = stats;
}
