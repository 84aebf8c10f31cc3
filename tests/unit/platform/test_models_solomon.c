/* Models of Solomon's chips: SSD0323, SSD1306, SSD1351. */
#include "model_script.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* ---- SSD0323 --------------------------------------------------------------------------------- */

static const int ssd0323_unturned[] = {RESET, 0xA8, 63, 0xA1, 0, 0xA2, 76, 0xA0, 0x52, 0xAF, END};
static const int ssd0323_turned[] = {RESET, 0xA8, 63, 0xA1, 0, 0xA2, 68, 0xA0, 0x41, 0xAF, END};

static void ssd0323_fill(yb_panel_model_t *model, uint8_t byte)
{
    play(model, (const int[]){0x15, 0, 63, 0x75, 0, 79, END});
    for (int i = 0; i < 64 * 80; i++)
        assert_true(yb_panel_model_byte(model, true, byte));
}

static void ssd0323_shows_its_corners(void **state)
{
    static const uint8_t levels[MARKS] = {0, 3, 7, 11, 15};
    static const uint32_t rgb[MARKS] = {0x000000, 0x333333, 0x777777, 0xBBBBBB, 0xFFFFFF};

    (void)state;
    for (unsigned turn = 0; turn < 4; turn += 2) {
        yb_panel_model_t *model = new_model("ssd0323");
        play(model, turn == 0 ? ssd0323_unturned : ssd0323_turned);
        play(model, (const int[]){0x15, 0, 63, 0x75, 0, 63, END});
        for (unsigned y = 0; y < 64; y++) {
            for (unsigned x = 0; x < 128; x += 2) {
                const int byte =
                    levels[mark_at(x, y, 128, 64)] << 4 | levels[mark_at(x + 1, y, 128, 64)];
                assert_true(yb_panel_model_byte(model, true, (uint8_t)byte));
            }
        }
        assert_marks(model, turn, rgb);
        yb_panel_model_free(model);
    }
}

/* Settings that a driver may not use must be right all the same, or the model would not notice a
 * driver that used them. */
static void ssd0323_follows_its_settings(void **state)
{
    yb_panel_model_t *model = new_model("ssd0323");

    (void)state;
    play(model, ssd0323_unturned);
    ssd0323_fill(model, 0x22);
    assert_all(model, 0x222222);
    play(model, (const int[]){0xA7, END});
    assert_all(model, 0xDDDDDD);
    play(model, (const int[]){0xA5, END});
    assert_all(model, 0xFFFFFF);
    play(model, (const int[]){0xA6, END});
    assert_all(model, 0x000000);
    play(model, (const int[]){0xA4, 0xAE, END});
    assert_all(model, 0x000000);
    assert_false(yb_panel_model_lit(model));
    play(model, (const int[]){0xAF, 0x15, 5, 5, 0x75, 3, 3, D(0x1F), END});
    assert_true(yb_panel_model_lit(model));
    assert_int_equal(shown_at(model, 10, 3), 0x111111);
    assert_int_equal(shown_at(model, 11, 3), 0xFFFFFF);
    play(model, (const int[]){0xA0, 0x50, END}); /* the low nibble is the left pixel */
    assert_int_equal(shown_at(model, 10, 3), 0xFFFFFF);
    play(model, (const int[]){0xA1, 3, END});
    assert_int_equal(shown_at(model, 11, 0), 0x111111);
    play(model, (const int[]){0xA1, 78, END}); /* the memory is a ring of 80 rows */
    assert_int_equal(shown_at(model, 11, 5), 0x111111);

    /* Vertical addressing: the second byte lies below the first one. */
    play(model, (const int[]){0xA1, 0, 0xA0, 0x56, 0x15, 0, 1, 0x75, 0, 1, D(0x10), D(0x20),
                              D(0x30), D(0x40), END});
    assert_int_equal(shown_at(model, 0, 0), 0x111111);
    assert_int_equal(shown_at(model, 0, 1), 0x222222);
    assert_int_equal(shown_at(model, 2, 0), 0x333333);
    assert_int_equal(shown_at(model, 2, 1), 0x444444);
    yb_panel_model_free(model);
}

