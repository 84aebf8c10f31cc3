#define _XOPEN_SOURCE 700 /* setitimer */

/* draw_frame PANEL FRAME NAME=VALUE...
 *
 * Draws one frame of noise on a panel in bands, and then one window again, and leaves the frame in
 * the file FRAME, a PNG. How the panel is wired is told by the names of yb_linux_wiring_t: spi,
 * spi_hz, chip, sck, mosi, cs, dc, reset, backlight; and turn=90 turns it. Signals come all the
 * time, as a program with timers or children has them. */
#include "linux_bus.h"

#include <png.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>

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

static unsigned spread(unsigned value, unsigned bits)
{
    return value << (8 - bits) | value >> (2 * bits - 8);
}

static void pixel_rgb(yb_format_t format, const uint8_t *row, unsigned x, uint8_t rgb[3])
{
    if (format == YB_RGB565) {
        const unsigned value = (unsigned)row[2 * x] << 8 | row[2 * x + 1];
        rgb[0] = (uint8_t)spread(value >> 11, 5);
        rgb[1] = (uint8_t)spread(value >> 5 & 63, 6);
        rgb[2] = (uint8_t)spread(value & 31, 5);
        return;
    }
    const unsigned level = format == YB_GREY4 ? 17U * (row[x / 2] >> (x % 2 == 0 ? 4 : 0) & 15U)
                                              : 255U * (row[x / 8] >> (7 - x % 8) & 1U);
    memset(rgb, (int)level, 3);
}

static int write_png(const char *path, const yb_screen_t *screen, const uint8_t *frame)
{
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .format = PNG_FORMAT_RGB,
                       .width = screen->width,
                       .height = screen->height};
    uint8_t *rgb = malloc(PNG_IMAGE_SIZE(image));

    if (rgb == NULL)
        return 1;
    for (size_t y = 0; y < screen->height; y++) {
        for (unsigned x = 0; x < screen->width; x++)
            pixel_rgb(screen->format, frame + y * yb_screen_pitch(screen), x,
                      rgb + 3 * (y * screen->width + x));
    }
    const int written = png_image_write_to_file(&image, path, 0, rgb, 0, NULL);
    if (!written)
        fprintf(stderr, "%s: %s\n", path, image.message);
    free(rgb);
    return written ? 0 : 1;
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

static void tick(int number)
{
    (void)number;
}

static void have_signals(void)
{
    const struct sigaction action = {.sa_handler = tick}; /* no SA_RESTART */
    const struct itimerval often = {{0, 2000}, {0, 2000}};

    sigaction(SIGALRM, &action, NULL);
    setitimer(ITIMER_REAL, &often, NULL);
}

static int run(const yb_linux_wiring_t *wiring, const yb_panel_t *panel, yb_turn_t turn,
               const char *path)
{
    char error[YB_LINUX_ERROR_BYTES];
    yb_display_t display = {.panel = panel, .turn = turn};
    const yb_screen_t screen = yb_display_screen(&display);
    const size_t bytes = yb_screen_pitch(&screen) * screen.height;
    uint8_t *frame = malloc(bytes);
    uint32_t noise = 20;
    int status = 1;

    if (frame == NULL)
        return 1;
    for (size_t i = 0; i < bytes; i++) {
        noise = noise * 1664525U + 1013904223U;
        frame[i] = (uint8_t)(noise >> 24);
    }
    yb_linux_bus_t *bus = yb_linux_bus_open(wiring, panel, error);
    if (bus == NULL) {
        fprintf(stderr, "draw_frame: %s\n", error);
        goto free_frame;
    }
    have_signals();
    display.bus = yb_linux_bus_panel(bus);
    if (draw(&display, frame) && yb_linux_bus_backlight(bus, true))
        status = write_png(path, &screen, frame);
    else
        fprintf(stderr, "draw_frame: %s\n", yb_linux_bus_error(bus));
    printf("%s: %llu bytes sent\n", panel->name, (unsigned long long)yb_linux_bus_bytes(bus));
    yb_linux_bus_close(bus);
free_frame:
    free(frame);
    return status;
}

int main(int argc, char **argv)
{
    yb_linux_wiring_t wiring = {.spi = NULL};
    unsigned long turn = 0;

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
        if (strncmp(argv[i], "turn=", 5) == 0)
            turn = strtoul(argv[i] + 5, NULL, 10);
        else if (!take_argument(&wiring, argv[i]))
            return 2;
    }
    return run(&wiring, panel, (yb_turn_t)(turn / 90), argv[2]);
}
