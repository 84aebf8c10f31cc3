/* Models of the chips that speak the MIPI Display Command Set: ST7735, ST7789, ILI9341, GC9A01. */
#include "model_script.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const uint32_t rgb[MARKS] = {0x000000, 0xFF0000, 0x00FF00, 0x0000FF, 0xFFFFFF};
static const uint16_t pixels[MARKS] = {0x0000, 0xF800, 0x07E0, 0x001F, 0xFFFF};

static void set_window(yb_panel_model_t *model, unsigned x, unsigned y, unsigned width,
                       unsigned height)
{
    const int script[] = {0x2A, D16((int)x), D16((int)(x + width) - 1),
                          0x2B, D16((int)y), D16((int)(y + height) - 1),
                          0x2C, END};
    play(model, script);
}

static void put_pixel(yb_panel_model_t *model, unsigned pixel)
{
    assert_true(yb_panel_model_byte(model, true, (uint8_t)(pixel >> 8)));
    assert_true(yb_panel_model_byte(model, true, (uint8_t)pixel));
}

static void fill(yb_panel_model_t *model, unsigned x, unsigned y, unsigned width, unsigned height,
                 unsigned pixel)
{
    set_window(model, x, y, width, height);
    for (unsigned i = 0; i < width * height; i++)
        put_pixel(model, pixel);
}

/* Each glass in each turn: what MADCTL must be, where the picture's top left pixel is addressed,
 * and its size. */
static const struct {
    const char *name;
    uint8_t madctl;
    uint8_t inversion; /* 20h or 21h */
    uint8_t turn;
    uint16_t x, y, width, height;
} turns[] = {
    {"st7735", 0xC8, 0x20, 0, 2, 1, 128, 160},
    {"st7735", 0xA8, 0x20, 1, 1, 2, 160, 128},
    {"st7735", 0x08, 0x20, 2, 2, 1, 128, 160},
    {"st7735", 0x68, 0x20, 3, 1, 2, 160, 128},
    {"st7735-80x160", 0xC8, 0x21, 0, 26, 1, 80, 160},
    {"st7735-80x160", 0xA8, 0x21, 1, 1, 26, 160, 80},
    {"st7735-80x160", 0x08, 0x21, 2, 26, 1, 80, 160},
    {"st7735-80x160", 0x68, 0x21, 3, 1, 26, 160, 80},
    {"st7735-128x128", 0xC8, 0x20, 0, 2, 3, 128, 128},
    {"st7735-128x128", 0xA8, 0x20, 1, 3, 2, 128, 128},
    {"st7735-128x128", 0x08, 0x20, 2, 2, 1, 128, 128},
    {"st7735-128x128", 0x68, 0x20, 3, 1, 2, 128, 128},
    {"st7789", 0x00, 0x21, 0, 0, 0, 240, 240},
    {"st7789", 0x60, 0x21, 1, 0, 0, 240, 240},
    {"st7789", 0xC0, 0x21, 2, 0, 80, 240, 240},
    {"st7789", 0xA0, 0x21, 3, 80, 0, 240, 240},
    {"st7789-240x320", 0x00, 0x21, 0, 0, 0, 240, 320},
    {"st7789-240x320", 0x60, 0x21, 1, 0, 0, 320, 240},
    {"st7789-240x320", 0xC0, 0x21, 2, 0, 0, 240, 320},
    {"st7789-240x320", 0xA0, 0x21, 3, 0, 0, 320, 240},
    {"st7789-135x240", 0x00, 0x21, 0, 52, 40, 135, 240},
    {"st7789-135x240", 0x60, 0x21, 1, 40, 53, 240, 135},
    {"st7789-135x240", 0xC0, 0x21, 2, 53, 40, 135, 240},
    {"st7789-135x240", 0xA0, 0x21, 3, 40, 52, 240, 135},
    {"ili9341", 0x48, 0x20, 0, 0, 0, 240, 320},
    {"ili9341", 0x28, 0x20, 1, 0, 0, 320, 240},
    {"ili9341", 0x88, 0x20, 2, 0, 0, 240, 320},
    {"ili9341", 0xE8, 0x20, 3, 0, 0, 320, 240},
    {"gc9a01", 0x08, 0x21, 0, 0, 0, 240, 240},
    {"gc9a01", 0x68, 0x21, 1, 0, 0, 240, 240},
    {"gc9a01", 0xC8, 0x21, 2, 0, 0, 240, 240},
    {"gc9a01", 0xA8, 0x21, 3, 0, 0, 240, 240},
};