static void ssd0323_refuses_hostile_sequences(void **state)
{
    static const wrong_t wrong[] = {
        {"ssd0323", "00h is no command", {0x00, END}},
        {"ssd0323", "FFh is no command", {0xFF, END}},
        {"ssd0323", "E2h is no command", {0xAE, 0xE2, END}},
        {"ssd0323", "command 15h takes 00h to 3Fh, not 40h", {0x15, 64, END}},
        {"ssd0323", "column address 64 is beyond", {0x15, 0, 64, END}},
        {"ssd0323", "row address 80 is beyond", {0x75, 0, 80, END}},
        {"ssd0323", "before it begins at 5", {0x75, 5, 4, END}},
        {"ssd0323", "before it begins at 9", {0x15, 9, 0, END}},
        {"ssd0323", "data where command 75h wants argument 2 of 2", {0x75, 0, D(0), END}},
        {"ssd0323", "data where command A0h wants argument 1 of 1", {0xA0, D(0x52), END}},
        {"ssd0323", "data beyond the end", {0x15, 3, 4, 0x75, 7, 7, D(1), D(2), D(3), END}},
        {"ssd0323", "remap 08h", {0xA0, 0x08, END}},
        {"ssd0323", "remap 20h", {0xA0, 0x20, END}},
        {"ssd0323", "command 81h takes", {0x81, 0x80, END}},
        {"ssd0323", "command A8h takes", {0xA8, 14, END}},
        {"ssd0323", "phase length 20h", {0xB1, 0x20, END}},
        {"ssd0323", "command B8h takes", {0xB8, 0x08, END}},
    };
    static const wrong_t set_ups[] = {
        {"ssd0323", "remap 42h mirrors", {0xA0, 0x42, END}},
        {"ssd0323", "remap 53h mirrors", {0xA0, 0x53, END}},
        {"ssd0323", "remap 12h tears", {0xA0, 0x12, END}},
        {"ssd0323", "offset 0 shifts the picture: the glass begins at 76", {0xA2, 0, END}},
        {"ssd0323", "offset 76 shifts the picture: the glass begins at 68", {0xA0, 0x41, END}},
        {"ssd0323", "80 rows are driven, and the glass has 64", {0xA8, 79, END}},
        {"ssd0323", "command 75h still wants 1 bytes", {0x75, 0, END}},
    };

    (void)state;
    assert_refused(NULL, wrong, COUNT(wrong));
    assert_no_pictures(ssd0323_unturned, set_ups, COUNT(set_ups));
}

/* ---- SSD1306 --------------------------------------------------------------------------------- */

static const int ssd1306_unturned[] = {RESET, 0xA8, 63,   0xDA, 0x12, 0xA1, 0xC8,
                                       0x20,  0,    0x8D, 0x14, 0xAF, END};
static const int ssd1306_flat[] = {RESET, 0xA8, 31,   0xDA, 0x02, 0xA1, 0xC8,
                                   0x20,  0,    0x8D, 0x14, 0xAF, END};

static void ssd1306_fill(yb_panel_model_t *model, uint8_t byte)
{
    play(model, (const int[]){0x21, 0, 127, 0x22, 0, 7, END});
    for (int i = 0; i < 128 * 8; i++)
        assert_true(yb_panel_model_byte(model, true, byte));
}

