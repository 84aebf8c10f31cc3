/* A panel's bus on a Linux machine: an SPI device of the kernel (spidev), or SPI mode 0 bit by bit
 * on any GPIO lines; D/C, reset and backlight are GPIO lines in both cases, over libgpiod 1 or 2.
 *
 *     char why[YB_LINUX_ERROR_BYTES];
 *     const yb_linux_wiring_t wiring = {.spi = "/dev/spidev0.0", .dc = "25", .reset = "GPIO24"};
 *     yb_linux_bus_t *bus = yb_linux_bus_open(&wiring, &yb_panel_st7789, why);
 *     if (bus == NULL)
 *         die(why);
 *     yb_display_t display = {.panel = &yb_panel_st7789, .bus = yb_linux_bus_panel(bus)};
 *     if (!yb_display_start(&display))
 *         die(yb_linux_bus_error(bus));
 *     yb_linux_bus_close(bus);
 *
 * A line is named by its number on the chip or by its name, as gpioinfo shows them. Bit by bit each
 * bit costs two system calls: it always works and is not fast. A bus is one thread's at a time, and
 * signals do not disturb it. Lines are held exclusively from open to close; a spidev device is kept
 * from others who open it so.
 */
#ifndef YB_LINUX_BUS_H
#define YB_LINUX_BUS_H

#include "panel.h"

enum {
    YB_LINUX_ERROR_BYTES = 240,
};

typedef struct {
    const char *spi;  /* a spidev device; NULL: bit by bit on sck, mosi and cs */
    uint32_t spi_hz;  /* spidev's clock; 0: the panel's rated one */
    const char *chip; /* GPIO chip of the lines: name, number, path or label; NULL: gpiochip0 */
    const char *sck;  /* these three NULL with spidev, which has them itself */
    const char *mosi;
    const char *cs;        /* its active level is the panel's */
    const char *dc;        /* NULL for panels that have none */
    const char *reset;     /* NULL: not wired */
    const char *backlight; /* high is lit; NULL: not wired */
} yb_linux_wiring_t;

typedef struct yb_linux_bus yb_linux_bus_t;

/* Takes lines and device, with the display not selected and its backlight off. NULL when that
 * failed, and then `error` (YB_LINUX_ERROR_BYTES) has one sentence that says why: no such chip,
 * line or device, a line that somebody holds and who, no permission and which group has it, mode,
 * clock or level of the chip select refused, one line named twice, a line that the panel needs and
 * that is not named, or one that it has not. */
yb_linux_bus_t *yb_linux_bus_open(const yb_linux_wiring_t *wiring, const yb_panel_t *panel,
                                  char *error);

/* The bus as panels take it; it lives as long as `bus`. */
const yb_panel_bus_t *yb_linux_bus_panel(const yb_linux_bus_t *bus);

/* Switches the backlight; true where it is not wired. */
bool yb_linux_bus_backlight(yb_linux_bus_t *bus, bool lit);

/* Bytes sent since it was opened. */
uint64_t yb_linux_bus_bytes(const yb_linux_bus_t *bus);

/* Why a transfer failed, in one sentence; "" while none has. */
const char *yb_linux_bus_error(const yb_linux_bus_t *bus);

/* Releases the lines and the device and forgets the bus. NULL is allowed. */
void yb_linux_bus_close(yb_linux_bus_t *bus);

#endif
