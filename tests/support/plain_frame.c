#include "plain_frame.h"

#include <stdlib.h>

#include "clip.h"
#include "raster.h"
#include "refine.h"
#include "relief.h"
#include "shade.h"
#include "split.h"

typedef struct {
    const yb_frame_t *frame;
    plain_leaf_fn fn;
    void *context;
    uint32_t count;
} walk_t;

/* With twice the room that its relief may need. Without this all that lies behind the eye would be
 * refined as if it touched it.
 */
bool plain_behind(const yb_frame_t *frame, const yb_point_t *const corner[3])
{
    relief_bound_t bound;
    relief_bound(frame->map, &corner[0]->at, &corner[1]->at, &corner[2]->at, &bound);
    int64_t reach = relief_reach(frame->map, &bound, 0);
    int64_t lift = frame->lift_back_q9 < 0 ? -frame->lift_back_q9 : frame->lift_back_q9;
    for (int i = 0; i < 3; i++) {
        int64_t stray = 2 * reach + 256;
        if (frame->view.water_q8 > corner[i]->at.z_q8)
            stray += frame->view.water_q8 - (int64_t)corner[i]->at.z_q8;
        if (corner[i]->depth_q8 + (stray * lift >> 9) >= frame->near_q8)
            return false;
    }
    return true;
}

static void walk(walk_t *at, const yb_point_t *const corner[3], int level)
{
    const yb_point_t *point[6] = {corner[0], corner[1], corner[2]};
    yb_point_t middle[3];
    int pattern = 0;
    if (plain_behind(at->frame, corner))
        return;
    for (int i = 0; i < 3 && level + 1 < YB_MAX_LEVELS; i++) {
        const yb_point_t *a = corner[i];
        const yb_point_t *b = corner[(i + 1) % 3];
        if (!refine_splits(at->frame, a, b))
            continue;
        refine_middle(at->frame, a, b, &middle[i]);
        point[3 + i] = &middle[i];
        pattern |= 1 << i;
    }
    if (pattern == 0) {
        at->count++;
        at->fn(at->context, corner);
        return;
    }
    for (int k = 0; k < SPLIT_CHILDREN && split_child[pattern][k][0] != SPLIT_END; k++) {
        const uint8_t *child = split_child[pattern][k];
        const yb_point_t *const below[3] = {point[child[0]], point[child[1]], point[child[2]]};
        walk(at, below, level + 1);
    }
}

uint32_t plain_leaves(const yb_frame_t *frame, plain_leaf_fn fn, void *context)
{
    walk_t at = {frame, fn, context, 0};
    for (int t = 0; t < frame->map->triangle_count; t++) {
        yb_point_t root[3];
        for (int i = 0; i < 3; i++)
            refine_root(frame, frame->map->triangle[t][i], &root[i]);
        const yb_point_t *const corner[3] = {&root[0], &root[1], &root[2]};
        walk(&at, corner, 0);
    }
    return at.count;
}

typedef struct {
    const yb_frame_t *frame;
    raster_t raster;
} drawing_t;

static void draw_leaf(void *context, const yb_point_t *const corner[3])
{
    drawing_t *drawing = context;
    uint16_t pixel = shade_ground(drawing->frame, &corner[0]->at, &corner[1]->at, &corner[2]->at);
    raster_point_t place[3];
    raster_setup_t setup;
    if (clip_needs(drawing->frame, corner, place))
        (void)clip_draw(drawing->frame, &drawing->raster, corner, pixel);
    else if (raster_setup(&drawing->raster, place, &setup))
        raster_fill(&drawing->raster, &setup, pixel);
}

void plain_frame(yb_frame_t *frame, const yb_band_t *band)
{
    drawing_t drawing = {frame, {&frame->screen, band, 0, frame->screen.height}};
    raster_clear(&drawing.raster, shade_background(frame));
    (void)plain_leaves(frame, draw_leaf, &drawing);
    static const refine_view_t everywhere; /* planes of zeros: nothing is outside */
    if (frame->view.walls)
        walls_draw(frame, &everywhere, &drawing.raster);
}

/* --- Views ------------------------------------------------------------------------------------ */

