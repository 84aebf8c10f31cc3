/* From a relief to a code: the whole encoder.
 *
 *     relief ─► contour lines ─► feature points ─► draft ─► search ─► code
 *                                                   ▲          │
 *                                                   └─ engine ─┘   analysis by synthesis
 */
#ifndef YB_ENCODE_H
#define YB_ENCODE_H

#include "code_file.h"
#include "contour_lines.h"
#include "fractal.h"
#include "grid.h"
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

typedef struct {
    yb_code_file_t *code;
    double rmse_m; /* smooth surface against the relief */
    double std_m;  /* of the relief */
    double k; /* of a code made to reach one (target.h), as yb_fidelity_measure says it; or 0 */
    yb_fractal_report_t fractal; /* of the relief's contour lines */
    long trials;
} yb_encode_result_t;

/* Frees what a result owns. */
void yb_encode_result_free(yb_encode_result_t *result);

/* Trials at an effort, of so many at the default one: each step triples them. */
long yb_encode_trials(long usual, int effort);

/* Whether the task's bytes can hold a map with its sections. False with a sentence. */
bool yb_encode_has_room(const yb_encode_task_t *task, yb_error_t *error);

/* Codes a grid. False with a sentence on failure, else the caller frees the result. Equal input
 * gives equal bytes.
 */
bool yb_encode_grid(const yb_grid_t *grid, const yb_encode_task_t *task, yb_encode_result_t *result,
                    yb_error_t *error);

/* Codes contour lines. Between them the relief is taken to rise evenly, and the innermost ones are
 * taken to hold a summit (or a pit) half an interval beyond; that surface then counts as the truth.
 * Lines keep the heights they have, unless the task names other ones.
 */
bool yb_encode_lines(const yb_lines_t *lines, const yb_encode_task_t *task,
                     yb_encode_result_t *result, yb_error_t *error);

#endif
