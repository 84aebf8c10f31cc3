/* The panels' drivers against the models of the panels, every panel in every turn that its chip
 * does: what is written is what is shown, and what the chip would not understand is refused. */
#include "panel.h"
#include "panel_driver.h"
#include "panel_model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    MOST_BYTES = 2 * 240 * 320,
    POISON = 0xA5
};

/* ---- A bus with a model behind it ---------------------------------------------------------- */

typedef struct {
    const yb_panel_t *panel;
    yb_panel_model_t *model; /* NULL: bytes are only counted */
    size_t transfers_left;   /* the bus fails when they are used up */
    size_t bytes;
    unsigned resets;
    uint32_t waited_ms;
    const uint8_t *late; /* pixels still to go out */
    size_t late_count;
} wire_t;

static bool feed(wire_t *wire, bool is_data, const uint8_t *bytes, size_t count)
{
    assert_true(count > 0);
    if (wire->transfers_left == 0)
        return false;
    wire->transfers_left--;
    wire->bytes += count;
    if (wire->model == NULL)
        return true;
    bool well = yb_panel_model_select(wire->model, true);
    for (size_t i = 0; well && i < count; i++)
        well = yb_panel_model_byte(wire->model, is_data, bytes[i]);
    if (!well || !yb_panel_model_select(wire->model, false))
        fail_msg("%s: the model refused: %s", wire->panel->name, yb_panel_model_error(wire->model));
    return true;
}

static bool wire_finish(void *context)
{
    wire_t *wire = context;
    const uint8_t *late = wire->late;

    wire->late = NULL;
    return late == NULL || feed(wire, true, late, wire->late_count);
}

static bool wire_command(void *context, const uint8_t *bytes, size_t count)
{
    return wire_finish(context) && feed(context, false, bytes, count);
}

static bool wire_data(void *context, const uint8_t *bytes, size_t count)
{
    return wire_finish(context) && feed(context, true, bytes, count);
}

static bool wire_pixels_late(void *context, const uint8_t *bytes, size_t count)
{
    wire_t *wire = context;
    const bool well = wire_finish(context);

    wire->late = bytes;
    wire->late_count = count;
    return well;
}

static bool wire_reset(void *context)
{
    wire_t *wire = context;
    wire->resets++;
    if (wire->model != NULL)
        yb_panel_model_reset(wire->model);
    return wire->transfers_left > 0;
}

static void wire_wait_ms(void *context, uint32_t ms)
{
    wire_t *wire = context;
    wire->waited_ms += ms;
    if (wire->model != NULL)
        yb_panel_model_wait(wire->model, ms * 1000);
}

static yb_panel_bus_t connect_blind(wire_t *wire, const yb_panel_t *panel)
{
    *wire = (wire_t){.panel = panel, .transfers_left = SIZE_MAX};
    return (yb_panel_bus_t){
        .context = wire,
        .command = (panel->flags & YB_PANEL_NO_DC) != 0 ? NULL : wire_command,
        .data = wire_data,
        .reset = wire_reset,
        .wait_ms = wire_wait_ms,
    };
}

static yb_panel_bus_t connect(wire_t *wire, const yb_panel_t *panel)
{
    const yb_panel_bus_t bus = connect_blind(wire, panel);
    wire->model = yb_panel_model_new(panel->name);
    if (wire->model == NULL)
        fail_msg("%s: there is no model", panel->name);
    return bus;
}

static void disconnect(wire_t *wire)
{
    yb_panel_model_free(wire->model);
    wire->model = NULL;
}

/* ---- Pictures -------------------------------------------------------------------------------- */

static uint32_t noise;

static uint32_t random_below(uint32_t limit)
{
    noise = noise * 1664525U + 1013904223U;
    return (uint32_t)((uint64_t)noise * limit >> 32);
}

static void draw_noise(uint8_t *picture, size_t bytes, uint32_t seed)
{
    noise = seed;
    for (size_t i = 0; i < bytes; i++)
        picture[i] = (uint8_t)random_below(256);
}

static size_t frame_bytes(const yb_display_t *display)
{
    const yb_screen_t screen = yb_display_screen(display);
    return yb_screen_pitch(&screen) * screen.height;
}

