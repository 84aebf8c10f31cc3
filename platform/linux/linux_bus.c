#define _POSIX_C_SOURCE 200809L /* nanosleep */

#include "linux_bus.h"

#include "linux_lines.h"
#include "wire.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    SCK,
    MOSI,
    CS,
    DC,
    RESET,
    BACKLIGHT,
    LINES
};

enum {
    FIRST_CONTROL = DC,
    CONTROLS = LINES - FIRST_CONTROL,
    RESET_MS = 10, /* panels ask for microseconds; level shifters may be slow */
};

struct yb_linux_bus {
    yb_gpiod_chip_t *chip; /* NULL: no line is wired */
    yb_wire_t *wire;
    yb_gpiod_group_t *control; /* D/C, reset and backlight, those that are wired, in this order */
    int values[CONTROLS];      /* the levels of those in the group */
    int place[LINES];          /* of a control line in the group; -1: not wired */
    _Atomic uint64_t bytes;    /* asked for while another thread sends */
    yb_panel_bus_t panel;
    char error[YB_LINUX_ERROR_BYTES];
};

bool yb_wire_failed(const char *device, const char *doing, int why, char *error)
{
    if (why == ENODEV || why == ESHUTDOWN)
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "the display could not be reached: %s is gone; was it unplugged?", device);
    else
        snprintf(error, YB_LINUX_ERROR_BYTES, "the display could not be reached: %s of %s: %s",
                 doing, device, strerror(why));
    return false;
}

/* ---- What panels call ------------------------------------------------------------------------ */

static bool set_control(yb_linux_bus_t *bus, int line, int value, const char *doing)
{
    if (bus->place[line] < 0 || bus->values[bus->place[line]] == value)
        return true;
    bus->values[bus->place[line]] = value;
    if (yb_gpiod_group_set(bus->control, bus->values))
        return true;
    bus->values[bus->place[line]] = !value; /* so that the next call tries again */
    return yb_wire_failed(yb_gpiod_chip_name(bus->chip), doing, errno, bus->error);
}

static bool transfer(yb_linux_bus_t *bus, int dc, const uint8_t *bytes, size_t count)
{
    if (!set_control(bus, DC, dc, "setting the D/C line") ||
        !bus->wire->send(bus->wire, bytes, count, bus->error))
        return false;
    bus->bytes += count;
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
    yb_linux_bus_t *bus = context;

    for (int level = 0; level <= 1; level++) {
        if (!set_control(bus, RESET, level, "setting the reset line"))
            return false;
        wait_ms(bus, RESET_MS);
    }
    return true;
}

/* ---- Opening --------------------------------------------------------------------------------- */

static bool refuse(char *error, const char *format, const char *panel, const char *line)
{
    snprintf(error, YB_LINUX_ERROR_BYTES, format, panel, line);
    return false;
}

/* Whether those lines are named that panel and bus need, and no other. */
static bool check_wiring(const yb_linux_wiring_t *wiring, const yb_panel_t *panel,
                         const yb_line_t lines[LINES], char *error)
{
    const bool has_dc = (panel->flags & YB_PANEL_NO_DC) == 0;

    for (int i = SCK; i <= CS; i++) {
        if (wiring->spi == NULL && lines[i].name == NULL)
            return refuse(error, "%s, bit by bit, needs the line %s; name it, or an SPI device",
                          panel->name, lines[i].role);
        if (wiring->spi != NULL && lines[i].name != NULL)
            return refuse(error, "%s has a line %s of its own; leave that out", wiring->spi,
                          lines[i].role);
    }
    if (has_dc && wiring->dc == NULL)
        return refuse(error, "%s needs the line %s, which tells data from commands; name it",
                      panel->name, lines[DC].role);
    if (!has_dc && wiring->dc != NULL)
        return refuse(error, "%s has no line %s; leave it out", panel->name, lines[DC].role);
    return true;
}