static void ssd1306_shows_its_corners(void **state)
{
    static const uint32_t rgb[MARKS] = {0x000000, 0xFFFFFF, 0xFFFFFF, 0xFFFFFF, 0x000000};
    static const struct {
        const char *name;
        const int *set_up;
        unsigned turn, height;
        int remap, scan;
    } turns[] = {{"ssd1306", ssd1306_unturned, 0, 64, 0xA1, 0xC8},
                 {"ssd1306", ssd1306_unturned, 2, 64, 0xA0, 0xC0},
                 {"ssd1306-128x32", ssd1306_flat, 0, 32, 0xA1, 0xC8},
                 {"ssd1306-128x32", ssd1306_flat, 2, 32, 0xA0, 0xC0}};

    (void)state;
    for (size_t i = 0; i < COUNT(turns); i++) {
        yb_panel_model_t *model = new_model(turns[i].name);
        const unsigned height = turns[i].height;

        play(model, turns[i].set_up);
        play(model, (const int[]){turns[i].remap, turns[i].scan, 0x21, 0, 127, 0x22, 0,
                                  (int)height / 8 - 1, END});
        for (unsigned y = 0; y < height; y += 8) {
            for (unsigned x = 0; x < 128; x++) {
                unsigned byte = 0;
                for (unsigned bit = 0; bit < 8; bit++) /* the lowest is the top one */
                    byte |= (unsigned)(rgb[mark_at(x, y + bit, 128, height)] != 0) << bit;
                assert_true(yb_panel_model_byte(model, true, (uint8_t)byte));
            }
        }
        assert_marks(model, turns[i].turn, rgb);
        yb_panel_model_free(model);
    }
}

static void ssd1306_follows_its_settings(void **state)
{
    yb_panel_model_t *model = new_model("ssd1306");

    (void)state;
    play(model, ssd1306_unturned);
    ssd1306_fill(model, 0x00);
    assert_all(model, 0x000000);
    play(model, (const int[]){0xA7, END});
    assert_all(model, 0xFFFFFF);
    play(model, (const int[]){0xA6, 0xA5, END});
    assert_all(model, 0xFFFFFF);
    play(model,
         (const int[]){0xA4, 0x21, 7, 8, 0x22, 1, 2, D(0x01), D(0x02), D(0x04), D(0x08), END});
    assert_int_equal(shown_at(model, 7, 8), 0xFFFFFF);
    assert_int_equal(shown_at(model, 8, 9), 0xFFFFFF);
    assert_int_equal(shown_at(model, 7, 18), 0xFFFFFF);
    assert_int_equal(shown_at(model, 8, 19), 0xFFFFFF);
    assert_int_equal(shown_at(model, 7, 9), 0x000000);
    play(model, (const int[]){0x48, END}); /* start line 8 */
    assert_int_equal(shown_at(model, 7, 0), 0xFFFFFF);
    play(model, (const int[]){0x40, 0xD3, 60, END}); /* offset: line 60 at the top */
    assert_int_equal(shown_at(model, 7, 12), 0xFFFFFF);
    play(model, (const int[]){0xD3, 0, 0x20, 1, 0x21, 20, 21, 0x22, 0, 1, D(0x01), D(0x02), D(0x04),
                              D(0x08), END});
    assert_int_equal(shown_at(model, 20, 0), 0xFFFFFF);
    assert_int_equal(shown_at(model, 20, 9), 0xFFFFFF);
    assert_int_equal(shown_at(model, 21, 2), 0xFFFFFF);
    assert_int_equal(shown_at(model, 21, 11), 0xFFFFFF);
    /* Page addressing: column 7Eh of page 3, to the page's end, then page 4 from there. */
    play(model, (const int[]){0x20, 2, 0x0E, 0x17, 0xB3, D(0x10), D(0x20), 0xB4, D(0x40), END});
    assert_int_equal(shown_at(model, 126, 28), 0xFFFFFF);
    assert_int_equal(shown_at(model, 127, 29), 0xFFFFFF);
    assert_int_equal(shown_at(model, 126, 38), 0xFFFFFF);
    play(model, (const int[]){0xAE, END});
    assert_false(yb_panel_model_lit(model));
    assert_all(model, 0x000000);
    yb_panel_model_free(model);
}