static void pixel_rgb(const yb_screen_t *screen, const uint8_t *frame, unsigned x, unsigned y,
                      uint8_t rgb[3])
{
    const uint8_t *row = frame + y * yb_screen_pitch(screen);

    if (screen->format == YB_RGB565) {
        const unsigned colour = (unsigned)row[2 * x] << 8 | row[2 * x + 1];
        const unsigned red = colour >> 11;
        const unsigned green = colour >> 5 & 63;
        const unsigned blue = colour & 31;
        rgb[0] = (uint8_t)(red << 3 | red >> 2);
        rgb[1] = (uint8_t)(green << 2 | green >> 4);
        rgb[2] = (uint8_t)(blue << 3 | blue >> 2);
    } else {
        const unsigned level = screen->format == YB_GREY4
                                   ? (x % 2 == 0 ? row[x / 2] >> 4 : row[x / 2] & 15) * 17U
                                   : (row[x / 8] >> (7 - x % 8) & 1) * 255U;
        rgb[0] = rgb[1] = rgb[2] = (uint8_t)level;
    }
}

/* Where on the unturned glass the turned picture's pixel is. */
static size_t place_on_glass(const yb_display_t *display, unsigned x, unsigned y)
{
    const unsigned width = display->panel->screen.width;
    const unsigned height = display->panel->screen.height;
    switch (display->turn) {
    case YB_TURN_90:
        return (size_t)x * width + (width - 1 - y);
    case YB_TURN_180:
        return (size_t)(height - 1 - y) * width + (width - 1 - x);
    case YB_TURN_270:
        return (size_t)(height - 1 - x) * width + y;
    default:
        return (size_t)y * width + x;
    }
}

/* That the glass shows the frame, light for dark if `flip` is 0xFF. */
static void assert_shown(wire_t *wire, const yb_display_t *display, const uint8_t *frame,
                         uint8_t flip)
{
    const yb_screen_t screen = yb_display_screen(display);
    yb_model_picture_t picture;

    if (!yb_panel_model_picture(wire->model, &picture))
        fail_msg("%s: the model has no picture: %s", wire->panel->name,
                 yb_panel_model_error(wire->model));
    assert_int_equal(picture.width, display->panel->screen.width);
    assert_int_equal(picture.height, display->panel->screen.height);
    for (unsigned y = 0; y < screen.height; y++) {
        for (unsigned x = 0; x < screen.width; x++) {
            const uint8_t *shown = picture.rgb + 3 * place_on_glass(display, x, y);
            uint8_t rgb[3];
            pixel_rgb(&screen, frame, x, y, rgb);
            for (int i = 0; i < 3; i++)
                rgb[i] ^= flip;
            if (memcmp(shown, rgb, 3) != 0)
                fail_msg("%s, turn %d, pixel %u, %u: shows %02X%02X%02X, not %02X%02X%02X",
                         wire->panel->name, (int)display->turn, x, y, shown[0], shown[1], shown[2],
                         rgb[0], rgb[1], rgb[2]);
        }
    }
}

static bool is_memory_lcd(const yb_panel_t *panel)
{
    return panel->driver->sleep == NULL;
}

/* What a display shows when it has started. */
static void blank(const yb_display_t *display, uint8_t *frame)
{
    memset(frame, is_memory_lcd(display->panel) ? 0xFF : 0, frame_bytes(display));
}

