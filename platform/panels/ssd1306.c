/* Solomon SSD1306 with glasses of 128 x 64 and 128 x 32 pixels: lit or not.
 *
 * "Datasheet" is Solomon Systech's SSD1306, revision 1.1; its sections are named. Commands and
 * their arguments both go with D/C low (Datasheet, "MPU Serial Interface (4-wire SPI)"); D/C high
 * is display RAM alone. A byte of that is a column of eight pixels, the lowest bit on top, where
 * the engine's is a row of eight with the highest bit on the left: the driver turns blocks of 8 x 8
 * over, and windows begin and end on them.
 */
#include "panel_driver.h"

#include <string.h>

enum {
    WIDTH = 128,
    BLOCK = 8,

    SET_ADDRESSING_MODE = 0x20,
    SET_COLUMN_ADDRESS = 0x21,
    SET_PAGE_ADDRESS = 0x22,
    STOP_SCROLL = 0x2E,
    SET_START_LINE_0 = 0x40,
    SET_CONTRAST = 0x81,
    SET_CHARGE_PUMP = 0x8D,
    SET_SEGMENTS_FORWARD = 0xA0,
    SET_SEGMENTS_BACKWARD = 0xA1,
    SHOW_RAM = 0xA4,
    SET_NORMAL = 0xA6,
    SET_INVERSE = 0xA7,
    SET_MULTIPLEX_RATIO = 0xA8,
    SET_DISPLAY_OFF = 0xAE,
    SET_DISPLAY_ON = 0xAF,
    SET_ROWS_FORWARD = 0xC0,
    SET_ROWS_BACKWARD = 0xC8,
    SET_OFFSET = 0xD3,
    SET_CLOCK = 0xD5,
    SET_PRECHARGE = 0xD9,
    SET_COM_PINS = 0xDA,
    SET_VCOMH = 0xDB,

    CONTRAST_AT = 2, /* where a glass's table has its rated contrast */
};

/* clang-format off */
/* Each line: how many arguments, the command, the arguments. First what all glasses share. */
static const uint8_t chip_setup[] = {
    /* Datasheet, "Set Display ON/OFF": nothing is shown while the registers change. */
    0, SET_DISPLAY_OFF,
    /* "Set Display Clock Divide Ratio / Oscillator Frequency": fastest, undivided: with the 66 clocks
     * a row of the precharge below, about 100 frames a second, so nothing flickers in motion. */
    1, SET_CLOCK, 0xF0,
    /* "Set Display Offset", "Set Display Start Line", "Deactivate Scroll": row 0 on top, at rest. */
    1, SET_OFFSET, 0,
    0, SET_START_LINE_0,
    0, STOP_SCROLL,
    /* "Set Memory Addressing Mode": horizontal, so that a window fills from left to right. */
    1, SET_ADDRESSING_MODE, 0,
    /* Application note, "Charge Pump Setting": the chip makes the glass's supply, and precharge of
     * 1 and 15 clocks and 0.77 of the supply at VCOMH go with that. */
    1, SET_CHARGE_PUMP, 0x14,
    1, SET_PRECHARGE, 0xF1,
    1, SET_VCOMH, 0x20,
    /* "Entire Display ON", "Set Normal/Inverse Display": the RAM as it is. */
    0, SHOW_RAM,
    0, SET_NORMAL,
};

/* Then the glass: "Set Contrast Control" (fewer rows are lit longer, so less will do), "Set Multiplex
 * Ratio", "Set COM Pins Hardware Configuration" (rows alternate between both sides of the glass, or
 * do not). */
static const uint8_t setup[] = {
    1, SET_CONTRAST, 0xCF,
    1, SET_MULTIPLEX_RATIO, 63,
    1, SET_COM_PINS, 0x12,
};

static const uint8_t setup_128x32[] = {
    1, SET_CONTRAST, 0x8F,
    1, SET_MULTIPLEX_RATIO, 31,
    1, SET_COM_PINS, 0x02,
};
/* clang-format on */

static bool set_window(const yb_display_t *display, uint16_t x, uint16_t y, uint16_t width,
                       uint16_t rows)
{
    const yb_panel_bus_t *bus = display->bus;
    const uint8_t bytes[] = {
        SET_COLUMN_ADDRESS, (uint8_t)x,           (uint8_t)(x + width - 1),
        SET_PAGE_ADDRESS,   (uint8_t)(y / BLOCK), (uint8_t)((y + rows) / BLOCK - 1),
    };
    return bus->command(bus->context, bytes, sizeof bytes);
}

static bool ssd1306_sleep(yb_display_t *display, bool asleep)
{
    return yb_panel_send(display, asleep ? SET_DISPLAY_OFF : SET_DISPLAY_ON, NULL, 0, false);
}

