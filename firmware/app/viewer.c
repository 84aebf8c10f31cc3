#include "viewer.h"

#define FNV_START 2166136261u
#define FNV_PRIME 16777619u

yb_status_t yb_viewer_load(yb_viewer_t *viewer, const uint8_t *code, size_t room)
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
    yb_view_init(&view, &viewer->map);
    view.exaggerate_q8 = YB_VIEWER_EXAGGERATE_Q8;
    yb_view_orbit(&view, &viewer->map, azimuth_bam, YB_DEGREES(YB_VIEWER_ELEVATION),
                  YB_VIEWER_DISTANCE_Q8);

    yb_viewer_drawing_t *drawing = &viewer->work.drawing;
    yb_frame_begin(&drawing->frame, &viewer->map, &view, &screen);
    yb_band_t rows = {.rows = YB_VIEWER_BAND_ROWS,
                      .depth = drawing->depth,
                      .pixels = drawing->pixels,
                      .pitch = YB_VIEWER_PITCH};
    uint32_t hash = FNV_START;
    for (uint16_t y = 0; y < YB_VIEWER_HEIGHT; y = (uint16_t)(y + YB_VIEWER_BAND_ROWS)) {
        rows.y = y;
        yb_frame_band(&drawing->frame, &rows);
        hash = hash_bytes(hash, drawing->pixels, sizeof drawing->pixels);
        if (band)
            band(context, y, drawing->pixels);
    }
    return hash;
}
