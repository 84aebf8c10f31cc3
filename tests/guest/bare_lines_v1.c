#include "bare_lines.h"

#include <gpiod.h>

static struct gpiod_line_bulk lines;

bool bare_lines_take(const char *path, unsigned clock, unsigned data)
{
    static const int low[2] = {0, 0};
    unsigned offsets[2] = {clock, data};
    struct gpiod_chip *chip = gpiod_chip_open(path);

    return chip != NULL && gpiod_chip_get_lines(chip, offsets, 2, &lines) == 0 &&
           gpiod_line_request_bulk_output(&lines, "bare", low) == 0;
}

bool bare_lines_send(unsigned bits)
{
    for (unsigned i = 0; i < bits; i++) {
        int values[2] = {0, (int)(i & 1)};
        if (gpiod_line_set_value_bulk(&lines, values) != 0)
            return false;
        values[0] = 1;
        if (gpiod_line_set_value_bulk(&lines, values) != 0)
            return false;
    }
    return true;
}
