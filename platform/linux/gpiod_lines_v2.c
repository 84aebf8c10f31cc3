#include "gpiod_lines.h"

#include <errno.h>
#include <gpiod.h>
#include <stdio.h>
#include <stdlib.h>

/* Shown by gpioinfo as the holder of the lines. */
static const char consumer[] = "yamabiko";

enum {
    EDGES_KEPT = 64, /* per line: a bouncing button must not push its first edge out */
};

struct yb_gpiod_chip {
    struct gpiod_chip *chip;
    struct gpiod_chip_info *info;
};

struct yb_gpiod_group {
    struct gpiod_line_request *request;
    struct gpiod_edge_event_buffer *edges; /* NULL for outputs */
    size_t count;
    unsigned lines[YB_GPIOD_GROUP_MAX];
};

/* ---- Chips ----------------------------------------------------------------------------------- */

yb_gpiod_chip_t *yb_gpiod_chip_open(const char *path)
{
    yb_gpiod_chip_t *chip = calloc(1, sizeof *chip);

    if (chip == NULL)
        return NULL;
    chip->chip = gpiod_chip_open(path);
    if (chip->chip == NULL)
        goto free_chip;
    chip->info = gpiod_chip_get_info(chip->chip);
    if (chip->info == NULL)
        goto close_chip;
    return chip;

close_chip:;
    const int why = errno;
    gpiod_chip_close(chip->chip);
    errno = why;
free_chip:
    free(chip);
    return NULL;
}

void yb_gpiod_chip_close(yb_gpiod_chip_t *chip)
{
    if (chip == NULL)
        return;
    gpiod_chip_info_free(chip->info);
    gpiod_chip_close(chip->chip);
    free(chip);
}

const char *yb_gpiod_chip_name(const yb_gpiod_chip_t *chip)
{
    return gpiod_chip_info_get_name(chip->info);
}

const char *yb_gpiod_chip_label(const yb_gpiod_chip_t *chip)
{
    return gpiod_chip_info_get_label(chip->info);
}

unsigned yb_gpiod_chip_lines(const yb_gpiod_chip_t *chip)
{
    return (unsigned)gpiod_chip_info_get_num_lines(chip->info);
}

int yb_gpiod_chip_find(yb_gpiod_chip_t *chip, const char *line_name)
{
    return gpiod_chip_get_line_offset_from_name(chip->chip, line_name);
}

bool yb_gpiod_chip_holder(yb_gpiod_chip_t *chip, unsigned line, char holder[YB_GPIOD_NAME_BYTES])
{
    struct gpiod_line_info *info = gpiod_chip_get_line_info(chip->chip, line);

    if (info == NULL)
        return false;
    const char *name = gpiod_line_info_get_consumer(info);
    const bool held = gpiod_line_info_is_used(info);
    snprintf(holder, YB_GPIOD_NAME_BYTES, "%s", name != NULL ? name : "");
    gpiod_line_info_free(info);
    return held;
}

/* ---- Groups ---------------------------------------------------------------------------------- */

static enum gpiod_line_value level(int value)
{
    return value != 0 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
}

/* `values` NULL: inputs, the line settings say which. */
static struct gpiod_line_request *request_lines(yb_gpiod_chip_t *chip,
                                                struct gpiod_line_settings *settings,
                                                const unsigned *lines, const int *values,
                                                size_t count)
{
    enum gpiod_line_value levels[YB_GPIOD_GROUP_MAX];
    struct gpiod_line_request *request = NULL;
    struct gpiod_line_config *config = gpiod_line_config_new();
    struct gpiod_request_config *who = gpiod_request_config_new();

    if (config == NULL || who == NULL ||
        gpiod_line_config_add_line_settings(config, lines, count, settings) != 0)
        goto free_configs;
    for (size_t i = 0; values != NULL && i < count; i++)
        levels[i] = level(values[i]);
    if (values != NULL && gpiod_line_config_set_output_values(config, levels, count) != 0)
        goto free_configs;
    gpiod_request_config_set_consumer(who, consumer);
    gpiod_request_config_set_event_buffer_size(who, count * EDGES_KEPT);
    request = gpiod_chip_request_lines(chip->chip, who, config);

free_configs:;
    const int why = errno;
    gpiod_request_config_free(who);
    gpiod_line_config_free(config);
    errno = why;
    return request;
}

