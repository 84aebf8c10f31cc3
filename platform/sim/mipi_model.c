/* Model of the chips that speak the MIPI Display Command Set, by four wires that only write.
 *
 * Sections named below are called alike in the datasheets of ST7735, ST7789, ILI9341 and GC9A01.
 * Commands go with D/C low, arguments and pixels with D/C high. Where the chips disagree (what a
 * software reset keeps, say) the model takes what none of them forgives. */
#include "mipi_model.h"

#include <string.h>

enum {
    MOST_PIXELS = 240 * 320,

    /* "Reset Timing", "SLPIN": to the next command. */
    SETTLES_US = 5000,
    /* "Reset Timing", "SLPIN", "SLPOUT": to sleep-out, if it was awake, or to sleep-in. */
    AWAKE_SETTLES_US = 120000,
};

typedef struct {
    uint16_t ram[MOST_PIXELS];
    yb_model_decoder_t decoder;
    yb_model_window_t window;
    bool writing;   /* data are pixels */
    bool has_place; /* 2Ch went to the window's start, and the window is still the same */
    bool half;      /* of a pixel has come */
    uint8_t high;
    bool awake;
    bool on;
    bool inverse;
    bool partial;
    bool idle;
    bool deep; /* 3Ah has set 16 bits a pixel */
    uint8_t madctl;
    uint8_t scan;           /* YB_SCAN_... */
    uint64_t command_at_us; /* nothing may come before */
    uint64_t sleep_in_at_us;
    uint64_t sleep_out_at_us;
} chip_t;

static const yb_mipi_glass_t *glass_of(const yb_panel_model_t *model)
{
    return model->kind->glass;
}

/* The address space as MADCTL turns it. */
static unsigned columns(const yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    const yb_mipi_glass_t *glass = glass_of(model);
    return (chip->madctl & YB_MADCTL_MV) != 0 ? glass->ram_height : glass->ram_width;
}

static unsigned rows(const yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    const yb_mipi_glass_t *glass = glass_of(model);
    return (chip->madctl & YB_MADCTL_MV) != 0 ? glass->ram_width : glass->ram_height;
}

/* Everything but picture memory; also the pauses after it. */
static void reset_registers(yb_panel_model_t *model)
{
    chip_t *chip = model->chip;
    const yb_mipi_glass_t *glass = glass_of(model);
    const bool was_awake = chip->awake;
    const yb_model_decoder_t decoder = {0};

    chip->decoder = decoder;
    yb_model_window_reset(&chip->window, glass->ram_width, glass->ram_height);
    chip->writing = chip->has_place = chip->half = false;
    chip->awake = chip->on = chip->inverse = chip->partial = chip->idle = chip->deep = false;
    chip->madctl = 0;
    chip->scan = glass->scan_at_reset;
    chip->command_at_us = model->now_us + SETTLES_US;
    chip->sleep_in_at_us = 0;
    chip->sleep_out_at_us = model->now_us + (was_awake ? AWAKE_SETTLES_US : SETTLES_US);
}

static void reset(yb_panel_model_t *model)
{
    chip_t *chip = model->chip;
    const yb_mipi_glass_t *glass = glass_of(model);

    reset_registers(model);
    yb_model_noise(model, chip->ram, 2U * glass->ram_width * glass->ram_height);
}

static bool soft_reset(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    (void)args;
    reset_registers(model);
    chip->command_at_us = model->now_us + glass_of(model)->settles_us;
    return true;
}

static bool late_enough(yb_panel_model_t *model, uint8_t code, uint64_t at_us, const char *after)
{
    if (!model->timed || model->now_us >= at_us)
        return true;
    return yb_model_fail(model, "command %02Xh came %u us too soon after %s", code,
                         (unsigned)(at_us - model->now_us), after);
}

static bool sleep_in(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    if (!late_enough(model, code, chip->sleep_in_at_us, "sleep-out"))
        return false;
    if (chip->awake) {
        chip->command_at_us = model->now_us + SETTLES_US;
        chip->sleep_out_at_us = model->now_us + AWAKE_SETTLES_US;
    }
    chip->awake = false;
    return true;
}

static bool sleep_out(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    if (!late_enough(model, code, chip->sleep_out_at_us, "a reset or sleep-in"))
        return false;
    if (!chip->awake) {
        chip->command_at_us = model->now_us + glass_of(model)->settles_us;
        chip->sleep_in_at_us = model->now_us + AWAKE_SETTLES_US;
    }
    chip->awake = true;
    return true;
}

static bool set_partial(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->partial = code == 0x12;
    return true;
}

