#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fractal_fit.h"

/* Positions of the tiling, each way: a quarter of a box apart. */
enum {
    SHIFTS = 4
};

/* A tiling, and for each side of its boxes whether it is crossed an odd number of times: a side
 * that runs east from the corner (column, row) at bottom[], one that runs north at left[].
 */
typedef struct {
    double size_m, west_m, south_m;
    int columns, rows; /* of whole boxes */
    int pitch;
    size_t sides;
    unsigned char *bottom, *left;
} tiling_t;

static bool begin_tiling(tiling_t *tiling, const yb_lines_t *lines, double size_m)
{
    tiling->size_m = size_m;
    tiling->pitch = 2 + (int)(lines->width_m / size_m);
    tiling->sides = (size_t)tiling->pitch * (size_t)(2 + (int)(lines->depth_m / size_m));
    tiling->bottom = malloc(2 * tiling->sides);
    tiling->left = tiling->bottom + tiling->sides;
    return tiling->bottom != NULL;
}

/* By whole cells: lines from a raster know the land at its cells and guess between them, where it
 * is smoother than it should be.
 */
static double shift_m(double size_m, double cell_m, int shift)
{
    return floor(size_m * shift / SHIFTS / cell_m + 1e-9) * cell_m;
}

static void shift_tiling(tiling_t *tiling, const yb_lines_t *lines, double cell_m, int shift)
{
    tiling->west_m = shift_m(tiling->size_m, cell_m, shift % SHIFTS);
    tiling->south_m = shift_m(tiling->size_m, cell_m, shift / SHIFTS);
    /* a hair more, or rounding may cost the last column of a tiling that fits exactly */
    tiling->columns = (int)((lines->width_m - tiling->west_m) / tiling->size_m + 1e-9);
    tiling->rows = (int)((lines->depth_m - tiling->south_m) / tiling->size_m + 1e-9);
    memset(tiling->bottom, 0, 2 * tiling->sides);
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

static int divided_boxes(const tiling_t *tiling)
{
    int count = 0;
    for (int row = 0; row < tiling->rows; row++)
        for (int column = 0; column < tiling->columns; column++) {
            const int at = row * tiling->pitch + column;
            count += tiling->bottom[at] | tiling->bottom[at + tiling->pitch] | tiling->left[at] |
                     tiling->left[at + 1];
        }
    return count;
}

bool yb_fractal_count_boxes(const yb_lines_t *lines, const int *order, int line_count,
                            double cell_m, const double *size_m, int sizes, double *counted)
{
    for (int k = 0; k < sizes; k++) {
        tiling_t tiling;
        double share = 0;
        if (!begin_tiling(&tiling, lines, size_m[k]))
            return false;
        for (int shift = 0; shift < SHIFTS * SHIFTS; shift++) {
            shift_tiling(&tiling, lines, cell_m, shift);
            for (int i = 0; i < line_count; i++)
                cross_line(&tiling, &lines->line[order[i]]);
            share += divided_boxes(&tiling) / ((double)tiling.columns * tiling.rows);
        }
        free(tiling.bottom);
        /* As shares, because a tiling rarely covers all of the frame. That is right for lines which
         * fill it, as those of many levels do; one lonely line in its middle measures 0.03 less.
         */
        counted[k] =
            share / (SHIFTS * SHIFTS) * lines->width_m * lines->depth_m / (size_m[k] * size_m[k]);
    }
    return true;
}
