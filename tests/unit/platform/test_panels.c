/* The panels' drivers against the models of the panels: what is written is what is shown. */
#include "panel.h"
#include "panel_model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    WIDTH = 128,
    HEIGHT = 64,
    ROW_BYTES = WIDTH / 2,
    PICTURE_BYTES = ROW_BYTES * HEIGHT,
};

/* One for the wire of the day; each test connects anew. */
static yb_panel_model_t *model;

typedef struct {
    size_t transfers_left; /* the bus fails when they are used up */
    unsigned resets;
    uint32_t waited_ms;
    bool on_before_wait;
} wire_t;

static bool feed(wire_t *wire, bool is_data, const uint8_t *bytes, size_t count)
{
    if (wire->transfers_left == 0)
        return false;
    wire->transfers_left--;
    for (size_t i = 0; i < count; i++) {
        if (!yb_panel_model_byte(model, is_data, bytes[i]))
            fail_msg("the model refused: %s", yb_panel_model_error(model));
    }
    return true;
}

static bool wire_command(void *context, const uint8_t *bytes, size_t count)
{
    return feed(context, false, bytes, count);
}

static bool wire_data(void *context, const uint8_t *bytes, size_t count)
{
    return feed(context, true, bytes, count);
}

static bool wire_reset(void *context)
{
    wire_t *wire = context;
    yb_panel_model_reset(model);
    wire->resets++;
    return true;
}

static void wire_wait_ms(void *context, uint32_t ms)
{
    wire_t *wire = context;
    wire->waited_ms += ms;
    wire->on_before_wait = yb_panel_model_lit(model);
}

static yb_panel_bus_t connect(wire_t *wire)
{
    memset(wire, 0, sizeof *wire);
    wire->transfers_left = SIZE_MAX;
    yb_panel_model_free(model);
    model = yb_panel_model_new("ssd0323");
    assert_non_null(model);
    return (yb_panel_bus_t){.context = wire,
                            .command = wire_command,
                            .data = wire_data,
                            .reset = wire_reset,
                            .wait_ms = wire_wait_ms};
}

static void draw_noise(uint8_t *picture, size_t bytes, uint32_t seed)
{
    for (size_t i = 0; i < bytes; i++) {
        seed = seed * 1664525U + 1013904223U;
        picture[i] = (uint8_t)(seed >> 24);
    }
}

/* Two pixels a byte, the high nibble left, as the display takes them. */
static void picture_of(uint8_t shown[PICTURE_BYTES])
{
    yb_model_picture_t picture;

    if (!yb_panel_model_picture(model, &picture))
        fail_msg("the model has no picture: %s", yb_panel_model_error(model));
    assert_int_equal(picture.width, WIDTH);
    assert_int_equal(picture.height, HEIGHT);
    for (size_t i = 0; i < PICTURE_BYTES; i++)
        shown[i] = (uint8_t)(picture.rgb[6 * i] / 17 << 4 | picture.rgb[6 * i + 3] / 17);
}

static void assert_shown(const uint8_t expected[PICTURE_BYTES])
{
    uint8_t shown[PICTURE_BYTES];

    picture_of(shown);
    assert_memory_equal(shown, expected, sizeof shown);
}

static void init_shows_black(void **state)
{
    static const uint8_t black[PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    assert_true(yb_display_start(&display));
    assert_true(yb_panel_model_lit(model));
    assert_int_equal(wire.resets, 1);
    assert_true(wire.waited_ms >= 100);
    assert_false(wire.on_before_wait);
    assert_shown(black);
}

static void init_works_without_reset_and_wait(void **state)
{
    wire_t wire;
    yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    bus.reset = NULL;
    bus.wait_ms = NULL;
    assert_true(yb_display_start(&display));
    assert_true(yb_panel_model_lit(model));
}

static void every_band_height_gives_the_frame(void **state)
{
    uint8_t frame[PICTURE_BYTES];

    (void)state;
    for (unsigned rows = 1; rows <= HEIGHT; rows++) {
        wire_t wire;
        const yb_panel_bus_t bus = connect(&wire);
        yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};
        draw_noise(frame, sizeof frame, rows);
        assert_true(yb_display_start(&display));
        for (unsigned y = 0; y < HEIGHT; y += rows) {
            const unsigned left = HEIGHT - y;
            assert_true(yb_display_write_rows(&display, (uint16_t)y,
                                              (uint16_t)(rows < left ? rows : left),
                                              frame + (size_t)y * ROW_BYTES));
        }
        assert_shown(frame);
    }
}

