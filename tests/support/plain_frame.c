#include "plain_frame.h"

#include <stdio.h>
#include <stdlib.h>

#include "camera.h"
#include "clip.h"
#include "colour.h"
#include "order.h"
#include "pixels.h"
#include "raster.h"
#include "refine.h"
#include "relief.h"
#include "shade.h"

typedef struct {
    const yb_frame_t *frame;
    const refine_view_t *view;
    plain_leaf_fn fn;
    void *context;
    uint32_t count;
} walk_t;

yb_edge_t plain_split(const yb_point_t *a, const yb_point_t *b, yb_edge_t edge)
{
    int class = relief_class(relief_dx(a->place, b->place), relief_dy(a->place, b->place));
    return edge >= REFINE_ONCE ? edge
                               : (edge & 0xffff) | (yb_edge_t)(class + 4) << 16 | REFINE_ONCE;
}

const refine_view_t *plain_view(const yb_frame_t *frame)
{
    static refine_view_t view;
    const uint32_t high = frame->screen.height * (uint32_t)16;
    view = (refine_view_t){-(1 << 20), -(int32_t)high, 1 << 21, 3 * high + 1, {{0, 0, 0}}};
    for (int i = 0; i < REFINE_PLANES; i++)
        view.plane[i].near = -(1 << 28); /* all is inside */
    return &view;
}

/* With twice the room that its relief may need. Without this all that lies behind the eye would be
 * refined as if it touched it.
 */
bool plain_behind(const yb_frame_t *frame, const yb_part_t *part)
{
    yb_part_t whole = *part;
    for (int i = 0; i < 3; i++)
        whole.edge[i] = plain_split(part->point[i], part->point[(i + 1) % 3], whole.edge[i]) |
                        0xff * REFINE_ONCE;
    int64_t stray = 2 * (int64_t)refine_stray(frame, &whole) + 256;
    int64_t lift = (int64_t)abs(frame->depth_z) * frame->view.exaggerate_q8 >> 8;
    for (int i = 0; i < 3; i++) {
        camera_point_t at;
        camera_view(frame, part->point[i]->place, part->point[i]->top_q8, &at);
        if (at.depth + (stray * lift >> 14 >> frame->eye_shift) + 2 >= camera_least(frame))
            return false;
    }
    return true;
}

/* What the engine relies on without asking. */
static void must(bool holds, const char *what)
{
    if (holds)
        return;
    (void)fprintf(stderr, "plain_frame: %s\n", what);
    abort();
}

/* An edge that is split has a class, and so has all that it is halved into. */
static void check_edges(const yb_part_t *part)
{
    for (int i = 0; i < 3; i++) {
        const yb_edge_t edge = part->edge[i];
        const int often = refine_often(edge);
        const int least = edge < REFINE_AGAIN ? 4 * (often - 1) : 0;
        if (edge < REFINE_ONCE)
            continue;
        must(often >= 1 && often <= YB_MAX_HALVINGS, "an edge is halved too often");
        must(refine_class(edge) >= least, "an edge is halved to what has no class");
    }
}

/* `used`: what the engine would have laid aside by now. */
static void walk(walk_t *at, yb_part_t part, int used)
{
    if (plain_behind(at->frame, &part))
        return;
    check_edges(&part);
    must(used <= YB_MAX_LEVELS, "the stack has not room enough");
    if (!refine_splits(&part)) {
        at->count++;
        at->fn(at->context, part.point);
        return;
    }
    yb_level_t rest[REFINE_PIECES];
    yb_level_t *top = refine_split(at->frame, at->view, &part, rest);
    yb_level_t *level = top;
    walk(at, part, used + (int)(top - rest));
    for (yb_part_t *done = &part; (level = refine_next(rest, level, done)) != NULL;) {
        done = &level->rest;
        walk(at, *done, used + (int)(refine_top(level) - rest));
    }
}

uint32_t plain_ordered(yb_frame_t *frame, plain_leaf_fn fn, void *context)
{
    walk_t at = {frame, plain_view(frame), fn, context, 0};
    for (int i = 0; i < frame->map->triangle_count; i++) {
        yb_part_t root;
        refine_root(frame, plain_view(frame), frame->order[i], NULL, &root);
        walk(&at, root, 0);
    }
    return at.count;
}

