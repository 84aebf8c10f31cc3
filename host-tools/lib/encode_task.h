/* What an encoder is asked for. */
#ifndef YB_ENCODE_TASK_H
#define YB_ENCODE_TASK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <yamabiko/yamabiko.h>

#include "error.h"
#include "sections.h"

enum {
    YB_ENCODE_DEFAULT_BYTES = 100,
    YB_ENCODE_LEAST_BYTES = 23, /* a header, one summit, the check byte */
    YB_ENCODE_DEFAULT_EFFORT = 5,
    YB_ENCODE_MOST_EFFORT = 9,
    YB_ENCODE_MOST_LEVELS = 64
};

typedef struct {
    size_t most_bytes;
    yb_profile_t profile;
    int vertices;      /* most of the mesh; 0: 255, what every device holds */
    int levels;        /* so many evenly spaced heights for lines; 0: see below */
    double interval_m; /* lines at multiples of it; 0: heights are the encoder's choice */
    uint8_t seed;      /* of the map's noise */
    int effort;        /* 1 to 9: each step triples the number of trials */
    int threads;       /* 1 or 2; 0: two if there are two processors. The bytes are the same */
    const yb_sections_t *sections; /* after a compact relief, inside most_bytes; NULL: none. An
                                    * asked-for certificate is measured at the end */
    /* Called now and then, perhaps from another thread, never twice at once. May be NULL. */
    void (*progress)(void *context, double share);
    void *context;
} yb_encode_task_t;

/* Trials at an effort, of so many at the default one: each step triples them. */
long yb_encode_trials(long usual, int effort);

/* Whether the task's bytes can hold a map with its sections. False with a sentence. */
bool yb_encode_has_room(const yb_encode_task_t *task, yb_error_t *error);

#endif