/* ---- Every panel, every turn ------------------------------------------------------------------
 */

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
            yb_panel_bus_t bus = connect(&wire, panel);
            yb_display_t display = {.panel = panel, .bus = &bus, .turn = (yb_turn_t)turn};
            body(&wire, &bus, &display);
            disconnect(&wire);
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
            const yb_panel_bus_t bus = connect_blind(&wire, panel);
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
    (void)bus;
    draw_noise(frame, frame_bytes(display), 6);
    assert_true(yb_display_start(display));
    assert_true(yb_display_write_rows(display, 0, yb_display_screen(display).height, frame));
    const size_t before = wire->bytes;
    for (int i = 0; i < 5; i++) {
        wire_wait_ms(wire, display->panel->tick_ms);
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
        yb_panel_bus_t bus = connect_blind(&wire, panel);
        yb_display_t display = {.panel = panel, .bus = &bus};
        assert_true(use(&display));
        const size_t transfers = SIZE_MAX - wire.transfers_left;
        for (size_t n = 0; n < transfers; n++) {
            bus = connect_blind(&wire, panel);
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

/* ---- Descriptions ------------------------------------------------------------------------------
 */

static void panels_are_found_by_name(void **state)
{
    const yb_panel_t *panel;
    size_t count = 0;

    (void)state;
    assert_ptr_equal(yb_panel_find("ssd0323"), &yb_panel_ssd0323);
    assert_ptr_equal(yb_panel_find("st7789-135x240"), &yb_panel_st7789_135x240);
    assert_null(yb_panel_find("ssd032"));
    assert_null(yb_panel_find("ssd03233"));
    assert_null(yb_panel_find("SSD0323"));
    assert_null(yb_panel_find(""));
    for (; (panel = yb_panel_at(count)) != NULL; count++)
        assert_ptr_equal(yb_panel_find(panel->name), panel);
    assert_int_equal(count, 16);
    assert_null(yb_panel_at(count));
    assert_null(yb_panel_at(SIZE_MAX));
}

static void every_panel_has_a_model(void **state)
{
    const char *name;
    size_t count = 0;

    (void)state;
    for (; (name = yb_panel_model_name(count)) != NULL; count++)
        assert_non_null(yb_panel_find(name));
    assert_null(yb_panel_at(count));
}

static void descriptions_fit_together(void **state)
{
    const yb_panel_t *panel;

    (void)state;
    for (size_t i = 0; (panel = yb_panel_at(i)) != NULL; i++) {
        assert_true(panel->ram_x + panel->screen.width <= panel->ram_width);
        assert_true(panel->ram_y + panel->screen.height <= panel->ram_height);
        assert_int_equal(panel->screen.width % panel->x_step, 0);
        assert_int_equal(panel->screen.height % panel->y_step, 0);
        assert_true(panel->x_step > 0 &&
                    bits_of(&panel->screen, panel->x_step) * panel->y_step % 8 == 0);
        assert_true(panel->spi_hz >= 1000000);
        size_t at = 0;
        while (at < panel->setup_bytes) {
            const uint8_t head = panel->setup[at];
            at += 2U + (head & (YB_SETUP_WAIT - 1U)) + ((head & YB_SETUP_WAIT) != 0);
        }
        assert_int_equal(at, panel->setup_bytes);
    }
}

/* A number as the page writes it: 153,611. */
static void write_number(char text[16], uint32_t number)
{
    if (number < 1000)
        (void)snprintf(text, 16, "%u", (unsigned)number);
    else
        (void)snprintf(text, 16, "%u,%03u", (unsigned)(number / 1000), (unsigned)(number % 1000));
}

/* The table of docs/PANELS.md has a row for each panel, with its figures. */
static void the_page_knows_every_panel(void **state)
{
    const yb_panel_t *panel;

    (void)state;
    for (size_t i = 0; (panel = yb_panel_at(i)) != NULL; i++) {
        const uint32_t bytes = yb_panel_frame_bytes(panel);
        char name[32];
        char size[32];
        char costs[64];
        char number[2][16];
        char line[512] = "";
        FILE *page = fopen(YB_PAGE, "r");
        assert_non_null(page);
        (void)snprintf(name, sizeof name, "| `%s` |", panel->name);
        while (strncmp(line, name, strlen(name)) != 0)
            if (fgets(line, sizeof line, page) == NULL)
                fail_msg("the page has no row for %s", panel->name);
        (void)fclose(page);
        (void)snprintf(size, sizeof size, "| %u x %u |", panel->screen.width, panel->screen.height);
        write_number(number[0], bytes);
        write_number(number[1], panel->spi_hz / (8 * bytes));
        (void)snprintf(costs, sizeof costs, " MHz | %s | %s |", number[0], number[1]);
        if (strstr(line, size) == NULL || strstr(line, costs) == NULL)
            fail_msg("the page's row for %s wants \"%s\" and \"%s\"", panel->name, size, costs);
        assert_int_equal(strstr(line, "| all |") != NULL, panel->turns == 0x0F);
        assert_int_equal(strstr(line, "| 0, 180 |") != NULL, panel->turns == 0x05);
    }
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
        cmocka_unit_test(panels_are_found_by_name),
        cmocka_unit_test(every_panel_has_a_model),
        cmocka_unit_test(descriptions_fit_together),
        cmocka_unit_test(the_page_knows_every_panel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