/* Up to the point where pixels may come. */
static yb_panel_model_t *start(size_t turn)
{
    yb_panel_model_t *model = new_model(turns[turn].name);
    const int script[] = {
        RESET, 0x11, 0x3A, D(0x55), 0x36, D(turns[turn].madctl), turns[turn].inversion, 0x29, END};

    play(model, script);
    if (turns[turn].name[0] == 'g')
        play(model, (const int[]){0xB6, D(0x00), D(0x20), END});
    return model;
}

static void every_turn_shows_its_corners(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(turns); i++) {
        yb_panel_model_t *model = start(i);
        const unsigned width = turns[i].width;
        const unsigned height = turns[i].height;

        set_window(model, turns[i].x, turns[i].y, width, height);
        for (unsigned y = 0; y < height; y++) {
            for (unsigned x = 0; x < width; x++)
                put_pixel(model, pixels[mark_at(x, y, width, height)]);
        }
        assert_marks(model, turns[i].turn, rgb);
        yb_panel_model_free(model);
    }
}

/* Every glass, unturned. */
static void states_are_seen(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(turns); i += 4) {
        yb_panel_model_t *model = start(i);
        const int right = turns[i].inversion;
        const int wrong = right ^ 1;

        fill(model, turns[i].x, turns[i].y, turns[i].width, turns[i].height, 0x8C31);
        assert_all(model, 0x8C868C); /* 10001 100001 10001, bits repeated from the top */
        play(model, (const int[]){wrong, END});
        assert_all(model, 0x737973);
        play(model, (const int[]){right, 0x39, END});
        assert_all(model, 0xFFFFFF);
        play(model, (const int[]){0x38, 0x28, END});
        assert_false(yb_panel_model_lit(model));
        assert_all(model, 0x000000);
        play(model, (const int[]){0x29, 0x10, END});
        assert_false(yb_panel_model_lit(model));
        assert_all(model, 0x000000);
        play(model, (const int[]){0x11, END});
        assert_true(yb_panel_model_lit(model));
        assert_all(model, 0x8C868C);
        play(model, (const int[]){0x01, END});
        assert_false(yb_panel_model_lit(model));
        yb_panel_model_free(model);
    }
}

static void half_windows_are_kept_in_order(void **state)
{
    yb_panel_model_t *model = start(12);

    (void)state;
    fill(model, 0, 0, 240, 240, 0x0000);
    play(model, (const int[]){0x2A, D16(5), D16(6), 0x2B, D16(9), D16(10), 0x2C, D16(0xF800), 0x3C,
                              D16(0x07E0), D16(0x001F), 0x00, 0x3C, D16(0xFFFF), END});
    assert_int_equal(shown_at(model, 5, 9), 0xFF0000);
    assert_int_equal(shown_at(model, 6, 9), 0x00FF00);
    assert_int_equal(shown_at(model, 5, 10), 0x0000FF);
    assert_int_equal(shown_at(model, 6, 10), 0xFFFFFF);
    assert_int_equal(shown_at(model, 7, 9), 0x000000);
    assert_int_equal(shown_at(model, 5, 11), 0x000000);
    yb_panel_model_free(model);
}

