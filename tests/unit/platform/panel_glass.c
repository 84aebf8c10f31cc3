#include "panel_glass.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static uint32_t noise;

uint32_t random_below(uint32_t limit)
{
    noise = noise * 1664525U + 1013904223U;
    return (uint32_t)((uint64_t)noise * limit >> 32);
}

void draw_noise(uint8_t *picture, size_t bytes, uint32_t seed)
{
    noise = seed;
    for (size_t i = 0; i < bytes; i++)
        picture[i] = (uint8_t)random_below(256);
}

size_t frame_bytes(const yb_display_t *display)
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

void assert_shown(wire_t *wire, const yb_display_t *display, const uint8_t *frame, uint8_t flip)
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

bool is_memory_lcd(const yb_panel_t *panel)
{
    return panel->driver->sleep == NULL;
}

void blank(const yb_display_t *display, uint8_t *frame)
{
    memset(frame, is_memory_lcd(display->panel) ? 0xFF : 0, frame_bytes(display));
}