static bool ssd1306_start(yb_display_t *display)
{
    const yb_panel_t *panel = display->panel;
    /* Datasheet, "Set Segment Re-map", "Set COM Output Scan Direction": glasses are bonded upside
     * down, so the unturned picture runs backwards both ways. */
    static const uint8_t turn[2][2] = {{SET_SEGMENTS_BACKWARD, SET_ROWS_BACKWARD},
                                       {SET_SEGMENTS_FORWARD, SET_ROWS_FORWARD}};

    /* Display RAM holds noise when the supply comes up, and is blackened before it can be seen. */
    return yb_panel_run(display, chip_setup, sizeof chip_setup, false) &&
           yb_panel_run(display, panel->setup, panel->setup_bytes, false) &&
           display->bus->command(display->bus->context, turn[display->turn == YB_TURN_180], 2) &&
           set_window(display, 0, 0, WIDTH, panel->screen.height) &&
           yb_panel_send_black(display, (uint32_t)(WIDTH / BLOCK) * panel->screen.height) &&
           ssd1306_sleep(display, false);
}

/* Turns a block over: eight rows, the leftmost pixel in the highest bit, into eight columns, the
 * top pixel in the lowest bit. Each row shifts its pixels in at the columns' lower ends, pushing up
 * those of the rows before. */
static void turn_block_over(const uint8_t *rows, size_t pitch_bytes, uint8_t columns[BLOCK])
{
    memset(columns, 0, BLOCK);
    for (uint8_t left = BLOCK; left > 0; left--) {
        uint8_t pixels = *rows;
        for (uint8_t column = BLOCK; column-- > 0;) {
            columns[column] = (uint8_t)(columns[column] >> 1 | (pixels << 7 & 0x80));
            pixels >>= 1;
        }
        rows += pitch_bytes;
    }
}

static bool ssd1306_write(yb_display_t *display, const yb_panel_window_t *window)
{
    const yb_panel_bus_t *bus = display->bus;
    const uint8_t *rows = window->pixels;
    const uint16_t first = window->x % BLOCK;
    uint8_t columns[WIDTH + BLOCK];

    if (!set_window(display, window->x, window->y, window->width, window->rows))
        return false;
    for (uint16_t row = 0; row < window->rows; row += BLOCK) {
        for (uint16_t x = 0; x < first + window->width; x += BLOCK)
            turn_block_over(rows + x / BLOCK, window->pitch_bytes, columns + x);
        if (!bus->data(bus->context, columns + first, window->width))
            return false;
        rows += BLOCK * window->pitch_bytes;
    }
    return true;
}

static bool ssd1306_invert(yb_display_t *display, bool inverted)
{
    return yb_panel_send(display, inverted ? SET_INVERSE : SET_NORMAL, NULL, 0, false);
}

static bool ssd1306_brightness(yb_display_t *display, uint8_t level)
{
    const uint8_t contrast = yb_panel_level(level, display->panel->setup[CONTRAST_AT]);
    return yb_panel_send(display, SET_CONTRAST, &contrast, 1, false);
}

static const yb_panel_driver_t driver = {
    .start = ssd1306_start,
    .write = ssd1306_write,
    .sleep = ssd1306_sleep,
    .invert = ssd1306_invert,
    .brightness = ssd1306_brightness,
};

const yb_panel_t yb_panel_ssd1306 = {
    .name = "ssd1306",
    .title = "Solomon SSD1306, 128 x 64 OLED",
    .driver = &driver,
    .screen = {.width = WIDTH, .height = 64, .format = YB_MONO},
    /* Datasheet, "4-wire Serial Interface Timing Characteristics": a cycle of 100 ns or more. */
    .spi_hz = 10000000,
    .ram_width = WIDTH,
    .ram_height = 64,
    .turns = 1 << YB_TURN_0 | 1 << YB_TURN_180,
    .x_step = 1,
    .y_step = BLOCK,
    .window_bytes = 6,
    .setup = setup,
    .setup_bytes = sizeof setup,
};

const yb_panel_t yb_panel_ssd1306_128x32 = {
    .name = "ssd1306-128x32",
    .title = "Solomon SSD1306, 128 x 32 OLED",
    .driver = &driver,
    .screen = {.width = WIDTH, .height = 32, .format = YB_MONO},
    .spi_hz = 10000000,
    .ram_width = WIDTH,
    .ram_height = 64,
    .turns = 1 << YB_TURN_0 | 1 << YB_TURN_180,
    .x_step = 1,
    .y_step = BLOCK,
    .window_bytes = 6,
    .setup = setup_128x32,
    .setup_bytes = sizeof setup_128x32,
};
