#include "panel_wire.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static bool feed(wire_t *wire, bool is_data, const uint8_t *bytes, size_t count)
{
    assert_true(count > 0);
    if (wire->transfers_left == 0)
        return false;
    wire->transfers_left--;
    wire->bytes += count;
    if (wire->model == NULL)
        return true;
    bool well = yb_panel_model_select(wire->model, true);
    for (size_t i = 0; well && i < count; i++)
        well = yb_panel_model_byte(wire->model, is_data, bytes[i]);
    if (!well || !yb_panel_model_select(wire->model, false))
        fail_msg("%s: the model refused: %s", wire->panel->name, yb_panel_model_error(wire->model));
    return true;
}

bool wire_finish(void *context)
{
    wire_t *wire = context;
    const uint8_t *late = wire->late;

    wire->late = NULL;
    return late == NULL || feed(wire, true, late, wire->late_count);
}

static bool wire_command(void *context, const uint8_t *bytes, size_t count)
{
    return wire_finish(context) && feed(context, false, bytes, count);
}

static bool wire_data(void *context, const uint8_t *bytes, size_t count)
{
    return wire_finish(context) && feed(context, true, bytes, count);
}

bool wire_pixels_late(void *context, const uint8_t *bytes, size_t count)
{
    wire_t *wire = context;
    const bool well = wire_finish(context);

    wire->late = bytes;
    wire->late_count = count;
    return well;
}

static bool wire_reset(void *context)
{
    wire_t *wire = context;
    wire->resets++;
    if (wire->model != NULL)
        yb_panel_model_reset(wire->model);
    return wire->transfers_left > 0;
}

static void wire_wait_ms(void *context, uint32_t ms)
{
    wire_t *wire = context;
    wire->waited_ms += ms;
    if (wire->model != NULL)
        yb_panel_model_wait(wire->model, ms * 1000);
}

yb_panel_bus_t wire_connect_blind(wire_t *wire, const yb_panel_t *panel)
{
    *wire = (wire_t){.panel = panel, .transfers_left = SIZE_MAX};
    return (yb_panel_bus_t){
        .context = wire,
        .command = (panel->flags & YB_PANEL_NO_DC) != 0 ? NULL : wire_command,
        .data = wire_data,
        .reset = wire_reset,
        .wait_ms = wire_wait_ms,
    };
}

yb_panel_bus_t wire_connect(wire_t *wire, const yb_panel_t *panel)
{
    const yb_panel_bus_t bus = wire_connect_blind(wire, panel);
    wire->model = yb_panel_model_new(panel->name);
    if (wire->model == NULL)
        fail_msg("%s: there is no model", panel->name);
    return bus;
}

void wire_disconnect(wire_t *wire)
{
    yb_panel_model_free(wire->model);
    wire->model = NULL;
}