/* Segment remap is for what is written after it. */
static void ssd1306_remap_leaves_memory_alone(void **state)
{
    yb_panel_model_t *model = new_model("ssd1306");

    (void)state;
    play(model, ssd1306_unturned);
    ssd1306_fill(model, 0x00);
    play(model, (const int[]){0x21, 3, 3, 0x22, 0, 0, D(0x01), 0xA0, 0xC0, END});
    assert_int_equal(shown_at(model, 3, 63), 0xFFFFFF);
    assert_int_equal(shown_at(model, 124, 63), 0x000000);
    yb_panel_model_free(model);
}

static void ssd1306_lights_nothing_without_its_pump(void **state)
{
    static const struct {
        int script[5];
        bool lit;
    } pumps[] = {{{0xAF, END}, false},
                 {{0x8D, 0x14, 0xAF, END}, true},
                 {{0xAF, 0x8D, 0x14, END}, false},
                 {{0x8D, 0x10, 0xAF, END}, false}};
    yb_panel_model_t *model = new_model("ssd1306");

    (void)state;
    for (size_t i = 0; i < COUNT(pumps); i++) {
        play(model, (const int[]){RESET, END});
        play(model, pumps[i].script);
        assert_int_equal(yb_panel_model_lit(model), pumps[i].lit);
        if (!pumps[i].lit)
            assert_all(model, 0x000000);
    }
    play(model, (const int[]){0x8D, 0x14, 0xAF, 0x8D, 0x10, END});
    assert_false(yb_panel_model_lit(model));
    yb_panel_model_free(model);
}

static void ssd1306_refuses_hostile_sequences(void **state)
{
    static const wrong_t wrong[] = {
        {"ssd1306", "18h is no command", {0x18, END}},
        {"ssd1306", "C1h is no command", {0xC1, END}},
        {"ssd1306", "FFh is no command", {0xFF, END}},
        {"ssd1306", "26h scrolls", {0x26, END}},
        {"ssd1306", "2Fh scrolls", {0x2E, 0x2F, END}},
        {"ssd1306", "A3h scrolls", {0xA3, END}},
        {"ssd1306", "command 20h takes", {0x20, 3, END}},
        {"ssd1306", "21h has no meaning in addressing mode 2", {0x21, 0, 127, END}},
        {"ssd1306", "B0h has no meaning in addressing mode 0", {0x20, 0, 0xB0, END}},
        {"ssd1306", "10h has no meaning in addressing mode 1", {0x20, 1, 0x10, END}},
        {"ssd1306", "column address 128 is beyond", {0x20, 0, 0x21, 0, 128, END}},
        {"ssd1306", "page address 8 is beyond the last one, 7", {0x20, 0, 0x22, 0, 8, END}},
        {"ssd1306", "ends at page 1, before it begins at 2", {0x20, 0, 0x22, 2, 1, END}},
        {"ssd1306", "data beyond", {0x20, 0, 0x21, 9, 9, 0x22, 1, 1, D(1), D(2), END}},
        {"ssd1306", "data beyond", {0x0F, 0x17, D(1), D(2), END}},
        {"ssd1306", "data where command 81h wants argument 1 of 1", {0x81, D(0x7F), END}},
        {"ssd1306", "charge pump setting 04h", {0x8D, 0x04, END}},
        {"ssd1306", "command A8h takes 0Fh to 3Fh, not 40h", {0xA8, 64, END}},
        {"ssd1306", "command D3h takes", {0xD3, 64, END}},
        {"ssd1306", "phase length 20h", {0xD9, 0x20, END}},
        {"ssd1306", "COM pins 10h", {0xDA, 0x10, END}},
        {"ssd1306", "COM pins 42h", {0xDA, 0x42, END}},
        {"ssd1306", "deselect level 40h", {0xDB, 0x40, END}},
    };
    static const wrong_t set_ups[] = {
        {"ssd1306", "A1h with C0h mirrors", {0xC0, END}},
        {"ssd1306", "A0h with C8h mirrors", {0xA0, END}},
        {"ssd1306", "COM pins 02h tear", {0xDA, 0x02, END}},
        {"ssd1306", "COM pins 32h tear", {0xDA, 0x32, END}},
        {"ssd1306", "32 rows are driven, and the glass has 64", {0xA8, 31, END}},
        {"ssd1306", "command 21h still wants 2 bytes", {0x21, END}},
        {"ssd1306-128x32", "64 rows are driven, and the glass has 32", {0xDA, 0x02, END}},
        {"ssd1306-128x32", "COM pins 12h tear", {0xA8, 31, END}},
        {"ssd1306-128x32", "offset 32 leaves row 0", {0xA8, 31, 0xDA, 0x02, 0xD3, 32, END}},
        {"ssd1306-128x32", "offset 1 leaves row 31", {0xA8, 31, 0xDA, 0x02, 0xD3, 1, END}},
    };

    (void)state;
    assert_refused(NULL, wrong, COUNT(wrong));
    assert_no_pictures(ssd1306_unturned, set_ups, COUNT(set_ups));
}