/* Scan direction mirrors what memory holds already. */
static void scan_direction_mirrors_the_glass(void **state)
{
    static const struct {
        size_t turn;
        int scan;
        unsigned x, y;
    } scans[] = {{24, 0x82, 0, 0}, {24, 0xA2, 239, 0}, {24, 0xC2, 0, 319}, {24, 0xE2, 239, 319},
                 {28, 0x20, 0, 0}, {28, 0x00, 239, 0}, {28, 0x60, 0, 239}};

    (void)state;
    for (size_t i = 0; i < COUNT(scans); i++) {
        yb_panel_model_t *model = start(scans[i].turn);
        fill(model, 0, 0, turns[scans[i].turn].width, turns[scans[i].turn].height, 0x0000);
        fill(model, 0, 0, 1, 1, 0xF800);
        play(model, (const int[]){0xB6, D(0x0A), D(scans[i].scan), END});
        if (turns[scans[i].turn].name[0] == 'i')
            play(model, (const int[]){D(0x27), D(0x04), END});
        assert_int_equal(shown_at(model, scans[i].x, scans[i].y), 0xFF0000);
        yb_panel_model_free(model);
    }
}

static void pauses_of_the_datasheet_are_enough(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(turns); i += 4) {
        yb_panel_model_t *model = new_model(turns[i].name);
        const int settles = strncmp(turns[i].name, "st7735", 6) == 0 ? 120 : 5;
        play(model, (const int[]){W(5), 0x01, W(settles), 0x11, W(settles), 0x00, W(120 - settles),
                                  0x10, W(5), 0x00, W(115), 0x11, W(settles), 0x01, W(120), 0x11,
                                  W(settles), 0x29, END});
        play(model, (const int[]){RESET, W(120), 0x11, W(settles), 0x29, END});
        /* No pauses are asked for where there is no time. */
        play(model, (const int[]){RESET, 0x11, 0x29, 0x10, 0x11, 0x01, 0x11, END});
        yb_panel_model_free(model);
    }
}