static void stand(yb_view_t *view, const yb_map_t *map, rng_t *rng, int above)
{
    view->eye_q8[0] = rng_range(rng, 0, map->east_q8);
    view->eye_q8[1] = rng_range(rng, 0, map->north_q8);
    int32_t ground = yb_map_height(map, (uint16_t)view->eye_q8[0], (uint16_t)view->eye_q8[1]);
    view->eye_q8[2] = ground * view->exaggerate_q8 / 256 + above;
    view->look_q8[0] = view->eye_q8[0] + rng_range(rng, -20000, 20000);
    view->look_q8[1] = view->eye_q8[1] + rng_range(rng, -20000, 20000);
    view->look_q8[2] = view->eye_q8[2] + rng_range(rng, -6000, 2000);
}

void random_view(yb_view_t *view, const yb_map_t *map, rng_t *rng)
{
    yb_view_init(view, map);
    if (rng_one_in(rng, 3))
        view->exaggerate_q8 = (uint16_t)rng_range(rng, 100, 1000);
    if (rng_one_in(rng, 3))
        view->zoom_q12 = (uint16_t)rng_range(rng, 1024, 12000);
    view->edge_q4 = (uint16_t)rng_range(rng, 48, 400);
    view->walls = rng_one_in(rng, 2);
    if (rng_one_in(rng, 2))
        view->water_q8 = rng_range(rng, map->low_q8, map->high_q8);
    uint16_t azimuth = (uint16_t)rng_range(rng, 0, 65535);
    uint16_t elevation = (uint16_t)rng_range(rng, 0, 16384);
    yb_view_sun(view, azimuth, elevation);
    azimuth = (uint16_t)rng_range(rng, 0, 65535);
    elevation = (uint16_t)rng_range(rng, -3000, 16384);
    switch (rng_range(rng, 0, 7)) {
    case 0:
    case 1:
        yb_view_orbit(view, map, azimuth, elevation, (uint16_t)rng_range(rng, 100, 700));
        break;
    case 2: /* far */
        yb_view_orbit(view, map, azimuth, elevation, (uint16_t)rng_range(rng, 700, 4000));
        break;
    case 3: /* in it, or just over it */
        stand(view, map, rng, rng_range(rng, -3000, 8000));
        break;
    case 4: /* on foot */
        stand(view, map, rng, rng_range(rng, 20, 600));
        break;
    case 5: /* straight down or up */
        stand(view, map, rng, rng_one_in(rng, 4) ? -20000 : rng_range(rng, 3000, 60000));
        view->azimuth_bam = azimuth;
        view->look_q8[0] = view->eye_q8[0];
        view->look_q8[1] = view->eye_q8[1];
        view->look_q8[2] = view->eye_q8[2] + (rng_one_in(rng, 4) ? 5000 : -5000);
        break;
    case 6: /* at a side or a corner of the frame */
        stand(view, map, rng, rng_range(rng, -2000, 4000));
        view->eye_q8[0] = rng_one_in(rng, 2) ? 0 : map->east_q8;
        if (rng_one_in(rng, 2))
            view->eye_q8[1] = rng_one_in(rng, 2) ? 0 : map->north_q8;
        break;
    default: /* from below */
        stand(view, map, rng, rng_range(rng, -60000, -1000));
        view->look_q8[2] = view->eye_q8[2] + rng_range(rng, -5000, 30000);
        break;
    }
}

static int32_t wild_number(rng_t *rng)
{
    static const int32_t extreme[] = {INT32_MIN,  INT32_MAX, 0,      1,       -1,   1 << 20,
                                      -(1 << 20), 65535,     -65535, 1 << 19, 32640};
    if (rng_one_in(rng, 2))
        return extreme[rng_range(rng, 0, 10)];
    return (int32_t)((int64_t)rng_next(rng) >> rng_range(rng, 33, 60));
}

void wild_view(yb_view_t *view, rng_t *rng)
{
    for (int i = 0; i < 3; i++) {
        view->eye_q8[i] = wild_number(rng);
        view->look_q8[i] = wild_number(rng);
        view->sun_q14[i] = (int16_t)wild_number(rng);
    }
    if (rng_one_in(rng, 3)) {
        for (int i = 0; i < 3; i++)
            view->look_q8[i] = view->eye_q8[i] ^ (rng_one_in(rng, 2) ? 0 : 1);
    }
    view->azimuth_bam = (uint16_t)wild_number(rng);
    view->zoom_q12 = (uint16_t)wild_number(rng);
    view->exaggerate_q8 = (uint16_t)wild_number(rng);
    view->edge_q4 = (uint16_t)wild_number(rng);
    view->walls = rng_one_in(rng, 2);
    view->water_q8 = wild_number(rng);
    view->max_leaves = (uint32_t)rng_range(rng, 1, 3000);
}