/* ---- SSD1351 --------------------------------------------------------------------------------- */

static const int ssd1351_unturned[] = {RESET, 0xFD, D(0x12), 0xFD, D(0xB1), 0xCA, D(127), 0xA1,
                                       D(0),  0xA2, D(0),    0xA0, D(0x74), 0xAF, END};

static void put_pixel(yb_panel_model_t *model, unsigned pixel)
{
    assert_true(yb_panel_model_byte(model, true, (uint8_t)(pixel >> 8)));
    assert_true(yb_panel_model_byte(model, true, (uint8_t)pixel));
}

static void ssd1351_fill(yb_panel_model_t *model, unsigned pixel)
{
    play(model, (const int[]){0x15, D(0), D(127), 0x75, D(0), D(127), 0x5C, END});
    for (int i = 0; i < 128 * 128; i++)
        put_pixel(model, pixel);
}

static void ssd1351_shows_its_corners(void **state)
{
    static const uint32_t rgb[MARKS] = {0x000000, 0xFF0000, 0x00FF00, 0x0000FF, 0xFFFFFF};
    static const uint16_t pixels[MARKS] = {0x0000, 0xF800, 0x07E0, 0x001F, 0xFFFF};
    static const int remaps[] = {0x74, 0x77, 0x66, 0x65};

    (void)state;
    for (unsigned i = 0; i < 8; i++) {
        const unsigned turn = i % 4;
        const unsigned rows = i < 4 ? 128 : 96;
        const unsigned width = turn % 2 != 0 ? rows : 128;
        const unsigned height = turn % 2 != 0 ? 128 : rows;
        yb_panel_model_t *model = new_model(i < 4 ? "ssd1351" : "ssd1351-128x96");

        play(model, ssd1351_unturned);
        play(model, (const int[]){0xCA, D((int)rows - 1), 0xA0, D(remaps[turn]), 0x15, D(0), D(127),
                                  0x75, D(0), D((int)rows - 1), 0x5C, END});
        for (unsigned y = 0; y < height; y++) {
            for (unsigned x = 0; x < width; x++)
                put_pixel(model, pixels[mark_at(x, y, width, height)]);
        }
        assert_marks(model, turn, rgb);
        yb_panel_model_free(model);
    }
}

