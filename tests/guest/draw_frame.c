/* draw_frame CHIP SCK MOSI CS DC RESET FRAME
 *
 * Draws one frame of noise on an SSD0323 on these GPIO lines, in bands and
 * then one window again, and leaves the frame in the file FRAME. */
#include "gpiod_bus.h"

#include <stdio.h>
#include <stdlib.h>

enum {
    WIDTH = 128,
    HEIGHT = 64,
    ROW_BYTES = WIDTH / 2,
    BAND_ROWS = 24
};

static int write_frame(const char *path, const uint8_t *frame, size_t bytes)
{
    FILE *file = fopen(path, "wb");

    if (file == NULL || fwrite(frame, 1, bytes, file) != bytes || fclose(file) != 0) {
        perror(path);
        return 1;
    }
    return 0;
}

static bool draw(yb_display_t *display, uint8_t *frame)
{
    const yb_panel_window_t window = {.x = 30,
                                      .y = 11,
                                      .width = 34,
                                      .rows = 17,
                                      .pixels = frame + 11 * ROW_BYTES + 15,
                                      .pitch_bytes = ROW_BYTES};

    if (!yb_display_start(display))
        return false;
    for (unsigned y = 0; y < HEIGHT; y += BAND_ROWS) {
        const unsigned rows = HEIGHT - y < BAND_ROWS ? HEIGHT - y : BAND_ROWS;
        if (!yb_display_write_rows(display, (uint16_t)y, (uint16_t)rows, frame + y * ROW_BYTES))
            return false;
    }
    for (int row = 11; row < 28; row++) {
        for (int i = 15; i < 32; i++)
            frame[row * ROW_BYTES + i] ^= 0xFF;
    }
    return yb_display_write(display, &window);
}

static int line_number(const char *text)
{
    return (int)strtol(text, NULL, 10);
}

int main(int argc, char **argv)
{
    static uint8_t frame[ROW_BYTES * HEIGHT];
    char error[YB_GPIOD_ERROR_BYTES];
    uint32_t noise = 20;

    if (argc != 8) {
        fputs("draw_frame CHIP SCK MOSI CS DC RESET FRAME\n", stderr);
        return 2;
    }
    for (size_t i = 0; i < sizeof frame; i++) {
        noise = noise * 1664525U + 1013904223U;
        frame[i] = (uint8_t)(noise >> 24);
    }
    const yb_gpiod_pins_t pins = {.chip = argv[1],
                                  .sck = line_number(argv[2]),
                                  .mosi = line_number(argv[3]),
                                  .cs = line_number(argv[4]),
                                  .dc = line_number(argv[5]),
                                  .reset = line_number(argv[6])};
    yb_gpiod_bus_t *bus = yb_gpiod_bus_open(&pins, error, sizeof error);
    if (bus == NULL) {
        fprintf(stderr, "draw_frame: %s\n", error);
        return 1;
    }
    yb_display_t display = {.panel = &yb_panel_ssd0323, .bus = yb_gpiod_bus_panel(bus)};
    const bool drawn = draw(&display, frame);
    if (!drawn)
        fprintf(stderr, "draw_frame: %s\n", yb_gpiod_bus_error(bus));
    yb_gpiod_bus_close(bus);
    return drawn ? write_frame(argv[7], frame, sizeof frame) : 1;
}