static bool set_inverse(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->inverse = code == 0x21;
    return true;
}

static bool set_on(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->on = code == 0x29;
    return true;
}

static bool set_idle(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    chip->idle = code == 0x39;
    return true;
}

/* "GAMSET": one of four curves. */
static bool set_curve(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    (void)code;
    return (args[0] & (args[0] - 1)) == 0 ||
           yb_model_fail(model, "gamma curve %02Xh is not one of four", args[0]);
}

/* "CASET", "RASET". */
static bool set_window(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;
    const unsigned first = (unsigned)args[0] << 8 | args[1];
    const unsigned last = (unsigned)args[2] << 8 | args[3];

    chip->has_place = false;
    if (code == 0x2A)
        return yb_model_range_set(model, &chip->window.column, "column", first, last,
                                  columns(model));
    return yb_model_range_set(model, &chip->window.row, "row", first, last, rows(model));
}

static bool may_write(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;

    if (!chip->awake)
        return yb_model_fail(model, "pixels before sleep-out");
    if (!chip->deep)
        return yb_model_fail(model, "pixels before 3Ah has set 16 bits for each");
    return true;
}

/* "RAMWR". The window may have been set before rows and columns changed places. */
static bool begin_pixels(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;
    yb_model_window_t *window = &chip->window;

    (void)code;
    (void)args;
    if (!may_write(model))
        return false;
    if (window->column.last >= columns(model) || window->row.last >= rows(model))
        return yb_model_fail(model,
                             "the window ends at %u, %u: off the memory, as it is turned now",
                             window->column.last, window->row.last);
    window->column.at = window->column.first;
    window->row.at = window->row.first;
    window->full = false;
    chip->writing = chip->has_place = true;
    return true;
}

/* "WRMEMC". */
bool yb_mipi_continue_pixels(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)args;
    if (!may_write(model))
        return false;
    if (!chip->has_place)
        return yb_model_fail(model, "command %02Xh has no pixels to go on from", code);
    chip->writing = true;
    return true;
}

/* "MADCTL". */
static bool set_madctl(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    if ((args[0] & 3) != 0)
        return yb_model_fail(model, "MADCTL %02Xh sets bits that the chip does not have", args[0]);
    chip->madctl = args[0];
    chip->has_place = false;
    return true;
}

void yb_mipi_set_scan(yb_panel_model_t *model, uint8_t scan)
{
    chip_t *chip = model->chip;
    chip->scan = scan;
}

