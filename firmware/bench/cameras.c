/* Draws the map in the slot from many places, so that the worst frame and the worst band can be
 * found. The console is as bench.c's; the regions of camera N are
 *
 *     begin SETTING N              preparing its frame
 *     band SETTING N * 256 + ROW   a band
 */
#include "board.h"
#include "report.h"
#include "settings.h"
#include "yamabiko/yamabiko.h"

enum {
    CAMERAS = 125
};

static union {
    struct {
        yb_map_t map;
        yb_load_t load;
    };
    uint8_t piece[BENCH_BYTES];
} memory;

typedef struct {
    const char *name;
    yb_screen_t screen;
    uint32_t bytes;
} setting_t;

static const setting_t settings[] = {
    {" 128x64-12k", {128, 64, YB_GREY4}, BYTES_12K},
    {" 320x240-32k", {320, 240, YB_RGB565}, BYTES_32K},
};

/* The next of a fixed series, from 0 up to below `end`. */
static uint16_t draw_lot(uint32_t *series, uint32_t end)
{
    *series = *series * 1103515245u + 12345u;
    return (uint16_t)((*series >> 16) * end >> 16);
}

/* Half of them round the map, half of them on it or in the air above it. */
static void place(yb_view_t *view, uint32_t *series)
{
    uint16_t azimuth = draw_lot(series, 65535);
    yb_view_init(view, &memory.map);
    if (draw_lot(series, 2) == 0) {
        uint16_t elevation = (uint16_t)(YB_DEGREES(5) + draw_lot(series, YB_DEGREES(80)));
        yb_view_orbit(view, &memory.map, azimuth, elevation,
                      (uint16_t)(150 + draw_lot(series, 400)));
        return;
    }
    uint16_t x = draw_lot(series, memory.map.east_q8);
    uint16_t y = draw_lot(series, memory.map.north_q8);
    int16_t tilt = (int16_t)(draw_lot(series, YB_DEGREES(50)) - YB_DEGREES(40));
    yb_view_walk(view, &memory.map, x, y, 256 + draw_lot(series, 8192), azimuth, tilt);
}

static void draw(const setting_t *setting, uint32_t camera, const yb_view_t *view)
{
    const yb_screen_t *screen = &setting->screen;
    yb_band_t band;
    yb_frame_t *frame = yb_frame_place(&memory.map, setting->bytes, screen, &band);
    report_line("region", "begin", setting->name, camera);
    yb_mark_begin();
    yb_frame_begin(frame, &memory.map, view, screen);
    yb_mark_end();
    const uint16_t most = band.rows;
    for (; band.y < screen->height; band.y = (uint16_t)(band.y + band.rows)) {
        band.rows = yb_band_rows(screen, band.y, most);
        report_line("region", "band", setting->name, camera * 256 + band.y);
        yb_mark_begin();
        yb_frame_band(frame, &band);
        yb_mark_end();
    }
}

/* From the same cameras for each setting, if the board has the memory. */
static void draw_all(const setting_t *setting)
{
    uint32_t series = 1;
    if (setting->bytes > sizeof memory)
        return;
    for (uint32_t camera = 0; camera < CAMERAS; camera++) {
        yb_view_t view;
        place(&view, &series);
        draw(setting, camera, &view);
    }
}

int main(void)
{
    yb_board_init();
    yb_map_begin(&memory.map, &memory.load);
    yb_status_t status = YB_MORE;
    for (size_t i = 0; i < YB_SLOT_BYTES && status == YB_MORE; i++)
        status = yb_map_feed(&memory.map, &memory.load, &yb_slot[i], 1);
    if (status == YB_OK) {
        /* What the markers themselves cost. */
        report_text("region nothing\r\n");
        yb_mark_begin();
        yb_mark_end();
        for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
            draw_all(&settings[i]);
    } else {
        report_text("error ");
        report_text(yb_status_text(status));
        report_text("\r\n");
    }
    report_text("done\r\n");
    report_leave();
    return 0;
}
