/* Updates: whatever the frames, the display shows the last one; what has not changed is not sent;
 * and what is sent does not cost more than the whole. On a display of the test's own, whose windows
 * land in a picture. */
#include "update.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    SIDE_MOST = 64,
    ROW_MOST = 2 * SIDE_MOST,
    WINDOW_BYTES = 11
};

static uint8_t glass[SIDE_MOST * ROW_MOST];
static size_t sent_bytes, sent_windows, fail_after;
static const yb_panel_window_t *pending; /* pixels that DMA has not fetched yet */
static yb_panel_window_t pending_window;

/* Bit by bit, so that any window can be told from its neighbours. */
static bool fetch(void *context)
{
    const yb_display_t *display = context;
    const yb_screen_t screen = yb_display_screen(display);
    if (pending == NULL)
        return true;
    const size_t bits = yb_pixel_bits(screen.format), first = pending->x * bits % 8;
    for (size_t row = 0; row < pending->rows; row++) {
        const uint8_t *from = pending->pixels + row * pending->pitch_bytes;
        uint8_t *to = glass + (pending->y + row) * yb_screen_pitch(&screen) + pending->x * bits / 8;
        for (size_t bit = first; bit < first + pending->width * bits; bit++) {
            const uint8_t mask = (uint8_t)(0x80 >> bit % 8);
            to[bit / 8] = (uint8_t)((to[bit / 8] & ~mask) | (from[bit / 8] & mask));
        }
    }
    pending = NULL;
    return true;
}

static bool test_start(yb_display_t *display)
{
    (void)display;
    return true;
}

static bool test_write(yb_display_t *display, const yb_panel_window_t *window)
{
    fetch(display);
    if (sent_windows >= fail_after)
        return false;
    sent_windows++;
    const size_t pixels = (size_t)window->rows * window->width;
    sent_bytes +=
        display->panel->window_bytes + pixels * yb_pixel_bits(display->panel->screen.format) / 8;
    pending_window = *window;
    pending = &pending_window;
    return true;
}

static const yb_panel_driver_t driver = {.start = test_start, .write = test_write};

typedef struct {
    yb_panel_t panel;
    yb_panel_bus_t bus;
    yb_display_t display;
    uint8_t shown[sizeof glass];
    yb_update_t update;
    size_t frame_bytes;
} bench_t;

static void set_up(bench_t *bench, yb_format_t format, uint16_t width, uint16_t height,
                   uint8_t x_step, uint8_t y_step)
{
    memset(bench, 0, sizeof *bench);
    bench->panel = (yb_panel_t){.driver = &driver,
                                .screen = {width, height, format},
                                .turns = 15,
                                .x_step = x_step,
                                .y_step = y_step,
                                .window_bytes = WINDOW_BYTES};
    bench->bus = (yb_panel_bus_t){.context = &bench->display, .finish = fetch};
    bench->display = (yb_display_t){.panel = &bench->panel, .bus = &bench->bus};
    bench->update = (yb_update_t){.display = &bench->display, .shown = bench->shown};
    bench->frame_bytes = yb_screen_pitch(&bench->panel.screen) * height;
    memset(glass, 0, sizeof glass);
    sent_bytes = sent_windows = 0;
    fail_after = SIZE_MAX;
    pending = NULL;
    assert_true(yb_display_start(&bench->display));
}

