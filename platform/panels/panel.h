/* Panels: the displays that Yamabiko draws on.
 *
 * Four thin layers lie between a picture and the wires, and each knows only the next one:
 *
 *     display        yb_panel_t           init, windows of pixels, sleep        (this folder)
 *     command/data   yb_panel_bus_t       bytes marked as command or as data    (the port's)
 *     byte           the port's           SPI hardware, a kernel driver, or bits one by one
 *     pins           the port's           registers, libgpiod, a simulated panel
 *
 * A panel is a const description; all that is known of a display at run time lies in the display.
 * Nothing here allocates, keeps state, or needs an operating system, so the same files are compiled
 * into firmware, into the PC's tools and into the tests. Calls on one bus must not overlap.
 *
 * Drawing a frame, band by band:
 *
 *     const yb_panel_t *panel = &yb_panel_ssd0323;
 *     if (!panel->init(&bus))
 *         return false;
 *     for (uint16_t y = 0; y < panel->screen.height; y += BAND_ROWS) {
 *         draw(band, y);
 *         if (!yb_panel_write_rows(panel, &bus, y, BAND_ROWS, band))
 *             return false;
 *     }
 */
#ifndef YB_PANEL_H
#define YB_PANEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <yamabiko/yamabiko.h>

/* How a panel's driver reaches the display; filled in by the port, which owns the context. Every
 * function but `wait_ms` and `reset` must be there, and answers false when the bus failed (why is
 * the port's to say). The bytes are borrowed for the call. */
typedef struct {
    void *context;
    bool (*command)(void *context, const uint8_t *bytes, size_t count);
    bool (*data)(void *context, const uint8_t *bytes, size_t count);
    /* Pulls the display's reset line; NULL where the board does that by itself. */
    bool (*reset)(void *context);
    /* Waits at least so long; NULL where the supplies are known to stand already. */
    void (*wait_ms)(void *context, uint32_t ms);
} yb_panel_bus_t;

/* A rectangle of pixels and where it goes. */
typedef struct {
    uint16_t x;
    uint16_t y;
    uint16_t width;
    uint16_t rows;
    const uint8_t *pixels; /* the top left corner, in the panel's format */
    size_t pitch_bytes;    /* from one row to the next */
} yb_panel_window_t;

typedef struct {
    const char *name;
    yb_screen_t screen; /* size and pixels, as the engine draws for it */
    uint32_t spi_hz;    /* the fastest serial clock that the datasheet allows */

    /* Resets the display, sets it up, blackens it and switches it on. */
    bool (*init)(const yb_panel_bus_t *bus);
    /* Writes one window; false also when it does not lie on the display, and then nothing is
     * sent. With four bits a pixel, x and width must be even. */
    bool (*write)(const yb_panel_bus_t *bus, const yb_panel_window_t *window);
    /* Switches the display off or on again; the picture is kept. */
    bool (*sleep)(const yb_panel_bus_t *bus, bool asleep);
} yb_panel_t;

/* Solomon SSD0323 on an OSRAM Pictiva 128 x 64 glass: 16 greys. */
extern const yb_panel_t yb_panel_ssd0323;

/* Writes a band: `rows` full rows from row `y` down, one after the other in `pixels`. */
static inline bool yb_panel_write_rows(const yb_panel_t *panel, const yb_panel_bus_t *bus,
                                       uint16_t y, uint16_t rows, const uint8_t *pixels)
{
    const yb_panel_window_t band = {
        .x = 0,
        .y = y,
        .width = panel->screen.width,
        .rows = rows,
        .pixels = pixels,
        .pitch_bytes = yb_screen_pitch(&panel->screen),
    };
    return panel->write(bus, &band);
}

/* The panel of that name, or NULL. Links every panel there is: for programs on a PC. */
const yb_panel_t *yb_panel_find(const char *name);

/* The panels one by one, for lists: index from 0, NULL after the last. */
const yb_panel_t *yb_panel_at(size_t index);

#endif
