/* MIPI DCS, as ST7735, ST7789, ILI9341 and GC9A01 understand it.
 *
 * Commands go with D/C low, their arguments and pixels with D/C high. The pauses are the longest
 * that these chips' datasheets ask for: 120 ms from a reset to sleep out (the display may have been
 * awake), and 120 ms from sleep out or sleep in to the next change of that.
 *
 * Turns. The address mode has three bits: MV lets the window's columns count the chip's rows and
 * the other way round; MX and MY let the chip's columns and rows run backwards, and stay with these
 * whatever MV says. A picture turned by
 *
 *       0     fills columns from the left,  rows from the top
 *      90     fills rows from the top,      columns from the right    MV, columns backwards
 *     180     fills columns from the right, rows from the bottom      both backwards
 *     270     fills rows from the bottom,   columns from the left     MV, rows backwards
 *
 * "Backwards" is as seen from the unturned picture, whose own MX and MY the panel's flags give. The
 * glass covers a part of the chip's memory; what lies before it when counted backwards is what lay
 * behind it.
 */
#include "mipi.h"

enum {
    SLEEP_IN = 0x10,
    SLEEP_OUT = 0x11,
    INVERSION_OFF = 0x20,
    INVERSION_ON = 0x21,
    DISPLAY_OFF = 0x28,
    DISPLAY_ON = 0x29,
    SET_COLUMNS = 0x2A,
    SET_ROWS = 0x2B,
    WRITE_MEMORY = 0x2C,
    SET_ADDRESS_MODE = 0x36,

    MODE_MY = 0x80,
    MODE_MX = 0x40,
    MODE_MV = 0x20,
    MODE_BGR = 0x08,

    PAUSE_MS = 120,
};

static bool columns_backwards(const yb_display_t *display)
{
    return display->turn == YB_TURN_90 || display->turn == YB_TURN_180;
}

static bool rows_backwards(const yb_display_t *display)
{
    return display->turn == YB_TURN_180 || display->turn == YB_TURN_270;
}

static bool send(const yb_display_t *display, uint8_t command)
{
    return yb_panel_send(display, command, NULL, 0, true);
}

static bool set_address_mode(const yb_display_t *display)
{
    const uint8_t flags = display->panel->flags;
    uint8_t mode = 0;

    if (((flags & YB_PANEL_MIRROR_X) != 0) != columns_backwards(display))
        mode |= MODE_MX;
    if (((flags & YB_PANEL_MIRROR_Y) != 0) != rows_backwards(display))
        mode |= MODE_MY;
    if (yb_turn_lies_across(display->turn))
        mode |= MODE_MV;
    if ((flags & YB_PANEL_BGR) != 0)
        mode |= MODE_BGR;
    return yb_panel_send(display, SET_ADDRESS_MODE, &mode, 1, true);
}

static bool set_range(const yb_display_t *display, uint8_t command, uint16_t first, uint16_t count)
{
    const uint16_t last = (uint16_t)(first + count - 1);
    const uint8_t args[] = {(uint8_t)(first >> 8), (uint8_t)first, (uint8_t)(last >> 8),
                            (uint8_t)last};
    return yb_panel_send(display, command, args, sizeof args, true);
}

static bool set_window(const yb_display_t *display, uint16_t x, uint16_t y, uint16_t width,
                       uint16_t rows)
{
    const yb_panel_t *panel = display->panel;
    const uint16_t columns_before =
        columns_backwards(display)
            ? (uint16_t)(panel->ram_width - panel->screen.width - panel->ram_x)
            : panel->ram_x;
    const uint16_t rows_before =
        rows_backwards(display)
            ? (uint16_t)(panel->ram_height - panel->screen.height - panel->ram_y)
            : panel->ram_y;
    const bool swap = yb_turn_lies_across(display->turn);

    x = (uint16_t)(x + (swap ? rows_before : columns_before));
    y = (uint16_t)(y + (swap ? columns_before : rows_before));
    return set_range(display, SET_COLUMNS, x, width) && set_range(display, SET_ROWS, y, rows) &&
           send(display, WRITE_MEMORY);
}

static bool mipi_invert(yb_display_t *display, bool inverted)
{
    const bool invert = ((display->panel->flags & YB_PANEL_INVERTED) != 0) != inverted;
    return send(display, invert ? INVERSION_ON : INVERSION_OFF);
}

static bool mipi_start(yb_display_t *display)
{
    const yb_panel_t *panel = display->panel;
    const yb_screen_t screen = yb_display_screen(display);

    yb_panel_wait(display, PAUSE_MS);
    if (!send(display, SLEEP_OUT))
        return false;
    yb_panel_wait(display, PAUSE_MS);
    /* Picture memory holds noise when the supply comes up, and is blackened before it can be seen.
     */
    return yb_panel_run(display, panel->setup, panel->setup_bytes, true) &&
           set_address_mode(display) && mipi_invert(display, false) &&
           set_window(display, 0, 0, screen.width, screen.height) &&
           yb_panel_send_black(display, (uint32_t)screen.width * screen.height * 2) &&
           send(display, DISPLAY_ON);
}

static bool mipi_write(yb_display_t *display, const yb_panel_window_t *window)
{
    return set_window(display, window->x, window->y, window->width, window->rows) &&
           yb_panel_send_pixels(display, window);
}

static bool mipi_sleep(yb_display_t *display, bool asleep)
{
    if (asleep && !send(display, DISPLAY_OFF))
        return false;
    if (!send(display, asleep ? SLEEP_IN : SLEEP_OUT))
        return false;
    yb_panel_wait(display, PAUSE_MS);
    return asleep || send(display, DISPLAY_ON);
}

const yb_panel_driver_t yb_panel_mipi = {
    .start = mipi_start,
    .write = mipi_write,
    .sleep = mipi_sleep,
    .invert = mipi_invert,
};
