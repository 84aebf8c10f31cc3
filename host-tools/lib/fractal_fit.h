/* What boxes and dividers share: sizes, and the line through their counts. Private to fractal*.c.
 */
#ifndef YB_FRACTAL_FIT_H
#define YB_FRACTAL_FIT_H

#include "fractal.h"

enum {
    YB_FRACTAL_SIZES = 10
};

/* The smallest size is 4 cells: between the cells of a raster the relief is a plane, and those of
 * real DEMs are smoothed over two to four of them, so that smaller sizes measure the sensor.
 */
#define YB_FRACTAL_LEAST_CELLS 4.0

/* Fits the first `count` sizes; fewer than three give none: two points always lie on a line. */
yb_fractal_fit_t yb_fractal_fit(const double *size_m, const double *counted, int count);

/* Counts boxes on the lines order[0 .. lines) of one level: for each of the sizes (each at most
 * half the frame's shorter side) the mean number that the frame holds. Tilings are shifted by whole
 * cells. False: no memory.
 */
bool yb_fractal_count_boxes(const yb_lines_t *lines, const int *order, int line_count,
                            double cell_m, const double *size_m, int sizes, double *counted);

#endif
