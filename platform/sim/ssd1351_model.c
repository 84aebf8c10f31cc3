/* Model of the Solomon SSD1351, 65k colours, on glasses of 128 x 128 and 128 x 96.
 *
 * "Datasheet" is Solomon Systech's SSD1351, 128 RGB x 128 dot matrix driver. Commands go with D/C
 * low, their arguments and display RAM with D/C high. */
#include "model_parts.h"

#include <string.h>

enum {
    COLUMNS = 128,
    ROWS = 128,

    WRITE_RAM = 0x5C,
    LOCK = 0xFD,

    /* Datasheet, "Set Re-map & Dual COM Line Mode". */
    REMAP_VERTICAL = 0x01,
    REMAP_COLUMNS = 0x02,
    REMAP_COLOURS = 0x04,
    REMAP_RESERVED = 0x08,
    REMAP_COM = 0x10,
    REMAP_COM_SPLIT = 0x20,
    REMAP_DEPTH = 0xC0,
    DEPTH_65K = 0x40,

    MODE_ALL_OFF = 0xA4,
    MODE_ALL_ON = 0xA5,
    MODE_NORMAL = 0xA6,
    MODE_INVERSE = 0xA7,
};

typedef struct {
    uint16_t ram[ROWS][COLUMNS];
    yb_model_decoder_t decoder;
    yb_model_window_t window;
    bool writing; /* data are pixels */
    bool half;    /* of a pixel has come */
    uint8_t high;
    bool on;
    bool locked;     /* FDh 16h */
    bool accessible; /* FDh B1h */
    uint8_t mode;
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
    return yb_model_range_set(model, &chip->window.row, "row", args[0], args[1], ROWS);
}

static bool begin_pixels(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    (void)args;
    chip->writing = true;
    return true;
}

static bool set_remap(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    if ((args[0] & REMAP_RESERVED) != 0)
        return yb_model_fail(model, "remap %02Xh sets a bit that the chip does not have", args[0]);
    if ((args[0] & REMAP_DEPTH) != DEPTH_65K)
        return yb_model_fail(model, "remap %02Xh sets another depth than 65k colours", args[0]);
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

/* Datasheet, "Set Reset (Phase 1) / Pre-charge (Phase 2) period": 2 to 15 and 3 to 15. */
static bool set_phases(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    return ((args[0] & 0x0F) >= 2 && args[0] >> 4 >= 3) ||
           yb_model_fail(model, "phase lengths %02Xh are shorter than the chip can", args[0]);
}

static bool set_clock(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    return (args[0] & 0x0F) <= 10 ||
           yb_model_fail(model, "clock divider %u is beyond 10", args[0] & 0x0FU);
}

/* Datasheet, "Look Up Table for Gray Scale Pulse width": 0 to 180, each more than the one before.
 */
static bool set_grey_table(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    for (int i = 1; i < 63; i++) {
        if (args[i] <= args[i - 1] || args[i] > 180)
            return yb_model_fail(model, "grey level %d of the table does not rise, or passes 180",
                                 i + 1);
    }
    return true;
}

/* Datasheet, "Set Command Lock". */
static bool set_lock(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    switch (args[0]) {
    case 0x12:
    case 0x16:
        chip->locked = args[0] == 0x16;
        return true;
    case 0xB0:
    case 0xB1:
        chip->accessible = args[0] == 0xB1;
        return true;
    default:
        return yb_model_fail(model, "%02Xh is no key of the command lock", args[0]);
    }
}

static bool refuse_scroll(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)args;
    return yb_model_fail(model, "command %02Xh scrolls, which this model does not follow", code);
}

static bool refuse_read(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)args;
    return yb_model_fail(model, "command %02Xh reads, and nothing comes back on these wires", code);
}

/* Datasheet, "Command Table". */
static const yb_model_command_t commands[] = {
    {0x15, 0x15, 2, 0, COLUMNS - 1, set_column},
    {WRITE_RAM, WRITE_RAM, 0, 0, 0, begin_pixels},
    {0x5D, 0x5D, 0, 0, 0, refuse_read},
    {0x75, 0x75, 2, 0, ROWS - 1, set_row},
    {0x96, 0x96, 0, 0, 0, refuse_scroll},
    {0x9E, 0x9E, 0, 0, 0, NULL}, /* scrolling off */
    {0x9F, 0x9F, 0, 0, 0, refuse_scroll},
    {0xA0, 0xA0, 1, 0, 0xFF, set_remap},
    {0xA1, 0xA2, 1, 0, ROWS - 1, set_rows}, /* start line, offset */
    {0xA4, 0xA7, 0, 0, 0, set_mode},
    {0xAB, 0xAB, 1, 0, 0xC1, NULL}, /* function selection */
    {0xAD, 0xAD, 0, 0, 0, NULL},    /* no operation */
    {0xAE, 0xAF, 0, 0, 0, set_on},
    {0xB0, 0xB0, 0, 0, 0, NULL}, /* no operation */
    {0xB1, 0xB1, 1, 0, 0xFF, set_phases},
    {0xB2, 0xB2, 3, 0, 0xFF, NULL}, /* display enhancement */
    {0xB3, 0xB3, 1, 0, 0xFF, set_clock},
    {0xB4, 0xB4, 3, 0xA0, 0xA2, NULL}, /* segment low voltage */
    {0xB5, 0xB5, 1, 0, 0x0F, NULL},    /* general purpose pins */
    {0xB6, 0xB6, 1, 1, 15, NULL},      /* second precharge period */
    {0xB8, 0xB8, 63, 0, 180, set_grey_table},
    {0xB9, 0xB9, 0, 0, 0, NULL},        /* linear grey table */
    {0xBB, 0xBB, 1, 0, 0x1F, NULL},     /* precharge voltage */
    {0xBE, 0xBE, 1, 0, 0x07, NULL},     /* VCOMH */
    {0xC1, 0xC1, 3, 0, 0xFF, NULL},     /* contrast of A, B, C */
    {0xC7, 0xC7, 1, 0, 0x0F, NULL},     /* master contrast */
    {0xCA, 0xCA, 1, 15, 127, set_rows}, /* multiplex ratio */
    {0xD1, 0xD1, 0, 0, 0, NULL},        /* no operation */
    {0xE3, 0xE3, 0, 0, 0, NULL},        /* no operation */
    {LOCK, LOCK, 1, 0, 0xFF, set_lock},
};

