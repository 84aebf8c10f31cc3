/* The panels' drivers against the models of the panels, every panel in every turn that its chip
 * does: what is written is what is shown, and what the chip would not understand is refused. */
#include "panel_glass.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    MOST_BYTES = 2 * 240 * 320,
    POISON = 0xA5
};

static uint8_t frame[MOST_BYTES];
static uint8_t other[MOST_BYTES];

/* Calls `body` with a fresh display, not started. */
static void for_each(void (*body)(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display))
{
    const yb_panel_t *panel;

    for (size_t i = 0; (panel = yb_panel_at(i)) != NULL; i++) {
        assert_true(yb_screen_pitch(&panel->screen) * panel->screen.height <= MOST_BYTES);
        for (int turn = YB_TURN_0; turn <= YB_TURN_270; turn++) {
            if ((panel->turns >> turn & 1) == 0)
                continue;
            wire_t wire;
            yb_panel_bus_t bus = wire_connect(&wire, panel);
            yb_display_t display = {.panel = panel, .bus = &bus, .turn = (yb_turn_t)turn};
            body(&wire, &bus, &display);
            wire_disconnect(&wire);
        }
    }
}

static void check_start(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    (void)bus;
    assert_true(yb_display_start(display));
    assert_true(yb_panel_model_lit(wire->model));
    assert_int_equal(wire->resets, 1);
    blank(display, frame);
    assert_shown(wire, display, frame, 0);

    /* Again, as after a failure. */
    draw_noise(other, frame_bytes(display), 1);
    assert_true(yb_display_write_rows(display, 0, yb_display_screen(display).height, other));
    assert_true(yb_display_start(display));
    assert_shown(wire, display, frame, 0);
}

static void start_shows_black(void **state)
{
    (void)state;
    for_each(check_start);
}

static void check_start_alone(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    bus->reset = NULL;
    bus->wait_ms = NULL;
    yb_panel_model_reset(wire->model);
    assert_true(yb_display_start(display));
    blank(display, frame);
    assert_shown(wire, display, frame, 0);
}

static void start_works_without_reset_and_wait(void **state)
{
    (void)state;
    for_each(check_start_alone);
}

static void check_restart(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    (void)bus;
    for (size_t transfers = 1; transfers < 60; transfers++) {
        wire->transfers_left = transfers;
        (void)(yb_display_start(display) && yb_display_write_rows(display, 0, 8, other));
        wire->transfers_left = SIZE_MAX;
        assert_true(yb_display_start(display));
    }
    blank(display, frame);
    assert_shown(wire, display, frame, 0);
}

static void start_works_after_failures(void **state)
{
    (void)state;
    for_each(check_restart);
}

static void unknown_turns_send_nothing(void **state)
{
    const yb_panel_t *panel;

    (void)state;
    for (size_t i = 0; (panel = yb_panel_at(i)) != NULL; i++) {
        assert_true((panel->turns & 1) != 0);
        for (int turn = YB_TURN_0; turn <= YB_TURN_270; turn++) {
            wire_t wire;
            const yb_panel_bus_t bus = wire_connect_blind(&wire, panel);
            yb_display_t display = {.panel = panel, .bus = &bus, .turn = (yb_turn_t)turn};
            if ((panel->turns >> turn & 1) != 0)
                continue;
            assert_false(yb_display_start(&display));
            assert_int_equal(wire.bytes + wire.resets, 0);
        }
    }
}

static void check_bands(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    static const unsigned steps[] = {1, 2, 3, 7, 8, 19, 1000};
    const yb_screen_t screen = yb_display_screen(display);
    const uint16_t step = yb_display_y_step(display);

    (void)bus;
    assert_true(yb_display_start(display));
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        const unsigned rows = steps[i] * step;
        draw_noise(frame, frame_bytes(display), rows);
        for (unsigned y = 0; y < screen.height; y += rows) {
            const unsigned left = screen.height - y;
            assert_true(yb_display_write_rows(display, (uint16_t)y,
                                              (uint16_t)(rows < left ? rows : left),
                                              frame + y * yb_screen_pitch(&screen)));
        }
        assert_shown(wire, display, frame, 0);
    }
}

static void every_band_height_gives_the_frame(void **state)
{
    (void)state;
    for_each(check_bands);
}

