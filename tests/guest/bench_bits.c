/* How fast the bus sends bit by bit, as a share of what libgpiod alone does on the same chip: the
 * bus may cost a fifth at most. Both are timed in short turns, one after the other, and the
 * shortest time of each counts: whatever else the machine does only makes turns longer. Runs in the
 * guest. */
#define _POSIX_C_SOURCE 200809L

#include "bare_lines.h"
#include "linux_bus.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    BYTES = 64, /* in a turn */
    TURNS = 60,
    ROUNDS = 5, /* a machine that is never left alone for one turn is asked again */
};

static double seconds(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec / 1e9;
}

/* Lowers the shortest times; false: something failed. */
static bool take_turns(const yb_panel_bus_t *bus, double *shortest_bus, double *shortest_bare)
{
    uint8_t bytes[BYTES];

    memset(bytes, 0x55, sizeof bytes);
    for (int turn = 0; turn < TURNS; turn++) {
        const double begin = seconds();
        if (!bus->data(bus->context, bytes, sizeof bytes))
            return false;
        const double middle = seconds();
        if (!bare_lines_send(8 * BYTES))
            return false;
        const double end = seconds();
        if (middle - begin < *shortest_bus)
            *shortest_bus = middle - begin;
        if (end - middle < *shortest_bare)
            *shortest_bare = end - middle;
    }
    return true;
}

int main(int argc, char **argv)
{
    char error[YB_LINUX_ERROR_BYTES];
    double bus_s = 1e9;
    double bare_s = 1e9;
    int status = 1;

    if (argc != 2) {
        fputs("bench_bits /dev/gpiochipN\n", stderr);
        return 2;
    }
    const yb_linux_wiring_t wiring = {
        .chip = argv[1], .sck = "0", .mosi = "1", .cs = "2", .dc = "3"};
    yb_linux_bus_t *bus = yb_linux_bus_open(&wiring, &yb_panel_ssd1306, error);
    if (bus == NULL || !bare_lines_take(argv[1], 4, 9)) {
        fprintf(stderr, "bench_bits: %s\n", bus == NULL ? error : "the lines cannot be had");
        goto close_bus;
    }
    for (int round = 0; round < ROUNDS && status != 0; round++) {
        if (!take_turns(yb_linux_bus_panel(bus), &bus_s, &bare_s)) {
            fputs("bench_bits: setting lines failed\n", stderr);
            goto close_bus;
        }
        status = bare_s / bus_s >= 0.8 ? 0 : 1;
    }
    printf("%.0f clock edges a second, %.0f bytes; libgpiod alone makes %.0f edges: %.0f %%\n",
           16 * BYTES / bus_s, BYTES / bus_s, 16 * BYTES / bare_s, 100 * bare_s / bus_s);
    if (status != 0)
        fputs("bench_bits: the bus costs more than a fifth\n", stderr);
close_bus:
    yb_linux_bus_close(bus);
    return status;
}
