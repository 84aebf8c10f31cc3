/* Model of the Solomon SSD0323 on an OSRAM Pictiva OS128064 glass.
 *
 * "Datasheet" is Solomon Systech's SSD0323, 128 x 80 dot matrix driver with 16 grey levels.
 * Commands and their arguments go with D/C low, display RAM with D/C high. */
#include "model_parts.h"

#include <string.h>

enum {
    COLUMNS = 64, /* bytes in a row, two pixels each */
    RAM_ROWS = 80,

    /* Datasheet, "Set Re-map". */
    REMAP_COLUMNS = 0x01,
    REMAP_NIBBLES = 0x02,
    REMAP_VERTICAL = 0x04,
    REMAP_COM = 0x10,
    REMAP_COM_SPLIT = 0x40,
    REMAP_NONE = 0x28, /* bits that do not exist */

    /* How the glass is bonded: its rows, from the top, to COM 75 down to COM 12. With COM remap,
     * COM c takes row 79 - c + offset, else c + offset, of 80 (Datasheet, "Set Display Offset"); so
     * these offsets bring row 0 to the top, and, turned, to the bottom. */
    OFFSET = 76,
    OFFSET_TURNED = 68,
};

typedef struct {
    uint8_t ram[RAM_ROWS][COLUMNS];
    yb_model_decoder_t decoder;
    yb_model_window_t window;
    bool on;
    uint8_t mode; /* A4h normal, A5h all on, A6h all off, A7h inverse */
    uint8_t remap;
    uint8_t start_line;
    uint8_t offset;
    uint8_t rows_driven;
} chip_t;

static bool set_column(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    chip->window.full = false;
    return yb_model_range_set(model, &chip->window.column, "column", args[0], args[1], COLUMNS);
}

static bool set_row(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    chip->window.full = false;
    return yb_model_range_set(model, &chip->window.row, "row", args[0], args[1], RAM_ROWS);
}

static bool set_remap(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    if ((args[0] & REMAP_NONE) != 0)
        return yb_model_fail(model, "remap %02Xh sets bits that the chip does not have", args[0]);
    chip->remap = args[0];
    return true;
}

static bool set_rows(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    if (code == 0xA1)
        chip->start_line = args[0];
    else if (code == 0xA2)
        chip->offset = args[0];
    else
        chip->rows_driven = (uint8_t)(args[0] + 1);
    return true;
}

static bool set_mode(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->mode = code;
    return true;
}

static bool set_on(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->on = code == 0xAF;
    return true;
}

static bool set_phases(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    return (args[0] & 0x0F) != 0 ||
           yb_model_fail(model, "phase length %02Xh has a phase of no clocks", args[0]);
}

/* Datasheet, "Command Table". */
static const yb_model_command_t commands[] = {
    {0x15, 0x15, 2, 0, COLUMNS - 1, set_column},
    {0x75, 0x75, 2, 0, RAM_ROWS - 1, set_row},
    {0x81, 0x81, 1, 0, 127, NULL}, /* contrast */
    {0x84, 0x86, 0, 0, 0, NULL},   /* current range: quarter, half, full */
    {0xA0, 0xA0, 1, 0, 0x7F, set_remap},
    {0xA1, 0xA2, 1, 0, RAM_ROWS - 1, set_rows}, /* start line, offset */
    {0xA4, 0xA7, 0, 0, 0, set_mode},
    {0xA8, 0xA8, 1, 15, RAM_ROWS - 1, set_rows}, /* multiplex ratio */
    {0xAD, 0xAD, 1, 2, 3, NULL},                 /* master configuration */
    {0xAE, 0xAF, 0, 0, 0, set_on},
    {0xB1, 0xB1, 1, 0x11, 0xFF, set_phases}, /* neither nibble may be 0 */
    {0xB2, 0xB2, 1, 2, 127, NULL},           /* row period */
    {0xB3, 0xB3, 1, 0, 0xFF, NULL},          /* clock */
    {0xB8, 0xB8, 8, 0, 7, NULL},             /* grey table; level 1 has three bits */
    {0xBC, 0xBC, 1, 0, 0x1F, NULL},          /* precharge voltage */
    {0xBE, 0xBE, 1, 0, 0x1F, NULL},          /* VCOMH */
    {0xBF, 0xBF, 1, 0, 0x0F, NULL},          /* VSL */
    {0xE3, 0xE3, 0, 0, 0, NULL},             /* no operation */
};