static void hostile_sequences_are_refused(void **state)
{
    static const int awake[] = {RESET, 0x11, 0x3A, D(0x05), END};
    static const wrong_t asleep[] = {
        {"st7789", "pixels before sleep-out", {0x3A, D(0x55), 0x2C, END}},
        {"st7789", "pixels before sleep-out", {0x11, 0x3A, D(0x55), 0x10, 0x2C, END}},
        {"st7789", "pixels before 3Ah", {0x11, 0x2C, END}},
        {"st7735", "pixels before 3Ah", {0x11, 0x3A, D(0x55), 0x01, 0x11, 0x2C, END}},
        {"st7735", "data 55h that no command asked for", {D(0x55), END}},
        {"st7789", "11h came 1000 us too soon", {W(4), 0x11, END}},
        {"ili9341", "00h came 5000 us too soon", {W(5), 0x01, 0x00, END}},
        {"gc9a01", "29h came 2000 us too soon", {W(5), 0x11, W(3), 0x29, END}},
        {"st7789", "10h came 1000 us too soon after sleep-out", {W(5), 0x11, W(119), 0x10, END}},
        {"st7789", "36h came 1000 us", {W(5), 0x11, W(120), 0x10, W(4), 0x36, END}},
        {"st7789", "11h came 1000 us", {W(5), 0x11, W(120), 0x10, W(119), 0x11, END}},
        {"st7789", "11h came 1000 us", {W(5), 0x11, W(120), 0x01, W(119), 0x11, END}},
        {"st7735", "11h came 1000 us too soon after a reset", {W(5), 0x01, W(119), 0x11, END}},
        {"st7735", "29h came 1000 us too soon after", {W(5), 0x11, W(119), 0x29, END}},
        {"st7735", "29h came 1000 us too soon after", {W(5), 0x11, W(120), 0x10, W(4), 0x29, END}},
        {"st7735", "11h came 1000 us", {0x11, RESET, W(119), 0x11, END}},
    };
    static const wrong_t wrong[] = {
        {"st7735", "3Ch is no command", {0x3C, END}},
        {"st7735", "B6h is no command", {0xB6, END}},
        {"st7735", "FFh is no command", {0xFF, END}},
        {"ili9341", "D2h is no command of", {0xB1, D(0), D(0), 0xB2, D(0), D(0), 0xD2, END}},
        {"gc9a01", "82h is no command", {0x82, END}},
        {"st7789", "22h is no command", {0x22, END}},
        {"st7789", "04h reads", {0x04, END}},
        {"st7789", "09h reads", {0x09, END}},
        {"st7789", "2Eh reads", {0x2E, END}},
        {"st7735", "DAh reads", {0xDA, END}},
        {"st7735", "33h scrolls", {0x33, END}},
        {"ili9341", "37h scrolls", {0x37, END}},
        {"st7735", "column address 132 is beyond the last one, 131", {0x2A, D16(0), D16(132), END}},
        {"st7735", "row address 162 is beyond", {0x2B, D16(0), D16(162), END}},
        {"st7735-128x128", "row address 132 is beyond", {0x2B, D16(0), D16(132), END}},
        {"st7789", "column address 240 is beyond", {0x2A, D16(0), D16(240), END}},
        {"st7789", "row address 320 is beyond", {0x2B, D16(0), D16(320), END}},
        {"gc9a01", "row address 240 is beyond", {0x2B, D16(0), D16(240), END}},
        {"st7789", "column address 320 is", {0x36, D(0x20), 0x2A, D16(0), D16(320), END}},
        {"st7789", "row address 240 is", {0x36, D(0x20), 0x2B, D16(0), D16(240), END}},
        {"st7789", "off the memory, as it is turned", {0x36, D(0x20), 0x2C, END}},
        {"st7789", "before it begins at 7", {0x2A, D16(7), D16(6), END}},
        {"st7789", "2Ah still wants 1 bytes", {0x2A, D(0), D(0), D(0), 0x2B, END}},
        {"st7789", "data 07h that no command", {0x36, D(0), D(7), END}},
        {"st7789", "data 01h that no command", {0x2C, D(0), D(0), 0x29, D(1), END}},
        {"st7789", "2Ch in the middle of a pixel", {0x2C, D(0), D(0), D(0), 0x2C, END}},
        {"st7789",
         "beyond the end",
         {0x2A, D16(3), D16(3), 0x2B, D16(319), D16(319), 0x2C, D16(0), D(0), END}},
        {"st7789", "no pixels to go on from", {0x3C, END}},
        {"st7789", "no pixels to go on from", {0x2C, D16(0), 0x2A, D16(0), D16(1), 0x3C, END}},
        {"st7789", "no pixels to go on from", {0x2C, D16(0), 0x36, D(0), 0x3C, END}},
        {"st7789", "MADCTL 01h sets bits", {0x36, D(0x01), END}},
        {"st7789", "MADCTL 02h sets bits", {0x36, D(0x02), END}},
        {"st7789", "pixel format 66h", {0x3A, D(0x66), END}},
        {"st7735", "pixel format 06h", {0x3A, D(0x06), END}},
        {"st7735", "gamma curve 03h", {0x26, D(0x03), END}},
        {"st7735", "command 26h takes 01h to 08h, not 00h", {0x26, D(0x00), END}},
        {"st7789", "C0h takes 2Ch to 2Ch, not 0Ch", {0xC0, D(0x0C), END}},
        {"st7789", "RAM control 00h F8h", {0xB0, D(0x00), D(0xF8), END}},
        {"st7789", "RAM control 10h F0h", {0xB0, D(0x10), D(0xF0), END}},
        {"ili9341", "interface 20h", {0xF6, D(0x01), D(0x00), D(0x20), END}},
        {"ili9341", "display functions 82h 1Dh", {0xB6, D(8), D(0x82), D(0x1D), D(0), END}},
        {"ili9341", "display functions 92h 27h", {0xB6, D(8), D(0x92), D(0x27), D(0), END}},
        {"ili9341", "display functions 02h 27h", {0xB6, D(8), D(0x02), D(0x27), D(0), END}},
    };

    (void)state;
    assert_refused(NULL, asleep, COUNT(asleep));
    assert_refused(awake, wrong, COUNT(wrong));
}

