#include "fractal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fractal_fit.h"
#include "sketch.h"

/* Sizes of the boxes in cells: about two to an octave. */
static const double size_cells[] = {YB_FRACTAL_LEAST_CELLS, 6, 8, 12, 16, 24, 32, 48, 64, 96};

/* The largest box is an eighth of the frame: of larger ones there are so few that each counts by
 * where the mountain happens to lie. And no size of which fewer boxes count than least_boxes. On a
 * circle these are boxes above a quarter of the radius, which cut off its bends: even so it
 * measures 0.97 to 1. (On what is fractal small boxes gain by bends what large ones lose.)
 */
static const double most_share = 1.0 / 8;
static const double least_boxes = 32;

static double clamp_dimension(double dimension)
{
    return fmin(fmax(dimension, YB_FRACTAL_LEAST), YB_FRACTAL_MOST);
}

yb_fractal_fit_t yb_fractal_fit(const double *size_m, const double *counted, int count)
{
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
    if (count < 3)
        return (yb_fractal_fit_t){0};
    for (int i = 0; i < count; i++) {
        mean_x -= log(size_m[i]) / count;
        mean_y += log(counted[i]) / count;
    }
    for (int i = 0; i < count; i++) {
        const double x = -log(size_m[i]) - mean_x, y = log(counted[i]) - mean_y;
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    return (yb_fractal_fit_t){.dimension = xy / xx,
                              .r2 = yy > 0 ? xy * xy / (xx * yy) : 1,
                              .from_m = size_m[0],
                              .to_m = size_m[count - 1],
                              .sizes = count};
}

static yb_fractal_fit_t fit_boxes(const double *size_m, const double *counted, int sizes)
{
    int used = 0;
    while (used < sizes && counted[used] >= least_boxes)
        used++;
    return yb_fractal_fit(size_m, counted, used);
}

/* A line that has a length, and which it is. */
typedef struct {
    const yb_line_t *line;
    int index;
} ordered_t;

/* By height first; lines that are the same follow each other. */
static int by_height(const void *a, const void *b)
{
    const yb_line_t *first = ((const ordered_t *)a)->line;
    const yb_line_t *second = ((const ordered_t *)b)->line;
    if (first->height_m != second->height_m)
        return first->height_m < second->height_m ? -1 : 1;
    if (first->count != second->count)
        return first->count < second->count ? -1 : 1;
    const int differ =
        memcmp(first->place, second->place, (size_t)first->count * sizeof(*first->place));
    return differ != 0 ? differ : ((const ordered_t *)a)->index - ((const ordered_t *)b)->index;
}

static bool same_line(const yb_line_t *a, const yb_line_t *b)
{
    return a->height_m == b->height_m && a->count == b->count && a->closed == b->closed &&
           memcmp(a->place, b->place, (size_t)a->count * sizeof(*a->place)) == 0;
}

/* Indices of the lines, those of one height one after the other. A line that is there twice (two
 * tenths of a grid may lie at one height: the sea) is taken once, or it would undo itself.
 */
static int *order_lines(const yb_lines_t *lines, int *count)
{
    ordered_t *line = malloc(((size_t)lines->count + 1) * sizeof(*line));
    int *order = malloc(((size_t)lines->count + 1) * sizeof(*order));
    int all = 0;
    *count = 0;
    for (int i = 0; line != NULL && i < lines->count; i++)
        if (lines->line[i].count > 1)
            line[all++] = (ordered_t){&lines->line[i], i};
    if (all > 1)
        qsort(line, (size_t)all, sizeof(*line), by_height);
    for (int i = 0; order != NULL && i < all; i++)
        if (i == 0 || !same_line(line[i - 1].line, line[i].line))
            order[(*count)++] = line[i].index;
    if (line == NULL) {
        free(order);
        order = NULL;
    }
    free(line);
    return order;
}

/* All levels: each fitted, and their counts added for one fit. */
static bool measure_boxes(const yb_lines_t *lines, double cell_m, const int *order, int count,
                          yb_fractal_report_t *report)
{
    double size_m[YB_FRACTAL_SIZES];
    double all[YB_FRACTAL_SIZES] = {0};
    int sizes = 0;
    const double most_m = most_share * (fmin(lines->width_m, lines->depth_m) + cell_m);
    for (; sizes < YB_FRACTAL_SIZES && size_cells[sizes] * cell_m <= most_m; sizes++)
        size_m[sizes] = size_cells[sizes] * cell_m;
    for (int from = 0, to = 0; from < count; from = to) {
        double counted[YB_FRACTAL_SIZES];
        const double height_m = lines->line[order[from]].height_m;
        while (to < count && lines->line[order[to]].height_m == height_m)
            to++;
        if (!yb_fractal_count_boxes(lines, order + from, to - from, cell_m, size_m, sizes, counted))
            return false;
        for (int k = 0; k < sizes; k++)
            all[k] += counted[k];
        report->level[report->level_count++] =
            (yb_fractal_level_t){height_m, fit_boxes(size_m, counted, sizes)};
    }
    report->boxes = fit_boxes(size_m, all, sizes);
    report->dimension = clamp_dimension(report->boxes.dimension);
    return true;
}

/* Takes a line among the longest, of equals the first; index[] are the lines of report->contour. */
static void offer_contour(yb_fractal_report_t *report, int *index, const yb_line_t *line, int at)
{
    const double length_m = yb_line_length_m(line);
    int place = report->contour_count;
    while (place > 0 && report->contour[place - 1].length_m < length_m)
        place--;
    if (place == YB_FRACTAL_CONTOURS)
        return;
    if (report->contour_count < YB_FRACTAL_CONTOURS)
        report->contour_count++;
    for (int i = report->contour_count - 1; i > place; i--) {
        report->contour[i] = report->contour[i - 1];
        index[i] = index[i - 1];
    }
    report->contour[place] = (yb_fractal_contour_t){
        .height_m = line->height_m, .closed = line->closed, .length_m = length_m};
    index[place] = at;
}

static bool measure_contours(const yb_lines_t *lines, double cell_m, const int *order, int count,
                             yb_fractal_report_t *report)
{
    int index[YB_FRACTAL_CONTOURS] = {0};
    for (int i = 0; i < count; i++)
        offer_contour(report, index, &lines->line[order[i]], order[i]);
    for (int i = 0; i < report->contour_count; i++) {
        yb_fractal_contour_t *contour = &report->contour[i];
        if (!yb_fractal_divider(&lines->line[index[i]], cell_m, &contour->divider))
            return false;
        if (contour->divider.sizes > 0)
            contour->dimension = yb_fractal_from_loop(contour->divider.dimension);
    }
    return true;
}

bool yb_fractal_of_lines(const yb_lines_t *lines, double cell_m, yb_fractal_report_t *report,
                         yb_error_t *error)
{
    int count = 0;
    *report = (yb_fractal_report_t){.dimension = YB_FRACTAL_LEAST};
    int *order = order_lines(lines, &count);
    report->level = malloc(((size_t)count + 1) * sizeof(*report->level));
    const bool good = order != NULL && report->level != NULL &&
                      measure_boxes(lines, cell_m, order, count, report) &&
                      measure_contours(lines, cell_m, order, count, report);
    free(order);
    if (good)
        return true;
    yb_fractal_free(report);
    return yb_error_set(error, "not enough memory to measure the fractal dimension");
}

bool yb_fractal_of_grid(const yb_grid_t *grid, yb_fractal_report_t *report, yb_error_t *error)
{
    double level_m[YB_FRACTAL_LEVELS];
    for (int i = 0; i < YB_FRACTAL_LEVELS; i++)
        level_m[i] = yb_sketch_quantile(grid, (i + 1.0) / (YB_FRACTAL_LEVELS + 1));
    yb_lines_t *lines = yb_lines_from_grid(grid, level_m, YB_FRACTAL_LEVELS, error);
    if (lines == NULL)
        return false;
    const bool good = yb_fractal_of_lines(lines, grid->cell_m, report, error);
    yb_lines_free(lines);
    return good;
}

bool yb_fractal_of_relief(const yb_grid_t *grid, const yb_lines_t *lines,
                          yb_fractal_report_t *report, yb_error_t *error)
{
    return lines != NULL ? yb_fractal_of_lines(lines, grid->cell_m, report, error)
                         : yb_fractal_of_grid(grid, report, error);
}

void yb_fractal_free(yb_fractal_report_t *report)
{
    free(report->level);
    *report = (yb_fractal_report_t){.dimension = YB_FRACTAL_LEAST};
}

double yb_fractal_from_loop(double loop)
{
    return clamp_dimension(2 - (3 - 2 * loop));
}

uint8_t yb_fractal_coded(double dimension)
{
    return (uint8_t)lround(fmin(fmax(dimension - 1, 0) * 256, 255));
}

void yb_fractal_dimension_of(yb_contour_set_t *set, double dimension)
{
    uint8_t coded = yb_fractal_coded(dimension);
    set->dimension = set->profile == YB_COMPACT ? yb_compact_dimension(coded) : coded;
}

static json_t *fit_json(const yb_fractal_fit_t *fit)
{
    if (fit->sizes == 0)
        return json_null();
    return json_pack("{s:f, s:f, s:f, s:f, s:i}", "dimension", fit->dimension, "r2", fit->r2,
                     "from_m", fit->from_m, "to_m", fit->to_m, "sizes", fit->sizes);
}

static json_t *contours_json(const yb_fractal_report_t *report)
{
    json_t *list = json_array();
    for (int i = 0; i < report->contour_count; i++) {
        const yb_fractal_contour_t *contour = &report->contour[i];
        json_array_append_new(
            list,
            json_pack("{s:f, s:b, s:f, s:o, s:o}", "height_m", contour->height_m, "closed",
                      contour->closed, "length_m", contour->length_m, "divider",
                      fit_json(&contour->divider), "dimension",
                      contour->divider.sizes > 0 ? json_real(contour->dimension) : json_null()));
    }
    return list;
}

json_t *yb_fractal_json(const yb_fractal_report_t *report)
{
    json_t *levels = json_array();
    for (int i = 0; i < report->level_count; i++)
        json_array_append_new(levels, json_pack("{s:f, s:o}", "height_m", report->level[i].height_m,
                                                "boxes", fit_json(&report->level[i].boxes)));
    json_t *root = json_pack("{s:f, s:f, s:o, s:o, s:o}", "dimension", report->dimension, "hurst",
                             yb_fractal_hurst(report->dimension), "boxes", fit_json(&report->boxes),
                             "levels", levels, "contours", contours_json(report));
    if (report->boxes.sizes > 0) {
        json_object_set_new(root, "r2", json_real(report->boxes.r2));
        json_object_set_new(root, "from_m", json_real(report->boxes.from_m));
        json_object_set_new(root, "to_m", json_real(report->boxes.to_m));
    }
    return root;
}