/* A stretch of at least one step on a side of so many pixels. */
static uint16_t random_stretch(uint16_t size, uint16_t step, uint16_t *from)
{
    const uint16_t steps = size / step;
    const uint16_t length = (uint16_t)(1 + random_below(steps));
    *from = (uint16_t)(random_below(steps - length + 1U) * step);
    return (uint16_t)(length * step);
}

static size_t bits_of(const yb_screen_t *screen, uint16_t width)
{
    return (size_t)width * yb_pixel_bits(screen->format);
}

static void copy_bits(uint8_t *to, const uint8_t *from, size_t first, size_t count)
{
    for (size_t bit = first; bit < first + count; bit++) {
        const uint8_t mask = (uint8_t)(0x80 >> bit % 8);
        to[bit / 8] = (uint8_t)((to[bit / 8] & ~mask) | (from[bit / 8] & mask));
    }
}

static void copy_window(const yb_screen_t *screen, const yb_panel_window_t *window, uint8_t *to,
                        const uint8_t *from)
{
    for (unsigned row = 0; row < window->rows; row++)
        copy_bits(to, from,
                  8 * (window->y + row) * window->pitch_bytes + bits_of(screen, window->x),
                  bits_of(screen, window->width));
}

/* A window somewhere, out of the whole picture `pixels`. */
static yb_panel_window_t random_window(const yb_display_t *display, const uint8_t *pixels)
{
    const yb_screen_t screen = yb_display_screen(display);
    yb_panel_window_t window = {.pitch_bytes = yb_screen_pitch(&screen)};

    window.width = random_stretch(screen.width, yb_display_x_step(display), &window.x);
    window.rows = random_stretch(screen.height, yb_display_y_step(display), &window.y);
    window.pixels = pixels + window.y * window.pitch_bytes + bits_of(&screen, window.x) / 8;
    return window;
}

static void check_windows(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    const yb_screen_t screen = yb_display_screen(display);
    const yb_panel_t *panel = display->panel;

    (void)bus;
    assert_true(yb_display_start(display));
    blank(display, frame);
    for (unsigned i = 0; i < 40; i++) {
        draw_noise(other, frame_bytes(display), i);
        const yb_panel_window_t window = random_window(display, other);
        const size_t row_bits = bits_of(&screen, window.width);
        const size_t before = wire->bytes;
        assert_true(yb_display_write(display, &window));
        assert_int_equal(wire->bytes - before, panel->window_bytes +
                                                   (size_t)window.rows * panel->row_bytes +
                                                   window.rows * row_bits / 8);
        copy_window(&screen, &window, frame, other);
        if (i % 8 == 0)
            assert_shown(wire, display, frame, 0);
    }
    assert_shown(wire, display, frame, 0);
}

static void windows_change_their_pixels_alone(void **state)
{
    (void)state;
    for_each(check_windows);
}

static void check_off(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    const yb_screen_t screen = yb_display_screen(display);
    const uint16_t w = screen.width;
    const uint16_t h = screen.height;
    const uint16_t x = yb_display_x_step(display);
    const uint16_t y = yb_display_y_step(display);
    const yb_panel_window_t off[] = {
        {.width = 0, .rows = y},
        {.width = x, .rows = 0},
        {.x = w, .width = x, .rows = y},
        {.width = (uint16_t)(w + x), .rows = y},
        {.x = (uint16_t)(w - x), .width = (uint16_t)(2 * x), .rows = y},
        {.y = h, .width = x, .rows = y},
        {.y = y, .width = x, .rows = h},
        {.x = (uint16_t)(0x10000 - x), .width = (uint16_t)(2 * x), .rows = y},
        {.y = (uint16_t)(0x10000 - y), .width = x, .rows = (uint16_t)(2 * y)},
    };

    (void)bus;
    for (size_t i = 0; i < sizeof off / sizeof off[0]; i++)
        assert_false(yb_display_write(display, &off[i]));
    for (uint16_t by = 1; by < x; by++) {
        assert_false(
            yb_display_write(display, &(yb_panel_window_t){.x = by, .width = x, .rows = y}));
        assert_false(yb_display_write(display, &(yb_panel_window_t){.width = by, .rows = y}));
    }
    for (uint16_t by = 1; by < y; by++) {
        assert_false(
            yb_display_write(display, &(yb_panel_window_t){.y = by, .width = x, .rows = y}));
        assert_false(yb_display_write(display, &(yb_panel_window_t){.width = x, .rows = by}));
    }
    assert_int_equal(wire->bytes, 0);
}