static void ssd1351_follows_its_settings(void **state)
{
    yb_panel_model_t *model = new_model("ssd1351");

    (void)state;
    play(model, ssd1351_unturned);
    ssd1351_fill(model, 0x8C31); /* 10001 100001 10001, bits repeated from the top */
    assert_all(model, 0x8C868C);
    play(model, (const int[]){0xA7, END});
    assert_all(model, 0x737973);
    play(model, (const int[]){0xA5, END});
    assert_all(model, 0xFFFFFF);
    play(model, (const int[]){0xA4, END});
    assert_all(model, 0x000000);
    play(model, (const int[]){0xA6, 0xAE, END});
    assert_false(yb_panel_model_lit(model));
    assert_all(model, 0x000000);
    play(model, (const int[]){0xAF, 0x15, D(5), D(6), 0x75, D(9), D(9), 0x5C, D16(0xF800), END});
    assert_true(yb_panel_model_lit(model));
    assert_int_equal(shown_at(model, 5, 9), 0xFF0000);
    play(model, (const int[]){D16(0x07E0), 0xA1, D(9), END});
    assert_int_equal(shown_at(model, 6, 0), 0x00FF00);
    play(model, (const int[]){0xA1, D(0), 0xA2, D(127), END});
    assert_int_equal(shown_at(model, 6, 10), 0x00FF00);
    yb_panel_model_free(model);
}

static void ssd1351_refuses_hostile_sequences(void **state)
{
    static const wrong_t wrong[] = {
        {"ssd1351", "00h is no command", {0x00, END}},
        {"ssd1351", "FFh is no command", {0xFF, END}},
        {"ssd1351", "5Dh reads", {0x5D, END}},
        {"ssd1351", "96h scrolls", {0x96, END}},
        {"ssd1351", "9Fh scrolls", {0x9E, 0x9F, END}},
        {"ssd1351", "command A2h wants FDh B1h first", {0xA2, END}},
        {"ssd1351", "command B1h wants FDh B1h first", {0xFD, D(0x12), 0xB1, END}},
        {"ssd1351", "command B3h wants FDh B1h first", {0xFD, D(0xB1), 0xFD, D(0xB0), 0xB3, END}},
        {"ssd1351", "command BBh wants FDh B1h first", {0xBB, END}},
        {"ssd1351", "command BEh wants FDh B1h first", {0xBE, END}},
        {"ssd1351", "command C1h wants FDh B1h first", {0xC1, END}},
        {"ssd1351", "AFh while the command lock is closed", {0xFD, D(0x16), 0xAF, END}},
        {"ssd1351", "13h is no key", {0xFD, D(0x13), END}},
        {"ssd1351", "15h still wants 1 bytes", {0x15, D(0), 0x75, END}},
        {"ssd1351", "15h still wants 2 bytes", {0x15, 0x00, END}},
        {"ssd1351", "command 15h takes", {0x15, D(128), END}},
        {"ssd1351", "column address 128 is beyond", {0x15, D(0), D(128), END}},
        {"ssd1351", "row address 128 is beyond", {0x75, D(0), D(128), END}},
        {"ssd1351", "before it begins at 3", {0x75, D(3), D(2), END}},
        {"ssd1351", "data 00h that no command asked for", {0x15, D(0), D(1), D(0), END}},
        {"ssd1351", "data 07h that no command asked for", {0x5C, D16(1), 0xAF, D(7), END}},
        {"ssd1351", "75h in the middle of a pixel", {0x5C, D(1), 0x75, END}},
        {"ssd1351", "data beyond", {0x15, D(1), D(1), 0x75, D(1), D(1), 0x5C, D16(1), D(1), END}},
        {"ssd1351", "remap 7Ch sets a bit", {0xA0, D(0x7C), END}},
        {"ssd1351", "another depth than 65k", {0xA0, D(0x34), END}},
        {"ssd1351", "another depth than 65k", {0xA0, D(0xB4), END}},
        {"ssd1351", "command CAh takes 0Fh to 7Fh", {0xCA, D(14), END}},
        {"ssd1351", "phase lengths 21h", {0xFD, D(0xB1), 0xB1, D(0x21), END}},
        {"ssd1351", "phase lengths 31h", {0xFD, D(0xB1), 0xB1, D(0x31), END}},
        {"ssd1351", "clock divider 11", {0xFD, D(0xB1), 0xB3, D(0xFB), END}},
        {"ssd1351", "command B6h takes", {0xB6, D(0), END}},
        {"ssd1351", "command C7h takes", {0xC7, D(0x10), END}},
    };
    static const wrong_t set_ups[] = {
        {"ssd1351", "remap 54h tears", {0xA0, D(0x54), END}},
        {"ssd1351", "remap 70h makes red and blue", {0xA0, D(0x70), END}},
        {"ssd1351", "96 rows are driven, and the glass has 128", {0xCA, D(95), END}},
        {"ssd1351-128x96", "128 rows are driven, and the glass has 96", {0xCA, D(127), END}},
        {"ssd1351-128x96", "offset 32 leaves row 64", {0xCA, D(95), 0xA2, D(32), END}},
        {"ssd1351", "half a pixel", {0x5C, D(1), END}},
        {"ssd1351", "command A0h still wants 1 bytes", {0xA0, END}},
    };

    (void)state;
    assert_refused(NULL, wrong, COUNT(wrong));
    assert_no_pictures(ssd1351_unturned, set_ups, COUNT(set_ups));
}

