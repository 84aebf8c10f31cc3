#include "levels.h"

#include <math.h>

#include "line_grid.h"

static bool take_multiples(yb_levels_t *levels, double interval_m, const yb_grid_t *grid,
                           yb_error_t *error)
{
    double low_m = (double)grid->low_m;
    double high_m = (double)grid->high_m;
    double first = floor(low_m / interval_m) + 1;
    double last = ceil(high_m / interval_m) - 1;
    if (last < first)
        return yb_error_set(error,
                            "no multiple of %g m lies between the lowest height, %.6g m, and the "
                            "highest, %.6g m: choose a smaller interval",
                            interval_m, low_m, high_m);
    if (last - first >= YB_ENCODE_MOST_LEVELS)
        return yb_error_set(error,
                            "an interval of %g m makes more than %d levels between %.6g m and "
                            "%.6g m: choose a larger one",
                            interval_m, YB_ENCODE_MOST_LEVELS, low_m, high_m);
    levels->count = (int)(last - first) + 1;
    for (int i = 0; i < levels->count; i++)
        levels->height_m[i] = (first + i) * interval_m;
    return true;
}

bool yb_levels_choose(yb_levels_t *levels, const yb_encode_task_t *task, const yb_grid_t *grid,
                      const yb_lines_t *given, yb_error_t *error)
{
    double range_m = (double)(grid->high_m - grid->low_m);
    levels->count = task->levels;
    for (int i = 0; i < task->levels; i++)
        levels->height_m[i] = (double)grid->low_m + range_m * (i + 1) / (task->levels + 1);
    if (task->levels > 0)
        return true;
    if (task->interval_m > 0)
        return take_multiples(levels, task->interval_m, grid, error);
    if (given != NULL)
        levels->count = yb_line_grid_levels(given, levels->height_m, YB_ENCODE_MOST_LEVELS);
    return true;
}
