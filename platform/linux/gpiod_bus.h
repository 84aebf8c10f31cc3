/* A panel's bus on GPIO lines of a Linux machine: SPI mode 0, bit by bit, over libgpiod.
 *
 * Any four free lines will do, and a fifth if the display's reset is wired. It is the bus that
 * always works, not the fast one: each bit costs two system calls, so a 128 x 64 frame of 16 greys
 * takes some tenths of a second.
 *
 *     char why[YB_GPIOD_ERROR_BYTES];
 *     const yb_gpiod_pins_t pins = {.chip = "gpiochip0", .sck = 11, .mosi = 10, .cs = 8, .dc = 25,
 *                                   .reset = YB_GPIOD_NOT_WIRED};
 *     yb_gpiod_bus_t *bus = yb_gpiod_bus_open(&pins, why, sizeof why);
 *     if (bus == NULL)
 *         die(why);
 *     if (!panel->init(yb_gpiod_bus_panel(bus)))
 *         die(yb_gpiod_bus_error(bus));
 *     yb_gpiod_bus_close(bus);
 *
 * A bus is one thread's at a time. Lines are held exclusively from open to close.
 */
#ifndef YB_GPIOD_BUS_H
#define YB_GPIOD_BUS_H

#include "panel.h"

#include <stddef.h>

enum {
    YB_GPIOD_NOT_WIRED = -1,
    YB_GPIOD_ERROR_BYTES = 240,
};

typedef struct {
    const char *chip; /* as libgpiod takes it: "gpiochip0", "0", "/dev/gpiochip0" or a label */
    int sck;          /* line offsets on that chip */
    int mosi;
    int cs;
    int dc;
    int reset; /* or YB_GPIOD_NOT_WIRED */
} yb_gpiod_pins_t;

typedef struct yb_gpiod_bus yb_gpiod_bus_t;

/* Takes the lines, with the display not selected. NULL when that failed, and then `error` has one
 * sentence that says why: no such chip or line, a line that somebody holds and who, no permission,
 * one line named twice. */
yb_gpiod_bus_t *yb_gpiod_bus_open(const yb_gpiod_pins_t *pins, char *error, size_t error_bytes);

/* The bus as panels take it; it lives as long as `bus`. */
const yb_panel_bus_t *yb_gpiod_bus_panel(const yb_gpiod_bus_t *bus);

/* Why a transfer failed, in one sentence; "" while none has. */
const char *yb_gpiod_bus_error(const yb_gpiod_bus_t *bus);

/* Releases the lines and forgets the bus. NULL is allowed. */
void yb_gpiod_bus_close(yb_gpiod_bus_t *bus);

#endif
