/* Solomon SSD1351 with glasses of 128 x 128 and 128 x 96 pixels: OLEDs in colour.
 *
 * "Datasheet" is Solomon Systech's SSD1351, revision 1.5; its sections are named. Unlike its older
 * relatives the chip takes a command's arguments with D/C high (Datasheet, "MPU Serial Interface
 * (4-wire SPI)").
 *
 * Turns: "Set Re-map / Dual COM Line Mode" can run columns and rows either way, and fill a window
 * column by column. Its addresses are the glass's columns and rows all the same, so that a picture
 * that lies across has its x counted by rows.
 */
#include "panel_driver.h"

enum {
    WIDTH = 128,

    SET_COLUMNS = 0x15,
    WRITE_RAM = 0x5C,
    SET_ROWS = 0x75,
    SET_REMAP = 0xA0,
    SET_START_LINE = 0xA1,
    SET_OFFSET = 0xA2,
    SET_NORMAL = 0xA6,
    SET_INVERSE = 0xA7,
    SET_FUNCTION = 0xAB,
    SET_SLEEP_ON = 0xAE,
    SET_SLEEP_OFF = 0xAF,
    SET_PHASE_LENGTH = 0xB1,
    SET_ENHANCEMENT = 0xB2,
    SET_CLOCK = 0xB3,
    SET_VSL = 0xB4,
    SET_GPIO = 0xB5,
    SET_PRECHARGE_PERIOD = 0xB6,
    SET_LINEAR_GREYS = 0xB9,
    SET_PRECHARGE_VOLTAGE = 0xBB,
    SET_VCOMH = 0xBE,
    SET_CONTRAST = 0xC1,
    SET_MASTER_CURRENT = 0xC7,
    SET_MULTIPLEX_RATIO = 0xCA,
    SET_LOCK = 0xFD,

    REMAP_DOWNWARDS = 0x01, /* a window fills column by column */
    REMAP_COLUMNS = 0x02,   /* columns run from right to left */
    REMAP_COLOURS = 0x04,   /* red comes first */
    REMAP_ROWS = 0x10,      /* rows run from the last output to the first */
    REMAP_SPLIT = 0x20,     /* odd rows are bonded on one side, even ones on the other */
    REMAP_65K = 0x40,       /* two bytes a pixel */

    RATED_A = 0xC8, /* contrasts of the three colours */
    RATED_B = 0x80,
    RATED_C = 0xC8,
};

/* clang-format off */
/* Each line: how many arguments, the command, the arguments. */
static const uint8_t setup[] = {
    /* Datasheet, "Set Command Lock": everything may be commanded, clocks and voltages as well. */
    1, SET_LOCK, 0x12,
    1, SET_LOCK, 0xB1,
    /* "Set Sleep mode ON/OFF": nothing is shown while the registers change. */
    0, SET_SLEEP_ON,
    /* "Set Front Clock Divider / Oscillator Frequency", "Set Reset (Phase 1) / Pre-charge (Phase 2)
     * Period", "Set Second Pre-charge Period": fastest oscillator, divided by 2. */
    1, SET_CLOCK, 0xF1,
    1, SET_PHASE_LENGTH, 0x32,
    1, SET_PRECHARGE_PERIOD, 0x01,
    /* "Set Display Start Line", "Set Display Offset": row 0 on top. */
    1, SET_START_LINE, 0,
    1, SET_OFFSET, 0,
    /* "Set GPIO": unused. "Function Selection": the chip makes its own core voltage. */
    1, SET_GPIO, 0,
    1, SET_FUNCTION, 0x01,
    /* "Set Segment Low Voltage (VSL)", "Display Enhancement", "Set Pre-charge voltage", "Set VCOMH
     * Voltage": for these glasses. */
    3, SET_VSL, 0xA0, 0xB5, 0x55,
    3, SET_ENHANCEMENT, 0xA4, 0x00, 0x00,
    1, SET_PRECHARGE_VOLTAGE, 0x17,
    1, SET_VCOMH, 0x05,
    /* "Set Contrast Current for Color A,B,C", "Master Contrast Current Control": white is white. */
    3, SET_CONTRAST, RATED_A, RATED_B, RATED_C,
    1, SET_MASTER_CURRENT, 0x0F,
    /* "Use Built-in Linear LUT". "Set Display Mode": the RAM as it is. */
    0, SET_LINEAR_GREYS,
    0, SET_NORMAL,
};
/* clang-format on */

