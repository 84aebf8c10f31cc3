/* The serial wires of a display: clock, data and chip select, whoever moves them. D/C and reset are
 * the bus's (linux_bus.c). `error` has YB_LINUX_ERROR_BYTES throughout. */
#ifndef YB_WIRE_H
#define YB_WIRE_H

#include "gpiod_lines.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct yb_wire yb_wire_t;

struct yb_wire {
    /* Selects the display, sends the bytes in SPI mode 0, deselects it. False: one sentence. */
    bool (*send)(yb_wire_t *wire, const uint8_t *bytes, size_t count, char *error);
    void (*close)(yb_wire_t *wire);
};

/* Bit by bit on lines of the chip, which must stay open. NULL with one sentence. */
yb_wire_t *yb_wire_gpiod_open(yb_gpiod_chip_t *chip, unsigned sck, unsigned mosi, unsigned cs,
                              bool select_high, char *error);

/* By the kernel's spidev device of that path. `whole`: the display must stay selected from the
 * first byte of a send to the last, or it would take it for two. NULL with one sentence. */
yb_wire_t *yb_wire_spidev_open(const char *path, uint32_t hz, bool select_high, bool whole,
                               char *error);

/* Says in the display's sentence why a device of Linux failed: errno `why`, while `doing`. */
bool yb_wire_failed(const char *device, const char *doing, int why, char *error);

#endif
