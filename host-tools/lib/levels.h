/* The heights at which lines must lie. */
#ifndef YB_LEVELS_H
#define YB_LEVELS_H

#include "contour_lines.h"
#include "encode_task.h"
#include "grid.h"

typedef struct {
    double height_m[YB_ENCODE_MOST_LEVELS]; /* rising */
    int count;                              /* 0: anywhere */
} yb_levels_t;

/* Those that a task names for a relief, or else those of `given`, the lines that the relief was
 * made from, or NULL. False with a sentence: the task's interval makes none, or too many.
 */
bool yb_levels_choose(yb_levels_t *levels, const yb_encode_task_t *task, const yb_grid_t *grid,
                      const yb_lines_t *given, yb_error_t *error);

#endif
