#include "gpiod_lines.h"

#include <errno.h>
#include <gpiod.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/epoll.h>
#include <unistd.h>

/* Shown by gpioinfo as the holder of the lines. */
static const char consumer[] = "yamabiko";

struct yb_gpiod_chip {
    struct gpiod_chip *chip;
};

/* Of inputs, each line has a descriptor of its own; one of epoll stands for them all. */
struct yb_gpiod_group {
    struct gpiod_line_bulk bulk;
    int epoll; /* -1 for outputs */
};

/* ---- Chips ----------------------------------------------------------------------------------- */

yb_gpiod_chip_t *yb_gpiod_chip_open(const char *path)
{
    yb_gpiod_chip_t *chip = calloc(1, sizeof *chip);

    if (chip == NULL)
        return NULL;
    chip->chip = gpiod_chip_open(path);
    if (chip->chip == NULL) {
        free(chip);
        return NULL;
    }
    return chip;
}

void yb_gpiod_chip_close(yb_gpiod_chip_t *chip)
{
    if (chip == NULL)
        return;
    gpiod_chip_close(chip->chip);
    free(chip);
}

const char *yb_gpiod_chip_name(const yb_gpiod_chip_t *chip)
{
    return gpiod_chip_name(chip->chip);
}

const char *yb_gpiod_chip_label(const yb_gpiod_chip_t *chip)
{
    return gpiod_chip_label(chip->chip);
}

unsigned yb_gpiod_chip_lines(const yb_gpiod_chip_t *chip)
{
    return gpiod_chip_num_lines(chip->chip);
}

int yb_gpiod_chip_find(yb_gpiod_chip_t *chip, const char *line_name)
{
    struct gpiod_line *line = gpiod_chip_find_line(chip->chip, line_name);
    return line != NULL ? (int)gpiod_line_offset(line) : -1;
}

bool yb_gpiod_chip_holder(yb_gpiod_chip_t *chip, unsigned line, char holder[YB_GPIOD_NAME_BYTES])
{
    struct gpiod_line *held = gpiod_chip_get_line(chip->chip, line);

    if (held == NULL || gpiod_line_update(held) != 0 || !gpiod_line_is_used(held))
        return false;
    const char *name = gpiod_line_consumer(held);
    snprintf(holder, YB_GPIOD_NAME_BYTES, "%s", name != NULL ? name : "");
    return true;
}

/* ---- Groups ---------------------------------------------------------------------------------- */

static yb_gpiod_group_t *group_new(yb_gpiod_chip_t *chip, const unsigned *lines, size_t count)
{
    yb_gpiod_group_t *group = calloc(1, sizeof *group);

    if (group == NULL)
        return NULL;
    group->epoll = -1;
    gpiod_line_bulk_init(&group->bulk);
    for (size_t i = 0; i < count; i++) {
        struct gpiod_line *line = gpiod_chip_get_line(chip->chip, lines[i]);
        if (line == NULL) {
            free(group);
            return NULL;
        }
        gpiod_line_bulk_add(&group->bulk, line);
    }
    return group;
}

yb_gpiod_group_t *yb_gpiod_take_outputs(yb_gpiod_chip_t *chip, const unsigned *lines,
                                        const int *values, size_t count)
{
    yb_gpiod_group_t *group = group_new(chip, lines, count);

    if (group == NULL)
        return NULL;
    if (gpiod_line_request_bulk_output(&group->bulk, consumer, values) != 0) {
        free(group);
        return NULL;
    }
    return group;
}

static bool watch(yb_gpiod_group_t *group)
{
    group->epoll = epoll_create1(EPOLL_CLOEXEC);
    if (group->epoll < 0)
        return false;
    for (unsigned i = 0; i < gpiod_line_bulk_num_lines(&group->bulk); i++) {
        struct epoll_event readable = {.events = EPOLLIN, .data.u32 = i};
        const int fd = gpiod_line_event_get_fd(gpiod_line_bulk_get_line(&group->bulk, i));
        if (fd < 0 || epoll_ctl(group->epoll, EPOLL_CTL_ADD, fd, &readable) != 0)
            return false;
    }
    return true;
}

yb_gpiod_group_t *yb_gpiod_take_inputs(yb_gpiod_chip_t *chip, const unsigned *lines, size_t count)
{
    yb_gpiod_group_t *group = group_new(chip, lines, count);

    if (group == NULL)
        return NULL;
    if (gpiod_line_request_bulk_both_edges_events_flags(
            &group->bulk, consumer, GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP) != 0 &&
        (errno == EBUSY ||
         gpiod_line_request_bulk_both_edges_events(&group->bulk, consumer) != 0)) {
        free(group);
        return NULL;
    }
    if (!watch(group)) {
        const int why = errno;
        yb_gpiod_group_free(group);
        errno = why;
        return NULL;
    }
    return group;
}

void yb_gpiod_group_free(yb_gpiod_group_t *group)
{
    if (group == NULL)
        return;
    if (group->epoll >= 0)
        close(group->epoll);
    gpiod_line_release_bulk(&group->bulk);
    free(group);
}

bool yb_gpiod_group_set(yb_gpiod_group_t *group, const int *values)
{
    int status;

    do
        status = gpiod_line_set_value_bulk(&group->bulk, values);
    while (status != 0 && errno == EINTR);
    return status == 0;
}

int yb_gpiod_group_fd(const yb_gpiod_group_t *group)
{
    return group->epoll;
}

/* Asks each line itself: from the one of epoll it would not be heard that the chip is gone. */
static int line_that_waits(yb_gpiod_group_t *group)
{
    struct pollfd fds[YB_GPIOD_GROUP_MAX];
    const unsigned count = gpiod_line_bulk_num_lines(&group->bulk);
    int status;

    for (unsigned i = 0; i < count; i++) {
        const int fd = gpiod_line_event_get_fd(gpiod_line_bulk_get_line(&group->bulk, i));
        fds[i] = (struct pollfd){.fd = fd, .events = POLLIN};
    }
    do
        status = poll(fds, count, 0);
    while (status < 0 && errno == EINTR);
    for (unsigned i = 0; status > 0 && i < count; i++) {
        if (fds[i].revents != 0)
            return (int)i;
    }
    return -1;
}

int yb_gpiod_group_read(yb_gpiod_group_t *group, yb_gpiod_edge_t *edge)
{
    struct gpiod_line_event event;
    int status;

    const int index = line_that_waits(group);
    if (index < 0)
        return 0;
    struct gpiod_line *line = gpiod_line_bulk_get_line(&group->bulk, (unsigned)index);
    do
        status = gpiod_line_event_read(line, &event);
    while (status != 0 && errno == EINTR);
    if (status != 0)
        return -1;
    edge->index = (unsigned)index;
    edge->falling = event.event_type == GPIOD_LINE_EVENT_FALLING_EDGE;
    edge->time_ns = (uint64_t)event.ts.tv_sec * 1000000000U + (uint64_t)event.ts.tv_nsec;
    return 1;
}
