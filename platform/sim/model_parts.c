#include "model_parts.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>

bool yb_model_fail(yb_panel_model_t *model, const char *format, ...)
{
    va_list args;

    const int used =
        snprintf(model->error, sizeof model->error, "byte %" PRIu64 ": ", model->bytes);
    va_start(args, format);
    (void)vsnprintf(model->error + used, sizeof model->error - (size_t)used, format, args);
    va_end(args);
    model->failed = true;
    return false;
}

void yb_model_noise(yb_panel_model_t *model, void *memory, size_t bytes)
{
    uint8_t *to = memory;

    for (size_t i = 0; i < bytes; i++) {
        model->noise = model->noise * 1664525U + 1013904223U;
        to[i] = (uint8_t)(model->noise >> 24);
    }
}

void yb_model_put(yb_panel_model_t *model, unsigned x, unsigned y, uint8_t red, uint8_t green,
                  uint8_t blue)
{
    uint8_t *rgb = model->rgb + 3 * ((size_t)y * model->kind->width + x);

    rgb[0] = red;
    rgb[1] = green;
    rgb[2] = blue;
}

void yb_model_put_565(yb_panel_model_t *model, unsigned x, unsigned y, uint16_t pixel)
{
    const unsigned red = pixel >> 11;
    const unsigned green = pixel >> 5 & 0x3F;
    const unsigned blue = pixel & 0x1F;

    yb_model_put(model, x, y, (uint8_t)(red << 3 | red >> 2), (uint8_t)(green << 2 | green >> 4),
                 (uint8_t)(blue << 3 | blue >> 2));
}

const yb_model_command_t *yb_model_find(yb_model_table_t table, uint8_t code)
{
    for (size_t i = 0; i < table.count; i++) {
        if (code >= table.commands[i].first && code <= table.commands[i].last)
            return &table.commands[i];
    }
    return NULL;
}

bool yb_model_unfinished(const yb_model_decoder_t *decoder)
{
    return decoder->got < decoder->command.args;
}

bool yb_model_finished(yb_panel_model_t *model, const yb_model_decoder_t *decoder)
{
    if (!yb_model_unfinished(decoder))
        return true;
    return yb_model_fail(model, "command %02Xh still wants %d bytes", decoder->code,
                         decoder->command.args - decoder->got);
}

static bool run(yb_panel_model_t *model, const yb_model_decoder_t *decoder)
{
    if (yb_model_unfinished(decoder) || decoder->command.run == NULL)
        return true;
    return decoder->command.run(model, decoder->code, decoder->args);
}

bool yb_model_begin(yb_panel_model_t *model, yb_model_decoder_t *decoder,
                    const yb_model_command_t *command, uint8_t code)
{
    if (command == NULL)
        return yb_model_fail(model, "%02Xh is no command of this chip", code);
    decoder->command = *command;
    decoder->code = code;
    decoder->got = 0;
    return run(model, decoder);
}

bool yb_model_argument(yb_panel_model_t *model, yb_model_decoder_t *decoder, uint8_t byte)
{
    const yb_model_command_t *command = &decoder->command;

    if (decoder->got == 0 && (byte < command->least || byte > command->most))
        return yb_model_fail(model, "command %02Xh takes %02Xh to %02Xh, not %02Xh", decoder->code,
                             command->least, command->most, byte);
    decoder->args[decoder->got++] = byte;
    return run(model, decoder);
}

void yb_model_window_reset(yb_model_window_t *window, uint16_t columns, uint16_t rows)
{
    *window = (yb_model_window_t){.column = {.last = (uint16_t)(columns - 1)},
                                  .row = {.last = (uint16_t)(rows - 1)}};
}

bool yb_model_range_set(yb_panel_model_t *model, yb_model_range_t *range, const char *what,
                        unsigned first, unsigned last, unsigned count)
{
    if (last >= count)
        return yb_model_fail(model, "%s address %u is beyond the last one, %u", what, last,
                             count - 1);
    if (last < first)
        return yb_model_fail(model, "the window ends at %s %u, before it begins at %u", what, last,
                             first);
    range->first = range->at = (uint16_t)first;
    range->last = (uint16_t)last;
    return true;
}

bool yb_model_window_open(yb_panel_model_t *model, const yb_model_window_t *window)
{
    return !window->full || yb_model_fail(model, "data beyond the end of the window");
}

/* True when it went round. */
static bool step(yb_model_range_t *range)
{
    if (range->at < range->last) {
        range->at++;
        return false;
    }
    range->at = range->first;
    return true;
}

void yb_model_window_step(yb_model_window_t *window, bool vertical)
{
    yb_model_range_t *inner = vertical ? &window->row : &window->column;
    yb_model_range_t *outer = vertical ? &window->column : &window->row;

    window->full = step(inner) && step(outer);
}
