/* What the drivers share. */
#ifndef YB_PANEL_DRIVER_H
#define YB_PANEL_DRIVER_H

#include "panel.h"

/* A set-up table is a row of commands: the number of argument bytes, the command, its arguments.
 * With YB_SETUP_WAIT added to the number one more byte follows: a pause in milliseconds. */
enum {
    YB_SETUP_WAIT = 0x80
};

/* Runs a set-up table. Arguments go with D/C high (`args_are_data`), as MIPI chips and the SSD1351
 * want them, or low as their command does. */
bool yb_panel_run(const yb_display_t *display, const uint8_t *table, size_t bytes,
                  bool args_are_data);

/* One command and its arguments. */
bool yb_panel_send(const yb_display_t *display, uint8_t command, const uint8_t *args, size_t count,
                   bool args_are_data);

/* A window's pixels by the bus's `pixels`, in one piece if its rows follow each other. */
bool yb_panel_send_pixels(const yb_display_t *display, const yb_panel_window_t *window);

/* So many bytes of 0 by the bus's `data`. */
bool yb_panel_send_black(const yb_display_t *display, uint32_t bytes);

/* A brightness of 0 to 255 as 0 to `rated`: both ends exact, and no division. */
static inline uint8_t yb_panel_level(uint8_t level, uint8_t rated)
{
    return (uint8_t)(level * (rated + 1U) >> 8);
}

/* Waits where the port can. */
void yb_panel_wait(const yb_display_t *display, uint32_t ms);

#endif
