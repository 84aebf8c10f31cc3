#define _POSIX_C_SOURCE 200809L

#include "gpio_trace.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

/* Layout of a page and its records: Documentation/trace/ring-buffer-design.rst and
 * include/linux/ring_buffer.h of the kernel, for 64-bit machines. */
enum {
    PAGE_BYTES = 4096,
    PAGE_HEADER_BYTES = 16, /* time stamp, bytes committed and flags */
    COMMIT_AT = 8,
    COMMIT_MASK = 0x000FFFFF,
    PADDING = 29,
    TIME_EXTEND = 30, /* and 31, TIME_STAMP: eight bytes without data */
};
static const uint32_t missed_events = 1U << 31;

/* Where a gpio_value record has its fields; the kernel says so in the event's `format` file. */
typedef struct {
    unsigned id;
    unsigned line_at;
    unsigned get_at;
    unsigned value_at;
} layout_t;

static uint32_t u32_at(const uint8_t *bytes)
{
    uint32_t value;
    memcpy(&value, bytes, sizeof value);
    return value;
}

/* Reads the number that follows `label` at the beginning of a line. */
static bool number_after(const char *text, const char *label, unsigned *number)
{
    const size_t length = strlen(label);

    if (strncmp(text, label, length) != 0)
        return false;
    *number = (unsigned)strtoul(text + length, NULL, 10);
    return true;
}

static bool read_layout(const char *tracing, layout_t *layout)
{
    char path[256];
    char text[160];
    unsigned found = 0;

    snprintf(path, sizeof path, "%s/events/gpio/gpio_value/format", tracing);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        return false;
    }
    while (fgets(text, sizeof text, file) != NULL) {
        found += number_after(text, "ID: ", &layout->id);
        found += number_after(text, "\tfield:unsigned gpio;\toffset:", &layout->line_at);
        found += number_after(text, "\tfield:int get;\toffset:", &layout->get_at);
        found += number_after(text, "\tfield:int value;\toffset:", &layout->value_at);
    }
    fclose(file);
    if (found != 4)
        fprintf(stderr, "%s: not the fields that this program knows\n", path);
    return found == 4;
}

static bool take_record(const layout_t *layout, const uint8_t *record, yb_gpio_edge_t edge,
                        void *context)
{
    uint16_t id;

    memcpy(&id, record, sizeof id);
    if (id != layout->id || u32_at(record + layout->get_at) != 0)
        return true;
    return edge(context, u32_at(record + layout->line_at), u32_at(record + layout->value_at) != 0);
}

static bool take_page(const layout_t *layout, const uint8_t *page, yb_gpio_edge_t edge,
                      void *context)
{
    const uint32_t commit = u32_at(page + COMMIT_AT);
    const uint32_t end = PAGE_HEADER_BYTES + (commit & COMMIT_MASK);
    uint32_t at = PAGE_HEADER_BYTES;

    if ((commit & missed_events) != 0 || end > PAGE_BYTES) {
        fputs("the trace lost events: its buffer is too small\n", stderr);
        return false;
    }
    while (at < end) {
        const uint32_t header = u32_at(page + at);
        const uint32_t type = header & 31;
        at += 4;
        if (type == PADDING) {
            if (header >> 5 == 0)
                break; /* the rest of the page is empty */
            at += u32_at(page + at);
        } else if (type >= TIME_EXTEND) {
            at += 4;
        } else if (type == 0) { /* the length, itself included, is in the next word */
            if (!take_record(layout, page + at + 4, edge, context))
                return false;
            at += u32_at(page + at);
        } else {
            if (!take_record(layout, page + at, edge, context))
                return false;
            at += type * 4;
        }
    }
    return true;
}

/* What is there now. False: the trace is broken, or `edge` said so. */
static bool read_pages(int file, const layout_t *layout, yb_gpio_edge_t edge, void *context)
{
    uint8_t page[PAGE_BYTES];
    ssize_t got;

    while ((got = read(file, page, sizeof page)) > 0) {
        if (got < PAGE_HEADER_BYTES || !take_page(layout, page, edge, context))
            return false;
    }
    if (got < 0 && errno != EAGAIN) {
        perror("the trace cannot be read");
        return false;
    }
    return true;
}

/* Stops a process while what it has left is read, so that it cannot fill the buffer meanwhile. */
static bool read_of(pid_t drawer, int file, const layout_t *layout, yb_gpio_edge_t edge,
                    void *context)
{
    const struct timespec while_it_draws = {0, 30 * 1000000L};

    while (kill(drawer, SIGSTOP) == 0) {
        const bool well = read_pages(file, layout, edge, context);
        kill(drawer, SIGCONT);
        if (!well)
            return false;
        nanosleep(&while_it_draws, NULL);
    }
    return read_pages(file, layout, edge, context);
}

bool yb_gpio_trace_follow(const char *tracing, long drawer, yb_gpio_edge_t edge, void *context)
{
    char path[256];
    layout_t layout = {0};

    if (!read_layout(tracing, &layout))
        return false;
    snprintf(path, sizeof path, "%s/per_cpu/cpu0/trace_pipe_raw", tracing);
    const int file = open(path, O_RDONLY | O_NONBLOCK);
    if (file < 0) {
        perror(path);
        return false;
    }
    const bool well = drawer > 0 ? read_of((pid_t)drawer, file, &layout, edge, context)
                                 : read_pages(file, &layout, edge, context);
    close(file);
    return well;
}

bool yb_gpio_trace_read(const char *tracing, yb_gpio_edge_t edge, void *context)
{
    return yb_gpio_trace_follow(tracing, 0, edge, context);
}
