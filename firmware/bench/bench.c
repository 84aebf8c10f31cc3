/* Runs the engine on a board so that instructions and stack can be counted from outside.
 *
 * The code to measure lies in the map slot. The console tells, line by line, what is being done:
 *
 *     size NAME BYTES        a struct of the engine, or working memory
 *     region NAME            instructions between yb_mark_begin and yb_mark_end are this NAME's
 *     stack NAME BYTES       the deepest the stack has been
 *     error TEXT             the code was refused
 *     done
 *
 * and the program then ends the emulator by semihosting. tests/budget reads this.
 */
#include "board.h"
#include "report.h"
#include "settings.h"
#include "standard_views.h"
#include "yamabiko/yamabiko.h"

enum {
    SHADOW_SIDE = 64
};

static uint8_t lit[YB_SHADOW_BYTES(SHADOW_SIDE)];
static yb_shadow_t shadow = {.side = SHADOW_SIDE, .lit = lit};
/* The largest frame measured is the largest that fits. */
static union {
    struct {
        yb_map_t map;
        union {
            yb_load_t load;
            uint8_t heights[YB_SHADOW_WORK(SHADOW_SIDE)];
        } work;
    };
    uint32_t piece[BENCH_BYTES / 4];
} memory;

/* --- What is measured ------------------------------------------------------------------------- */

static yb_view_t views[YB_STANDARD_VIEWS];

/* The standard setting of a screen size, in so many KB for all of it, is measured from all the
 * standard views: its bands are as high as there is memory for. What other bands cost is measured
 * from the orbits alone.
 */
typedef struct {
    const char *name;
    yb_screen_t screen;
    uint16_t rows;  /* of a band; 0: as many as fit … */
    uint16_t bytes; /* … into so much memory for all but the stack */
    uint16_t views;
    void (*look)(yb_view_t *view); /* what is drawn beside the relief, or NULL */
} setting_t;

#define ORBITS (YB_ORBIT_315 + 1)

static void with_shadows(yb_view_t *view)
{
    view->shadow = &shadow;
}

static void with_lines(yb_view_t *view)
{
    view->contour_q8 = (memory.map.high_q8 - memory.map.low_q8) / 10 + YB_LEAST_CONTOUR_Q8;
}

static void with_haze(yb_view_t *view)
{
    view->haze_q8 = memory.map.east_q8;
}

static void with_all(yb_view_t *view)
{
    with_shadows(view);
    with_lines(view);
    with_haze(view);
}

static const setting_t settings[] = {
    {"128x64-12k", {128, 64, YB_GREY4}, 0, BYTES_12K, YB_STANDARD_VIEWS, NULL},
    {"128x64-12k-shadows", {128, 64, YB_GREY4}, 0, BYTES_12K, ORBITS, with_shadows},
    {"128x64-12k-lines", {128, 64, YB_GREY4}, 0, BYTES_12K, ORBITS, with_lines},
    {"128x64-12k-haze", {128, 64, YB_GREY4}, 0, BYTES_12K, ORBITS, with_haze},
    {"128x64-12k-all", {128, 64, YB_GREY4}, 0, BYTES_12K, ORBITS, with_all},
    {"128x64-rows1", {128, 64, YB_GREY4}, 1, 0, ORBITS, NULL},
    {"128x64-rows4", {128, 64, YB_GREY4}, 4, 0, ORBITS, NULL},
    {"128x64-rows8", {128, 64, YB_GREY4}, 8, 0, ORBITS, NULL},
    {"128x64-rows16", {128, 64, YB_GREY4}, 16, 0, ORBITS, NULL},
    {"128x64-rows64", {128, 64, YB_GREY4}, 64, 0, ORBITS, NULL},
    {"320x240-32k", {320, 240, YB_RGB565}, 0, BYTES_32K, YB_STANDARD_VIEWS, NULL},
    {"320x240-rows16", {320, 240, YB_RGB565}, 16, 0, ORBITS, NULL},
    {"320x240-rows240", {320, 240, YB_RGB565}, 240, 0, ORBITS, NULL},
};

/* NULL: the board has not so much memory. */
static yb_frame_t *place(const setting_t *setting, yb_band_t *band)
{
    const size_t bytes = setting->rows == 0 ? setting->bytes : sizeof memory;
    yb_frame_t *frame = yb_frame_place(&memory.map, bytes, &setting->screen, band);
    if (bytes > sizeof memory || frame == NULL || band->rows < setting->rows)
        return NULL;
    if (setting->rows != 0)
        band->rows = setting->rows;
    return frame;
}

static void draw(const setting_t *setting, const yb_view_t *view)
{
    yb_band_t band;
    yb_frame_t *frame = place(setting, &band);
    yb_frame_begin(frame, &memory.map, view, &setting->screen);
    const uint16_t most = band.rows;
    for (; band.y < setting->screen.height; band.y = (uint16_t)(band.y + band.rows)) {
        band.rows = yb_band_rows(&setting->screen, band.y, most);
        yb_frame_band(frame, &band);
    }
}

static void measure_frame(const setting_t *setting, int which)
{
    report_text("region frame ");
    report_text(setting->name);
    report_text(" ");
    report_text(yb_standard_view_name(which));
    report_text("\r\n");
    yb_view_t view = views[which];
    if (setting->look != NULL)
        setting->look(&view);
    yb_mark_begin();
    draw(setting, &view);
    yb_mark_end();
}

static void measure_frames(const setting_t *setting)
{
    yb_band_t band;
    if (place(setting, &band) == NULL)
        return;
    report_line("size", "piece-", setting->name, setting->bytes);
    report_paint_stack();
    for (int which = 0; which < setting->views; which++)
        measure_frame(setting, which);
    report_line("stack", "frame-", setting->name, report_stack_used());
}

static bool measure_load(void)
{
    report_text("region load\r\n");
    report_paint_stack();
    yb_mark_begin();
    yb_map_begin(&memory.map, &memory.work.load);
    yb_status_t status = YB_MORE;
    for (size_t i = 0; i < YB_SLOT_BYTES && status == YB_MORE; i++)
        status = yb_map_feed(&memory.map, &memory.work.load, &yb_slot[i], 1);
    yb_mark_end();
    report_line("stack", "load", "", report_stack_used());
    if (status != YB_OK) {
        report_text("error ");
        report_text(yb_status_text(status));
        report_text("\r\n");
    }
    return status == YB_OK;
}

static void measure_shadows(void)
{
    report_text("region shadows\r\n");
    report_paint_stack();
    yb_mark_begin();
    yb_shadow_cast(&memory.map, &views[0], &shadow, memory.work.heights);
    yb_mark_end();
    report_line("stack", "shadows", "", report_stack_used());
}

static void measure_all(void)
{
    report_line("size", "yb_map_t", "", sizeof(yb_map_t));
    report_line("size", "yb_load_t", "", sizeof(yb_load_t));
    report_line("size", "yb_frame_t", "", sizeof(yb_frame_t));
    /* What the markers themselves cost. */
    report_text("region nothing\r\n");
    yb_mark_begin();
    yb_mark_end();
    if (!measure_load())
        return;
    report_line("size", "vertices", "", memory.map.vertex_count);
    for (int which = 0; which < YB_STANDARD_VIEWS; which++) {
        yb_view_init(&views[which], &memory.map);
        yb_standard_view_set(&views[which], &memory.map, (yb_standard_view_t)which);
    }
    measure_shadows();
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        measure_frames(&settings[i]);
}

int main(void)
{
    yb_board_init();
    measure_all();
    report_text("done\r\n");
    report_leave();
    return 0;
}