static void reset(yb_panel_model_t *model)
{
    chip_t *chip = model->chip;

    memset(chip, 0, sizeof *chip);
    yb_model_noise(model, chip->ram, sizeof chip->ram);
    yb_model_window_reset(&chip->window, COLUMNS, RAM_ROWS);
    chip->mode = 0xA4;
    chip->rows_driven = RAM_ROWS;
}

static bool take_data(yb_panel_model_t *model, uint8_t byte)
{
    chip_t *chip = model->chip;
    yb_model_window_t *window = &chip->window;

    if (yb_model_unfinished(&chip->decoder))
        return yb_model_fail(model, "data where command %02Xh wants argument %d of %d",
                             chip->decoder.code, chip->decoder.got + 1, chip->decoder.command.args);
    if (!yb_model_window_open(model, window))
        return false;
    chip->ram[window->row.at][window->column.at] = byte;
    yb_model_window_step(window, (chip->remap & REMAP_VERTICAL) != 0);
    return true;
}

static bool take_byte(yb_panel_model_t *model, bool is_data, uint8_t byte)
{
    static const yb_model_table_t table = {commands, sizeof commands / sizeof commands[0]};
    chip_t *chip = model->chip;

    if (is_data)
        return take_data(model, byte);
    if (yb_model_unfinished(&chip->decoder))
        return yb_model_argument(model, &chip->decoder, byte);
    return yb_model_begin(model, &chip->decoder, yb_model_find(table, byte), byte);
}

static bool is_lit(const yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    return chip->on;
}

static bool finished(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    return yb_model_finished(model, &chip->decoder);
}

static bool set_up_for_glass(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    const bool turned = (chip->remap & REMAP_COLUMNS) != 0;
    const int offset = turned ? OFFSET_TURNED : OFFSET;

    if ((chip->remap & REMAP_COM_SPLIT) == 0)
        return yb_model_fail(model, "remap %02Xh tears the picture on this glass", chip->remap);
    if (turned == ((chip->remap & REMAP_COM) != 0))
        return yb_model_fail(model, "remap %02Xh mirrors the picture on this glass", chip->remap);
    if (chip->offset != offset)
        return yb_model_fail(model, "offset %u shifts the picture: the glass begins at %d",
                             chip->offset, offset);
    if (chip->rows_driven != model->kind->height)
        return yb_model_fail(model, "%u rows are driven, and the glass has %u", chip->rows_driven,
                             model->kind->height);
    return true;
}

static uint8_t shown(const chip_t *chip, uint8_t byte)
{
    if (chip->mode == 0xA6)
        return 0x00;
    if (chip->mode == 0xA5)
        return 0xFF;
    return chip->mode == 0xA7 ? (uint8_t)~byte : byte;
}

/* Unturned, the bits 7 to 4 of a byte are the left pixel if nibbles are remapped. */
static bool draw(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    const unsigned width = model->kind->width;
    const unsigned height = model->kind->height;
    const bool turned = (chip->remap & REMAP_COLUMNS) != 0;
    const bool high_first = (chip->remap & REMAP_NIBBLES) != 0;

    if (!set_up_for_glass(model))
        return false;
    for (unsigned y = 0; y < height; y++) {
        const unsigned line = turned ? height - 1 - y : y;
        const uint8_t *row = chip->ram[(chip->start_line + line) % RAM_ROWS];
        for (unsigned x = 0; x < width; x++) {
            const unsigned column = turned ? COLUMNS - 1 - x / 2 : x / 2;
            const uint8_t byte = shown(chip, row[column]);
            const unsigned level = (x % 2 == 0) == high_first ? byte >> 4 : byte & 0x0F;
            const uint8_t grey = (uint8_t)(17 * level);
            yb_model_put(model, x, y, grey, grey, grey);
        }
    }
    return true;
}

const yb_model_family_t yb_model_ssd0323 = {
    .chip_bytes = sizeof(chip_t),
    .reset = reset,
    .byte = take_byte,
    .lit = is_lit,
    .finished = finished,
    .picture = draw,
};
