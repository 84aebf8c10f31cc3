#include "gpiod_bus.h"

#include <stdio.h>
#include <string.h>

enum {
    OFFSET_DIGITS_MAX = 4,
    NAME_COLUMNS_MAX = 20
};

/* A line's number after its '='; the character after it, or NULL when there is no number. */
static const char *read_offset(const char *text, int *offset)
{
    int value = 0;
    int digits = 0;

    while (*text >= '0' && *text <= '9' && digits < OFFSET_DIGITS_MAX) {
        value = value * 10 + (*text++ - '0');
        digits++;
    }
    *offset = value;
    return digits > 0 && (*text == '\0' || *text == ',') ? text : NULL;
}

bool yb_gpiod_pins_parse(yb_gpiod_pins_t *pins, const char *text, char *error, size_t error_bytes)
{
    const struct {
        const char *name;
        int *line;
    } lines[] = {{"sck=", &pins->sck},
                 {"mosi=", &pins->mosi},
                 {"cs=", &pins->cs},
                 {"dc=", &pins->dc},
                 {"reset=", &pins->reset}};
    const size_t count = sizeof lines / sizeof lines[0];
    const char *at = text;

    for (size_t i = 0; i < count; i++)
        *lines[i].line = YB_GPIOD_NOT_WIRED;
    for (;;) {
        size_t i = 0;
        while (i < count && strncmp(at, lines[i].name, strlen(lines[i].name)) != 0)
            i++;
        const int columns = (int)strcspn(at, ",");
        const int shown = columns < NAME_COLUMNS_MAX ? columns : NAME_COLUMNS_MAX;
        if (i == count) {
            snprintf(error, error_bytes,
                     "\"%.*s\" is not one of sck=N, mosi=N, cs=N, dc=N, reset=N", shown, at);
            return false;
        }
        if (*lines[i].line != YB_GPIOD_NOT_WIRED) {
            snprintf(error, error_bytes, "\"%.*s\" names that line a second time", shown, at);
            return false;
        }
        const char *end = read_offset(at + strlen(lines[i].name), lines[i].line);
        if (end == NULL) {
            snprintf(error, error_bytes, "\"%.*s\" has no line number, 0 to 9999", shown, at);
            return false;
        }
        if (*end == '\0')
            break;
        at = end + 1;
    }
    for (size_t i = 0; i < count - 1; i++) {
        if (*lines[i].line == YB_GPIOD_NOT_WIRED) {
            snprintf(error, error_bytes, "\"%s\" lacks %sN", text, lines[i].name);
            return false;
        }
    }
    return true;
}
