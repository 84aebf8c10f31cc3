/* Models of Sharp's memory LCDs. */
#include "model_script.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const struct {
    const char *name;
    unsigned width, height;
} glasses[] = {{"ls013b7dh03", 128, 128}, {"ls013b7dh05", 144, 168}, {"ls027b7dh01", 400, 240}};

static const int clear[] = {SELECT, 0x20, 0x00, RELEASE, END};

/* The line's number goes out lowest bit first. */
static unsigned number_byte(unsigned line)
{
    unsigned byte = 0;

    for (unsigned bit = 0; bit < 8; bit++) {
        if ((line >> bit & 1) != 0)
            byte |= 0x80U >> bit;
    }
    return byte;
}

static void send(yb_panel_model_t *model, unsigned byte)
{
    assert_true(yb_panel_model_byte(model, true, (uint8_t)byte));
}

static void picture_shows_its_corners(void **state)
{
    static const uint32_t rgb[MARKS] = {0x000000, 0xFFFFFF, 0xFFFFFF, 0xFFFFFF, 0x000000};

    (void)state;
    for (size_t i = 0; i < COUNT(glasses); i++) {
        const unsigned width = glasses[i].width;
        const unsigned height = glasses[i].height;
        yb_panel_model_t *model = new_model(glasses[i].name);

        play(model, (const int[]){SELECT, 0x80, END});
        for (unsigned y = 0; y < height; y++) {
            send(model, number_byte(y + 1));
            for (unsigned x = 0; x < width; x += 8) {
                unsigned byte = 0;
                for (unsigned bit = 0; bit < 8; bit++)
                    byte = byte << 1 | (rgb[mark_at(x + bit, y, width, height)] != 0);
                send(model, byte);
            }
            send(model, 0x00);
        }
        play(model, (const int[]){0x00, RELEASE, END});
        assert_marks(model, 0, rgb);
        assert_true(yb_panel_model_lit(model));
        yb_panel_model_free(model);
    }
}

static void noise_stays_until_it_is_written(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(glasses); i++) {
        yb_panel_model_t *model = new_model(glasses[i].name);
        unsigned white = 0;

        play(model, (const int[]){SELECT, 0x40, 0x00, RELEASE, END});
        for (unsigned x = 0; x < 64; x++)
            white += shown_at(model, x, glasses[i].height - 1) != 0;
        assert_in_range(white, 8, 56);
        play(model, clear);
        assert_all(model, 0xFFFFFF);
        yb_panel_model_reset(model);
        white = 0;
        for (unsigned x = 0; x < 64; x++)
            white += shown_at(model, x, 0) != 0;
        assert_in_range(white, 8, 56);
        yb_panel_model_free(model);
    }
}

/* Line 2, number 40h on the wire, alone; and D/C has no meaning. */
static void one_line_changes_alone(void **state)
{
    yb_panel_model_t *model = new_model("ls013b7dh03");

    (void)state;
    play(model, clear);
    play(model, (const int[]){SELECT, 0xC0, 0x40, D(0x7F), 0xFE, END});
    for (int i = 2; i < 16; i++)
        send(model, 0xFF);
    play(model, (const int[]){0x00, 0x00, RELEASE, END});
    assert_int_equal(shown_at(model, 0, 1), 0x000000);
    assert_int_equal(shown_at(model, 1, 1), 0xFFFFFF);
    assert_int_equal(shown_at(model, 14, 1), 0xFFFFFF);
    assert_int_equal(shown_at(model, 15, 1), 0x000000);
    assert_int_equal(shown_at(model, 0, 0), 0xFFFFFF);
    assert_int_equal(shown_at(model, 0, 2), 0xFFFFFF);
    yb_panel_model_free(model);
}

#define LINE_BYTES 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16

