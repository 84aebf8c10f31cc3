/* Solomon SSD0323 with an OSRAM Pictiva OS128064 glass: 128 x 64 pixels, 16 greys.
 *
 * "Datasheet" is Solomon Systech's SSD0323, 128 x 80 dot matrix driver with 16 grey levels; its
 * sections are named, not numbered, because the numbers differ between revisions. Commands and
 * their arguments both go with D/C low (Datasheet, "MPU Serial Interface"); D/C high is display RAM
 * alone. The RAM has 80 rows of 64 bytes, and the glass shows 64 of them.
 */
#include "panel_driver.h"

enum {
    WIDTH = 128,
    HEIGHT = 64,
    ROW_BYTES = WIDTH / 2,

    SET_COLUMN_ADDRESS = 0x15,
    SET_ROW_ADDRESS = 0x75,
    SET_CONTRAST = 0x81,
    SET_CURRENT_HALF = 0x85,
    SET_REMAP = 0xA0,
    SET_START_LINE = 0xA1,
    SET_OFFSET = 0xA2,
    SET_MODE_NORMAL = 0xA4,
    SET_MODE_INVERSE = 0xA7,
    SET_MULTIPLEX_RATIO = 0xA8,
    SET_MASTER_CONFIGURATION = 0xAD,
    SET_DISPLAY_OFF = 0xAE,
    SET_DISPLAY_ON = 0xAF,
    SET_PHASE_LENGTH = 0xB1,
    SET_ROW_PERIOD = 0xB2,
    SET_CLOCK = 0xB3,
    SET_GREY_TABLE = 0xB8,
    SET_PRECHARGE_VOLTAGE = 0xBC,
    SET_VCOMH = 0xBE,
    SET_VSL = 0xBF,

    REMAP_COLUMNS = 0x01, /* the first byte of a row drives the last two columns */
    REMAP_NIBBLES = 0x02, /* the high nibble is the first pixel */
    REMAP_COM = 0x10,     /* rows scanned from the last one */
    REMAP_SPLIT = 0x40,   /* odd rows are bonded on one side of the glass, even ones on the other */

    RAM_ROWS = 80,
    FIRST_COM = 12, /* the outputs COM 12 to 75 drive the glass, its top row is COM 75 */

    RATED_CONTRAST = 50, /* of 127 */
    CONVERTER_SETTLES_MS = 100,
};

/* clang-format off */
/* Each line: how many arguments, the command, the arguments. */
static const uint8_t setup[] = {
    /* Datasheet, "Set Display On/Off": nothing is shown while the registers change. */
    0, SET_DISPLAY_OFF,
    /* "Set Display Clock Divide Ratio / Oscillator Frequency", "Set Multiplex Ratio", "Set Row
     * Period", "Set Phase Length": fastest oscillator, divided by 2; 64 rows of 70 clocks, of which
     * 2 reset and 2 precharge: well above 100 frames a second, so nothing flickers in motion. */
    1, SET_CLOCK, 0xF1,
    1, SET_MULTIPLEX_RATIO, HEIGHT - 1,
    1, SET_ROW_PERIOD, 70,
    1, SET_PHASE_LENGTH, 0x22,
    1, SET_START_LINE, 0,
    /* "Set Current Range", "Set Contrast Control Register": half range and 50 of 127 keep the glass
     * below its rated luminance, which decides how long it lives. */
    0, SET_CURRENT_HALF,
    1, SET_CONTRAST, RATED_CONTRAST,
    /* "Set Gray Scale Table": the standard table, pulse widths in steps that look even. */
    8, SET_GREY_TABLE, 0x01, 0x11, 0x22, 0x32, 0x43, 0x54, 0x65, 0x76,
    /* "Set Segment Low Voltage", "Set VCOMH Voltage", "Set Precharge Voltage": for this glass. */
    1, SET_VSL, 0x0D,
    1, SET_VCOMH, 0x02,
    1, SET_PRECHARGE_VOLTAGE, 0x10,
    /* "Set Display Mode": the RAM as it is, neither inverse nor all on. */
    0, SET_MODE_NORMAL,
    /* "Set Master Configuration": the chip's own converter makes the glass's supply. */
    1, SET_MASTER_CONFIGURATION, 0x03,
};
/* clang-format on */

