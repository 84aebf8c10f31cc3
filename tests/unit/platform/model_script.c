#include "model_script.h"

#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

yb_panel_model_t *new_model(const char *name)
{
    yb_panel_model_t *model = yb_panel_model_new(name);

    assert_non_null(model);
    return model;
}

static bool play_item(yb_panel_model_t *model, int item)
{
    bool well = true;

    if (item >= WAIT_MS)
        yb_panel_model_wait(model, (uint32_t)(item - WAIT_MS) * 1000);
    else if (item == RESET)
        yb_panel_model_reset(model);
    else if (item >= SELECT)
        well = yb_panel_model_select(model, item == SELECT);
    else
        well = yb_panel_model_byte(model, item >= DATA, (uint8_t)item);
    if (well && item < WAIT_MS)
        assert_string_equal(yb_panel_model_error(model), "");
    return yb_panel_model_error(model)[0] == '\0';
}

void play(yb_panel_model_t *model, const int *script)
{
    for (size_t i = 0; script != NULL && script[i] != END; i++) {
        if (!play_item(model, script[i]))
            fail_msg("item %zu, %Xh: %s", i, (unsigned)script[i], yb_panel_model_error(model));
    }
}

static void assert_says(yb_panel_model_t *model, const wrong_t *wrong)
{
    const char *said = yb_panel_model_error(model);
    char number[32];

    (void)snprintf(number, sizeof number, "byte %" PRIu64 ": ", yb_panel_model_bytes(model));
    if (strncmp(said, number, strlen(number)) != 0)
        fail_msg("\"%s\" does not begin with \"%s\"", said, number);
    if (strstr(said, wrong->expected) == NULL)
        fail_msg("%s: \"%s\" does not say \"%s\"", wrong->name, said, wrong->expected);
}

void assert_refused(const int *before, const wrong_t *wrong, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        yb_panel_model_t *model = new_model(wrong[i].name);
        yb_model_picture_t picture;
        bool well = true;

        play(model, before);
        for (const int *item = wrong[i].script; *item != END; item++) {
            if (!well)
                fail_msg("%s: refused too early: %s", wrong[i].name, yb_panel_model_error(model));
            well = play_item(model, *item);
        }
        if (well)
            fail_msg("%s: not refused: \"%s\"", wrong[i].name, wrong[i].expected);
        assert_says(model, &wrong[i]);

        yb_panel_model_reset(model);
        assert_false(yb_panel_model_select(model, true));
        assert_false(yb_panel_model_byte(model, false, 0x00));
        assert_false(yb_panel_model_picture(model, &picture));
        assert_says(model, &wrong[i]);
        yb_panel_model_free(model);
    }
}

void assert_no_pictures(const int *before, const wrong_t *wrong, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        yb_panel_model_t *model = new_model(wrong[i].name);
        yb_model_picture_t picture;

        play(model, before);
        play(model, wrong[i].script);
        if (yb_panel_model_picture(model, &picture))
            fail_msg("%s: a picture in spite of \"%s\"", wrong[i].name, wrong[i].expected);
        assert_says(model, &wrong[i]);
        yb_panel_model_free(model);
    }
}

static yb_model_picture_t picture_of(yb_panel_model_t *model)
{
    yb_model_picture_t picture;

    if (!yb_panel_model_picture(model, &picture))
        fail_msg("no picture: %s", yb_panel_model_error(model));
    return picture;
}

static uint32_t rgb_at(const yb_model_picture_t *picture, unsigned x, unsigned y)
{
    const uint8_t *rgb = picture->rgb + 3 * ((size_t)y * picture->width + x);
    return (uint32_t)rgb[0] << 16 | (uint32_t)rgb[1] << 8 | rgb[2];
}

uint32_t shown_at(yb_panel_model_t *model, unsigned x, unsigned y)
{
    const yb_model_picture_t picture = picture_of(model);

    assert_true(x < picture.width && y < picture.height);
    return rgb_at(&picture, x, y);
}

void assert_all(yb_panel_model_t *model, uint32_t rgb)
{
    const yb_model_picture_t picture = picture_of(model);

    for (unsigned y = 0; y < picture.height; y++) {
        for (unsigned x = 0; x < picture.width; x++)
            assert_int_equal(rgb_at(&picture, x, y), rgb);
    }
}

unsigned mark_at(unsigned x, unsigned y, unsigned width, unsigned height)
{
    if (x == 0 && y == 0)
        return TOP_LEFT;
    if (y == 0 && x >= width - 2)
        return TOP_RIGHT;
    if (x == 0 && y >= height - 2)
        return BOTTOM_LEFT;
    return x == width - 1 && y == height - 1 ? BOTTOM_RIGHT : DARK;
}

void assert_marks(yb_panel_model_t *model, unsigned turn, const uint32_t rgb[MARKS])
{
    const yb_model_picture_t picture = picture_of(model);
    const unsigned right = picture.width - 1U;
    const unsigned bottom = picture.height - 1U;
    const unsigned width = turn % 2 != 0 ? picture.height : picture.width;
    const unsigned height = turn % 2 != 0 ? picture.width : picture.height;

    for (unsigned y = 0; y < height; y++) {
        for (unsigned x = 0; x < width; x++) {
            const unsigned glass_x[] = {x, right - y, right - x, y};
            const unsigned glass_y[] = {y, x, bottom - y, bottom - x};
            const uint32_t seen = rgb_at(&picture, glass_x[turn], glass_y[turn]);
            const uint32_t expected = rgb[mark_at(x, y, width, height)];
            if (seen != expected)
                fail_msg("turn %u: %06" PRIX32 " at %u, %u, not %06" PRIX32, turn, seen, x, y,
                         expected);
        }
    }
}
