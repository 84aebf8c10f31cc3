/* The outlet: every panel and turn shows what was drawn, the thread passes failures on, a started
 * display hears its ticks in time, with frames and without. Against the panels' models. */
#include "outlet.h"

#include <model_bus.h>

#include "picture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

typedef struct {
    yb_model_bus_t wires;
    yb_panel_bus_t bus; /* over that one */
    long transfers_left;
    unsigned ticks;
} bench_t;

static bool pass(bench_t *bench, bool is_data, const uint8_t *bytes, size_t count)
{
    const yb_panel_bus_t *bus = &bench->wires.bus;
    if (bench->transfers_left-- <= 0)
        return false;
    if (count == 2 && (bytes[0] & 0xA0) == 0)
        bench->ticks++; /* of a memory LCD: neither writes nor clears */
    return is_data ? bus->data(bus->context, bytes, count)
                   : bus->command(bus->context, bytes, count);
}

static bool command(void *context, const uint8_t *bytes, size_t count)
{
    return pass(context, false, bytes, count);
}

static bool data(void *context, const uint8_t *bytes, size_t count)
{
    return pass(context, true, bytes, count);
}

static void wait_ms(void *context, uint32_t ms)
{
    bench_t *bench = context;
    yb_model_bus_pass(&bench->wires, ms * 1000);
}

static void set_up(bench_t *bench, const yb_panel_t *panel)
{
    assert_true(yb_model_bus_open(&bench->wires, panel));
    bench->bus =
        (yb_panel_bus_t){.context = bench, .command = command, .data = data, .wait_ms = wait_ms};
    bench->transfers_left = 1000000000;
    bench->ticks = 0;
    yb_panel_model_reset(bench->wires.model);
}

static uint64_t model_ms(void *context)
{
    const bench_t *bench = context;
    return bench->wires.nanoseconds / 1000000;
}

static uint8_t drawn[320 * 320 * 2];

/* Draws noise in bands of so many rows, and keeps it; answers what the outlet does. */
static bool draw(yb_outlet_t *outlet, const yb_screen_t *screen, uint16_t rows, uint32_t seed)
{
    const size_t pitch = yb_screen_pitch(screen);
    for (uint16_t y = 0; y < screen->height; y = (uint16_t)(y + rows)) {
        const uint16_t left = (uint16_t)(screen->height - y);
        const uint16_t now = left < rows ? left : rows;
        uint8_t *band = yb_outlet_band(outlet, y);
        for (size_t i = 0; i < now * pitch; i++) {
            seed = seed * 1664525u + 1013904223u;
            band[i] = (uint8_t)(seed >> 24);
        }
        memcpy(drawn + y * pitch, band, now * pitch);
        yb_outlet_send(outlet, y, now);
    }
    return yb_outlet_finish(outlet);
}

/* The glass, turned back, shows what was drawn. */
static void assert_shown(bench_t *bench, const yb_screen_t *screen, unsigned turn)
{
    yb_model_picture_t glass;
    yb_picture_t expected, turned;
    if (!yb_panel_model_picture(bench->wires.model, &glass))
        fail_msg("%s", yb_panel_model_error(bench->wires.model));
    assert_true(yb_picture_from_frame(&expected, screen, drawn));
    assert_true(yb_picture_turn(&turned, &expected, turn));
    assert_int_equal(turned.width, glass.width);
    assert_int_equal(turned.height, glass.height);
    for (size_t i = 0; i < 3u * glass.width * glass.height; i++) {
        if (glass.rgb[i] != turned.samples[turned.channels == 3 ? i : i / 3])
            fail_msg("sample %zu differs", i);
    }
    yb_picture_free(&expected);
    yb_picture_free(&turned);
}

static void all_turns_show_what_was_drawn(void **state)
{
    const yb_panel_t *panel = NULL;
    (void)state;
    for (size_t i = 0; (panel = yb_panel_at(i)) != NULL; i++) {
        for (int turn = 0; turn < 4; turn++) {
            bench_t bench;
            set_up(&bench, panel);
            const yb_outlet_clock_t clock = {model_ms, &bench};
            const yb_screen_t screen = yb_outlet_screen(panel, (yb_turn_t)turn);
            const uint16_t step = yb_outlet_step(panel, (yb_turn_t)turn);
            const uint16_t rows = (uint16_t)(step * 3);
            yb_outlet_t *outlet = yb_outlet_open(panel, (yb_turn_t)turn, &bench.bus, rows, &clock);
            assert_non_null(outlet);
            assert_true(yb_outlet_start(outlet));
            for (uint32_t frame = 0; frame < 4; frame++)
                assert_true(draw(outlet, &screen, rows, frame / 2));
            assert_shown(&bench, &screen, (unsigned)turn);
            yb_outlet_close(outlet);
            yb_model_bus_close(&bench.wires);
        }
    }
}

