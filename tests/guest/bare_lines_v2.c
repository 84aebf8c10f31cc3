#include "bare_lines.h"

#include <gpiod.h>
#include <stddef.h>

static struct gpiod_line_request *lines;

bool bare_lines_take(const char *path, unsigned clock, unsigned data)
{
    const unsigned offsets[2] = {clock, data};
    struct gpiod_chip *chip = gpiod_chip_open(path);
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    struct gpiod_line_config *config = gpiod_line_config_new();

    if (chip == NULL || settings == NULL || config == NULL)
        return false;
    gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT);
    if (gpiod_line_config_add_line_settings(config, offsets, 2, settings) != 0)
        return false;
    lines = gpiod_chip_request_lines(chip, NULL, config);
    gpiod_line_config_free(config);
    gpiod_line_settings_free(settings);
    return lines != NULL;
}

bool bare_lines_send(unsigned bits)
{
    for (unsigned i = 0; i < bits; i++) {
        enum gpiod_line_value values[2] = {
            GPIOD_LINE_VALUE_INACTIVE, i & 1 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE};
        if (gpiod_line_request_set_values(lines, values) != 0)
            return false;
        values[0] = GPIOD_LINE_VALUE_ACTIVE;
        if (gpiod_line_request_set_values(lines, values) != 0)
            return false;
    }
    return true;
}
