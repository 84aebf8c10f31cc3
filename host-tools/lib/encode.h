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
#include "encode_task.h"
#include "fractal.h"
#include "grid.h"

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
