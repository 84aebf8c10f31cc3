/* A panel's bus for tests of the drivers: it ends in the panel's model, fails when it is told to,
 * and can be slow to fetch pixels. What the model refuses fails the test. */
#ifndef PANEL_WIRE_H
#define PANEL_WIRE_H

#include "panel.h"
#include "panel_model.h"

typedef struct {
    const yb_panel_t *panel;
    yb_panel_model_t *model; /* NULL: bytes are only counted */
    size_t transfers_left;   /* the bus fails when they are used up */
    size_t bytes;
    unsigned resets;
    uint32_t waited_ms;
    const uint8_t *late; /* pixels still to go out */
    size_t late_count;
} wire_t;

/* A bus to a fresh model of the panel, which knows no time until the driver waits; and one that
 * only counts. The wire must stay where it is. */
yb_panel_bus_t wire_connect(wire_t *wire, const yb_panel_t *panel);
yb_panel_bus_t wire_connect_blind(wire_t *wire, const yb_panel_t *panel);
void wire_disconnect(wire_t *wire);

/* For the bus's `pixels` and `finish`: as if by DMA, pixels are fetched at the next call. */
bool wire_pixels_late(void *context, const uint8_t *bytes, size_t count);
bool wire_finish(void *context);

#endif
