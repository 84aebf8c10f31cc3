#include "model_bus.h"

static bool send(yb_model_bus_t *wires, bool is_data, const uint8_t *bytes, size_t count)
{
    const uint64_t byte_ns = 8000000000u / wires->panel->spi_hz;
    const uint64_t before_us = wires->nanoseconds / 1000;
    bool good = yb_panel_model_select(wires->model, true);

    for (size_t i = 0; good && i < count; i++)
        good = yb_panel_model_byte(wires->model, is_data, bytes[i]);
    good = good && yb_panel_model_select(wires->model, false);
    wires->nanoseconds += count * byte_ns;
    yb_panel_model_wait(wires->model, (uint32_t)(wires->nanoseconds / 1000 - before_us));
    return good;
}

static bool send_command(void *context, const uint8_t *bytes, size_t count)
{
    return send(context, false, bytes, count);
}

static bool send_data(void *context, const uint8_t *bytes, size_t count)
{
    return send(context, true, bytes, count);
}

static bool pull_reset(void *context)
{
    yb_model_bus_t *wires = context;
    yb_panel_model_reset(wires->model);
    return true;
}

static void wait_ms(void *context, uint32_t ms)
{
    yb_model_bus_pass(context, ms * 1000);
}

void yb_model_bus_pass(yb_model_bus_t *wires, uint32_t us)
{
    wires->nanoseconds += (uint64_t)us * 1000;
    yb_panel_model_wait(wires->model, us);
}

bool yb_model_bus_open(yb_model_bus_t *wires, const yb_panel_t *panel)
{
    *wires = (yb_model_bus_t){.bus = {.context = wires,
                                      .command = send_command,
                                      .data = send_data,
                                      .reset = pull_reset,
                                      .wait_ms = wait_ms},
                              .model = yb_panel_model_new(panel->name),
                              .panel = panel};
    return wires->model != NULL;
}

void yb_model_bus_close(yb_model_bus_t *wires)
{
    yb_panel_model_free(wires->model);
    wires->model = NULL;
}
