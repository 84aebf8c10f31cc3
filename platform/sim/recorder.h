/* A recorder on a panel's bus: passes everything on to another bus and writes down what went over
 * the wires, a line a transfer, to hold against a logic analyser or another driver:
 *
 *     reset
 *     command 2a
 *     data 00 00 00 ef
 *     wait 120 ms
 *
 * Bytes are two hexadecimal digits each. With no other bus it only writes. What cannot be written
 * is the stream's affair: ask ferror in the end.
 */
#ifndef YB_RECORDER_H
#define YB_RECORDER_H

#include <stdio.h>

#include <panel.h>

typedef struct {
    yb_panel_bus_t bus;         /* to be used instead of the other */
    const yb_panel_bus_t *next; /* may be NULL */
    FILE *to;
} yb_recorder_t;

/* The struct must stay where it is, and the stream open, while the bus is used. */
void yb_recorder_init(yb_recorder_t *recorder, FILE *to, const yb_panel_bus_t *next);

#endif