static void hostile_sequences_are_refused(void **state)
{
    static const int line[] = {SELECT, 0x80, 0x80, LINE_BYTES, END};
    static const wrong_t wrong[] = {
        {"ls013b7dh03", "mode byte 01h sets dummy bits", {SELECT, 0x01, END}},
        {"ls013b7dh03", "mode byte 90h sets dummy bits", {SELECT, 0x90, END}},
        {"ls013b7dh03", "writes and clears at once", {SELECT, 0xA0, END}},
        {"ls013b7dh03", "line 0 is not one of 1 to 128", {SELECT, 0x80, 0x00, END}},
        {"ls013b7dh03", "line 129 is not one of 1 to 128", {SELECT, 0x80, 0x81, END}},
        {"ls013b7dh05", "line 169 is not one of 1 to 168", {SELECT, 0x80, 0x95, END}},
        {"ls027b7dh01", "line 241 is not one of 1 to 240", {SELECT, 0x80, 0x8F, END}},
        {"ls013b7dh03", "the transfer has no bytes", {SELECT, RELEASE, END}},
        {"ls013b7dh03", "before it names a line", {SELECT, 0x80, RELEASE, END}},
        {"ls013b7dh03", "after 2 of 16 bytes of line 1", {SELECT, 0x80, 0x80, 1, 2, RELEASE, END}},
        {"ls027b7dh01", "after 0 of 50 bytes of line 240", {SELECT, 0x80, 0x0F, RELEASE, END}},
        {"ls013b7dh03", "before its last dummy byte", {SELECT, 0x20, RELEASE, END}},
        {"ls013b7dh03", "before its last dummy byte", {SELECT, 0x40, RELEASE, END}},
        {"ls013b7dh03", "01h where a dummy byte belongs", {SELECT, 0x20, 0x01, END}},
        {"ls013b7dh03", "00h after the transfer's last", {SELECT, 0x20, 0x00, 0x00, END}},
        {"ls013b7dh03",
         "VCOM has kept its side",
         {W(5000), SELECT, 0x40, 0x00, RELEASE, W(1000), W(1), END}},
        {"ls013b7dh03",
         "VCOM has kept its side",
         {W(1), SELECT, 0, 0, RELEASE, W(900), SELECT, 0x20, 0, RELEASE, W(101), END}},
    };
    static const wrong_t after_line[] = {
        {"ls013b7dh03", "55h where a dummy byte belongs", {0x55, END}},
        {"ls013b7dh03", "before its last dummy byte", {RELEASE, END}},
        {"ls013b7dh03", "before its last dummy byte", {0x00, RELEASE, END}},
        {"ls013b7dh03", "line 255 is not", {0x00, 0xFF, END}},
        {"ls013b7dh03", "00h after the transfer's last", {0x00, 0x00, 0x00, END}},
    };
    static const wrong_t selected[] = {{"ls013b7dh03", "still selected", {0x00, 0x00, END}}};

    (void)state;
    assert_refused(NULL, wrong, COUNT(wrong));
    assert_refused(line, after_line, COUNT(after_line));
    assert_no_pictures(line, selected, COUNT(selected));
}

static void vcom_in_time_is_taken(void **state)
{
    yb_panel_model_t *model = new_model("ls027b7dh01");

    (void)state;
    play(model, (const int[]){W(3000), SELECT, 0x60, 0, RELEASE, W(1000), SELECT, 0x00, 0, RELEASE,
                              W(999), SELECT, 0x40, 0, RELEASE, W(1000), END});
    /* Nobody knows the time. */
    play(model, (const int[]){RESET, SELECT, 0x60, 0, RELEASE, SELECT, 0x60, 0, RELEASE, END});
    assert_all(model, 0xFFFFFF);
    yb_panel_model_free(model);
}

int test_sharp_models(void)
{
    const struct CMUnitTest sharp[] = {
        cmocka_unit_test(picture_shows_its_corners),
        cmocka_unit_test(noise_stays_until_it_is_written),
        cmocka_unit_test(one_line_changes_alone),
        cmocka_unit_test(hostile_sequences_are_refused),
        cmocka_unit_test(vcom_in_time_is_taken),
    };
    return cmocka_run_group_tests(sharp, NULL, NULL);
}
