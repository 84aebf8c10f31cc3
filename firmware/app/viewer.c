#include "viewer.h"

#include <stddef.h>

#define FNV_START 2166136261u
#define FNV_PRIME 16777619u

static void set_view(yb_view_t *view, const yb_map_t *map, uint16_t azimuth_bam)
{
    yb_view_init(view, map);
    view->exaggerate_q8 = YB_VIEWER_EXAGGERATE_Q8;
    yb_view_orbit(view, map, azimuth_bam, YB_DEGREES(YB_VIEWER_ELEVATION), YB_VIEWER_DISTANCE_Q8);
}

static yb_status_t load_map(yb_viewer_t *viewer, const uint8_t *code, size_t room)
{
    yb_load_t *load = &viewer->work.load;
    yb_map_begin(&viewer->map, load);
    /* One byte at a time: only the decoder knows where the code ends. */
    for (size_t i = 0; i < room; i++) {
        yb_status_t status = yb_map_feed(&viewer->map, load, &code[i], 1);
        if (status != YB_MORE)
            return status;
    }
    return yb_map_end(&viewer->map, load);
}

yb_status_t yb_viewer_load(yb_viewer_t *viewer, const uint8_t *code, size_t room)
{
    yb_status_t status = load_map(viewer, code, room);
    viewer->looks = 0;
    if (status != YB_OK)
        return status;
    yb_view_t view;
    set_view(&view, &viewer->map, 0);
    viewer->shadow.side = YB_VIEWER_SHADOW_SIDE;
    viewer->shadow.lit = viewer->lit;
    yb_shadow_cast(&viewer->map, &view, &viewer->shadow, viewer->work.heights);
    return YB_OK;
}

/* Heights of a map are below 2^18 in 1/256 step, a step below 2^27 in 1/64 m. */
static uint32_t to_metres(const yb_map_t *map, uint32_t height_q8)
{
    return (uint32_t)((uint64_t)height_q8 * yb_unit_64th_m(map->cell) >> 14);
}

uint32_t yb_viewer_interval_m(const yb_map_t *map)
{
    static const uint8_t steps[3] = {1, 2, 5};
    uint32_t least = to_metres(map, (uint32_t)(map->high_q8 - map->low_q8)) / 14;
    uint32_t power = 1;
    for (unsigned i = 0;; i++) {
        if (i == 3) {
            power *= 10;
            i = 0;
        }
        if (steps[i] * power >= least || power >= 100000000)
            return steps[i] * power;
    }
}

/* Lines at multiples of the interval above the datum. */
static void set_lines(yb_view_t *view, const yb_map_t *map)
{
    uint32_t cell = yb_unit_64th_m(map->cell);
    int32_t interval_m = (int32_t)yb_viewer_interval_m(map);
    int32_t above_m = interval_m - map->base_m % interval_m; /* the base's own, or the next */
    view->contour_q8 = (int32_t)(((uint64_t)interval_m << 14) / (cell > 0 ? cell : 1));
    view->contour_at_q8 = (int32_t)(((uint64_t)above_m << 14) / (cell > 0 ? cell : 1));
}

static uint32_t hash_bytes(uint32_t hash, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ bytes[i]) * FNV_PRIME;
    return hash;
}

uint32_t yb_viewer_draw(yb_viewer_t *viewer, uint16_t azimuth_bam, yb_viewer_band_fn band,
                        void *context)
{
    const yb_screen_t screen = {
        .width = YB_VIEWER_WIDTH, .height = YB_VIEWER_HEIGHT, .format = YB_GREY4};
    yb_view_t view;
    set_view(&view, &viewer->map, azimuth_bam);
    if ((viewer->looks & YB_VIEWER_SHADOWS) != 0)
        view.shadow = &viewer->shadow;
    if ((viewer->looks & YB_VIEWER_LINES) != 0)
        set_lines(&view, &viewer->map);

    yb_band_t rows;
    yb_frame_t *frame = yb_frame_place(
        &viewer->map, offsetof(yb_viewer_t, work) + sizeof viewer->work, &screen, &rows);
    uint32_t hash = FNV_START;
    if (frame == NULL) /* there is room for a row of any map */
        return hash;
    yb_frame_begin(frame, &viewer->map, &view, &screen);
    const uint16_t most = rows.rows;
    for (; rows.y < YB_VIEWER_HEIGHT; rows.y = (uint16_t)(rows.y + rows.rows)) {
        rows.rows = yb_band_rows(&screen, rows.y, most);
        yb_frame_band(frame, &rows);
        hash = hash_bytes(hash, rows.pixels, (size_t)YB_VIEWER_PITCH * rows.rows);
        if (band)
            band(context, rows.y, rows.rows, rows.pixels);
    }
    return hash;
}
