/* The panels' drivers against the models of the panels: what is written is what is shown, and what
 * the chip would not understand is refused. */
#include "panel.h"
#include "ssd0323_model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

typedef struct {
    yb_ssd0323_model_t model;
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
        if (!yb_ssd0323_model_byte(&wire->model, is_data, bytes[i]))
            fail_msg("the model refused: %s", wire->model.error);
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
    yb_ssd0323_model_reset(&wire->model);
    wire->resets++;
    return true;
}

static void wire_wait_ms(void *context, uint32_t ms)
{
    wire_t *wire = context;
    wire->waited_ms += ms;
    wire->on_before_wait = wire->model.on;
}

static yb_panel_bus_t connect(wire_t *wire)
{
    memset(wire, 0, sizeof *wire);
    wire->transfers_left = SIZE_MAX;
    yb_ssd0323_model_reset(&wire->model);
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

static void assert_shown(wire_t *wire, const uint8_t expected[YB_SSD0323_PICTURE_BYTES])
{
    uint8_t shown[YB_SSD0323_PICTURE_BYTES];

    if (!yb_ssd0323_model_picture(&wire->model, shown))
        fail_msg("the model has no picture: %s", wire->model.error);
    assert_memory_equal(shown, expected, sizeof shown);
}

static void init_shows_black(void **state)
{
    static const uint8_t black[YB_SSD0323_PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    assert_true(yb_display_start(&display));
    assert_true(wire.model.on);
    assert_int_equal(wire.resets, 1);
    assert_true(wire.waited_ms >= 100);
    assert_false(wire.on_before_wait);
    assert_shown(&wire, black);
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
    assert_true(wire.model.on);
}

static void every_band_height_gives_the_frame(void **state)
{
    uint8_t frame[YB_SSD0323_PICTURE_BYTES];

    (void)state;
    for (unsigned rows = 1; rows <= YB_SSD0323_HEIGHT; rows++) {
        wire_t wire;
        const yb_panel_bus_t bus = connect(&wire);
        yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};
        draw_noise(frame, sizeof frame, rows);
        assert_true(yb_display_start(&display));
        for (unsigned y = 0; y < YB_SSD0323_HEIGHT; y += rows) {
            const unsigned left = YB_SSD0323_HEIGHT - y;
            assert_true(yb_display_write_rows(&display, (uint16_t)y,
                                              (uint16_t)(rows < left ? rows : left),
                                              frame + (size_t)y * YB_SSD0323_COLUMNS));
        }
        assert_shown(&wire, frame);
    }
}

static void window_changes_its_pixels_alone(void **state)
{
    uint8_t frame[YB_SSD0323_PICTURE_BYTES] = {0};
    uint8_t other[YB_SSD0323_PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};
    const yb_panel_window_t window = {
        .x = 6,
        .y = 9,
        .width = 20,
        .rows = 5,
        .pixels = other + 9 * YB_SSD0323_COLUMNS + 3,
        .pitch_bytes = YB_SSD0323_COLUMNS,
    };

    (void)state;
    draw_noise(other, sizeof other, 7);
    assert_true(yb_display_start(&display));
    assert_true(yb_display_write(&display, &window));
    for (size_t y = 9; y < 14; y++)
        memcpy(frame + y * YB_SSD0323_COLUMNS + 3, other + y * YB_SSD0323_COLUMNS + 3, 10);
    assert_shown(&wire, frame);
}

static void high_nibble_is_the_left_pixel(void **state)
{
    static const uint8_t pixels[] = {0xF0};
    const yb_panel_window_t window = {
        .width = 2, .rows = 1, .pixels = pixels, .pitch_bytes = sizeof pixels};
    uint8_t shown[YB_SSD0323_PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    assert_true(yb_display_start(&display));
    assert_true(yb_display_write(&display, &window));
    assert_true(yb_ssd0323_model_picture(&wire.model, shown));
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
    assert_int_equal(wire.model.bytes, 0);
}

static void sleep_keeps_the_picture(void **state)
{
    static const uint8_t black[YB_SSD0323_PICTURE_BYTES];
    uint8_t frame[YB_SSD0323_PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    draw_noise(frame, sizeof frame, 3);
    assert_true(yb_display_start(&display));
    assert_true(yb_display_write_rows(&display, 0, YB_SSD0323_HEIGHT, frame));
    assert_true(yb_display_sleep(&display, true));
    assert_shown(&wire, black);
    assert_true(yb_display_sleep(&display, false));
    assert_shown(&wire, frame);
}

static void bus_failures_are_passed_on(void **state)
{
    uint8_t frame[YB_SSD0323_PICTURE_BYTES] = {0};
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
    for (size_t i = 0; yb_panel_at(i) != NULL; i++)
        assert_ptr_equal(yb_panel_find(yb_panel_at(i)->name), yb_panel_at(i));
}

/* Wire bytes as a test writes them: -1 ends, DATA marks a byte sent with D/C high. */
enum {
    DATA = 0x100
};

static void model_refuses_hostile_sequences(void **state)
{
    static const struct {
        const char *expected;
        int bytes[12];
    } hostile[] = {
        {"00h is no command", {0x00, -1}},
        {"FFh is no command", {0xFF, -1}},
        {"E2h is no command", {0xAE, 0xE2, -1}},
        {"command 15h takes", {0x15, 64, -1}},
        {"column address 64 is beyond", {0x15, 0, 64, -1}},
        {"row address 80 is beyond", {0x75, 0, 80, -1}},
        {"before it begins at 5", {0x75, 5, 4, -1}},
        {"before it begins at 9", {0x15, 9, 0, -1}},
        {"data where command 75h wants argument 2", {0x75, 0, DATA | 0, -1}},
        {"data where command A0h wants argument 1", {0xA0, DATA | 0x52, -1}},
        {"data beyond the end", {0x15, 3, 4, 0x75, 7, 7, DATA | 1, DATA | 2, DATA | 3, -1}},
        {"remap 08h", {0xA0, 0x08, -1}},
        {"remap 20h", {0xA0, 0x20, -1}},
        {"command 81h takes", {0x81, 0x80, -1}},
        {"command A8h takes", {0xA8, 14, -1}},
        {"phase length 20h", {0xB1, 0x20, -1}},
        {"command B8h takes", {0xB8, 0x08, -1}},
    };

    (void)state;
    for (size_t i = 0; i < sizeof hostile / sizeof hostile[0]; i++) {
        yb_ssd0323_model_t model;
        bool well = true;
        yb_ssd0323_model_reset(&model);
        for (const int *byte = hostile[i].bytes; *byte >= 0; byte++) {
            assert_true(well); /* refused at the last byte, not before */
            well = yb_ssd0323_model_byte(&model, (*byte & DATA) != 0, (uint8_t)*byte);
        }
        assert_false(well);
        if (strstr(model.error, hostile[i].expected) == NULL)
            fail_msg("\"%s\" does not say \"%s\"", model.error, hostile[i].expected);
        assert_false(yb_ssd0323_model_byte(&model, false, 0xE3));
    }
}

static void model_refuses_a_wrong_set_up(void **state)
{
    static const struct {
        const char *expected;
        uint8_t bytes[3];
    } wrong[] = {
        {"turns or tears", {0xA0, 0x42, 0xE3}},  {"turns or tears", {0xA0, 0x53, 0xE3}},
        {"shifts the picture", {0xA2, 0, 0xE3}}, {"rows are driven", {0xA8, 79, 0xE3}},
        {"still wants 1", {0x75, 0, 0}},
    };

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        uint8_t shown[YB_SSD0323_PICTURE_BYTES];
        wire_t wire;
        const yb_panel_bus_t bus = connect(&wire);
        yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};
        const size_t count = wrong[i].bytes[0] == 0x75 ? 2 : 3;
        assert_true(yb_display_start(&display));
        assert_true(wire_command(&wire, wrong[i].bytes, count));
        assert_false(yb_ssd0323_model_picture(&wire.model, shown));
        if (strstr(wire.model.error, wrong[i].expected) == NULL)
            fail_msg("\"%s\" does not say \"%s\"", wire.model.error, wrong[i].expected);
    }
}

/* The settings that our driver does not use must be right all the same, or the model would not
 * notice a driver that used them. */
static void model_follows_modes_and_start_line(void **state)
{
    uint8_t frame[YB_SSD0323_PICTURE_BYTES];
    uint8_t shown[YB_SSD0323_PICTURE_BYTES];
    wire_t wire;
    const yb_panel_bus_t bus = connect(&wire);
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = &bus};

    (void)state;
    draw_noise(frame, sizeof frame, 11);
    assert_true(yb_display_start(&display));
    assert_true(yb_display_write_rows(&display, 0, YB_SSD0323_HEIGHT, frame));

    assert_true(wire_command(&wire, (const uint8_t[]){0xA7}, 1));
    assert_true(yb_ssd0323_model_picture(&wire.model, shown));
    assert_int_equal(shown[100], (uint8_t)~frame[100]);
    assert_true(wire_command(&wire, (const uint8_t[]){0xA5}, 1));
    assert_true(yb_ssd0323_model_picture(&wire.model, shown));
    assert_int_equal(shown[100], 0xFF);
    assert_true(wire_command(&wire, (const uint8_t[]){0xA6}, 1));
    assert_true(yb_ssd0323_model_picture(&wire.model, shown));
    assert_int_equal(shown[100], 0x00);

    assert_true(wire_command(&wire, (const uint8_t[]){0xA4, 0xA1, 3, 0xA0, 0x50}, 5));
    assert_true(yb_ssd0323_model_picture(&wire.model, shown));
    const uint8_t byte = frame[3 * YB_SSD0323_COLUMNS + 5];
    assert_int_equal(shown[5], (uint8_t)(byte << 4 | byte >> 4));

    /* Vertical addressing: the second byte lies below the first one. */
    assert_true(wire_command(&wire, (const uint8_t[]){0xA1, 0, 0xA0, 0x56}, 4));
    assert_true(wire_command(&wire, (const uint8_t[]){0x15, 0, 1, 0x75, 0, 1}, 6));
    assert_true(wire_data(&wire, (const uint8_t[]){1, 2, 3, 4}, 4));
    assert_true(yb_ssd0323_model_picture(&wire.model, shown));
    assert_int_equal(shown[0], 1);
    assert_int_equal(shown[YB_SSD0323_COLUMNS], 2);
    assert_int_equal(shown[1], 3);
    assert_int_equal(shown[YB_SSD0323_COLUMNS + 1], 4);
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
        cmocka_unit_test(model_refuses_hostile_sequences),
        cmocka_unit_test(model_refuses_a_wrong_set_up),
        cmocka_unit_test(model_follows_modes_and_start_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