static void window_changes_its_pixels_alone(void **state)
{
    uint8_t frame[PICTURE_BYTES] = {0};
    uint8_t other[PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};
    const yb_panel_window_t window = {
        .x = 6,
        .y = 9,
        .width = 20,
        .rows = 5,
        .pixels = other + 9 * ROW_BYTES + 3,
        .pitch_bytes = ROW_BYTES,
    };

    (void)state;
    draw_noise(other, sizeof other, 7);
    assert_true(yb_display_start(&display));
    assert_true(yb_display_write(&display, &window));
    for (size_t y = 9; y < 14; y++)
        memcpy(frame + y * ROW_BYTES + 3, other + y * ROW_BYTES + 3, 10);
    assert_shown(frame);
}

static void high_nibble_is_the_left_pixel(void **state)
{
    static const uint8_t pixels[] = {0xF0};
    const yb_panel_window_t window = {
        .width = 2, .rows = 1, .pixels = pixels, .pitch_bytes = sizeof pixels};
    uint8_t shown[PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    assert_true(yb_display_start(&display));
    assert_true(yb_display_write(&display, &window));
    picture_of(shown);
    assert_int_equal(shown[0], 0xF0);
    assert_int_equal(shown[1], 0x00);
}

static void windows_off_the_display_send_nothing(void **state)
{
    static const yb_panel_window_t off[] = {
        {.x = 0, .y = 0, .width = 0, .rows = 1},    {.x = 0, .y = 0, .width = 2, .rows = 0},
        {.x = 1, .y = 0, .width = 2, .rows = 1},    {.x = 0, .y = 0, .width = 3, .rows = 1},
        {.x = 128, .y = 0, .width = 2, .rows = 1},  {.x = 0, .y = 0, .width = 130, .rows = 1},
        {.x = 126, .y = 0, .width = 4, .rows = 1},  {.x = 0, .y = 64, .width = 2, .rows = 1},
        {.x = 0, .y = 1, .width = 2, .rows = 64},   {.x = 65534, .y = 0, .width = 4, .rows = 1},
        {.x = 0, .y = 65535, .width = 2, .rows = 2}};
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    for (size_t i = 0; i < sizeof off / sizeof off[0]; i++)
        assert_false(yb_display_write(&display, &off[i]));
    assert_int_equal(yb_panel_model_bytes(model), 0);
}

static void sleep_keeps_the_picture(void **state)
{
    static const uint8_t black[PICTURE_BYTES];
    uint8_t frame[PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    draw_noise(frame, sizeof frame, 3);
    assert_true(yb_display_start(&display));
    assert_true(yb_display_write_rows(&display, 0, HEIGHT, frame));
    assert_true(yb_display_sleep(&display, true));
    assert_shown(black);
    assert_true(yb_display_sleep(&display, false));
    assert_shown(frame);
}

static void bus_failures_are_passed_on(void **state)
{
    uint8_t frame[PICTURE_BYTES] = {0};
    size_t transfers;
    wire_t wire;
    yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    assert_true(yb_display_start(&display));
    assert_true(yb_display_write_rows(&display, 0, 8, frame));
    transfers = SIZE_MAX - wire.transfers_left;
    for (size_t n = 0; n < transfers; n++) {
        bus = connect(&wire);
        wire.transfers_left = n;
        assert_false(yb_display_start(&display) && yb_display_write_rows(&display, 0, 8, frame));
    }
}

static void panels_are_found_by_name(void **state)
{
    (void)state;
    assert_ptr_equal(yb_panel_find("ssd0323"), &yb_panel_ssd0323);
    assert_null(yb_panel_find("ssd032"));
    assert_null(yb_panel_find("ssd03233"));
    assert_null(yb_panel_find(""));
    assert_ptr_equal(yb_panel_at(0), &yb_panel_ssd0323);
    assert_null(yb_panel_at(1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(init_shows_black),
        cmocka_unit_test(init_works_without_reset_and_wait),
        cmocka_unit_test(every_band_height_gives_the_frame),
        cmocka_unit_test(window_changes_its_pixels_alone),
        cmocka_unit_test(high_nibble_is_the_left_pixel),
        cmocka_unit_test(windows_off_the_display_send_nothing),
        cmocka_unit_test(sleep_keeps_the_picture),
        cmocka_unit_test(bus_failures_are_passed_on),
        cmocka_unit_test(panels_are_found_by_name),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);

    yb_panel_model_free(model);
    return failed;
}
