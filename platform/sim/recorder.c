#include "recorder.h"

static void write_line(yb_recorder_t *recorder, const char *what, const uint8_t *bytes,
                       size_t count)
{
    fputs(what, recorder->to);
    for (size_t i = 0; i < count; i++)
        fprintf(recorder->to, " %02x", bytes[i]);
    putc('\n', recorder->to);
}

static bool record_command(void *context, const uint8_t *bytes, size_t count)
{
    yb_recorder_t *recorder = context;
    const yb_panel_bus_t *next = recorder->next;
    write_line(recorder, "command", bytes, count);
    return next == NULL || next->command(next->context, bytes, count);
}

static bool record_data(void *context, const uint8_t *bytes, size_t count)
{
    yb_recorder_t *recorder = context;
    const yb_panel_bus_t *next = recorder->next;
    write_line(recorder, "data", bytes, count);
    return next == NULL || next->data(next->context, bytes, count);
}

static bool record_pixels(void *context, const uint8_t *bytes, size_t count)
{
    yb_recorder_t *recorder = context;
    write_line(recorder, "data", bytes, count);
    return recorder->next->pixels(recorder->next->context, bytes, count);
}

static bool record_finish(void *context)
{
    const yb_recorder_t *recorder = context;
    return recorder->next->finish(recorder->next->context);
}

static bool record_reset(void *context)
{
    yb_recorder_t *recorder = context;
    const yb_panel_bus_t *next = recorder->next;
    write_line(recorder, "reset", NULL, 0);
    return next == NULL || next->reset == NULL || next->reset(next->context);
}

static void record_wait_ms(void *context, uint32_t ms)
{
    const yb_recorder_t *recorder = context;
    const yb_panel_bus_t *next = recorder->next;
    fprintf(recorder->to, "wait %lu ms\n", (unsigned long)ms);
    if (next != NULL && next->wait_ms != NULL)
        next->wait_ms(next->context, ms);
}

void yb_recorder_init(yb_recorder_t *recorder, FILE *to, const yb_panel_bus_t *next)
{
    *recorder = (yb_recorder_t){.bus = {.context = recorder,
                                        .command = record_command,
                                        .data = record_data,
                                        .reset = record_reset,
                                        .wait_ms = record_wait_ms},
                                .next = next,
                                .to = to};
    if (next != NULL && next->pixels != NULL)
        recorder->bus.pixels = record_pixels;
    if (next != NULL && next->finish != NULL)
        recorder->bus.finish = record_finish;
}
