/* Pictures for tests of the drivers, and what the glass of a panel's model shows of them. */
#ifndef PANEL_GLASS_H
#define PANEL_GLASS_H

#include "panel_wire.h"

uint32_t random_below(uint32_t limit);

/* Noise that depends on the seed alone, and sets random_below anew. */
void draw_noise(uint8_t *picture, size_t bytes, uint32_t seed);

size_t frame_bytes(const yb_display_t *display);

/* That the glass shows the frame, light for dark if `flip` is 0xFF. */
void assert_shown(wire_t *wire, const yb_display_t *display, const uint8_t *frame, uint8_t flip);

/* They have no sleep, and are white when they have started. */
bool is_memory_lcd(const yb_panel_t *panel);

/* What a display shows when it has started. */
void blank(const yb_display_t *display, uint8_t *frame);

#endif