static bool take_control(yb_linux_bus_t *bus, const yb_line_t lines[LINES], char *error)
{
    static const int at_first[LINES] = {[DC] = 0, [RESET] = 1, [BACKLIGHT] = 0};
    unsigned numbers[CONTROLS];
    int count = 0;

    for (int i = FIRST_CONTROL; i < LINES; i++) {
        bus->place[i] = -1;
        if (lines[i].name == NULL)
            continue;
        bus->place[i] = count;
        bus->values[count] = at_first[i];
        numbers[count++] = lines[i].number;
    }
    if (count == 0)
        return true;
    bus->control = yb_lines_take_outputs(bus->chip, numbers, bus->values, (size_t)count, error);
    return bus->control != NULL;
}

static bool open_all(yb_linux_bus_t *bus, const yb_linux_wiring_t *wiring, const yb_panel_t *panel,
                     char *error)
{
    const bool select_high = (panel->flags & YB_PANEL_SELECT_HIGH) != 0;
    bool any_line = false;
    yb_line_t lines[LINES] = {
        [SCK] = {"sck", wiring->sck, 0},       [MOSI] = {"mosi", wiring->mosi, 0},
        [CS] = {"cs", wiring->cs, 0},          [DC] = {"dc", wiring->dc, 0},
        [RESET] = {"reset", wiring->reset, 0}, [BACKLIGHT] = {"backlight", wiring->backlight, 0}};

    if (!check_wiring(wiring, panel, lines, error))
        return false;
    for (int i = 0; i < LINES; i++)
        any_line = any_line || lines[i].name != NULL;
    if (any_line) {
        bus->chip = yb_lines_chip(wiring->chip, error);
        if (bus->chip == NULL || !yb_lines_find(bus->chip, lines, LINES, error))
            return false;
    }
    if (wiring->spi != NULL)
        bus->wire =
            yb_wire_spidev_open(wiring->spi, wiring->spi_hz != 0 ? wiring->spi_hz : panel->spi_hz,
                                select_high, (panel->flags & YB_PANEL_NO_DC) != 0, error);
    else
        bus->wire = yb_wire_gpiod_open(bus->chip, lines[SCK].number, lines[MOSI].number,
                                       lines[CS].number, select_high, error);
    return bus->wire != NULL && take_control(bus, lines, error);
}

yb_linux_bus_t *yb_linux_bus_open(const yb_linux_wiring_t *wiring, const yb_panel_t *panel,
                                  char *error)
{
    yb_linux_bus_t *bus = calloc(1, sizeof *bus);

    if (bus == NULL) {
        snprintf(error, YB_LINUX_ERROR_BYTES, "out of memory");
        return NULL;
    }
    if (!open_all(bus, wiring, panel, error)) {
        yb_linux_bus_close(bus);
        return NULL;
    }
    bus->panel.context = bus;
    bus->panel.command = send_command;
    bus->panel.data = send_data;
    bus->panel.reset = wiring->reset != NULL ? pull_reset : NULL;
    bus->panel.wait_ms = wait_ms;
    return bus;
}

const yb_panel_bus_t *yb_linux_bus_panel(const yb_linux_bus_t *bus)
{
    return &bus->panel;
}

bool yb_linux_bus_backlight(yb_linux_bus_t *bus, bool lit)
{
    return set_control(bus, BACKLIGHT, lit, "setting the backlight line");
}

uint64_t yb_linux_bus_bytes(const yb_linux_bus_t *bus)
{
    return bus->bytes;
}

const char *yb_linux_bus_error(const yb_linux_bus_t *bus)
{
    return bus->error;
}

void yb_linux_bus_close(yb_linux_bus_t *bus)
{
    if (bus == NULL)
        return;
    if (bus->wire != NULL)
        bus->wire->close(bus->wire);
    yb_gpiod_group_free(bus->control);
    yb_gpiod_chip_close(bus->chip);
    free(bus);
}