static void ssd1351_wants_a_grey_table_that_rises(void **state)
{
    (void)state;
    for (int bad = 0; bad <= 63; bad++) {
        yb_panel_model_t *model = new_model("ssd1351");
        bool well = true;

        play(model, (const int[]){0xB8, END});
        for (int i = 1; i <= 63; i++)
            well = yb_panel_model_byte(model, true, (uint8_t)(2 * i - (i == bad ? 2 : 0)));
        assert_int_equal(well, bad <= 1);
        if (!well)
            assert_non_null(strstr(yb_panel_model_error(model), "of the table does not rise"));
        yb_panel_model_free(model);
    }
}

/* ---- All of them ----------------------------------------------------------------------------- */

/* Memory that was not written after a reset is no picture. */
static void noise_comes_with_every_reset(void **state)
{
    static const struct {
        const char *name;
        const int *set_up;
    } chips[] = {{"ssd0323", ssd0323_unturned},
                 {"ssd1306", ssd1306_unturned},
                 {"ssd1351", ssd1351_unturned}};

    (void)state;
    for (size_t i = 0; i < COUNT(chips); i++) {
        yb_panel_model_t *model = new_model(chips[i].name);
        for (int n = 0; n < 2; n++) {
            unsigned same = 0;
            play(model, chips[i].set_up);
            for (unsigned x = 0; x < 64; x++)
                same += shown_at(model, x, 0) == shown_at(model, x + 1, 0);
            assert_true(same < 56);
        }
        yb_panel_model_free(model);
    }
}

int test_solomon_models(void)
{
    const struct CMUnitTest solomon[] = {
        cmocka_unit_test(ssd0323_shows_its_corners),
        cmocka_unit_test(ssd0323_follows_its_settings),
        cmocka_unit_test(ssd0323_refuses_hostile_sequences),
        cmocka_unit_test(ssd1306_shows_its_corners),
        cmocka_unit_test(ssd1306_follows_its_settings),
        cmocka_unit_test(ssd1306_remap_leaves_memory_alone),
        cmocka_unit_test(ssd1306_lights_nothing_without_its_pump),
        cmocka_unit_test(ssd1306_refuses_hostile_sequences),
        cmocka_unit_test(ssd1351_shows_its_corners),
        cmocka_unit_test(ssd1351_follows_its_settings),
        cmocka_unit_test(ssd1351_refuses_hostile_sequences),
        cmocka_unit_test(ssd1351_wants_a_grey_table_that_rises),
        cmocka_unit_test(noise_comes_with_every_reset),
    };
    return cmocka_run_group_tests(solomon, NULL, NULL);
}
