/* A bus that ends in the model of a panel: the driver sends, the model shows. Time is the model's
 * own: a byte takes eight clocks of the panel's rated speed, a pause takes as long as it is asked
 * for, and nobody waits.
 *
 *     yb_model_bus_t wires;
 *     if (!yb_model_bus_open(&wires, &yb_panel_st7789))
 *         no memory, or the panel has no model
 *     yb_display_t display = {.panel = &yb_panel_st7789, .bus = &wires.bus};
 *     yb_display_start(&display) …
 *     yb_panel_model_picture(wires.model, &picture);
 *     yb_model_bus_close(&wires);
 */
#ifndef YB_MODEL_BUS_H
#define YB_MODEL_BUS_H

#include <panel.h>

#include "panel_model.h"

typedef struct {
    yb_panel_bus_t bus;
    yb_panel_model_t *model;
    const yb_panel_t *panel;
    uint64_t nanoseconds; /* of the model's time since it was opened */
} yb_model_bus_t;

/* The struct must stay where it is while the bus is used. */
bool yb_model_bus_open(yb_model_bus_t *wires, const yb_panel_t *panel);
void yb_model_bus_close(yb_model_bus_t *wires);

/* So much time passes without anything on the wires. */
void yb_model_bus_pass(yb_model_bus_t *wires, uint32_t us);

#endif
