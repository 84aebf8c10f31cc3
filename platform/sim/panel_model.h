/* Models of panels: strict ones, that take the bytes which come over a panel's wires and yield the
 * picture that its glass shows.
 *
 * They are made from the datasheets and know no driver. Where a chip would do something odd in
 * silence (an unknown command, an argument out of range, a window off the memory, data beyond the
 * window, pixels while it sleeps, a command too soon after a reset), the model stops and says what
 * was wrong, so that a test can see it. A glass is bonded to its chip in one way; settings that
 * would tear the picture, or show it in wrong colours, are errors too.
 *
 *     yb_panel_model_t *model = yb_panel_model_new("st7789");
 *     for each byte on the wire
 *         if (!yb_panel_model_byte(model, is_data, byte))
 *             puts(yb_panel_model_error(model));
 *     if (yb_panel_model_picture(model, &picture)) ...
 *     yb_panel_model_free(model);
 *
 * Chip select is not a byte's affair but a panel's: tell it by yb_panel_model_select. Panels that
 * frame their bytes by it (Sharp's) take none without; the others count as selected until they are
 * told anything. A mirrored picture is an error where the chip can turn by halves alone, and is
 * shown as it is where the order of addresses may be meant to mirror it back. For PCs only.
 */
#ifndef YB_PANEL_MODEL_H
#define YB_PANEL_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct yb_panel_model yb_panel_model_t;

/* What the glass shows, looked at unturned: red, green, blue, a byte each, row by row from the top.
 * A chip's value of n bits is spread to 8 by repeating its bits from the top (grey level g of 16 is
 * 17 g); a lit pixel of a display without greys is 255. */
typedef struct {
    uint16_t width;
    uint16_t height;
    const uint8_t *rgb; /* the model's; until the next call on it */
} yb_model_picture_t;

/* The names that have a model, one by one: index from 0, NULL after the last. The same as the
 * panels' names in platform/panels. */
const char *yb_panel_model_name(size_t index);

/* A panel that has just got its supply and is as its own power-on reset leaves it, not selected.
 * NULL: no panel of that name, or no memory. At most about 400 KB. */
yb_panel_model_t *yb_panel_model_new(const char *name);
void yb_panel_model_free(yb_panel_model_t *model);

/* The reset line was pulled and let go; panels without one lose their supply for a moment. Picture
 * memory holds noise, as real one does. What was wrong before stays so. */
void yb_panel_model_reset(yb_panel_model_t *model);

/* Chip select becomes active or not, whatever its level. False, and from then on, once anything was
 * wrong. */
bool yb_panel_model_select(yb_panel_model_t *model, bool selected);

/* Takes one byte with the state of D/C (true: data). False once anything was wrong. */
bool yb_panel_model_byte(yb_panel_model_t *model, bool is_data, uint8_t byte);

/* Time has passed. Pauses that a datasheet demands are asked for only if this was called since the
 * last reset, so that a trace without times can be judged too. */
void yb_panel_model_wait(yb_panel_model_t *model, uint32_t us);

/* What the glass shows; black if the display is off or sleeps. False, with an error, when there is
 * no telling: something was wrong, a command is unfinished, or the chip is not set up for its
 * glass. */
bool yb_panel_model_picture(yb_panel_model_t *model, yb_model_picture_t *picture);

/* Whether the display is on and awake, and has the supply that its set-up gives it. */
bool yb_panel_model_lit(const yb_panel_model_t *model);

/* Bytes taken since it was made. */
uint64_t yb_panel_model_bytes(const yb_panel_model_t *model);

/* One sentence, "" while all is well; it begins with "byte N: ". */
const char *yb_panel_model_error(const yb_panel_model_t *model);

#endif
