/* The pins below gpiod_bus: groups of output lines that are set together. One file per version of
 * libgpiod implements it; CMake chooses. */
#ifndef YB_GPIOD_LINES_H
#define YB_GPIOD_LINES_H

#include <stdbool.h>
#include <stddef.h>

enum {
    YB_GPIOD_GROUP_MAX = 4,
};

typedef struct yb_gpiod_chip yb_gpiod_chip_t;
typedef struct yb_gpiod_group yb_gpiod_group_t;

/* NULL, and one sentence in `error`, when there is no such chip or it must not be opened. */
yb_gpiod_chip_t *yb_gpiod_chip_open(const char *name, char *error, size_t error_bytes);
void yb_gpiod_chip_close(yb_gpiod_chip_t *chip);

/* Takes `count` lines, at most YB_GPIOD_GROUP_MAX, as outputs with these values. NULL, and one
 * sentence in `error`, when one of them cannot be had. Free the group before its chip. */
yb_gpiod_group_t *yb_gpiod_group_take(yb_gpiod_chip_t *chip, const int *offsets, const int *values,
                                      size_t count, char *error, size_t error_bytes);
void yb_gpiod_group_free(yb_gpiod_group_t *group);

/* Sets all lines of the group by one system call; false leaves the reason in errno. */
bool yb_gpiod_group_set(yb_gpiod_group_t *group, const int *values);

#endif