static void windows_off_the_display_send_nothing(void **state)
{
    (void)state;
    for_each(check_off);
}

static void check_sleep(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    (void)bus;
    draw_noise(frame, frame_bytes(display), 3);
    assert_true(yb_display_start(display));
    assert_true(yb_display_write_rows(display, 0, yb_display_screen(display).height, frame));
    const size_t before = wire->bytes;
    assert_true(yb_display_sleep(display, true));
    if (is_memory_lcd(display->panel)) {
        assert_int_equal(wire->bytes, before);
    } else {
        memset(other, 0, sizeof other);
        assert_false(yb_panel_model_lit(wire->model));
        assert_shown(wire, display, other, 0);
    }
    assert_true(yb_display_sleep(display, false));
    assert_true(yb_panel_model_lit(wire->model));
    assert_shown(wire, display, frame, 0);

    /* Pauses are kept by the driver, not by who calls it. */
    assert_true(yb_display_sleep(display, true));
    assert_true(yb_display_sleep(display, false));
    assert_true(yb_display_sleep(display, true));
    assert_true(yb_display_sleep(display, false));
    assert_shown(wire, display, frame, 0);
}

static void sleep_keeps_the_picture(void **state)
{
    (void)state;
    for_each(check_sleep);
}

static void check_invert(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    const uint16_t rows = yb_display_screen(display).height;
    const bool rewrite = is_memory_lcd(display->panel);

    (void)bus;
    draw_noise(frame, frame_bytes(display), 4);
    assert_true(yb_display_start(display));
    assert_true(yb_display_write_rows(display, 0, rows, frame));
    assert_true(yb_display_invert(display, true));
    if (rewrite)
        assert_shown(wire, display, frame, 0);
    assert_true(!rewrite || yb_display_write_rows(display, 0, rows, frame));
    assert_shown(wire, display, frame, 0xFF);
    assert_true(yb_display_invert(display, false));
    assert_true(!rewrite || yb_display_write_rows(display, 0, rows, frame));
    assert_shown(wire, display, frame, 0);
}

static void inverting_shows_light_for_dark(void **state)
{
    (void)state;
    for_each(check_invert);
}

static void check_brightness(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    (void)bus;
    draw_noise(frame, frame_bytes(display), 5);
    assert_true(yb_display_start(display));
    assert_true(yb_display_write_rows(display, 0, yb_display_screen(display).height, frame));
    const size_t before = wire->bytes;
    for (unsigned level = 0; level <= 255; level++)
        assert_true(yb_display_brightness(display, (uint8_t)level));
    if (display->panel->driver->brightness == NULL)
        assert_int_equal(wire->bytes, before);
    else
        assert_true(wire->bytes > before);
    assert_shown(wire, display, frame, 0);
}

static void every_brightness_is_understood(void **state)
{
    (void)state;
    for_each(check_brightness);
}

static void check_tick(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    draw_noise(frame, frame_bytes(display), 6);
    assert_true(yb_display_start(display));
    assert_true(yb_display_write_rows(display, 0, yb_display_screen(display).height, frame));
    const size_t before = wire->bytes;
    for (int i = 0; i < 5; i++) {
        bus->wait_ms(bus->context, display->panel->tick_ms);
        assert_true(yb_display_tick(display));
    }
    assert_int_equal(wire->bytes - before, display->panel->tick_ms != 0 ? 10 : 0);
    assert_int_equal(display->panel->tick_ms != 0, display->panel->driver->tick != NULL);
    assert_shown(wire, display, frame, 0);
}

static void ticks_keep_the_picture(void **state)
{
    (void)state;
    for_each(check_tick);
}

/* The polarity bit of memory LCDs: as it is in lines, the other with each tick. */
static uint8_t first_byte;

static bool note_first_byte(void *context, const uint8_t *bytes, size_t count)
{
    (void)context;
    (void)count;
    first_byte = bytes[0];
    return true;
}