uint32_t plain_leaves(yb_frame_t *frame, plain_leaf_fn fn, void *context)
{
    (void)order_rows(frame, 0, 1);
    return plain_ordered(frame, fn, context);
}

typedef struct {
    const yb_frame_t *frame;
    raster_t raster;
} drawing_t;

static void draw_leaf(void *context, const yb_point_t *const p[3])
{
    drawing_t *drawing = context;
    const shade_t shade = shade_ground(drawing->frame, p);
    const uint16_t pixel = shade_pixel(shade);
    if (p[0]->spot.near == 0 || p[1]->spot.near == 0 || p[2]->spot.near == 0)
        (void)clip_draw(drawing->frame, &drawing->raster, p, shade, drawing->frame->lines);
    else {
        raster_cut_t cut;
        const yb_spot_t *const spot[3] = {&p[0]->spot, &p[1]->spot, &p[2]->spot};
        raster_t only_look = drawing->raster;
        only_look.band = NULL;
        if (raster_draw(&only_look, spot[0], spot[1], spot[2], pixel, NULL) == RASTER_NOTHING)
            return;
        raster_shape_t shape;
        raster_look_t look = raster_front(spot[0], spot[1], spot[2], &shape);
        const bool cuts = drawing->frame->lines && shade_cut(drawing->frame, p, shade, &cut);
        raster_fill(&drawing->raster, &shape, look, pixel, cuts ? &cut : NULL);
    }
}

void plain_frame(yb_frame_t *frame, const yb_band_t *band)
{
    const int32_t height = frame->screen.height;
    drawing_t drawing = {frame, pixels_open(&frame->screen, band)};
    raster_t *raster = &drawing.raster;
    for (int32_t y = 0; y < height; y++)
        pixels_clear(raster, y, colour_sky(frame, y));
    for (int32_t y = 0; y < height; y = raster->end_row) {
        raster->first_row = y;
        raster->end_row = order_rows(frame, y, height);
        frame->binned = false;
        if (frame->view.walls)
            walls_draw(frame, plain_view(frame), raster);
        (void)plain_ordered(frame, draw_leaf, &drawing);
    }
    for (int32_t y = 0; y < height; y++)
        pixels_show(raster, y);
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

/* Shadows that nothing casts: any bits. */
static const yb_shadow_t *random_shadow(rng_t *rng)
{
    static uint8_t lit[YB_SHADOW_BYTES(64)];
    static yb_shadow_t shadow = {.lit = lit};
    shadow.side = shadow.columns = shadow.rows = (uint16_t)(16 << rng_range(rng, 0, 2));
    for (size_t i = 0; i < YB_SHADOW_BYTES(shadow.side); i++)
        lit[i] = (uint8_t)rng_range(rng, 0, 255);
    return &shadow;
}

void random_look(yb_view_t *view, rng_t *rng)
{
    view->contour_q8 = view->haze_q8 = 0;
    view->lamp = rng_one_in(rng, 5);
    for (int i = 0; i < 3; i++)
        view->lamp_q8[i] = rng_range(rng, -70000, 130000);
    view->shadow = NULL;
    view->palette = (yb_palette_t)rng_range(rng, 0, YB_PALETTES - 1);
    if (rng_one_in(rng, 2)) {
        view->contour_q8 = rng_range(rng, 0, rng_one_in(rng, 2) ? 2000 : 70000);
        view->contour_at_q8 = rng_range(rng, -20000, 20000);
    }
    if (rng_one_in(rng, 3))
        view->haze_q8 = rng_range(rng, 1, 100000);
    if (rng_one_in(rng, 3))
        view->shadow = random_shadow(rng);
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
    random_look(view, rng);
    view->contour_q8 = wild_number(rng);
    view->contour_at_q8 = wild_number(rng);
    view->haze_q8 = wild_number(rng);
    for (int i = 0; i < 3; i++)
        view->lamp_q8[i] = wild_number(rng);
    view->max_leaves = (uint32_t)rng_range(rng, 1, 3000);
}
