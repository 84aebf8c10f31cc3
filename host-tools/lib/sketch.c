#include "sketch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "contour_code.h"
#include "paper_code.h"

enum {
    MOST_STEPS = 255
};

void yb_sketch_begin(yb_contour_set_t *set, double width_m, double depth_m, double low_m,
                     double high_m, int spacing)
{
    memset(set, 0, sizeof(*set));
    int unit = spacing;
    int longest = MOST_STEPS / unit * unit;
    double cell_m = fmax(width_m, depth_m) / longest;
    int east = (int)lround(width_m / cell_m / unit) * unit;
    int north = (int)lround(depth_m / cell_m / unit) * unit;
    set->east = (uint8_t)(east < 2 * unit ? 2 * unit : east);
    set->north = (uint8_t)(north < 2 * unit ? 2 * unit : north);
    set->spacing = (uint8_t)spacing;
    while (1 << set->shift < spacing)
        set->shift++;
    set->cell = yb_unit_coded(cell_m);
    double range_m = high_m - low_m;
    double lowest_m = floor(low_m - range_m / 2);
    set->base_m = (int16_t)fmin(fmax(lowest_m, INT16_MIN), INT16_MAX);
    double unit_m = 1.0 / 64;
    while (unit_m * UINT16_MAX < 2 * range_m + 2)
        unit_m *= 2;
    set->unit = yb_unit_coded(unit_m);
    set->seed = 1;
    set->gain = 32;
    set->dimension = 64;
    set->frame = yb_contour_set_height(set, low_m);
}

void yb_sketch_task(yb_contour_set_t *set, const yb_grid_t *grid, const yb_encode_task_t *task,
                    int spacing)
{
    double width_m = yb_grid_width_m(grid);
    double depth_m = yb_grid_depth_m(grid);
    yb_sketch_begin(set, width_m, depth_m, (double)grid->low_m, (double)grid->high_m, spacing);
    set->profile = task->profile;
    set->seed = task->seed & 127;
    set->sections = task->sections;
    set->most_vertices = task->vertices;
    if (set->profile == YB_COMPACT)
        set->cell = yb_compact_cell(fmax(width_m / set->east, depth_m / set->north));
}

void yb_sketch_units(yb_contour_set_t *set, uint16_t unit, int interval, double lowest_m)
{
    int multiple = 1 << interval;
    set->unit = unit;
    set->interval = (uint8_t)interval;
    set->base = (int)floor(lowest_m / yb_unit_m(unit) / multiple) * multiple;
}

void yb_sketch_corners(yb_contour_set_t *set, const yb_grid_t *grid)
{
    double width_m = yb_grid_width_m(grid);
    double depth_m = yb_grid_depth_m(grid);
    const double corner_m[YB_CORNERS][2] = {{0, 0}, {width_m, 0}, {width_m, depth_m}, {0, depth_m}};
    double sum = 0;
    for (int i = 0; i < YB_CORNERS; i++) {
        double height_m = yb_grid_height(grid, corner_m[i][0], corner_m[i][1]);
        set->corner[i] = yb_contour_set_height(set, height_m);
        sum += height_m;
    }
    set->frame = yb_contour_set_height(set, sum / YB_CORNERS);
}

bool yb_sketch_spot(yb_contour_set_t *set, const yb_lines_t *frame, yb_place_t at, double height_m,
                    size_t most_bytes)
{
    double unit = set->spacing;
    double x = round(at.x_m / frame->width_m * set->east / unit) * unit;
    double y = round(at.y_m / frame->depth_m * set->north / unit) * unit;
    x = fmin(fmax(x, unit), set->east - unit);
    y = fmin(fmax(y, unit), set->north - unit);
    yb_step_t point = {(uint8_t)x, (uint8_t)y};
    if (!yb_simplify_fits(set, &point, 1, false) ||
        !yb_contour_set_append(set, yb_contour_set_height(set, height_m), false, &point, 1))
        return false;
    if (yb_contour_code_fits(set, most_bytes))
        return true;
    yb_contour_set_drop(set, set->contour_count - 1);
    return false;
}

/* Appends a line with the points that its long segments need, if all of it is possible. */
static bool append_line(yb_contour_set_t *set, double height_m, const yb_step_t *point, int count,
                        bool open, size_t most_bytes)
{
    yb_contour_set_t before = *set;
    if (yb_simplify_fits(set, point, count, open) &&
        yb_contour_set_append(set, yb_contour_set_line_height(set, height_m), open, point, count) &&
        yb_paper_split(set) && yb_contour_code_fits(set, most_bytes))
        return true;
    *set = before;
    return false;
}

int yb_sketch_lines(yb_contour_set_t *set, const yb_lines_t *lines, double tolerance_m,
                    size_t most_bytes)
{
    yb_lattice_t lattice = {.width_m = lines->width_m,
                            .depth_m = lines->depth_m,
                            .east = set->east,
                            .north = set->north,
                            .spacing = set->spacing};
    int added = 0;
    for (int i = 0; i < lines->count; i++) {
        const yb_line_t *line = &lines->line[i];
        yb_step_t point[YB_SET_POINTS];
        if (line->count == 1) {
            added += yb_sketch_spot(set, lines, line->place[0], line->height_m, most_bytes);
            continue;
        }
        int count = yb_simplify_to_lattice(line, tolerance_m, &lattice, point, YB_SET_POINTS);
        if (count > 0)
            added += append_line(set, line->height_m, point, count, !line->closed, most_bytes);
    }
    return added;
}

static int longer_first(const void *a, const void *b)
{
    const yb_line_t *first = a;
    const yb_line_t *second = b;
    double first_length = yb_line_length_m(first);
    double second_length = yb_line_length_m(second);
    if (first_length != second_length)
        return first_length > second_length ? -1 : 1;
    if (first->height_m != second->height_m)
        return first->height_m > second->height_m ? -1 : 1;
    if (first->place[0].x_m != second->place[0].x_m)
        return first->place[0].x_m < second->place[0].x_m ? -1 : 1;
    return first->place[0].y_m < second->place[0].y_m ? -1 : 1;
}

void yb_sketch_sort(yb_lines_t *lines)
{
    if (lines->count > 1)
        qsort(lines->line, (size_t)lines->count, sizeof(*lines->line), longer_first);
}

yb_place_t yb_sketch_summit(const yb_grid_t *grid)
{
    int best = 0;
    for (int i = 0; i < grid->columns * grid->rows; i++)
        if (grid->height_m[i] > grid->height_m[best])
            best = i;
    int row = best / grid->columns;
    return (yb_place_t){best % grid->columns * grid->cell_m, (grid->rows - 1 - row) * grid->cell_m};
}

static int by_height(const void *a, const void *b)
{
    float first = *(const float *)a;
    float second = *(const float *)b;
    return (first > second) - (first < second);
}

double yb_sketch_quantile(const yb_grid_t *grid, double share)
{
    size_t cells = (size_t)grid->columns * (size_t)grid->rows;
    float *sorted = malloc(cells * sizeof(*sorted));
    if (sorted == NULL)
        return (double)grid->low_m + share * (double)(grid->high_m - grid->low_m);
    memcpy(sorted, grid->height_m, cells * sizeof(*sorted));
    qsort(sorted, cells, sizeof(*sorted), by_height);
    double value = (double)sorted[(size_t)(share * (double)(cells - 1))];
    free(sorted);
    return value;
}
