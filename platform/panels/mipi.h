/* The driver of all panels whose controllers speak MIPI DCS, the display command set: what differs
 * between them is in their yb_panel_t. Colours go out as RGB565, the high byte first.
 *
 * A panel's flags say how its glass is bonded: YB_PANEL_MIRROR_X, _MIRROR_Y, _BGR and _INVERTED;
 * its set-up table sets the pixel format, the frame rate, voltages and gamma curves, but no address
 * mode and no inversion: the driver does that.
 */
#ifndef YB_PANEL_MIPI_H
#define YB_PANEL_MIPI_H

#include "panel_driver.h"

enum {
    YB_MIPI_PIXEL_FORMAT = 0x3A /* argument 05h or, on chips that have an RGB interface, 55h */
};

/* What the descriptions of all such panels say alike: all four turns, single pixels, and a window
 * by 2Ah and 2Bh with four arguments each and 2Ch. */
#define YB_MIPI_PANEL(table)                                                                       \
    .driver = &yb_panel_mipi, .turns = 0x0F, .x_step = 1, .y_step = 1, .window_bytes = 11,         \
    .setup = (table), .setup_bytes = sizeof(table)

extern const yb_panel_driver_t yb_panel_mipi;

#endif
