/* Model of Sharp's memory LCDs: LS013B7DH03, LS013B7DH05, LS027B7DH01.
 *
 * "Datasheet" is Sharp's specification of each; they differ in size alone. Chip select frames what
 * is sent. First comes a byte with the mode bits on top: M0 write, M1 the side of VCOM, M2 clear;
 * the rest of it is dummy bits ("Input Signal Timing Chart": "Data Update Mode, Multiple Lines",
 * "Display Mode", "All Clear Mode"). After it:
 *
 *     write     line number, pixels, dummy byte; again for each line; one dummy byte more
 *     display   one dummy byte (only VCOM is set)
 *     clear     one dummy byte
 *
 * Lines are numbered from 1, the lowest bit first. A set bit is a white pixel, the first one is the
 * leftmost. The datasheets call dummy bits "don't care" and draw them low; the model wants them
 * low, so that a line too short or too long is noticed. */
#include "model_parts.h"

#include <string.h>

enum {
    MOST_LINE_BYTES = 400 / 8,
    MOST_LINES = 240,

    M0_WRITE = 0x80,
    M1_VCOM = 0x40,
    M2_CLEAR = 0x20,

    VCOM_US = 1000000, /* Datasheet, "VCOM inversion": at least once a second */
};

typedef enum {
    MODE,     /* the mode byte comes next */
    LINE,     /* a line number or, after a line, the last dummy byte */
    PIXELS,   /* of the line */
    TRAILER,  /* a line's dummy byte */
    ONE_LAST, /* the dummy byte that ends display and clear modes */
    OVER,
} expected_t;

typedef struct {
    uint8_t ram[MOST_LINES][MOST_LINE_BYTES];
    uint8_t line_bytes[MOST_LINE_BYTES];
    expected_t expected;
    unsigned line; /* from 1; 0: none yet */
    unsigned got;
    bool clear;
    bool vcom;
    bool vcom_known;
    uint64_t vcom_since_us;
} chip_t;

static void reset(yb_panel_model_t *model)
{
    chip_t *chip = model->chip;

    memset(chip, 0, sizeof *chip);
    yb_model_noise(model, chip->ram, sizeof chip->ram);
}

static bool vcom_in_time(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;

    if (!chip->vcom_known || model->now_us - chip->vcom_since_us <= VCOM_US)
        return true;
    return yb_model_fail(model, "VCOM has kept its side for more than a second");
}

static bool take_mode(yb_panel_model_t *model, uint8_t byte)
{
    chip_t *chip = model->chip;
    const bool vcom = (byte & M1_VCOM) != 0;

    if ((byte & ~(M0_WRITE | M1_VCOM | M2_CLEAR)) != 0)
        return yb_model_fail(model, "mode byte %02Xh sets dummy bits", byte);
    if ((byte & M0_WRITE) != 0 && (byte & M2_CLEAR) != 0)
        return yb_model_fail(model, "mode byte %02Xh writes and clears at once", byte);
    if (!chip->vcom_known || chip->vcom != vcom)
        chip->vcom_since_us = model->now_us;
    chip->vcom = vcom;
    chip->vcom_known = true;
    chip->clear = (byte & M2_CLEAR) != 0;
    chip->line = 0;
    chip->expected = (byte & M0_WRITE) != 0 ? LINE : ONE_LAST;
    return true;
}

static unsigned reversed(uint8_t byte)
{
    unsigned result = 0;

    for (int bit = 0; bit < 8; bit++)
        result = result << 1 | (byte >> bit & 1U);
    return result;
}

static bool take_line_number(yb_panel_model_t *model, uint8_t byte)
{
    chip_t *chip = model->chip;
    const unsigned line = reversed(byte);

    if (line == 0 && chip->line != 0) {
        chip->expected = OVER;
        return true;
    }
    if (line == 0 || line > model->kind->height)
        return yb_model_fail(model, "line %u is not one of 1 to %u", line, model->kind->height);
    chip->line = line;
    chip->got = 0;
    chip->expected = PIXELS;
    return true;
}

static bool take_dummy(yb_panel_model_t *model, uint8_t byte)
{
    chip_t *chip = model->chip;

    if (byte != 0)
        return yb_model_fail(model, "%02Xh where a dummy byte belongs", byte);
    if (chip->expected == TRAILER) {
        memcpy(chip->ram[chip->line - 1], chip->line_bytes, sizeof chip->line_bytes);
        chip->expected = LINE;
        return true;
    }
    if (chip->clear)
        memset(chip->ram, 0xFF, sizeof chip->ram);
    chip->expected = OVER;
    return true;
}

static bool take_byte(yb_panel_model_t *model, bool is_data, uint8_t byte)
{
    chip_t *chip = model->chip;

    (void)is_data;
    switch (chip->expected) {
    case MODE:
        return take_mode(model, byte);
    case LINE:
        return take_line_number(model, byte);
    case PIXELS:
        chip->line_bytes[chip->got++] = byte;
        if (chip->got == model->kind->width / 8U)
            chip->expected = TRAILER;
        return true;
    case TRAILER:
    case ONE_LAST:
        return take_dummy(model, byte);
    default:
        return yb_model_fail(model, "%02Xh after the transfer's last byte", byte);
    }
}

/* A transfer ends when the panel is no longer selected. */
static bool take_select(yb_panel_model_t *model, bool selected)
{
    chip_t *chip = model->chip;
    const expected_t expected = chip->expected;

    chip->expected = MODE;
    if (selected || expected == OVER)
        return true;
    if (expected == MODE)
        return yb_model_fail(model, "the transfer has no bytes");
    if (expected == LINE && chip->line == 0)
        return yb_model_fail(model, "the transfer ends before it names a line");
    if (expected == PIXELS)
        return yb_model_fail(model, "the transfer ends after %u of %u bytes of line %u", chip->got,
                             model->kind->width / 8U, chip->line);
    return yb_model_fail(model, "the transfer ends before its last dummy byte");
}

/* The glass shows its memory as long as it has its supply. */
static bool is_lit(const yb_panel_model_t *model)
{
    (void)model;
    return true;
}

static bool finished(yb_panel_model_t *model)
{
    return !model->selected || yb_model_fail(model, "the panel is still selected");
}

static bool draw(yb_panel_model_t *model)
{
    const chip_t *chip = model->chip;

    for (unsigned y = 0; y < model->kind->height; y++) {
        for (unsigned x = 0; x < model->kind->width; x++) {
            const bool white = (chip->ram[y][x / 8] << x % 8 & 0x80) != 0;
            const uint8_t grey = white ? 0xFF : 0x00;
            yb_model_put(model, x, y, grey, grey, grey);
        }
    }
    return true;
}

const yb_model_family_t yb_model_sharp = {
    .chip_bytes = sizeof(chip_t),
    .must_be_selected = true,
    .reset = reset,
    .byte = take_byte,
    .select = take_select,
    .wait = vcom_in_time,
    .lit = is_lit,
    .finished = finished,
    .picture = draw,
};