static bool set_window(const yb_display_t *display, uint16_t x, uint16_t y, uint16_t width,
                       uint16_t rows)
{
    const yb_panel_bus_t *bus = display->bus;
    const uint8_t bytes[] = {
        SET_COLUMN_ADDRESS, (uint8_t)(x / 2), (uint8_t)((x + width) / 2 - 1),
        SET_ROW_ADDRESS,    (uint8_t)y,       (uint8_t)(y + rows - 1),
    };
    return bus->command(bus->context, bytes, sizeof bytes);
}

/* Datasheet, "Set Re-map", "Set Display Offset". COM n shows row (n + offset) mod 80, n counted
 * from COM 79 downwards when rows are remapped: the top row of the unturned picture, COM 75, is the
 * fifth so counted. Remapping the columns turns the order of bytes round, but not that of the two
 * pixels in each: the nibbles must change places as well. */
static bool set_turn(const yb_display_t *display)
{
    const bool turned = display->turn == YB_TURN_180;
    const uint8_t remap =
        turned ? REMAP_SPLIT | REMAP_COLUMNS : REMAP_SPLIT | REMAP_NIBBLES | REMAP_COM;
    const uint8_t offset = turned ? RAM_ROWS - FIRST_COM : FIRST_COM + HEIGHT;

    return yb_panel_send(display, SET_REMAP, &remap, 1, false) &&
           yb_panel_send(display, SET_OFFSET, &offset, 1, false);
}

static bool ssd0323_sleep(yb_display_t *display, bool asleep)
{
    return yb_panel_send(display, asleep ? SET_DISPLAY_OFF : SET_DISPLAY_ON, NULL, 0, false);
}

static bool ssd0323_start(yb_display_t *display)
{
    const yb_panel_t *panel = display->panel;

    /* Display RAM holds noise when the supply comes up (Datasheet, "Reset Circuit", does not list
     * it among what a reset clears), so it is blackened before it can be seen. */
    if (!yb_panel_run(display, panel->setup, panel->setup_bytes, false) || !set_turn(display) ||
        !set_window(display, 0, 0, WIDTH, HEIGHT) ||
        !yb_panel_send_black(display, (uint32_t)ROW_BYTES * HEIGHT))
        return false;
    /* Datasheet, "Power on sequence": the supply must stand before the display goes on. */
    yb_panel_wait(display, CONVERTER_SETTLES_MS);
    return ssd0323_sleep(display, false);
}

static bool ssd0323_write(yb_display_t *display, const yb_panel_window_t *window)
{
    return set_window(display, window->x, window->y, window->width, window->rows) &&
           yb_panel_send_pixels(display, window);
}

static bool ssd0323_invert(yb_display_t *display, bool inverted)
{
    return yb_panel_send(display, inverted ? SET_MODE_INVERSE : SET_MODE_NORMAL, NULL, 0, false);
}

static bool ssd0323_brightness(yb_display_t *display, uint8_t level)
{
    const uint8_t contrast = yb_panel_level(level, RATED_CONTRAST);
    return yb_panel_send(display, SET_CONTRAST, &contrast, 1, false);
}

static const yb_panel_driver_t driver = {
    .start = ssd0323_start,
    .write = ssd0323_write,
    .sleep = ssd0323_sleep,
    .invert = ssd0323_invert,
    .brightness = ssd0323_brightness,
};

const yb_panel_t yb_panel_ssd0323 = {
    .name = "ssd0323",
    .title = "Solomon SSD0323, OSRAM Pictiva glass",
    .driver = &driver,
    .screen = {.width = WIDTH, .height = HEIGHT, .format = YB_GREY4},
    /* Datasheet, "Serial Interface Characteristics": a clock cycle takes 250 ns or more. */
    .spi_hz = 4000000,
    .ram_width = WIDTH,
    .ram_height = RAM_ROWS,
    .turns = 1 << YB_TURN_0 | 1 << YB_TURN_180,
    .x_step = 2,
    .y_step = 1,
    .window_bytes = 6,
    .setup = setup,
    .setup_bytes = sizeof setup,
};
