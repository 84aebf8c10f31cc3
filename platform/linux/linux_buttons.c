#include "linux_buttons.h"

#include "linux_bus.h"
#include "linux_lines.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

static const uint64_t bounce_ns = 30 * UINT64_C(1000000);

struct yb_linux_buttons {
    yb_gpiod_chip_t *chip;
    yb_gpiod_group_t *group;
    bool moved[YB_LINUX_BUTTONS_MAX];        /* whether a line ever did */
    uint64_t moved_ns[YB_LINUX_BUTTONS_MAX]; /* and when it did last */
};

yb_linux_buttons_t *yb_linux_buttons_open(const char *chip, const char *const *lines, size_t count,
                                          char *error)
{
    yb_line_t wanted[YB_LINUX_BUTTONS_MAX];
    char roles[YB_LINUX_BUTTONS_MAX][16];
    unsigned numbers[YB_LINUX_BUTTONS_MAX];

    if (count == 0 || count > YB_LINUX_BUTTONS_MAX) {
        snprintf(error, YB_LINUX_ERROR_BYTES, "there can be 1 to %d buttons, not %zu",
                 YB_LINUX_BUTTONS_MAX, count);
        return NULL;
    }
    yb_linux_buttons_t *buttons = calloc(1, sizeof *buttons);
    if (buttons == NULL) {
        snprintf(error, YB_LINUX_ERROR_BYTES, "out of memory");
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        snprintf(roles[i], sizeof roles[i], "button %u", (unsigned)i + 1);
        wanted[i] = (yb_line_t){roles[i], lines[i], 0};
    }
    buttons->chip = yb_lines_chip(chip, error);
    if (buttons->chip == NULL)
        goto free_buttons;
    if (!yb_lines_find(buttons->chip, wanted, count, error))
        goto close_chip;
    for (size_t i = 0; i < count; i++)
        numbers[i] = wanted[i].number;
    buttons->group = yb_lines_take_inputs(buttons->chip, numbers, count, error);
    if (buttons->group == NULL)
        goto close_chip;
    return buttons;

close_chip:
    yb_gpiod_chip_close(buttons->chip);
free_buttons:
    free(buttons);
    return NULL;
}

int yb_linux_buttons_fd(const yb_linux_buttons_t *buttons)
{
    return yb_gpiod_group_fd(buttons->group);
}

/* Contacts bounce when they open, too, and those falls are no presses. So both edges are taken, and
 * a press is a fall after a time without any. */
int yb_linux_buttons_read(yb_linux_buttons_t *buttons)
{
    yb_gpiod_edge_t edge;
    int status;

    while ((status = yb_gpiod_group_read(buttons->group, &edge)) > 0) {
        const bool rested = !buttons->moved[edge.index] ||
                            edge.time_ns - buttons->moved_ns[edge.index] >= bounce_ns;
        buttons->moved[edge.index] = true;
        buttons->moved_ns[edge.index] = edge.time_ns;
        if (edge.falling && rested)
            return (int)edge.index;
    }
    return status == 0 ? -1 : -2;
}

void yb_linux_buttons_close(yb_linux_buttons_t *buttons)
{
    if (buttons == NULL)
        return;
    yb_gpiod_group_free(buttons->group);
    yb_gpiod_chip_close(buttons->chip);
    free(buttons);
}
