/* A strict model of the SSD0323 panel: takes the bytes that come over its wires and yields the
 * picture that its glass shows.
 *
 * It is made from the chip's datasheet and knows no driver. Where the chip would do something odd
 * in silence (an unknown command, an argument out of range, data beyond the window), the model
 * stops and says what was wrong, so that a test can see it. The glass is bonded in one way only;
 * settings that would turn or tear the picture are errors too.
 *
 *     yb_ssd0323_model_t model;
 *     yb_ssd0323_model_reset(&model);
 *     for each byte on the wire
 *         if (!yb_ssd0323_model_byte(&model, is_data, byte))
 *             puts(model.error);
 *     yb_ssd0323_model_picture(&model, picture);
 *
 * No heap; the struct is the caller's and all its fields may be read.
 */
#ifndef YB_SSD0323_MODEL_H
#define YB_SSD0323_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    YB_SSD0323_COLUMNS = 64, /* bytes in a row, two pixels each */
    YB_SSD0323_RAM_ROWS = 80,
    YB_SSD0323_WIDTH = 128,
    YB_SSD0323_HEIGHT = 64,
    YB_SSD0323_PICTURE_BYTES = YB_SSD0323_COLUMNS * YB_SSD0323_HEIGHT,
};

typedef struct {
    uint8_t ram[YB_SSD0323_RAM_ROWS][YB_SSD0323_COLUMNS];

    uint8_t command; /* the command that waits for its arguments */
    uint8_t args[8];
    uint8_t args_wanted;
    uint8_t args_got;

    uint8_t column_first, column_last, column;
    uint8_t row_first, row_last, row;
    bool window_full;

    bool on;
    uint8_t mode; /* A4h normal, A5h all on, A6h all off, A7h inverse */
    uint8_t remap;
    uint8_t start_line;
    uint8_t offset;
    uint8_t rows_shown;
    uint8_t contrast;

    uint32_t bytes; /* taken since the reset, the refused one included */
    bool failed;
    char error[120]; /* one sentence, empty while all is well */
} yb_ssd0323_model_t;

/* The state after the reset line was pulled; the RAM holds noise, as a real one does. */
void yb_ssd0323_model_reset(yb_ssd0323_model_t *model);

/* Takes one byte with the state of D/C. False once anything was wrong, and from then on. */
bool yb_ssd0323_model_byte(yb_ssd0323_model_t *model, bool is_data, uint8_t byte);

/* What the glass shows, two pixels a byte, the high nibble left. False, with an error, when there
 * is no telling: something was wrong, a command is unfinished, or the chip is not set up for the
 * glass. A display that is off is black. */
bool yb_ssd0323_model_picture(yb_ssd0323_model_t *model, uint8_t picture[YB_SSD0323_PICTURE_BYTES]);

#endif
