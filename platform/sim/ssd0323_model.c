#include "ssd0323_model.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    REMAP_COLUMNS = 0x01,
    REMAP_NIBBLES = 0x02,
    REMAP_VERTICAL = 0x04,
    REMAP_COM = 0x10,
    REMAP_COM_SPLIT = 0x40,

    /* How the OSRAM glass is bonded to the chip. */
    GLASS_REMAP = REMAP_COM | REMAP_COM_SPLIT,
    GLASS_OFFSET = 76,
};

/* Command table of the datasheet: how many argument bytes follow, and what the first one may be
 * (the others are checked where they are used). */
static const struct {
    uint8_t command;
    uint8_t args;
    uint8_t least;
    uint8_t most;
} commands[] = {
    {0x15, 2, 0, YB_SSD0323_COLUMNS - 1},  /* column address */
    {0x75, 2, 0, YB_SSD0323_RAM_ROWS - 1}, /* row address */
    {0x81, 1, 0, 127},                     /* contrast */
    {0x84, 0, 0, 0},                       /* current range: quarter, half, full */
    {0x85, 0, 0, 0},
    {0x86, 0, 0, 0},
    {0xA0, 1, 0, 0x57},                    /* remap; bit 3 is tested below */
    {0xA1, 1, 0, YB_SSD0323_RAM_ROWS - 1}, /* start line */
    {0xA2, 1, 0, YB_SSD0323_RAM_ROWS - 1}, /* offset */
    {0xA4, 0, 0, 0},                       /* mode: normal, all on, all off, inverse */
    {0xA5, 0, 0, 0},
    {0xA6, 0, 0, 0},
    {0xA7, 0, 0, 0},
    {0xA8, 1, 15, YB_SSD0323_RAM_ROWS - 1}, /* multiplex ratio */
    {0xAD, 1, 2, 3},                        /* master configuration */
    {0xAE, 0, 0, 0},                        /* off, on */
    {0xAF, 0, 0, 0},
    {0xB1, 1, 0x11, 0xFF}, /* phase lengths; neither nibble may be 0 */
    {0xB2, 1, 2, 127},     /* row period */
    {0xB3, 1, 0, 0xFF},    /* clock */
    {0xB8, 8, 0, 7},       /* grey table; level 1 has three bits */
    {0xBC, 1, 0, 0x1F},    /* precharge voltage */
    {0xBE, 1, 0, 0x1F},    /* VCOMH */
    {0xBF, 1, 0, 0x0F},    /* VSL */
    {0xE3, 0, 0, 0},       /* no operation */
};

