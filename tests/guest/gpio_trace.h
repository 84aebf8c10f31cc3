/* The kernel's trace of GPIO lines, edge by edge: reads the gpio_value events of one CPU from the
 * ring buffer's raw pages, as the text form is too slow for millions of them. */
#ifndef YB_GPIO_TRACE_H
#define YB_GPIO_TRACE_H

#include <stdbool.h>

/* Called for every line that was set, in order, also when it kept its value. False stops. */
typedef bool (*yb_gpio_edge_t)(void *context, unsigned line, int value);

/* Reads what the trace below `tracing` (usually /sys/kernel/tracing) holds and empties it. False,
 * with a sentence on stderr, when it cannot be read or events were lost. */
bool yb_gpio_trace_read(const char *tracing, yb_gpio_edge_t edge, void *context);

/* The same while the process `drawer` makes it, until that has ended: for more than the trace's
 * buffer holds. The process is stopped and continued all the time, wherever it just is. */
bool yb_gpio_trace_follow(const char *tracing, long drawer, yb_gpio_edge_t edge, void *context);

#endif
