#include "gpiod_lines.h"

#include <errno.h>
#include <gpiod.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Shown by gpioinfo as the holder of the lines. */
static const char consumer[] = "yamabiko";

struct yb_gpiod_chip {
    struct gpiod_chip *chip;
    const char *name;
};

struct yb_gpiod_group {
    struct gpiod_line_bulk bulk;
};

static void explain_chip(const char *name, int why, char *error, size_t error_bytes)
{
    switch (why) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
        snprintf(error, error_bytes,
                 "there is no GPIO chip \"%s\"; gpiodetect lists the chips of this machine", name);
        break;
    case EACCES:
    case EPERM:
        snprintf(error, error_bytes,
                 "no permission to open GPIO chip \"%s\"; become a member of the group that owns "
                 "/dev/gpiochip*, or root",
                 name);
        break;
    case ENOTTY:
    case EINVAL:
        snprintf(error, error_bytes, "\"%s\" is not a GPIO chip; gpiodetect lists those there are",
                 name);
        break;
    default:
        snprintf(error, error_bytes, "GPIO chip \"%s\" cannot be opened: %s", name, strerror(why));
        break;
    }
}

yb_gpiod_chip_t *yb_gpiod_chip_open(const char *name, char *error, size_t error_bytes)
{
    yb_gpiod_chip_t *chip = calloc(1, sizeof *chip);

    if (chip == NULL) {
        snprintf(error, error_bytes, "out of memory");
        return NULL;
    }
    errno = 0;
    chip->chip = gpiod_chip_open_lookup(name);
    if (chip->chip == NULL) {
        explain_chip(name, errno, error, error_bytes);
        free(chip);
        return NULL;
    }
    chip->name = gpiod_chip_name(chip->chip);
    return chip;
}

void yb_gpiod_chip_close(yb_gpiod_chip_t *chip)
{
    if (chip == NULL)
        return;
    gpiod_chip_close(chip->chip);
    free(chip);
}

/* The kernel refuses the group as a whole: look for the line that is the reason. */
static void explain_group(yb_gpiod_group_t *group, const char *chip, int why, char *error,
                          size_t error_bytes)
{
    for (unsigned i = 0; i < gpiod_line_bulk_num_lines(&group->bulk); i++) {
        struct gpiod_line *line = gpiod_line_bulk_get_line(&group->bulk, i);
        const unsigned offset = gpiod_line_offset(line);
        if (gpiod_line_update(line) != 0 || !gpiod_line_is_used(line))
            continue;
        const char *holder = gpiod_line_consumer(line);
        if (holder != NULL)
            snprintf(error, error_bytes, "line %u of %s is busy: \"%s\" holds it", offset, chip,
                     holder);
        else
            snprintf(error, error_bytes,
                     "line %u of %s is busy: something that gave no name holds it", offset, chip);
        return;
    }
    if (why == EACCES || why == EPERM)
        snprintf(error, error_bytes, "no permission to take lines of %s as outputs", chip);
    else
        snprintf(error, error_bytes, "lines of %s cannot be taken as outputs: %s", chip,
                 strerror(why));
}

yb_gpiod_group_t *yb_gpiod_group_take(yb_gpiod_chip_t *chip, const int *offsets, const int *values,
                                      size_t count, char *error, size_t error_bytes)
{
    const unsigned lines = gpiod_chip_num_lines(chip->chip);
    yb_gpiod_group_t *group = calloc(1, sizeof *group);

    if (group == NULL) {
        snprintf(error, error_bytes, "out of memory");
        return NULL;
    }
    gpiod_line_bulk_init(&group->bulk);
    for (size_t i = 0; i < count; i++) {
        if (offsets[i] < 0 || (unsigned)offsets[i] >= lines) {
            snprintf(error, error_bytes, "there is no line %d: %s has lines 0 to %u", offsets[i],
                     chip->name, lines - 1);
            goto free_group;
        }
        struct gpiod_line *line = gpiod_chip_get_line(chip->chip, (unsigned)offsets[i]);
        if (line == NULL) {
            snprintf(error, error_bytes, "line %d of %s cannot be read: %s", offsets[i], chip->name,
                     strerror(errno));
            goto free_group;
        }
        gpiod_line_bulk_add(&group->bulk, line);
    }
    if (gpiod_line_request_bulk_output(&group->bulk, consumer, values) != 0) {
        explain_group(group, chip->name, errno, error, error_bytes);
        goto free_group;
    }
    return group;

free_group:
    free(group);
    return NULL;
}

void yb_gpiod_group_free(yb_gpiod_group_t *group)
{
    if (group == NULL)
        return;
    gpiod_line_release_bulk(&group->bulk);
    free(group);
}

bool yb_gpiod_group_set(yb_gpiod_group_t *group, const int *values)
{
    return gpiod_line_set_value_bulk(&group->bulk, values) == 0;
}
