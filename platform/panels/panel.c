#include "panel.h"

#include "panel_driver.h"

#include <string.h>

/* ---- Displays ----------------------------------------------------------------------------- */

yb_screen_t yb_display_screen(const yb_display_t *display)
{
    yb_screen_t screen = display->panel->screen;
    if (yb_turn_lies_across(display->turn)) {
        screen.width = display->panel->screen.height;
        screen.height = display->panel->screen.width;
    }
    return screen;
}

uint16_t yb_display_x_step(const yb_display_t *display)
{
    return yb_turn_lies_across(display->turn) ? display->panel->y_step : display->panel->x_step;
}

uint16_t yb_display_y_step(const yb_display_t *display)
{
    return yb_turn_lies_across(display->turn) ? display->panel->x_step : display->panel->y_step;
}

bool yb_display_start(yb_display_t *display)
{
    const yb_panel_bus_t *bus = display->bus;

    if ((display->panel->turns >> display->turn & 1) == 0)
        return false;
    display->state = 0;
    if (bus->reset != NULL && !bus->reset(bus->context))
        return false;
    return display->panel->driver->start(display) && yb_display_finish(display);
}

/* Whether a stretch lies on the display and on its steps. Not from + length > size: int has 16 bits
 * on some targets. */
static bool fits(uint16_t from, uint16_t length, uint16_t size, uint16_t step)
{
    return length != 0 && length <= size && from <= size - length && from % step == 0 &&
           length % step == 0;
}

bool yb_display_write(yb_display_t *display, const yb_panel_window_t *window)
{
    const yb_screen_t screen = yb_display_screen(display);

    return fits(window->x, window->width, screen.width, yb_display_x_step(display)) &&
           fits(window->y, window->rows, screen.height, yb_display_y_step(display)) &&
           display->panel->driver->write(display, window);
}

bool yb_display_write_rows(yb_display_t *display, uint16_t y, uint16_t rows, const uint8_t *pixels)
{
    const yb_screen_t screen = yb_display_screen(display);
    const yb_panel_window_t band = {
        .x = 0,
        .y = y,
        .width = screen.width,
        .rows = rows,
        .pixels = pixels,
        .pitch_bytes = yb_screen_pitch(&screen),
    };
    return yb_display_write(display, &band);
}

bool yb_display_finish(yb_display_t *display)
{
    const yb_panel_bus_t *bus = display->bus;
    return bus->finish == NULL || bus->finish(bus->context);
}

bool yb_display_sleep(yb_display_t *display, bool asleep)
{
    const yb_panel_driver_t *driver = display->panel->driver;
    return driver->sleep == NULL || driver->sleep(display, asleep);
}

bool yb_display_invert(yb_display_t *display, bool inverted)
{
    return display->panel->driver->invert(display, inverted);
}

bool yb_display_brightness(yb_display_t *display, uint8_t level)
{
    const yb_panel_driver_t *driver = display->panel->driver;
    return driver->brightness == NULL || driver->brightness(display, level);
}

bool yb_display_tick(yb_display_t *display)
{
    const yb_panel_driver_t *driver = display->panel->driver;
    return driver->tick == NULL || driver->tick(display);
}

/* ---- For the drivers ---------------------------------------------------------------------- */

void yb_panel_wait(const yb_display_t *display, uint32_t ms)
{
    if (display->bus->wait_ms != NULL)
        display->bus->wait_ms(display->bus->context, ms);
}

bool yb_panel_send(const yb_display_t *display, uint8_t command, const uint8_t *args, size_t count,
                   bool args_are_data)
{
    const yb_panel_bus_t *bus = display->bus;

    if (!bus->command(bus->context, &command, 1))
        return false;
    if (count == 0)
        return true;
    return args_are_data ? bus->data(bus->context, args, count)
                         : bus->command(bus->context, args, count);
}

bool yb_panel_run(const yb_display_t *display, const uint8_t *table, size_t bytes,
                  bool args_are_data)
{
    const uint8_t *const end = table + bytes;

    while (table < end) {
        const bool wait = (*table & YB_SETUP_WAIT) != 0;
        const size_t count = *table++ & (YB_SETUP_WAIT - 1);
        const uint8_t command = *table++;
        if (!yb_panel_send(display, command, table, count, args_are_data))
            return false;
        table += count;
        if (wait)
            yb_panel_wait(display, *table++);
    }
    return true;
}

bool yb_panel_send_pixels(const yb_display_t *display, const yb_panel_window_t *window)
{
    const yb_panel_bus_t *bus = display->bus;
    const yb_screen_t strip = {window->width, window->rows, display->panel->screen.format};
    const size_t row_bytes = yb_screen_pitch(&strip);
    bool (*const send)(void *, const uint8_t *, size_t) =
        bus->pixels != NULL ? bus->pixels : bus->data;

    if (window->pitch_bytes == row_bytes)
        return send(bus->context, window->pixels, row_bytes * window->rows);
    for (uint16_t row = 0; row < window->rows; row++) {
        if (!send(bus->context, window->pixels + row * window->pitch_bytes, row_bytes))
            return false;
    }
    return true;
}

bool yb_panel_send_black(const yb_display_t *display, uint32_t bytes)
{
    const yb_panel_bus_t *bus = display->bus;
    uint8_t black[64];

    memset(black, 0, sizeof black);
    while (bytes > 0) {
        const size_t count = bytes < sizeof black ? (size_t)bytes : sizeof black;
        if (!bus->data(bus->context, black, count))
            return false;
        bytes -= (uint32_t)count;
    }
    return true;
}
