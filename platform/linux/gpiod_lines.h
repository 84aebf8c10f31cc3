/* GPIO lines as libgpiod gives them: groups of outputs that are set together, groups of inputs
 * whose edges are told. gpiod_lines_v1.c is it on libgpiod 1.x, gpiod_lines_v2.c on 2.x; CMake
 * builds one of them. Failures are left in errno: linux_lines.h makes sentences of them. */
#ifndef YB_GPIOD_LINES_H
#define YB_GPIOD_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    YB_GPIOD_GROUP_MAX = 16, /* lines in a group */
    YB_GPIOD_NAME_BYTES = 64,
};

typedef struct yb_gpiod_chip yb_gpiod_chip_t;
typedef struct yb_gpiod_group yb_gpiod_group_t;

typedef struct {
    unsigned index; /* of the line in its group */
    bool falling;
    uint64_t time_ns; /* of a clock that nobody sets */
} yb_gpiod_edge_t;

/* ---- Chips ----------------------------------------------------------------------------------- */

/* The chip behind a device file. NULL: errno says why, ENOTTY if it is something else. */
yb_gpiod_chip_t *yb_gpiod_chip_open(const char *path);
void yb_gpiod_chip_close(yb_gpiod_chip_t *chip);

const char *yb_gpiod_chip_name(const yb_gpiod_chip_t *chip); /* "gpiochip0" */
const char *yb_gpiod_chip_label(const yb_gpiod_chip_t *chip);
unsigned yb_gpiod_chip_lines(const yb_gpiod_chip_t *chip);

/* The number of the first line of that name; -1: there is none. */
int yb_gpiod_chip_find(yb_gpiod_chip_t *chip, const char *line_name);

/* Whether something holds the line, and what it calls itself: "" if it gave no name. */
bool yb_gpiod_chip_holder(yb_gpiod_chip_t *chip, unsigned line, char holder[YB_GPIOD_NAME_BYTES]);

/* ---- Groups -----------------------------------------------------------------------------------
 * At most YB_GPIOD_GROUP_MAX lines, held exclusively until the group is freed, all or none of them.
 * Free the group before its chip. */

yb_gpiod_group_t *yb_gpiod_take_outputs(yb_gpiod_chip_t *chip, const unsigned *lines,
                                        const int *values, size_t count);

/* Inputs, pulled up where the kernel can do that. */
yb_gpiod_group_t *yb_gpiod_take_inputs(yb_gpiod_chip_t *chip, const unsigned *lines, size_t count);

void yb_gpiod_group_free(yb_gpiod_group_t *group);

/* Sets all lines of a group of outputs by one system call. */
bool yb_gpiod_group_set(yb_gpiod_group_t *group, const int *values);

/* A descriptor that can be read, for poll, while edges of a group of inputs wait. */
int yb_gpiod_group_fd(const yb_gpiod_group_t *group);

/* 1 and the next edge, in order for each line; 0: none waits; -1: errno says why. Does not wait. */
int yb_gpiod_group_read(yb_gpiod_group_t *group, yb_gpiod_edge_t *edge);

#endif
