/* GPIO chips and lines by the names that users write, with a sentence for every failure. `error`
 * has YB_LINUX_ERROR_BYTES throughout. */
#ifndef YB_LINUX_LINES_H
#define YB_LINUX_LINES_H

#include "gpiod_lines.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    const char *role; /* what it is for, as the user calls it: "sck" */
    const char *name; /* its number or its name; NULL: not wired */
    unsigned number;  /* found by yb_lines_find */
} yb_line_t;

/* By name, number, path or label; NULL is gpiochip0. */
yb_gpiod_chip_t *yb_lines_chip(const char *name, char *error);

/* Finds the numbers of all lines that are wired; no line may be two of them. */
bool yb_lines_find(yb_gpiod_chip_t *chip, yb_line_t *lines, size_t count, char *error);

/* yb_gpiod_take_outputs and yb_gpiod_take_inputs, with the reason in words. */
yb_gpiod_group_t *yb_lines_take_outputs(yb_gpiod_chip_t *chip, const unsigned *numbers,
                                        const int *values, size_t count, char *error);
yb_gpiod_group_t *yb_lines_take_inputs(yb_gpiod_chip_t *chip, const unsigned *numbers, size_t count,
                                       char *error);

/* That a device file must not be opened, and which group's members may. */
void yb_lines_no_permission(const char *path, char *error);

#endif
