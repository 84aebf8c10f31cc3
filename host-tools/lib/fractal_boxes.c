#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fractal_fit.h"

/* Positions of the tiling, each way: a quarter of a box apart. */
enum {
    SHIFTS = 4
};

/* Where the tilings of one size lie along an axis: how many whole boxes from each shift on. */
typedef struct {
    double shift_m[SHIFTS];
    int boxes[SHIFTS];
    double scale; /* of the frame to what any tiling covers */
} axis_t;

/* A tiling, and for each side of its boxes whether it is crossed an odd number of times: a side
 * that runs east from the corner (column, row) at bottom[], one that runs north at left[].
 */
typedef struct {
    double size_m, west_m, south_m;
    int columns, rows; /* of whole boxes */
    int pitch;
    size_t sides;
    unsigned char *bottom, *left;
    double *weight; /* of the columns */
} tiling_t;

/* Shifted by whole cells: lines from a raster know the land at its cells and guess between them,
 * where it is smoother than it should be.
 */
static axis_t lay_axis(double side_m, double size_m, double cell_m)
{
    axis_t axis;
    double end_m = 0;
    for (int i = 0; i < SHIFTS; i++) {
        axis.shift_m[i] = floor(size_m * i / SHIFTS / cell_m + 1e-9) * cell_m;
        /* a hair more, or rounding may cost the last box of a tiling that fits exactly */
        axis.boxes[i] = (int)((side_m - axis.shift_m[i]) / size_m + 1e-9);
        end_m = fmax(end_m, axis.shift_m[i] + axis.boxes[i] * size_m);
    }
    axis.scale = side_m / end_m;
    return axis;
}

/* What a box counts: more where not all tilings reach, near the frame. So lines that fill the frame
 * and one in its middle are counted alike.
 */
static double box_weight(const axis_t *axis, double size_m, int shift, int box)
{
    enum {
        SAMPLES = 8
    };
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const double at_m = axis->shift_m[shift] + (box + (i + 0.5) / SAMPLES) * size_m;
        int reached = 0;
        for (int k = 0; k < SHIFTS; k++)
            reached +=
                at_m >= axis->shift_m[k] && at_m < axis->shift_m[k] + axis->boxes[k] * size_m;
        sum += 1.0 / (reached > 0 ? reached : 1);
    }
    return sum / SAMPLES * axis->scale;
}

static bool begin_tiling(tiling_t *tiling, const yb_lines_t *lines, double size_m)
{
    tiling->size_m = size_m;
    tiling->pitch = 2 + (int)(lines->width_m / size_m);
    tiling->sides = (size_t)tiling->pitch * (size_t)(2 + (int)(lines->depth_m / size_m));
    tiling->bottom = malloc(2 * tiling->sides);
    tiling->left = tiling->bottom == NULL ? NULL : tiling->bottom + tiling->sides;
    tiling->weight = malloc((size_t)tiling->pitch * sizeof(*tiling->weight));
    return tiling->bottom != NULL && tiling->weight != NULL;
}

static void end_tiling(tiling_t *tiling)
{
    free(tiling->bottom);
    free(tiling->weight);
}

static void shift_tiling(tiling_t *tiling, const axis_t *across, const axis_t *up, int column,
                         int row)
{
    tiling->west_m = across->shift_m[column];
    tiling->south_m = up->shift_m[row];
    tiling->columns = across->boxes[column];
    tiling->rows = up->boxes[row];
    memset(tiling->bottom, 0, 2 * tiling->sides);
    for (int i = 0; i < tiling->columns; i++)
        tiling->weight[i] = box_weight(across, tiling->size_m, column, i);
}

/* A place on the frame lies no more than a box outside of the tiling. (floor() takes most of the
 * time where it is a call.)
 */
static int floored(double boxes)
{
    return (int)(boxes + 1) - 1;
}

/* Turns over each side that the segment crosses. A side begins at its corner and ends before the
 * next, a segment likewise: where two meet in a point, exactly one of them is crossed there.
 */
static void cross_sides(tiling_t *tiling, yb_place_t a, yb_place_t b)
{
    const double ax = (a.x_m - tiling->west_m) / tiling->size_m;
    const double ay = (a.y_m - tiling->south_m) / tiling->size_m;
    const double bx = (b.x_m - tiling->west_m) / tiling->size_m;
    const double by = (b.y_m - tiling->south_m) / tiling->size_m;
    const int from_row = floored(ay), to_row = floored(by);
    const int from_column = floored(ax), to_column = floored(bx);
    const int south = from_row < to_row ? from_row : to_row;
    const int west = from_column < to_column ? from_column : to_column;
    for (int row = south + 1; row <= from_row + to_row - south; row++) {
        const int column = floored(ax + (bx - ax) * (row - ay) / (by - ay));
        if (column >= 0 && row >= 0 && column < tiling->columns && row <= tiling->rows)
            tiling->bottom[row * tiling->pitch + column] ^= 1;
    }
    for (int column = west + 1; column <= from_column + to_column - west; column++) {
        const int row = floored(ay + (by - ay) * (column - ax) / (bx - ax));
        if (column >= 0 && row >= 0 && column <= tiling->columns && row < tiling->rows)
            tiling->left[row * tiling->pitch + column] ^= 1;
    }
}

static void cross_line(tiling_t *tiling, const yb_line_t *line)
{
    for (int i = 1; i < line->count; i++)
        cross_sides(tiling, line->place[i - 1], line->place[i]);
    if (line->closed)
        cross_sides(tiling, line->place[line->count - 1], line->place[0]);
}

/* The weights of the boxes of a row whose corners are divided. */
static double divided_in_row(const tiling_t *tiling, int row)
{
    double sum = 0;
    for (int column = 0; column < tiling->columns; column++) {
        const int at = row * tiling->pitch + column;
        const int odd = tiling->bottom[at] | tiling->bottom[at + tiling->pitch] | tiling->left[at] |
                        tiling->left[at + 1];
        sum += odd * tiling->weight[column];
    }
    return sum;
}

bool yb_fractal_count_boxes(const yb_lines_t *lines, const int *order, int line_count,
                            double cell_m, const double *size_m, int sizes, double *counted)
{
    for (int k = 0; k < sizes; k++) {
        tiling_t tiling;
        const axis_t across = lay_axis(lines->width_m, size_m[k], cell_m);
        const axis_t up = lay_axis(lines->depth_m, size_m[k], cell_m);
        counted[k] = 0;
        const bool good = begin_tiling(&tiling, lines, size_m[k]);
        for (int shift = 0; good && shift < SHIFTS * SHIFTS; shift++) {
            shift_tiling(&tiling, &across, &up, shift % SHIFTS, shift / SHIFTS);
            for (int i = 0; i < line_count; i++)
                cross_line(&tiling, &lines->line[order[i]]);
            for (int row = 0; row < tiling.rows; row++)
                counted[k] +=
                    divided_in_row(&tiling, row) * box_weight(&up, size_m[k], shift / SHIFTS, row);
        }
        end_tiling(&tiling);
        if (!good)
            return false;
    }
    return true;
}
