/* Model of the Solomon SSD1306, one bit a pixel, on glasses of 128 x 64 and 128 x 32.
 *
 * "Datasheet" is Solomon Systech's SSD1306, 128 x 64 dot matrix driver, with its appendix on the
 * charge pump. Commands and their arguments go with D/C low, display RAM with D/C high. */
#include "model_parts.h"

#include <string.h>

enum {
    COLUMNS = 128,
    PAGES = 8, /* of eight rows; the lowest bit of a byte is the top one */
    ROWS = 64,

    HORIZONTAL = 0,
    VERTICAL = 1,
    BY_PAGE = 2,

    /* Datasheet, "Set COM Pins Hardware Configuration": rows alternate between both sides of the
     * taller glass; the flat one has them in sequence. */
    PINS_64 = 0x12,
    PINS_32 = 0x02,
};

typedef struct {
    uint8_t ram[PAGES][COLUMNS]; /* by segment, because remap acts as bytes are written */
    yb_model_decoder_t decoder;
    yb_model_window_t window; /* its rows are pages */
    bool on;
    bool pumped; /* the charge pump ran when the display went on, and runs */
    bool pump;
    bool all_on;
    bool inverse;
    bool segment_remap;
    bool com_remap;
    uint8_t addressing;
    uint8_t start_line;
    uint8_t offset;
    uint8_t rows_driven;
    uint8_t pins;
} chip_t;

static bool only_when(yb_panel_model_t *model, uint8_t code, bool by_page)
{
    const chip_t *chip = model->chip;

    if ((chip->addressing == BY_PAGE) == by_page)
        return true;
    return yb_model_fail(model, "command %02Xh has no meaning in addressing mode %u", code,
                         chip->addressing);
}

/* Datasheet, "Set Lower (Higher) Column Start Address for Page Addressing Mode". */
static bool set_column_nibble(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;
    yb_model_range_t *column = &chip->window.column;

    (void)args;
    if (!only_when(model, code, true))
        return false;
    if ((code & 0x10) == 0)
        column->first = (uint16_t)((column->first & 0x70) | (code & 0x0F));
    else
        column->first = (uint16_t)((column->first & 0x0F) | (code & 0x07) << 4);
    column->at = column->first;
    chip->window.full = false;
    return true;
}

static bool set_page(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    if (!only_when(model, code, true))
        return false;
    chip->window.row.at = code & 0x07;
    chip->window.full = false;
    return true;
}

static bool set_addressing(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    chip->addressing = args[0];
    yb_model_window_reset(&chip->window, COLUMNS, PAGES);
    return true;
}

static bool set_range(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    if (!only_when(model, code, false))
        return false;
    chip->window.full = false;
    if (code == 0x21)
        return yb_model_range_set(model, &chip->window.column, "column", args[0], args[1], COLUMNS);
    return yb_model_range_set(model, &chip->window.row, "page", args[0], args[1], PAGES);
}

static bool set_start_line(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->start_line = code & 0x3F;
    return true;
}

static bool set_switch(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;
    const bool set = (code & 1) != 0;

    (void)args;
    if (code <= 0xA1)
        chip->segment_remap = set;
    else if (code <= 0xA5)
        chip->all_on = set;
    else
        chip->inverse = set;
    return true;
}

static bool set_com_scan(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->com_remap = code == 0xC8;
    return true;
}

static bool set_rows(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    if (code == 0xA8)
        chip->rows_driven = (uint8_t)(args[0] + 1);
    else
        chip->offset = args[0];
    return true;
}

/* Datasheet, appendix "Charge Pump Regulator": 8Dh 14h, then AFh. */
static bool set_pump(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    if (args[0] != 0x10 && args[0] != 0x14)
        return yb_model_fail(model, "charge pump setting %02Xh is neither 10h nor 14h", args[0]);
    chip->pump = args[0] == 0x14;
    chip->pumped = chip->pumped && chip->pump;
    return true;
}

static bool set_on(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->on = code == 0xAF;
    chip->pumped = chip->on && chip->pump;
    return true;
}

static bool set_phases(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    return (args[0] & 0x0F) != 0 ||
           yb_model_fail(model, "phase length %02Xh has a phase of no clocks", args[0]);
}

static bool set_pins(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    if ((args[0] & ~0x30) != 0x02)
        return yb_model_fail(model, "COM pins %02Xh set bits that the chip does not have", args[0]);
    chip->pins = args[0];
    return true;
}

static bool set_deselect_level(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    return args[0] == 0x00 || args[0] == 0x20 || args[0] == 0x30 ||
           yb_model_fail(model, "VCOMH deselect level %02Xh is not in the datasheet", args[0]);
}

static bool refuse_scroll(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)args;
    return yb_model_fail(model, "command %02Xh scrolls, which this model does not follow", code);
}