static uint32_t next_random(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static void show(bench_t *bench, const uint8_t *frame, uint16_t rows)
{
    const size_t pitch = yb_screen_pitch(&bench->panel.screen);
    uint8_t band[sizeof glass];
    for (uint16_t y = 0; y < bench->panel.screen.height; y = (uint16_t)(y + rows)) {
        const uint16_t left = (uint16_t)(bench->panel.screen.height - y);
        const uint16_t now = left < rows ? left : rows;
        memcpy(band, frame + y * pitch, now * pitch);
        assert_true(yb_update_rows(&bench->update, y, now, band));
        memset(band, 0xA5, sizeof band); /* the band is the caller's again */
    }
    assert_true(yb_display_finish(&bench->display));
    assert_memory_equal(glass, frame, bench->frame_bytes);
}

static const struct {
    yb_format_t format;
    uint16_t width, height;
    uint8_t x_step, y_step;
} shapes[] = {
    {YB_RGB565, 61, 47, 1, 1}, {YB_GREY4, 64, 40, 2, 1}, {YB_MONO, 64, 48, 8, 8},
    {YB_MONO, 64, 48, 1, 8},   {YB_MONO, 56, 30, 56, 1}, {YB_RGB565, 1, 1, 1, 1},
};

/* Frames in which few, some or all pixels change, here and there or in blocks. */
static void change(uint8_t *frame, size_t bytes, size_t pitch, uint32_t *seed)
{
    const uint32_t how = next_random(seed) % 6;
    const size_t rows = bytes / pitch;
    if (how == 0)
        return;
    if (how == 1) {
        for (size_t i = 0; i < bytes; i++)
            frame[i] = (uint8_t)next_random(seed);
        return;
    }
    if (how == 2) { /* a comb: more runs in a row than rectangles can be open */
        for (size_t i = 0; i < bytes; i += 3)
            frame[i] = (uint8_t)next_random(seed);
        return;
    }
    for (uint32_t blocks = next_random(seed) % 5; blocks > 0; blocks--) {
        const size_t x = next_random(seed) % pitch, y = next_random(seed) % rows;
        const size_t width = 1 + next_random(seed) % (pitch - x);
        const size_t height = 1 + next_random(seed) % (rows - y);
        for (size_t row = y; row < y + height; row++)
            memset(frame + row * pitch + x, (int)(next_random(seed) & 0xFF), width);
    }
}

static void the_display_shows_every_frame(void **state)
{
    (void)state;
    for (size_t s = 0; s < sizeof shapes / sizeof shapes[0]; s++) {
        static bench_t bench;
        static uint8_t frame[sizeof glass];
        uint32_t seed = (uint32_t)s;
        set_up(&bench, shapes[s].format, shapes[s].width, shapes[s].height, shapes[s].x_step,
               shapes[s].y_step);
        memset(frame, 0, sizeof frame);
        for (int i = 0; i < 400; i++) {
            const uint16_t bands = (uint16_t)(shapes[s].height / shapes[s].y_step);
            change(frame, bench.frame_bytes, yb_screen_pitch(&bench.panel.screen), &seed);
            sent_bytes = 0;
            show(&bench, frame, (uint16_t)(shapes[s].y_step * (1 + next_random(&seed) % bands)));
            /* The whole band by band would cost a window each. */
            assert_true(sent_bytes <= bench.frame_bytes + (size_t)bands * WINDOW_BYTES);
        }
    }
}

static void a_still_picture_sends_nothing(void **state)
{
    static bench_t bench;
    static uint8_t frame[sizeof glass];
    (void)state;
    set_up(&bench, YB_RGB565, 60, 40, 1, 1);
    memset(frame, 0x35, sizeof frame);
    show(&bench, frame, 40);
    assert_int_equal(sent_windows, 1);
    sent_bytes = 0;
    show(&bench, frame, 8);
    assert_int_equal(sent_bytes, 0);
}

static void near_differences_share_a_window(void **state)
{
    static bench_t bench;
    static uint8_t frame[sizeof glass];
    const size_t pitch = 120;
    (void)state;
    set_up(&bench, YB_RGB565, 60, 40, 1, 1);
    /* Two pixels with four between them: 8 bytes, less than a window's 11. */
    frame[10 * pitch + 20] = frame[10 * pitch + 30] = 1;
    show(&bench, frame, 40);
    assert_int_equal(sent_windows, 1);
    assert_int_equal(sent_bytes, WINDOW_BYTES + 12);
    /* And far ones do not. */
    sent_bytes = sent_windows = 0;
    frame[10 * pitch + 20] = frame[10 * pitch + 70] = 2;
    show(&bench, frame, 40);
    assert_int_equal(sent_windows, 2);
    assert_int_equal(sent_bytes, 2 * (WINDOW_BYTES + 2));
    /* A block of rows is one window. */
    sent_bytes = sent_windows = 0;
    for (size_t y = 5; y < 25; y++)
        memset(frame + y * pitch + 10, 7, 40);
    show(&bench, frame, 40);
    assert_int_equal(sent_windows, 1);
    assert_int_equal(sent_bytes, WINDOW_BYTES + 20 * 40);
}

static void whole_rows_are_sent_on_demand(void **state)
{
    static bench_t bench;
    static uint8_t frame[sizeof glass];
    (void)state;
    set_up(&bench, YB_GREY4, 64, 40, 2, 1);
    memset(glass, 0x99, sizeof glass); /* something else is on the display */
    assert_true(yb_update_rows_whole(&bench.update, 0, 40, frame));
    assert_int_equal(sent_bytes, bench.frame_bytes + WINDOW_BYTES);
    sent_bytes = 0;
    show(&bench, frame, 40);
    assert_int_equal(sent_bytes, 0);
}

static void failures_and_wrong_bands_are_told(void **state)
{
    static bench_t bench;
    static uint8_t frame[sizeof glass];
    (void)state;
    set_up(&bench, YB_MONO, 64, 48, 8, 8);
    memset(frame, 0xFF, sizeof frame);
    assert_false(yb_update_rows(&bench.update, 4, 8, frame));
    assert_false(yb_update_rows(&bench.update, 0, 12, frame));
    assert_false(yb_update_rows(&bench.update, 40, 16, frame));
    assert_false(yb_update_rows(&bench.update, 0, 56, frame));
    assert_false(yb_update_rows_whole(&bench.update, 48, 8, frame));
    assert_int_equal(sent_windows, 0);
    fail_after = 0;
    assert_false(yb_update_rows(&bench.update, 0, 8, frame));
    assert_false(yb_update_rows_whole(&bench.update, 0, 8, frame));
}

static void pictures_turn_clockwise(void **state)
{
    /* 2 x 2 with a letter in each corner: AB over CD. */
    static const uint8_t from[] = {0, 'A', 0, 'B', 0, 'C', 0, 'D'};
    static const char *const turned[] = {"ABCD", "CADB", "DCBA", "BDAC"};
    const yb_screen_t screen = {2, 2, YB_RGB565};
    (void)state;
    for (int turn = 0; turn < 4; turn++) {
        uint8_t to[8];
        yb_turn_picture(&screen, (yb_turn_t)turn, from, to);
        for (int i = 0; i < 4; i++)
            assert_int_equal(to[2 * i + 1], turned[turn][i]);
    }
}

static void four_quarter_turns_are_none(void **state)
{
    static const yb_screen_t screens[] = {
        {14, 6, YB_GREY4}, {24, 16, YB_MONO}, {5, 9, YB_RGB565}, {128, 64, YB_GREY4}};
    (void)state;
    for (size_t i = 0; i < sizeof screens / sizeof screens[0]; i++) {
        const yb_screen_t across = {screens[i].height, screens[i].width, screens[i].format};
        const size_t bytes = yb_screen_pitch(&screens[i]) * screens[i].height;
        uint8_t first[4096], a[4096], b[4096];
        uint32_t seed = 5;
        for (size_t k = 0; k < bytes; k++)
            first[k] = (uint8_t)next_random(&seed);
        yb_turn_picture(&screens[i], YB_TURN_90, first, a);
        yb_turn_picture(&across, YB_TURN_90, a, b);
        yb_turn_picture(&screens[i], YB_TURN_180, first, a);
        assert_memory_equal(a, b, bytes);
        yb_turn_picture(&screens[i], YB_TURN_90, b, a);
        yb_turn_picture(&screens[i], YB_TURN_270, first, b);
        assert_memory_equal(a, b, bytes);
        yb_turn_picture(&across, YB_TURN_90, b, a);
        assert_memory_equal(a, first, bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_display_shows_every_frame),
        cmocka_unit_test(a_still_picture_sends_nothing),
        cmocka_unit_test(near_differences_share_a_window),
        cmocka_unit_test(whole_rows_are_sent_on_demand),
        cmocka_unit_test(failures_and_wrong_bands_are_told),
        cmocka_unit_test(pictures_turn_clockwise),
        cmocka_unit_test(four_quarter_turns_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
