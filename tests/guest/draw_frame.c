/* draw_frame PANEL FRAME NAME=VALUE...
 *
 * Draws one frame of noise on a panel in bands, and then one window again, and leaves the frame in
 * the file FRAME, in the panel's own format. How the panel is wired is told by the names of
 * yb_linux_wiring_t: spi, spi_hz, chip, sck, mosi, cs, dc, reset, backlight. */
#include "linux_bus.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    BAND_ROWS = 24, /* a multiple of every panel's step */
};

static bool take_argument(yb_linux_wiring_t *wiring, const char *argument)
{
    const struct {
        const char *name;
        const char **value;
    } names[] = {{"spi=", &wiring->spi},     {"chip=", &wiring->chip},
                 {"sck=", &wiring->sck},     {"mosi=", &wiring->mosi},
                 {"cs=", &wiring->cs},       {"dc=", &wiring->dc},
                 {"reset=", &wiring->reset}, {"backlight=", &wiring->backlight}};

    if (strncmp(argument, "spi_hz=", 7) == 0) {
        wiring->spi_hz = (uint32_t)strtoul(argument + 7, NULL, 10);
        return true;
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const size_t length = strlen(names[i].name);
        if (strncmp(argument, names[i].name, length) == 0) {
            *names[i].value = argument + length;
            return true;
        }
    }
    fprintf(stderr, "draw_frame: there is no \"%s\" in a wiring\n", argument);
    return false;
}

static int write_frame(const char *path, const uint8_t *frame, size_t bytes)
{
    FILE *file = fopen(path, "wb");

    if (file == NULL || fwrite(frame, 1, bytes, file) != bytes || fclose(file) != 0) {
        perror(path);
        return 1;
    }
    return 0;
}

static unsigned bits_of(yb_format_t format)
{
    return format == YB_MONO ? 1 : format == YB_GREY4 ? 4 : 16;
}

/* The middle third of a stretch, on its steps; all of it where that is none. */
static void middle(uint16_t size, unsigned step, uint16_t *from, uint16_t *length)
{
    *length = (uint16_t)(size / 3 / step * step);
    *from = (uint16_t)(*length != 0 ? size / 3 / step * step : 0);
    if (*length == 0)
        *length = size;
}

/* The window differs from what is on the glass in every bit. */
static bool draw_window(yb_display_t *display, uint8_t *frame)
{
    const yb_screen_t screen = yb_display_screen(display);
    const size_t pitch = yb_screen_pitch(&screen);
    const unsigned bits = bits_of(screen.format);
    unsigned step = yb_display_x_step(display);
    yb_panel_window_t window = {.pitch_bytes = pitch};

    while (step * bits % 8 != 0)
        step *= 2;
    middle(screen.width, step, &window.x, &window.width);
    middle(screen.height, yb_display_y_step(display), &window.y, &window.rows);
    uint8_t *pixels = frame + window.y * pitch + window.x * bits / 8;
    for (size_t row = 0; row < window.rows; row++) {
        for (size_t i = 0; i < window.width * bits / 8; i++)
            pixels[row * pitch + i] ^= 0xFF;
    }
    window.pixels = pixels;
    return yb_display_write(display, &window);
}

static bool draw(yb_display_t *display, uint8_t *frame)
{
    const yb_screen_t screen = yb_display_screen(display);
    const size_t pitch = yb_screen_pitch(&screen);

    if (!yb_display_start(display))
        return false;
    for (unsigned y = 0; y < screen.height; y += BAND_ROWS) {
        const unsigned rows = screen.height - y < BAND_ROWS ? screen.height - y : BAND_ROWS;
        if (!yb_display_write_rows(display, (uint16_t)y, (uint16_t)rows, frame + y * pitch))
            return false;
    }
    return draw_window(display, frame) && yb_display_finish(display);
}

int main(int argc, char **argv)
{
    char error[YB_LINUX_ERROR_BYTES];
    yb_linux_wiring_t wiring = {.spi = NULL};
    uint32_t noise = 20;
    int status = 1;

    if (argc < 3) {
        fputs("draw_frame PANEL FRAME NAME=VALUE...\n", stderr);
        return 2;
    }
    const yb_panel_t *panel = yb_panel_find(argv[1]);
    if (panel == NULL) {
        fprintf(stderr, "draw_frame: there is no panel \"%s\"\n", argv[1]);
        return 2;
    }
    for (int i = 3; i < argc; i++) {
        if (!take_argument(&wiring, argv[i]))
            return 2;
    }
    const size_t bytes = yb_screen_pitch(&panel->screen) * panel->screen.height;
    uint8_t *frame = malloc(bytes);
    if (frame == NULL)
        return 1;
    for (size_t i = 0; i < bytes; i++) {
        noise = noise * 1664525U + 1013904223U;
        frame[i] = (uint8_t)(noise >> 24);
    }
    yb_linux_bus_t *bus = yb_linux_bus_open(&wiring, panel, error);
    if (bus == NULL) {
        fprintf(stderr, "draw_frame: %s\n", error);
        goto free_frame;
    }
    yb_display_t display = {.panel = panel, .bus = yb_linux_bus_panel(bus)};
    if (draw(&display, frame) && yb_linux_bus_backlight(bus, true))
        status = write_frame(argv[2], frame, bytes);
    else
        fprintf(stderr, "draw_frame: %s\n", yb_linux_bus_error(bus));
    printf("%s: %llu bytes sent\n", panel->name, (unsigned long long)yb_linux_bus_bytes(bus));
    yb_linux_bus_close(bus);
free_frame:
    free(frame);
    return status;
}
