/* Updates: only what changed goes over the wire.
 *
 * The caller keeps a copy of what the display shows; a band of rows is compared with it, and only
 * rectangles that hold a difference are written, each as small as it pays: two differences are sent
 * as one rectangle when the pixels between them cost no more bytes than a second window would. The
 * display shows exactly the band afterwards.
 *
 *     static uint8_t shown[YB_UPDATE_BYTES];     yb_screen_pitch(&screen) * screen.height
 *     yb_update_t update = {.display = &display, .shown = shown};
 *     yb_display_start(&display);
 *     for each frame, for each band
 *         yb_update_rows(&update, y, rows, pixels);
 *
 * After a start, and after anything that may have changed the display behind our back, write a
 * frame by yb_update_rows_whole. Bands begin and end on multiples of the display's y step. Pixels
 * go out of `shown`, so the caller may draw the next band while they do.
 */
#ifndef YB_UPDATE_H
#define YB_UPDATE_H

#include "panel.h"

typedef struct {
    yb_display_t *display;
    uint8_t *shown; /* the caller's: every row of the screen, the display's format and turn */
} yb_update_t;

/* Writes `rows` full rows from row `y` down, one after the other in `pixels`. False when the bus
 * failed (what the display shows is then not known) or the rows do not fit. Cost: one comparison of
 * each byte; 340 bytes of stack beside the driver's and 1.2 KB of code on a Cortex-M0 (-Os
 * -fstack-usage). */
bool yb_update_rows(yb_update_t *update, uint16_t y, uint16_t rows, const uint8_t *pixels);

/* The same, and nothing is left out. */
bool yb_update_rows_whole(yb_update_t *update, uint16_t y, uint16_t rows, const uint8_t *pixels);

/* A whole picture turned clockwise, for panels whose chip cannot do it: `from` has the rows of
 * `screen`, `to` gets those of the turned one, width and height exchanged if it lies across.
 * The pieces of memory must not overlap. With two pixels a byte both sides must be even, with eight
 * multiples of eight. */
void yb_turn_picture(const yb_screen_t *screen, yb_turn_t turn, const uint8_t *from, uint8_t *to);

#endif
