/* Draws the map in the slot from many places, at 128 x 64 in 12 KB for all of it, so that the worst
 * frame and the worst band can be found. The console is as bench.c's; the regions of camera N are
 *
 *     begin N                preparing its frame
 *     band N * 64 + ROW      a band
 */
#include "board.h"
#include "report.h"
#include "yamabiko/yamabiko.h"

enum {
    CAMERAS = 125,
    WIDTH = 128,
    HEIGHT = 64,
    BYTES = 12 * 1024 - 960 /* all of it, but for what the stack takes at most */
};

static union {
    struct {
        yb_map_t map;
        yb_load_t load;
    };
    uint8_t piece[BYTES];
} memory;

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

static void draw(uint32_t camera, const yb_view_t *view)
{
    static const yb_screen_t screen = {WIDTH, HEIGHT, YB_GREY4};
    yb_band_t band;
    yb_frame_t *frame = yb_frame_place(&memory.map, sizeof memory, &screen, &band);
    report_line("region", "begin", "", camera);
    yb_mark_begin();
    yb_frame_begin(frame, &memory.map, view, &screen);
    yb_mark_end();
    const uint16_t most = band.rows;
    for (; band.y < HEIGHT; band.y = (uint16_t)(band.y + band.rows)) {
        band.rows = yb_band_rows(&screen, band.y, most);
        report_line("region", "band", "", camera * HEIGHT + band.y);
        yb_mark_begin();
        yb_frame_band(frame, &band);
        yb_mark_end();
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
        uint32_t series = 1;
        /* What the markers themselves cost. */
        report_text("region nothing\r\n");
        yb_mark_begin();
        yb_mark_end();
        for (uint32_t camera = 0; camera < CAMERAS; camera++) {
            yb_view_t view;
            place(&view, &series);
            draw(camera, &view);
        }
    } else {
        report_text("error ");
        report_text(yb_status_text(status));
        report_text("\r\n");
    }
    report_text("done\r\n");
    report_leave();
    return 0;
}