static void ticks_alone_change_the_polarity(void **state)
{
    const yb_panel_bus_t bus = {.data = note_first_byte};
    yb_display_t display = {.panel = &yb_panel_ls013b7dh03, .bus = &bus};
    uint8_t polarity = 0;

    (void)state;
    assert_true(yb_display_start(&display));
    assert_int_equal(first_byte, 0x20);
    for (int i = 0; i < 4; i++) {
        assert_true(yb_display_tick(&display));
        polarity ^= 0x40;
        assert_int_equal(first_byte, polarity);
        assert_true(yb_display_invert(&display, i % 2 == 0));
        assert_true(yb_display_write_rows(&display, 0, 3, frame));
        assert_int_equal(first_byte, 0x80 | polarity);
    }
}

/* A transfer that fails makes the call fail that needed it, and those before it do not notice. */
static bool use(yb_display_t *display)
{
    return yb_display_start(display) && yb_display_write_rows(display, 0, 16, other) &&
           yb_display_invert(display, true) && yb_display_brightness(display, 9) &&
           yb_display_sleep(display, true) && yb_display_sleep(display, false) &&
           yb_display_tick(display) && yb_display_finish(display);
}

static void bus_failures_are_passed_on(void **state)
{
    const yb_panel_t *panel;

    (void)state;
    for (size_t i = 0; (panel = yb_panel_at(i)) != NULL; i++) {
        wire_t wire;
        yb_panel_bus_t bus = wire_connect_blind(&wire, panel);
        yb_display_t display = {.panel = panel, .bus = &bus};
        assert_true(use(&display));
        const size_t transfers = SIZE_MAX - wire.transfers_left;
        for (size_t n = 0; n < transfers; n++) {
            bus = wire_connect_blind(&wire, panel);
            wire.transfers_left = n;
            assert_false(use(&display));
        }
    }
}

static void check_late(wire_t *wire, yb_panel_bus_t *bus, yb_display_t *display)
{
    static uint8_t bands[2][MOST_BYTES / 4];
    const yb_screen_t screen = yb_display_screen(display);
    const size_t pitch = yb_screen_pitch(&screen);
    const uint16_t rows = 8;

    bus->pixels = wire_pixels_late;
    bus->finish = wire_finish;
    assert_true(yb_display_start(display));
    draw_noise(frame, frame_bytes(display), 8);
    for (uint16_t y = 0; y < screen.height; y += rows) {
        uint8_t *band = bands[y / rows % 2];
        const uint16_t left = screen.height - y;
        memcpy(band, frame + y * pitch, pitch * (rows < left ? rows : left));
        assert_true(yb_display_write_rows(display, y, rows < left ? rows : left, band));
        memset(bands[1 - y / rows % 2], POISON, pitch * rows);
    }
    assert_true(yb_display_finish(display));
    memset(bands, POISON, sizeof bands);
    assert_shown(wire, display, frame, 0);

    /* Rows one by one, and then a call that is no write. */
    draw_noise(other, frame_bytes(display), 9);
    const yb_panel_window_t window = random_window(display, other);
    assert_true(yb_display_write(display, &window));
    assert_true(yb_display_invert(display, true) && yb_display_invert(display, false) &&
                yb_display_finish(display));
    copy_window(&screen, &window, frame, other);
    memset(other, POISON, sizeof other);
    assert_shown(wire, display, frame, 0);
}

static void pixels_may_go_out_late(void **state)
{
    (void)state;
    for_each(check_late);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(start_shows_black),
        cmocka_unit_test(start_works_without_reset_and_wait),
        cmocka_unit_test(start_works_after_failures),
        cmocka_unit_test(unknown_turns_send_nothing),
        cmocka_unit_test(every_band_height_gives_the_frame),
        cmocka_unit_test(windows_change_their_pixels_alone),
        cmocka_unit_test(windows_off_the_display_send_nothing),
        cmocka_unit_test(sleep_keeps_the_picture),
        cmocka_unit_test(inverting_shows_light_for_dark),
        cmocka_unit_test(every_brightness_is_understood),
        cmocka_unit_test(ticks_keep_the_picture),
        cmocka_unit_test(ticks_alone_change_the_polarity),
        cmocka_unit_test(bus_failures_are_passed_on),
        cmocka_unit_test(pixels_may_go_out_late),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
