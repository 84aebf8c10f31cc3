/* Solomon SSD0323 with an OSRAM Pictiva OS128064 glass: 128 x 64 pixels, 16 greys.
 *
 * "Datasheet" is Solomon Systech's SSD0323, 128 x 80 dot matrix driver with 16 grey levels; its
 * sections are named, not numbered, because the numbers differ between revisions. Commands and
 * their arguments both go with D/C low (Datasheet, "MPU Serial Interface"); D/C high is display RAM
 * alone. The RAM has 80 rows of 64 bytes, and the glass shows 64 of them.
 */
#include "panel.h"

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

    REMAP_NIBBLES = 0x02, /* the high nibble is the left pixel */
    REMAP_COM = 0x10,     /* rows scanned from the last one */
    REMAP_COM_SPLIT =
        0x40, /* odd rows are bonded on one side of the glass, even ones on the other */

    CONVERTER_SETTLES_MS = 100,
};

static const uint8_t setup[] = {
    /* Datasheet, "Set Display On/Off": nothing is shown while the registers change. */
    SET_DISPLAY_OFF,
    /* "Set Display Clock Divide Ratio / Oscillator Frequency", "Set Multiplex Ratio", "Set Row
     * Period", "Set Phase Length": fastest oscillator, divided by 2; 64 rows of 70 clocks, of which
     * 2 reset and 2 precharge: well above 100 frames a second, so nothing flickers in motion. */
    SET_CLOCK,
    0xF1,
    SET_MULTIPLEX_RATIO,
    HEIGHT - 1,
    SET_ROW_PERIOD,
    70,
    SET_PHASE_LENGTH,
    0x22,
    /* "Set Display Start Line", "Set Display Offset", "Set Re-map": how the glass is bonded. Its
     * first row is the chip's COM 76, rows run upwards and alternate between both sides. */
    SET_START_LINE,
    0,
    SET_OFFSET,
    76,
    SET_REMAP,
    REMAP_NIBBLES | REMAP_COM | REMAP_COM_SPLIT,
    /* "Set Current Range", "Set Contrast Control Register": half range and 50 of 127 keep the glass
     * below its rated luminance, which decides how long it lives. */
    SET_CURRENT_HALF,
    SET_CONTRAST,
    50,
    /* "Set Gray Scale Table": the standard table, pulse widths in steps that look even. */
    SET_GREY_TABLE,
    0x01,
    0x11,
    0x22,
    0x32,
    0x43,
    0x54,
    0x65,
    0x76,
    /* "Set Segment Low Voltage", "Set VCOMH Voltage", "Set Precharge Voltage": for this glass. */
    SET_VSL,
    0x0D,
    SET_VCOMH,
    0x02,
    SET_PRECHARGE_VOLTAGE,
    0x10,
    /* "Set Display Mode": the RAM as it is, neither inverse nor all on. */
    SET_MODE_NORMAL,
    /* "Set Master Configuration": the chip's own converter makes the glass's supply. */
    SET_MASTER_CONFIGURATION,
    0x03,
};

static bool set_window(const yb_panel_bus_t *bus, uint16_t x, uint16_t y, uint16_t width,
                       uint16_t rows)
{
    const uint8_t bytes[] = {
        SET_COLUMN_ADDRESS, (uint8_t)(x / 2), (uint8_t)((x + width) / 2 - 1),
        SET_ROW_ADDRESS,    (uint8_t)y,       (uint8_t)(y + rows - 1),
    };
    return bus->command(bus->context, bytes, sizeof bytes);
}

/* Display RAM holds noise when the supply comes up (Datasheet, "Reset Circuit", does not list it
 * among what a reset clears), so it is blackened before it can be seen. */
static bool blacken(const yb_panel_bus_t *bus)
{
    static const uint8_t black[ROW_BYTES];

    if (!set_window(bus, 0, 0, WIDTH, HEIGHT))
        return false;
    for (int row = 0; row < HEIGHT; row++) {
        if (!bus->data(bus->context, black, sizeof black))
            return false;
    }
    return true;
}

static bool ssd0323_sleep(const yb_panel_bus_t *bus, bool asleep)
{
    const uint8_t command = asleep ? SET_DISPLAY_OFF : SET_DISPLAY_ON;
    return bus->command(bus->context, &command, 1);
}

static bool ssd0323_init(const yb_panel_bus_t *bus)
{
    if (bus->reset != NULL && !bus->reset(bus->context))
        return false;
    if (!bus->command(bus->context, setup, sizeof setup) || !blacken(bus))
        return false;
    /* Datasheet, "Power on sequence": the supply must stand before the display goes on. */
    if (bus->wait_ms != NULL)
        bus->wait_ms(bus->context, CONVERTER_SETTLES_MS);
    return ssd0323_sleep(bus, false);
}

static bool ssd0323_write(const yb_panel_bus_t *bus, const yb_panel_window_t *window)
{
    /* Not x + width > WIDTH: int has 16 bits on some targets. */
    if (window->width == 0 || window->rows == 0 || window->width > WIDTH || window->rows > HEIGHT ||
        window->x > WIDTH - window->width || window->y > HEIGHT - window->rows ||
        window->x % 2 != 0 || window->width % 2 != 0)
        return false;

    const size_t row_bytes = window->width / 2U;
    if (!set_window(bus, window->x, window->y, window->width, window->rows))
        return false;
    if (window->pitch_bytes == row_bytes)
        return bus->data(bus->context, window->pixels, row_bytes * window->rows);
    for (uint16_t row = 0; row < window->rows; row++) {
        if (!bus->data(bus->context, window->pixels + row * window->pitch_bytes, row_bytes))
            return false;
    }
    return true;
}

const yb_panel_t yb_panel_ssd0323 = {
    .name = "ssd0323",
    .screen = {.width = WIDTH, .height = HEIGHT, .format = YB_GREY4},
    /* Datasheet, "Serial Interface Characteristics": a clock cycle takes 250 ns or more. */
    .spi_hz = 4000000,
    .init = ssd0323_init,
    .write = ssd0323_write,
    .sleep = ssd0323_sleep,
};