static bool fail(yb_ssd0323_model_t *model, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool fail(yb_ssd0323_model_t *model, const char *format, ...)
{
    va_list args;

    const int used =
        snprintf(model->error, sizeof model->error, "byte %lu: ", (unsigned long)model->bytes);
    va_start(args, format);
    (void)vsnprintf(model->error + used, sizeof model->error - (size_t)used, format, args);
    va_end(args);
    model->failed = true;
    return false;
}

void yb_ssd0323_model_reset(yb_ssd0323_model_t *model)
{
    memset(model, 0, sizeof *model);
    model->column_last = YB_SSD0323_COLUMNS - 1;
    model->row_last = YB_SSD0323_RAM_ROWS - 1;
    model->mode = 0xA4;
    model->rows_shown = YB_SSD0323_RAM_ROWS;
    model->contrast = 64;

    /* Not zeros: a driver that does not clear the screen must not look as if it had. */
    uint32_t noise = 0x5EED;
    for (int row = 0; row < YB_SSD0323_RAM_ROWS; row++) {
        for (int column = 0; column < YB_SSD0323_COLUMNS; column++) {
            noise = noise * 1664525U + 1013904223U;
            model->ram[row][column] = (uint8_t)(noise >> 24);
        }
    }
}

static bool set_addresses(yb_ssd0323_model_t *model)
{
    const bool columns = model->command == 0x15;
    const uint8_t first = model->args[0];
    const uint8_t last = model->args[1];
    const uint8_t most = columns ? YB_SSD0323_COLUMNS - 1 : YB_SSD0323_RAM_ROWS - 1;

    if (last > most)
        return fail(model, "%s address %u is beyond the last one, %u", columns ? "column" : "row",
                    last, most);
    if (last < first)
        return fail(model, "the window ends at %s %u, before it begins at %u",
                    columns ? "column" : "row", last, first);
    if (columns) {
        model->column = model->column_first = first;
        model->column_last = last;
    } else {
        model->row = model->row_first = first;
        model->row_last = last;
    }
    model->window_full = false;
    return true;
}

static bool run_command(yb_ssd0323_model_t *model)
{
    const uint8_t arg = model->args[0];

    switch (model->command) {
    case 0x15:
    case 0x75:
        return set_addresses(model);
    case 0x81:
        model->contrast = arg;
        break;
    case 0xA0:
        if ((arg & 0x28) != 0)
            return fail(model, "remap %02Xh sets bits that the chip does not have", arg);
        model->remap = arg;
        break;
    case 0xA1:
        model->start_line = arg;
        break;
    case 0xA2:
        model->offset = arg;
        break;
    case 0xA4:
    case 0xA5:
    case 0xA6:
    case 0xA7:
        model->mode = model->command;
        break;
    case 0xA8:
        model->rows_shown = (uint8_t)(arg + 1);
        break;
    case 0xAE:
    case 0xAF:
        model->on = model->command == 0xAF;
        break;
    case 0xB1:
        if ((arg & 0x0F) == 0)
            return fail(model, "phase length %02Xh has a phase of no clocks", arg);
        break;
    default:
        break; /* voltages and times: they change no pixel */
    }
    return true;
}

static bool take_command_byte(yb_ssd0323_model_t *model, uint8_t byte)
{
    const size_t count = sizeof commands / sizeof commands[0];
    size_t i = 0;

    if (model->args_got < model->args_wanted) {
        model->args[model->args_got++] = byte;
    } else {
        model->command = byte;
        model->args_got = 0;
    }
    while (i < count && commands[i].command != model->command)
        i++;
    if (i == count)
        return fail(model, "%02Xh is no command of this chip", byte);
    model->args_wanted = commands[i].args;
    if (model->args_got == 1 && (byte < commands[i].least || byte > commands[i].most))
        return fail(model, "command %02Xh takes %02Xh to %02Xh, not %02Xh", model->command,
                    commands[i].least, commands[i].most, byte);
    return model->args_got < model->args_wanted || run_command(model);
}

/* Steps `*at` from first to last; true when it went round. */
static bool step(uint8_t *at, uint8_t first, uint8_t last)
{
    if (*at < last) {
        (*at)++;
        return false;
    }
    *at = first;
    return true;
}

static bool take_data_byte(yb_ssd0323_model_t *model, uint8_t byte)
{
    if (model->args_got < model->args_wanted)
        return fail(model, "data where command %02Xh wants argument %u of %u", model->command,
                    model->args_got + 1U, model->args_wanted);
    if (model->window_full)
        return fail(model, "data beyond the end of the window");
    model->ram[model->row][model->column] = byte;
    if ((model->remap & REMAP_VERTICAL) != 0)
        model->window_full = step(&model->row, model->row_first, model->row_last) &&
                             step(&model->column, model->column_first, model->column_last);
    else
        model->window_full = step(&model->column, model->column_first, model->column_last) &&
                             step(&model->row, model->row_first, model->row_last);
    return true;
}

bool yb_ssd0323_model_byte(yb_ssd0323_model_t *model, bool is_data, uint8_t byte)
{
    if (model->failed)
        return false;
    model->bytes++;
    return is_data ? take_data_byte(model, byte) : take_command_byte(model, byte);
}

static bool set_up_for_glass(yb_ssd0323_model_t *model)
{
    if ((model->remap & ~(REMAP_NIBBLES | REMAP_VERTICAL)) != GLASS_REMAP)
        return fail(model, "remap %02Xh turns or tears the picture on this glass", model->remap);
    if (model->offset != GLASS_OFFSET)
        return fail(model, "offset %u shifts the picture: the glass begins at %d", model->offset,
                    GLASS_OFFSET);
    if (model->rows_shown != YB_SSD0323_HEIGHT)
        return fail(model, "%u rows are driven, and the glass has %d", model->rows_shown,
                    YB_SSD0323_HEIGHT);
    return true;
}

static uint8_t shown(const yb_ssd0323_model_t *model, uint8_t byte)
{
    if (!model->on || model->mode == 0xA6)
        return 0x00;
    if (model->mode == 0xA5)
        return 0xFF;
    if ((model->remap & REMAP_NIBBLES) == 0)
        byte = (uint8_t)(byte << 4 | byte >> 4);
    return model->mode == 0xA7 ? (uint8_t)~byte : byte;
}

bool yb_ssd0323_model_picture(yb_ssd0323_model_t *model, uint8_t picture[YB_SSD0323_PICTURE_BYTES])
{
    if (model->failed)
        return false;
    if (model->args_got < model->args_wanted)
        return fail(model, "command %02Xh still wants %d bytes", model->command,
                    model->args_wanted - model->args_got);
    if (model->on && !set_up_for_glass(model))
        return false;
    for (int y = 0; y < YB_SSD0323_HEIGHT; y++) {
        const uint8_t *row = model->ram[(model->start_line + y) % YB_SSD0323_RAM_ROWS];
        for (int i = 0; i < YB_SSD0323_COLUMNS; i++)
            picture[y * YB_SSD0323_COLUMNS + i] = shown(model, row[i]);
    }
    return true;
}