static void reset(yb_panel_model_t *model)
{
    chip_t *chip = model->chip;

    memset(chip, 0, sizeof *chip);
    yb_model_noise(model, chip->ram, sizeof chip->ram);
    yb_model_window_reset(&chip->window, COLUMNS, ROWS);
    chip->mode = MODE_NORMAL;
    chip->remap = DEPTH_65K;
    chip->rows_driven = ROWS;
}

static bool take_command(yb_panel_model_t *model, uint8_t byte)
{
    static const yb_model_table_t table = {commands, sizeof commands / sizeof commands[0]};
    static const uint8_t guarded[] = {0xA2, 0xB1, 0xB3, 0xBB, 0xBE, 0xC1};
    chip_t *chip = model->chip;

    if (!yb_model_finished(model, &chip->decoder))
        return false;
    if (chip->half)
        return yb_model_fail(model, "command %02Xh in the middle of a pixel", byte);
    if (chip->locked && byte != LOCK)
        return yb_model_fail(model, "command %02Xh while the command lock is closed", byte);
    if (!chip->accessible && memchr(guarded, byte, sizeof guarded) != NULL)
        return yb_model_fail(model, "command %02Xh wants FDh B1h first", byte);
    chip->writing = false;
    return yb_model_begin(model, &chip->decoder, yb_model_find(table, byte), byte);
}

static bool take_byte(yb_panel_model_t *model, bool is_data, uint8_t byte)
{
    chip_t *chip = model->chip;
    yb_model_window_t *window = &chip->window;

    if (!is_data)
        return take_command(model, byte);
    if (yb_model_unfinished(&chip->decoder))
        return yb_model_argument(model, &chip->decoder, byte);
    if (!chip->writing)
        return yb_model_fail(model, "data %02Xh that no command asked for", byte);
    if (!yb_model_window_open(model, window))
        return false;
    chip->half = !chip->half;
    if (chip->half) {
        chip->high = byte;
        return true;
    }
    chip->ram[window->row.at][window->column.at] = (uint16_t)(chip->high << 8 | byte);
    yb_model_window_step(window, (chip->remap & REMAP_VERTICAL) != 0);
    return true;
}

static bool is_lit(const yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    return chip->on;
}

static bool finished(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;

    if (chip->half)
        return yb_model_fail(model, "half a pixel is missing");
    return yb_model_finished(model, &chip->decoder);
}

static bool set_up_for_glass(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;

    if ((chip->remap & REMAP_COM_SPLIT) == 0)
        return yb_model_fail(model, "remap %02Xh tears the picture on this glass", chip->remap);
    if ((chip->remap & REMAP_COLOURS) == 0)
        return yb_model_fail(model, "remap %02Xh makes red and blue change places on this glass",
                             chip->remap);
    if (chip->rows_driven != model->kind->height)
        return yb_model_fail(model, "%u rows are driven, and the glass has %u", chip->rows_driven,
                             model->kind->height);
    return true;
}

static uint16_t shown(const chip_t *chip, uint16_t pixel)
{
    switch (chip->mode) {
    case MODE_ALL_OFF:
        return 0x0000;
    case MODE_ALL_ON:
        return 0xFFFF;
    case MODE_INVERSE:
        return (uint16_t)~pixel;
    default:
        return pixel;
    }
}

/* The glass's top row is at its last COM (of the flat one, COM 95), its left column at segment 0.
 * COM c takes row c + offset of 128, or with remap N - 1 - c + offset, where N rows are driven
 * (Datasheet, "Set Re-map", A[4], and "Set Display Offset"); rows from N on are blank. So both
 * glasses show row 0 at the top with remap and at the bottom without, both at offset 0 and start
 * line 0. With column remap, column 127 is at segment 0. Turned by quarters, the address runs down
 * the columns: columns are then the picture's rows. */
static bool draw(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    const unsigned height = model->kind->height;

    if (!set_up_for_glass(model))
        return false;
    for (unsigned y = 0; y < height; y++) {
        const unsigned scan = (chip->remap & REMAP_COM) != 0 ? y : height - 1 - y;
        const unsigned row = (scan + chip->offset) % ROWS;
        if (row >= height)
            return yb_model_fail(model, "offset %u leaves row %u of the glass blank", chip->offset,
                                 y);
        const uint16_t *line = chip->ram[(row + chip->start_line) % ROWS];
        for (unsigned x = 0; x < COLUMNS; x++) {
            const unsigned column = (chip->remap & REMAP_COLUMNS) != 0 ? COLUMNS - 1 - x : x;
            yb_model_put_565(model, x, y, shown(chip, line[column]));
        }
    }
    return true;
}

const yb_model_family_t yb_model_ssd1351 = {
    .chip_bytes = sizeof(chip_t),
    .reset = reset,
    .byte = take_byte,
    .lit = is_lit,
    .finished = finished,
    .picture = draw,
};