static void failures_reach_the_caller(void **state)
{
    bench_t bench;
    (void)state;
    set_up(&bench, &yb_panel_st7789);
    const yb_screen_t screen = yb_outlet_screen(&yb_panel_st7789, YB_TURN_0);
    yb_outlet_t *outlet = yb_outlet_open(&yb_panel_st7789, YB_TURN_0, &bench.bus, 30, NULL);
    bench.transfers_left = 3;
    assert_false(yb_outlet_start(outlet));
    bench.transfers_left = 1000000;
    assert_true(yb_outlet_start(outlet));
    assert_true(draw(outlet, &screen, 30, 1));
    bench.transfers_left = 20;
    assert_false(draw(outlet, &screen, 30, 2));
    /* A start mends it, and the next frame is whole. */
    bench.transfers_left = 1000000;
    assert_true(yb_outlet_start(outlet));
    const uint64_t before = yb_panel_model_bytes(bench.wires.model);
    assert_true(draw(outlet, &screen, 30, 2));
    assert_true(yb_panel_model_bytes(bench.wires.model) - before >= 240u * 240 * 2);
    yb_outlet_close(outlet);
    yb_model_bus_close(&bench.wires);
}

/* Three seconds of frames by the model's clock: the model refuses if a second goes by unheard. */
static void ticks_come_while_frames_go(void **state)
{
    bench_t bench;
    (void)state;
    set_up(&bench, &yb_panel_ls027b7dh01);
    const yb_outlet_clock_t clock = {model_ms, &bench};
    const yb_screen_t screen = yb_outlet_screen(&yb_panel_ls027b7dh01, YB_TURN_0);
    yb_outlet_t *outlet = yb_outlet_open(&yb_panel_ls027b7dh01, YB_TURN_0, &bench.bus, 40, &clock);
    assert_true(yb_outlet_start(outlet));
    for (uint32_t frame = 0; model_ms(&bench) < 3000; frame++)
        assert_true(draw(outlet, &screen, 40, frame));
    yb_outlet_close(outlet);
    assert_in_range(bench.ticks, 5, 6);
    yb_model_bus_close(&bench.wires);
}

static void ticks_come_while_nothing_goes(void **state)
{
    const struct timespec pause = {.tv_sec = 1, .tv_nsec = 300000000};
    bench_t bench;
    (void)state;
    set_up(&bench, &yb_panel_ls013b7dh03);
    yb_outlet_t *outlet = yb_outlet_open(&yb_panel_ls013b7dh03, YB_TURN_0, &bench.bus, 128, NULL);
    assert_true(yb_outlet_start(outlet));
    nanosleep(&pause, NULL);
    yb_outlet_close(outlet);
    assert_in_range(bench.ticks, 1, 2);
    yb_model_bus_close(&bench.wires);
}

static void blank_shows_nothing(void **state)
{
    static const yb_panel_t *const panels[] = {&yb_panel_ssd0323, &yb_panel_ls013b7dh03};
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        bench_t bench;
        yb_model_picture_t glass;
        set_up(&bench, panels[i]);
        const yb_screen_t screen = yb_outlet_screen(panels[i], YB_TURN_0);
        yb_outlet_t *outlet = yb_outlet_open(panels[i], YB_TURN_0, &bench.bus, 32, NULL);
        assert_true(yb_outlet_start(outlet) && draw(outlet, &screen, 32, 5));
        assert_true(yb_outlet_blank(outlet));
        assert_true(yb_panel_model_picture(bench.wires.model, &glass));
        for (size_t k = 0; k < 3u * glass.width * glass.height; k++)
            assert_int_equal(glass.rgb[k], i == 0 ? 0 : 255);
        yb_outlet_close(outlet);
        yb_model_bus_close(&bench.wires);
    }
}

/* A bus that fails while nothing is drawn, and so nobody asks. */
static void failures_between_frames_are_seen(void **state)
{
    const struct timespec pause = {.tv_sec = 0, .tv_nsec = 900000000};
    bench_t bench;
    (void)state;
    set_up(&bench, &yb_panel_ls013b7dh03);
    yb_outlet_t *outlet = yb_outlet_open(&yb_panel_ls013b7dh03, YB_TURN_0, &bench.bus, 128, NULL);
    assert_true(yb_outlet_start(outlet));
    assert_true(yb_outlet_well(outlet));
    bench.transfers_left = 0;
    nanosleep(&pause, NULL);
    assert_false(yb_outlet_well(outlet));
    yb_outlet_close(outlet);
    yb_model_bus_close(&bench.wires);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_turns_show_what_was_drawn),
        cmocka_unit_test(failures_reach_the_caller),
        cmocka_unit_test(ticks_come_while_frames_go),
        cmocka_unit_test(ticks_come_while_nothing_goes),
        cmocka_unit_test(blank_shows_nothing),
        cmocka_unit_test(failures_between_frames_are_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