static void wrong_set_ups_have_no_picture(void **state)
{
    static const int lit[] = {RESET, 0x11, 0x3A, D(0x55), 0x29, END};
    static const wrong_t wrong[] = {
        {"st7735", "red and blue change places", {0x36, D(0xC0), END}},
        {"st7735-80x160", "red and blue change places", {0x36, D(0xC0), END}},
        {"st7735-128x128", "red and blue change places", {0x36, D(0xC0), END}},
        {"st7789", "red and blue change places", {0x36, D(0x08), END}},
        {"st7789-240x320", "red and blue change places", {0x36, D(0x08), END}},
        {"st7789-135x240", "red and blue change places", {0x36, D(0x08), END}},
        {"ili9341", "red and blue change places", {0x36, D(0x40), END}},
        {"gc9a01", "red and blue change places", {0xB6, D(0), D(0x20), END}},
        {"gc9a01", "B6h has not said", {0x36, D(0x08), END}},
        {"st7789", "partial mode", {0x12, END}},
        {"st7789", "2Ah still wants 3 bytes", {0x2A, D(0), END}},
        {"st7789", "half a pixel is missing", {0x2C, D(0), END}},
    };

    (void)state;
    assert_no_pictures(lit, wrong, COUNT(wrong));
}

/* The manufacturer's commands, with the arguments of the makers' own set-ups. */
static void set_ups_of_the_makers_are_taken(void **state)
{
    static const struct {
        const char *name;
        int command;
        unsigned args;
    } commands[] = {
        {"st7735", 0xB1, 3},  {"st7735", 0xB3, 6},   {"st7735", 0xC0, 3},  {"st7735", 0xC5, 1},
        {"st7735", 0xE0, 16}, {"st7735", 0xE1, 16},  {"st7789", 0xB2, 5},  {"st7789", 0xBB, 1},
        {"st7789", 0xC2, 2},  {"st7789", 0xD0, 2},   {"st7789", 0xE0, 14}, {"st7789", 0xE2, 64},
        {"ili9341", 0xCB, 5}, {"ili9341", 0xCF, 3},  {"ili9341", 0xE8, 3}, {"ili9341", 0xED, 4},
        {"ili9341", 0xB1, 2}, {"ili9341", 0xE0, 15}, {"gc9a01", 0xFE, 0},  {"gc9a01", 0xEF, 0},
        {"gc9a01", 0x8F, 1},  {"gc9a01", 0x90, 4},   {"gc9a01", 0xF0, 6},  {"gc9a01", 0x62, 12},
        {"gc9a01", 0x66, 10}, {"gc9a01", 0x70, 9},   {"gc9a01", 0x74, 7},
    };

    (void)state;
    for (size_t i = 0; i < COUNT(commands); i++) {
        yb_panel_model_t *model = new_model(commands[i].name);
        play(model, (const int[]){commands[i].command, END});
        for (unsigned n = 0; n < commands[i].args; n++)
            assert_true(yb_panel_model_byte(model, true, 0x11));
        play(model, (const int[]){0x00, 0x11, END});
        assert_false(yb_panel_model_byte(model, true, 0x11));
        yb_panel_model_free(model);
    }
}

int test_mipi_models(void)
{
    const struct CMUnitTest mipi[] = {
        cmocka_unit_test(every_turn_shows_its_corners),
        cmocka_unit_test(states_are_seen),
        cmocka_unit_test(half_windows_are_kept_in_order),
        cmocka_unit_test(scan_direction_mirrors_the_glass),
        cmocka_unit_test(pauses_of_the_datasheet_are_enough),
        cmocka_unit_test(hostile_sequences_are_refused),
        cmocka_unit_test(wrong_set_ups_have_no_picture),
        cmocka_unit_test(set_ups_of_the_makers_are_taken),
    };
    return cmocka_run_group_tests(mipi, NULL, NULL);
}