static bool set_window(const yb_display_t *display, uint16_t x, uint16_t y, uint16_t width,
                       uint16_t rows)
{
    const uint8_t across[] = {(uint8_t)x, (uint8_t)(x + width - 1)};
    const uint8_t down[] = {(uint8_t)y, (uint8_t)(y + rows - 1)};
    const bool swap = yb_turn_lies_across(display->turn);

    return yb_panel_send(display, SET_COLUMNS, swap ? down : across, 2, true) &&
           yb_panel_send(display, SET_ROWS, swap ? across : down, 2, true) &&
           yb_panel_send(display, WRITE_RAM, NULL, 0, true);
}

static bool set_geometry(const yb_display_t *display)
{
    /* Unturned, a glass has its first row at the chip's last output. */
    static const uint8_t turns[] = {
        [YB_TURN_0] = REMAP_ROWS,
        [YB_TURN_90] = REMAP_ROWS | REMAP_COLUMNS | REMAP_DOWNWARDS,
        [YB_TURN_180] = REMAP_COLUMNS,
        [YB_TURN_270] = REMAP_DOWNWARDS,
    };
    const uint8_t last_row = (uint8_t)(display->panel->screen.height - 1);
    const uint8_t remap = (uint8_t)(REMAP_65K | REMAP_SPLIT | REMAP_COLOURS | turns[display->turn]);

    return yb_panel_send(display, SET_MULTIPLEX_RATIO, &last_row, 1, true) &&
           yb_panel_send(display, SET_REMAP, &remap, 1, true);
}

static bool ssd1351_sleep(yb_display_t *display, bool asleep)
{
    return yb_panel_send(display, asleep ? SET_SLEEP_ON : SET_SLEEP_OFF, NULL, 0, true);
}

static bool ssd1351_start(yb_display_t *display)
{
    const yb_panel_t *panel = display->panel;
    const yb_screen_t screen = yb_display_screen(display);

    /* Display RAM holds noise when the supply comes up, and is blackened before it can be seen. */
    return yb_panel_run(display, panel->setup, panel->setup_bytes, true) && set_geometry(display) &&
           set_window(display, 0, 0, screen.width, screen.height) &&
           yb_panel_send_black(display, (uint32_t)screen.width * screen.height * 2) &&
           ssd1351_sleep(display, false);
}

static bool ssd1351_write(yb_display_t *display, const yb_panel_window_t *window)
{
    return set_window(display, window->x, window->y, window->width, window->rows) &&
           yb_panel_send_pixels(display, window);
}

static bool ssd1351_invert(yb_display_t *display, bool inverted)
{
    return yb_panel_send(display, inverted ? SET_INVERSE : SET_NORMAL, NULL, 0, true);
}

static bool ssd1351_brightness(yb_display_t *display, uint8_t level)
{
    const uint8_t contrast[] = {yb_panel_level(level, RATED_A), yb_panel_level(level, RATED_B),
                                yb_panel_level(level, RATED_C)};
    return yb_panel_send(display, SET_CONTRAST, contrast, sizeof contrast, true);
}

static const yb_panel_driver_t driver = {
    .start = ssd1351_start,
    .write = ssd1351_write,
    .sleep = ssd1351_sleep,
    .invert = ssd1351_invert,
    .brightness = ssd1351_brightness,
};

const yb_panel_t yb_panel_ssd1351 = {
    .name = "ssd1351",
    .title = "Solomon SSD1351, 128 x 128 colour OLED",
    .driver = &driver,
    .screen = {.width = WIDTH, .height = 128, .format = YB_RGB565},
    /* Datasheet, "Serial Interface Timing Characteristics (4-wire SPI)": 50 ns a cycle or more. */
    .spi_hz = 20000000,
    .ram_width = WIDTH,
    .ram_height = 128,
    .turns = 0x0F,
    .x_step = 1,
    .y_step = 1,
    .window_bytes = 7,
    .setup = setup,
    .setup_bytes = sizeof setup,
};

const yb_panel_t yb_panel_ssd1351_128x96 = {
    .name = "ssd1351-128x96",
    .title = "Solomon SSD1351, 128 x 96 colour OLED",
    .driver = &driver,
    .screen = {.width = WIDTH, .height = 96, .format = YB_RGB565},
    .spi_hz = 20000000,
    .ram_width = WIDTH,
    .ram_height = 128,
    .turns = 0x0F,
    .x_step = 1,
    .y_step = 1,
    .window_bytes = 7,
    .setup = setup,
    .setup_bytes = sizeof setup,
};