/* Datasheet, "Command Table". */
static const yb_model_command_t commands[] = {
    {0x00, 0x17, 0, 0, 0, set_column_nibble},
    {0x20, 0x20, 1, 0, 2, set_addressing},
    {0x21, 0x21, 2, 0, COLUMNS - 1, set_range},
    {0x22, 0x22, 2, 0, PAGES - 1, set_range},
    {0x26, 0x27, 0, 0, 0, refuse_scroll},
    {0x29, 0x2A, 0, 0, 0, refuse_scroll},
    {0x2E, 0x2E, 0, 0, 0, NULL}, /* scrolling off */
    {0x2F, 0x2F, 0, 0, 0, refuse_scroll},
    {0x40, 0x7F, 0, 0, 0, set_start_line},
    {0x81, 0x81, 1, 0, 0xFF, NULL}, /* contrast */
    {0x8D, 0x8D, 1, 0, 0xFF, set_pump},
    {0xA0, 0xA1, 0, 0, 0, set_switch}, /* segment remap */
    {0xA3, 0xA3, 0, 0, 0, refuse_scroll},
    {0xA4, 0xA5, 0, 0, 0, set_switch}, /* all on */
    {0xA6, 0xA7, 0, 0, 0, set_switch}, /* inverse */
    {0xA8, 0xA8, 1, 15, 63, set_rows}, /* multiplex ratio */
    {0xAE, 0xAF, 0, 0, 0, set_on},
    {0xB0, 0xB7, 0, 0, 0, set_page},
    {0xC0, 0xC0, 0, 0, 0, set_com_scan},
    {0xC8, 0xC8, 0, 0, 0, set_com_scan},
    {0xD3, 0xD3, 1, 0, 63, set_rows},        /* offset */
    {0xD5, 0xD5, 1, 0, 0xFF, NULL},          /* clock */
    {0xD9, 0xD9, 1, 0x11, 0xFF, set_phases}, /* neither nibble may be 0 */
    {0xDA, 0xDA, 1, 0, 0xFF, set_pins},
    {0xDB, 0xDB, 1, 0, 0xFF, set_deselect_level},
    {0xE3, 0xE3, 0, 0, 0, NULL}, /* no operation */
};

static void reset(yb_panel_model_t *model)
{
    chip_t *chip = model->chip;

    memset(chip, 0, sizeof *chip);
    yb_model_noise(model, chip->ram, sizeof chip->ram);
    yb_model_window_reset(&chip->window, COLUMNS, PAGES);
    chip->addressing = BY_PAGE;
    chip->rows_driven = ROWS;
    chip->pins = PINS_64;
}

/* Datasheet, "Set Memory Addressing Mode"; by pages, the end of the page is the window's end, and
 * the column goes back to its start. */
static void step(chip_t *chip)
{
    yb_model_range_t *column = &chip->window.column;

    if (chip->addressing != BY_PAGE) {
        yb_model_window_step(&chip->window, chip->addressing == VERTICAL);
    } else if (column->at < COLUMNS - 1) {
        column->at++;
    } else {
        column->at = column->first;
        chip->window.full = true;
    }
}

static bool take_byte(yb_panel_model_t *model, bool is_data, uint8_t byte)
{
    static const yb_model_table_t table = {commands, sizeof commands / sizeof commands[0]};
    chip_t *chip = model->chip;

    if (!is_data) {
        if (yb_model_unfinished(&chip->decoder))
            return yb_model_argument(model, &chip->decoder, byte);
        return yb_model_begin(model, &chip->decoder, yb_model_find(table, byte), byte);
    }
    if (yb_model_unfinished(&chip->decoder))
        return yb_model_fail(model, "data where command %02Xh wants argument %d of %d",
                             chip->decoder.code, chip->decoder.got + 1, chip->decoder.command.args);
    if (!yb_model_window_open(model, &chip->window))
        return false;
    const unsigned column = chip->window.column.at;
    chip->ram[chip->window.row.at][chip->segment_remap ? COLUMNS - 1 - column : column] = byte;
    step(chip);
    return true;
}

static bool is_lit(const yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    return chip->pumped;
}

static bool finished(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    return yb_model_finished(model, &chip->decoder);
}

static bool set_up_for_glass(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    const unsigned height = model->kind->height;

    if (chip->rows_driven != height)
        return yb_model_fail(model, "%u rows are driven, and the glass has %u", chip->rows_driven,
                             height);
    if (chip->pins != (height == 64 ? PINS_64 : PINS_32))
        return yb_model_fail(model, "COM pins %02Xh tear the picture on this glass", chip->pins);
    if (chip->segment_remap != chip->com_remap)
        return yb_model_fail(model, "%s mirrors the picture on this glass",
                             chip->segment_remap ? "A1h with C0h" : "A0h with C8h");
    return true;
}

/* The glass's top row is at the last COM, its left column at segment 127. Datasheet, "Set Display
 * Offset", tables of examples: COM c takes row c + offset of 64, or with remap N - 1 - c + offset,
 * where N rows are driven; rows from N on are blank. */
static bool draw(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    const unsigned height = model->kind->height;

    if (!set_up_for_glass(model))
        return false;
    for (unsigned y = 0; y < height; y++) {
        const unsigned scan = chip->com_remap ? y : height - 1 - y;
        const unsigned row = (scan + chip->offset) % ROWS;
        if (row >= height)
            return yb_model_fail(model, "offset %u leaves row %u of the glass blank", chip->offset,
                                 y);
        const unsigned line = (row + chip->start_line) % ROWS;
        for (unsigned x = 0; x < COLUMNS; x++) {
            const unsigned bit = chip->ram[line / 8][COLUMNS - 1 - x] >> line % 8 & 1;
            const bool set = chip->all_on || (bit != 0) != chip->inverse;
            const uint8_t grey = set ? 0xFF : 0x00;
            yb_model_put(model, x, y, grey, grey, grey);
        }
    }
    return true;
}

const yb_model_family_t yb_model_ssd1306 = {
    .chip_bytes = sizeof(chip_t),
    .reset = reset,
    .byte = take_byte,
    .lit = is_lit,
    .finished = finished,
    .picture = draw,
};