static yb_gpiod_group_t *group_new(const unsigned *lines, size_t count)
{
    yb_gpiod_group_t *group = calloc(1, sizeof *group);

    for (size_t i = 0; group != NULL && i < count; i++)
        group->lines[group->count++] = lines[i];
    return group;
}

yb_gpiod_group_t *yb_gpiod_take_outputs(yb_gpiod_chip_t *chip, const unsigned *lines,
                                        const int *values, size_t count)
{
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    yb_gpiod_group_t *group = group_new(lines, count);

    if (settings == NULL || group == NULL)
        goto free_group;
    gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT);
    group->request = request_lines(chip, settings, lines, values, count);
    if (group->request == NULL)
        goto free_group;
    gpiod_line_settings_free(settings);
    return group;

free_group:;
    const int why = errno;
    free(group);
    gpiod_line_settings_free(settings);
    errno = why;
    return NULL;
}

yb_gpiod_group_t *yb_gpiod_take_inputs(yb_gpiod_chip_t *chip, const unsigned *lines, size_t count)
{
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    yb_gpiod_group_t *group = group_new(lines, count);

    if (settings == NULL || group == NULL)
        goto free_group;
    group->edges = gpiod_edge_event_buffer_new(1);
    if (group->edges == NULL)
        goto free_group;
    gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT);
    gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_BOTH);
    gpiod_line_settings_set_bias(settings, GPIOD_LINE_BIAS_PULL_UP);
    group->request = request_lines(chip, settings, lines, NULL, count);
    if (group->request == NULL && errno != EBUSY) {
        gpiod_line_settings_set_bias(settings, GPIOD_LINE_BIAS_AS_IS);
        group->request = request_lines(chip, settings, lines, NULL, count);
    }
    if (group->request == NULL)
        goto free_group;
    gpiod_line_settings_free(settings);
    return group;

free_group:;
    const int why = errno;
    if (group != NULL)
        gpiod_edge_event_buffer_free(group->edges);
    free(group);
    gpiod_line_settings_free(settings);
    errno = why;
    return NULL;
}

void yb_gpiod_group_free(yb_gpiod_group_t *group)
{
    if (group == NULL)
        return;
    gpiod_line_request_release(group->request);
    gpiod_edge_event_buffer_free(group->edges);
    free(group);
}

bool yb_gpiod_group_set(yb_gpiod_group_t *group, const int *values)
{
    enum gpiod_line_value levels[YB_GPIOD_GROUP_MAX];
    int status;

    for (size_t i = 0; i < group->count; i++)
        levels[i] = level(values[i]);
    do
        status = gpiod_line_request_set_values(group->request, levels);
    while (status != 0 && errno == EINTR);
    return status == 0;
}

int yb_gpiod_group_fd(const yb_gpiod_group_t *group)
{
    return gpiod_line_request_get_fd(group->request);
}

int yb_gpiod_group_read(yb_gpiod_group_t *group, yb_gpiod_edge_t *edge)
{
    int status;

    do
        status = gpiod_line_request_wait_edge_events(group->request, 0);
    while (status < 0 && errno == EINTR);
    if (status <= 0)
        return status;
    do
        status = gpiod_line_request_read_edge_events(group->request, group->edges, 1);
    while (status < 0 && errno == EINTR);
    if (status < 1)
        return -1;
    struct gpiod_edge_event *event = gpiod_edge_event_buffer_get_event(group->edges, 0);
    const unsigned line = gpiod_edge_event_get_line_offset(event);
    edge->index = 0;
    while (edge->index + 1 < group->count && group->lines[edge->index] != line)
        edge->index++;
    edge->falling = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_FALLING_EDGE;
    edge->time_ns = gpiod_edge_event_get_timestamp_ns(event);
    return 1;
}
