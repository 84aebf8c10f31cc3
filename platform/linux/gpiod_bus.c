#define _POSIX_C_SOURCE 200809L /* nanosleep */

#include "gpiod_bus.h"

#include "gpiod_lines.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* The lines are taken in two groups so that a bit moves two lines and not five. */
enum {
    SCK,
    MOSI,
    WIRE_LINES
};
enum {
    CS,
    DC,
    RESET,
    CONTROL_LINES
};

enum {
    RESET_MS = 10, /* the panels so far ask for microseconds; level shifters may be slow */
};

struct yb_gpiod_bus {
    yb_gpiod_chip_t *chip;
    yb_gpiod_group_t *wire;
    yb_gpiod_group_t *control;
    int control_values[CONTROL_LINES];
    yb_panel_bus_t panel;
    char error[YB_GPIOD_ERROR_BYTES];
};

static bool transfer_failed(yb_gpiod_bus_t *bus, const char *what)
{
    snprintf(bus->error, sizeof bus->error, "the display could not be reached: setting %s: %s",
             what, strerror(errno));
    return false;
}

/* Mode 0: the display reads MOSI when the clock rises; the host changes it while it is low. */
static bool send_byte(yb_gpiod_bus_t *bus, uint8_t byte)
{
    for (unsigned bit = 0x80; bit != 0; bit >>= 1) {
        int values[WIRE_LINES] = {[SCK] = 0, [MOSI] = (byte & bit) != 0};
        if (!yb_gpiod_group_set(bus->wire, values))
            return false;
        values[SCK] = 1;
        if (!yb_gpiod_group_set(bus->wire, values))
            return false;
    }
    return true;
}

static bool set_control(yb_gpiod_bus_t *bus, int cs, int dc)
{
    bus->control_values[CS] = cs;
    bus->control_values[DC] = dc;
    return yb_gpiod_group_set(bus->control, bus->control_values);
}

static bool transfer(yb_gpiod_bus_t *bus, int dc, const uint8_t *bytes, size_t count)
{
    static const int idle[WIRE_LINES] = {0, 0};

    if (!set_control(bus, 0, dc))
        return transfer_failed(bus, "the chip-select and D/C lines");
    for (size_t i = 0; i < count; i++) {
        if (!send_byte(bus, bytes[i]))
            return transfer_failed(bus, "the clock and data lines");
    }
    /* Mode 0 rests with the clock low, and it must rest before the display is deselected. */
    if (!yb_gpiod_group_set(bus->wire, idle))
        return transfer_failed(bus, "the clock and data lines");
    if (!set_control(bus, 1, dc))
        return transfer_failed(bus, "the chip-select and D/C lines");
    return true;
}

static bool send_command(void *context, const uint8_t *bytes, size_t count)
{
    return transfer(context, 0, bytes, count);
}

static bool send_data(void *context, const uint8_t *bytes, size_t count)
{
    return transfer(context, 1, bytes, count);
}

static void wait_ms(void *context, uint32_t ms)
{
    struct timespec left = {.tv_sec = (time_t)(ms / 1000), .tv_nsec = (long)(ms % 1000) * 1000000};
    int status;

    (void)context;
    do
        status = nanosleep(&left, &left);
    while (status != 0 && errno == EINTR);
}

static bool pull_reset(void *context)
{
    yb_gpiod_bus_t *bus = context;

    for (int level = 0; level <= 1; level++) {
        bus->control_values[RESET] = level;
        if (!yb_gpiod_group_set(bus->control, bus->control_values))
            return transfer_failed(bus, "the reset line");
        wait_ms(bus, RESET_MS);
    }
    return true;
}

/* The kernel would call the second use "busy", and the user would look for another program. */
static bool all_different(const yb_gpiod_pins_t *pins, char *error, size_t error_bytes)
{
    const struct {
        const char *name;
        int line;
    } all[] = {{"sck", pins->sck},
               {"mosi", pins->mosi},
               {"cs", pins->cs},
               {"dc", pins->dc},
               {"reset", pins->reset}};

    for (size_t i = 1; i < sizeof all / sizeof all[0]; i++) {
        for (size_t j = 0; j < i; j++) {
            if (all[i].line == all[j].line) {
                snprintf(error, error_bytes, "line %d cannot be both %s and %s", all[i].line,
                         all[j].name, all[i].name);
                return false;
            }
        }
    }
    return true;
}

yb_gpiod_bus_t *yb_gpiod_bus_open(const yb_gpiod_pins_t *pins, char *error, size_t error_bytes)
{
    const int wire[WIRE_LINES] = {[SCK] = pins->sck, [MOSI] = pins->mosi};
    const int control[CONTROL_LINES] = {[CS] = pins->cs, [DC] = pins->dc, [RESET] = pins->reset};
    const int wire_values[WIRE_LINES] = {0, 0};
    const bool has_reset = pins->reset != YB_GPIOD_NOT_WIRED;

    if (!all_different(pins, error, error_bytes))
        return NULL;
    yb_gpiod_bus_t *bus = calloc(1, sizeof *bus);
    if (bus == NULL) {
        snprintf(error, error_bytes, "out of memory");
        return NULL;
    }
    bus->control_values[CS] = 1;
    bus->control_values[RESET] = 1;
    bus->chip = yb_gpiod_chip_open(pins->chip, error, error_bytes);
    if (bus->chip == NULL)
        goto free_bus;
    /* Control first: the display must be deselected before its clock line moves. */
    bus->control =
        yb_gpiod_group_take(bus->chip, control, bus->control_values,
                            has_reset ? CONTROL_LINES : CONTROL_LINES - 1, error, error_bytes);
    if (bus->control == NULL)
        goto close_chip;
    bus->wire = yb_gpiod_group_take(bus->chip, wire, wire_values, WIRE_LINES, error, error_bytes);
    if (bus->wire == NULL)
        goto free_control;

    bus->panel.context = bus;
    bus->panel.command = send_command;
    bus->panel.data = send_data;
    bus->panel.reset = has_reset ? pull_reset : NULL;
    bus->panel.wait_ms = wait_ms;
    return bus;

free_control:
    yb_gpiod_group_free(bus->control);
close_chip:
    yb_gpiod_chip_close(bus->chip);
free_bus:
    free(bus);
    return NULL;
}

const yb_panel_bus_t *yb_gpiod_bus_panel(const yb_gpiod_bus_t *bus)
{
    return &bus->panel;
}

const char *yb_gpiod_bus_error(const yb_gpiod_bus_t *bus)
{
    return bus->error;
}

void yb_gpiod_bus_close(yb_gpiod_bus_t *bus)
{
    if (bus == NULL)
        return;
    yb_gpiod_group_free(bus->wire);
    yb_gpiod_group_free(bus->control);
    yb_gpiod_chip_close(bus->chip);
    free(bus);
}
