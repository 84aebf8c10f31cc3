/* The board's OLED as a panel bus: SSD0323 on SSI 0. */
#ifndef YB_LM3S6965EVB_OLED_H
#define YB_LM3S6965EVB_OLED_H

#include "panel.h"

/* Gives the pins and SSI 0 their clocks and functions and the glass its supply. To be called once,
 * after yb_board_init and before anything is sent over yb_oled_bus.
 */
void yb_oled_start(void);

extern const yb_panel_bus_t yb_oled_bus;

#endif