/* "COLMOD". */
static bool set_depth(yb_panel_model_t *model, uint8_t code, const uint8_t *args)
{
    chip_t *chip = model->chip;

    (void)code;
    if (args[0] != 0x05 && args[0] != 0x55)
        return yb_model_fail(model, "pixel format %02Xh is not 16 bits a pixel", args[0]);
    chip->deep = true;
    return true;
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

/* What all chips have. */
static const yb_model_command_t commands[] = {
    {0x00, 0x00, 0, 0, 0, NULL}, /* no operation */
    {0x01, 0x01, 0, 0, 0, soft_reset},    {0x04, 0x0F, 0, 0, 0, refuse_read},
    {0x10, 0x10, 0, 0, 0, sleep_in},      {0x11, 0x11, 0, 0, 0, sleep_out},
    {0x12, 0x13, 0, 0, 0, set_partial},   {0x20, 0x21, 0, 0, 0, set_inverse},
    {0x26, 0x26, 1, 1, 8, set_curve},     {0x28, 0x29, 0, 0, 0, set_on},
    {0x2A, 0x2B, 4, 0, 0xFF, set_window}, {0x2C, 0x2C, 0, 0, 0, begin_pixels},
    {0x2E, 0x2E, 0, 0, 0, refuse_read},   {0x30, 0x30, 4, 0, 0xFF, NULL}, /* partial area */
    {0x33, 0x33, 0, 0, 0, refuse_scroll}, {0x34, 0x34, 0, 0, 0, NULL}, /* tearing signal off, on */
    {0x35, 0x35, 1, 0, 1, NULL},          {0x36, 0x36, 1, 0, 0xFF, set_madctl},
    {0x37, 0x37, 0, 0, 0, refuse_scroll}, {0x38, 0x39, 0, 0, 0, set_idle},
    {0x3A, 0x3A, 1, 0, 0xFF, set_depth},  {0xDA, 0xDC, 0, 0, 0, refuse_read},
};

static bool take_command(yb_panel_model_t *model, uint8_t byte)
{
    static const yb_model_table_t table = {commands, sizeof commands / sizeof commands[0]};
    chip_t *chip = model->chip;

    if (!yb_model_finished(model, &chip->decoder))
        return false;
    if (chip->half)
        return yb_model_fail(model, "command %02Xh in the middle of a pixel", byte);
    if (!late_enough(model, byte, chip->command_at_us, "a reset, sleep-in or sleep-out"))
        return false;
    chip->writing = false;
    const yb_model_command_t *command = yb_model_find(table, byte);
    if (command == NULL)
        command = yb_model_find(glass_of(model)->more, byte);
    return yb_model_begin(model, &chip->decoder, command, byte);
}

/* "MADCTL", "Memory Access Control": first rows and columns change places, then each is mirrored.
 * It acts as pixels are written. */
static void write_pixel(yb_panel_model_t *model, uint16_t pixel)
{
    chip_t *chip = model->chip;
    const yb_mipi_glass_t *glass = glass_of(model);
    const bool swapped = (chip->madctl & YB_MADCTL_MV) != 0;
    unsigned x = swapped ? chip->window.row.at : chip->window.column.at;
    unsigned y = swapped ? chip->window.column.at : chip->window.row.at;

    if ((chip->madctl & YB_MADCTL_MX) != 0)
        x = glass->ram_width - 1U - x;
    if ((chip->madctl & YB_MADCTL_MY) != 0)
        y = glass->ram_height - 1U - y;
    chip->ram[y * glass->ram_width + x] = pixel;
    yb_model_window_step(&chip->window, false);
}

static bool take_byte(yb_panel_model_t *model, bool is_data, uint8_t byte)
{
    chip_t *chip = model->chip;

    if (!is_data)
        return take_command(model, byte);
    if (yb_model_unfinished(&chip->decoder))
        return yb_model_argument(model, &chip->decoder, byte);
    if (!chip->writing)
        return yb_model_fail(model, "data %02Xh that no command asked for", byte);
    if (!yb_model_window_open(model, &chip->window))
        return false;
    chip->half = !chip->half;
    if (chip->half)
        chip->high = byte;
    else
        write_pixel(model, (uint16_t)(chip->high << 8 | byte));
    return true;
}

static bool is_lit(const yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    return chip->on && chip->awake;
}

static bool finished(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;

    if (chip->half)
        return yb_model_fail(model, "half a pixel is missing");
    return yb_model_finished(model, &chip->decoder);
}

/* "IDMON": eight colours, by the highest bit of red, green and blue. */
static uint16_t eight_colours(uint16_t pixel)
{
    return (uint16_t)((pixel & 0x8000 ? 0xF800 : 0) | (pixel & 0x0400 ? 0x07E0 : 0) |
                      (pixel & 0x0010 ? 0x001F : 0));
}

static bool set_up_for_glass(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;

    if (((chip->madctl & YB_MADCTL_BGR) != 0) != glass_of(model)->bgr)
        return yb_model_fail(model, "MADCTL %02Xh makes red and blue change places on this glass",
                             chip->madctl);
    if (chip->partial)
        return yb_model_fail(model, "partial mode shows a part of the picture alone");
    if (chip->scan == YB_SCAN_UNKNOWN)
        return yb_model_fail(model, "B6h has not said which way the glass is scanned");
    return true;
}

static bool draw(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;
    const yb_mipi_glass_t *glass = glass_of(model);
    const uint8_t scan = chip->scan ^ glass->scan;
    const bool leftwards = ((glass->upright & YB_MADCTL_MX) != 0) != ((scan & YB_SCAN_SS) != 0);
    const bool upwards = ((glass->upright & YB_MADCTL_MY) != 0) != ((scan & YB_SCAN_GS) != 0);
    const bool light_for_dark = chip->inverse != glass->inverted;

    if (!set_up_for_glass(model))
        return false;
    for (unsigned y = 0; y < model->kind->height; y++) {
        const unsigned row = upwards ? glass->ram_height - 1U - glass->y - y : glass->y + y;
        for (unsigned x = 0; x < model->kind->width; x++) {
            const unsigned column = leftwards ? glass->ram_width - 1U - glass->x - x : glass->x + x;
            uint16_t pixel = chip->ram[row * glass->ram_width + column];
            if (chip->idle)
                pixel = eight_colours(pixel);
            yb_model_put_565(model, x, y, light_for_dark ? (uint16_t)~pixel : pixel);
        }
    }
    return true;
}

const yb_model_family_t yb_model_mipi = {
    .chip_bytes = sizeof(chip_t),
    .reset = reset,
    .byte = take_byte,
    .lit = is_lit,
    .finished = finished,
    .picture = draw,
};
