/* Sharp's memory LCDs LS013B7DH03, LS013B7DH05 and LS027B7DH01: reflecting, white or black.
 *
 * "Datasheet" is Sharp's specification of each, sections "Input Signal Timing Chart" and "Display
 * data and gate address". The panels have no D/C line and select high. Bits go out as their timing
 * charts name them, M0 first, so in a byte sent from its highest bit
 *
 *     0x80 M0  write lines    0x40 M1  polarity of the common electrode    0x20 M2  clear all
 *
 * and a line's number, which counts from 1 and goes out from its lowest bit, is sent in reverse. A
 * line is the smallest thing that can be written; pixels are 1 for white, the leftmost first.
 *
 * The common electrode must change its polarity about once a second, or the glass ages: each tick
 * does that, with the two bytes that neither write nor clear. Lines are sent with the polarity as
 * it is: were it changed with each of them, it would run at some kilohertz, far above the rated 60
 * Hz. This wants the panel's pin EXTMODE low. Its pin DISP is the port's; low shows white and keeps
 * the picture. There is no command for that, nor for inverting, which is done on the way out.
 */
#include "panel_driver.h"

enum {
    WRITE_LINES = 0x80,
    POLARITY = 0x40,
    CLEAR_ALL = 0x20,

    HEAD_BYTES = 2, /* command, line number */
    TAIL_BYTES = 2, /* clocks in which the panel takes the line over */
    MOST_WIDTH = 400,

    /* yb_display_t.state: POLARITY as in commands, and */
    STATE_INVERTED = 0x01,
};

static uint8_t reversed(uint8_t byte)
{
    byte = (uint8_t)(byte << 4 | byte >> 4);
    byte = (uint8_t)((byte & 0x33) << 2 | (byte >> 2 & 0x33));
    return (uint8_t)((byte & 0x55) << 1 | (byte >> 1 & 0x55));
}

static bool send(const yb_display_t *display, uint8_t command)
{
    const uint8_t bytes[] = {(uint8_t)(command | (display->state & POLARITY)), 0};
    return display->bus->data(display->bus->context, bytes, sizeof bytes);
}

/* The panel has no reset, and its memory holds noise when the supply comes up. */
static bool sharp_start(yb_display_t *display)
{
    return send(display, CLEAR_ALL);
}

/* Fills the pixels of a line: turned, they go out from the last to the first. */
static void take_pixels(const yb_display_t *display, const uint8_t *pixels, uint8_t *line,
                        uint8_t bytes)
{
    const uint8_t flip = (display->state & STATE_INVERTED) != 0 ? 0xFF : 0x00;
    const bool turned = display->turn == YB_TURN_180;

    for (uint8_t i = 0; i < bytes; i++)
        line[i] = (uint8_t)(flip ^ (turned ? reversed(pixels[bytes - 1 - i]) : pixels[i]));
}

static bool sharp_write(yb_display_t *display, const yb_panel_window_t *window)
{
    const yb_panel_bus_t *bus = display->bus;
    const yb_screen_t *screen = &display->panel->screen;
    const uint8_t bytes = (uint8_t)(screen->width / 8);
    uint8_t line[HEAD_BYTES + MOST_WIDTH / 8 + TAIL_BYTES];

    if (screen->width > MOST_WIDTH)
        return false;
    line[0] = (uint8_t)(WRITE_LINES | (display->state & POLARITY));
    line[HEAD_BYTES + bytes] = 0;
    line[HEAD_BYTES + bytes + 1] = 0;
    for (uint16_t row = 0; row < window->rows; row++) {
        const uint16_t y = window->y + row;
        const uint16_t number = display->turn == YB_TURN_180 ? screen->height - y : y + 1;
        line[1] = reversed((uint8_t)number);
        take_pixels(display, window->pixels + row * window->pitch_bytes, line + HEAD_BYTES, bytes);
        if (!bus->data(bus->context, line, (size_t)HEAD_BYTES + bytes + TAIL_BYTES))
            return false;
    }
    return true;
}

static bool sharp_invert(yb_display_t *display, bool inverted)
{
    display->state &= POLARITY;
    if (inverted)
        display->state |= STATE_INVERTED;
    return true;
}

static bool sharp_tick(yb_display_t *display)
{
    display->state ^= POLARITY;
    return send(display, 0);
}

static const yb_panel_driver_t driver = {
    .start = sharp_start,
    .write = sharp_write,
    .invert = sharp_invert,
    .tick = sharp_tick,
};

/* What the descriptions of all of them say alike; a window is whole lines. */
#define MEMORY_LCD(wide, high)                                                                     \
    .driver = &driver, .screen = {.width = (wide), .height = (high), .format = YB_MONO},           \
    .ram_width = (wide), .ram_height = (high), .flags = YB_PANEL_SELECT_HIGH | YB_PANEL_NO_DC,     \
    .turns = 1 << YB_TURN_0 | 1 << YB_TURN_180, .x_step = (wide), .y_step = 1,                     \
    .row_bytes = HEAD_BYTES + TAIL_BYTES, .tick_ms = 500

/* Clocks: Datasheet, "Timing characteristics of input signals". */

const yb_panel_t yb_panel_ls013b7dh03 = {
    .name = "ls013b7dh03",
    .title = "Sharp LS013B7DH03 memory LCD",
    MEMORY_LCD(128, 128),
    .spi_hz = 1100000, /* 1 MHz, at most 1.1 */
};

const yb_panel_t yb_panel_ls013b7dh05 = {
    .name = "ls013b7dh05",
    .title = "Sharp LS013B7DH05 memory LCD",
    MEMORY_LCD(144, 168),
    .spi_hz = 1100000, /* the same */
};

const yb_panel_t yb_panel_ls027b7dh01 = {
    .name = "ls027b7dh01",
    .title = "Sharp LS027B7DH01 memory LCD",
    MEMORY_LCD(MOST_WIDTH, 240),
    .spi_hz = 2000000, /* 1 MHz, at most 2 */
};
