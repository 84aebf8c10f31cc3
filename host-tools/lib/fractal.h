/* How rough a relief is: the fractal dimension of its contour lines, and the strength of the noise
 * that a map needs to look like it.
 *
 * D is the dimension of all lines of one level together: D = 2 - H, with H the Hurst exponent of
 * the surface. A single line of them, a closed loop or one from frame to frame, is smoother:
 * D_loop = (3 - H) / 2. (The 1985 paper prints H = D - 1, which would make the raggedest lines give
 * the smoothest mountain.)
 *
 * Boxes: squares of the size s tile the frame; a box counts when the lines of the level divide its
 * corners, that is, cross one of its sides an odd number of times. The mean over 16 positions of
 * the tiling falls as s^-D. On fractional surfaces that has no bias that could be measured, where
 * counting every box that a line meets finds too little (docs/DESIGN.md).
 *
 * Dividers: chords of the length s are stepped off along one line, from 8 places of it; what is
 * left at the end counts as a part of a step. Their number falls as s^-D.
 *
 * Sizes run from 4 cells, below which a raster is smoother than the land, to an eighth of the
 * frame's shorter side (boxes) or a thirtieth of the line (dividers).
 */
#ifndef YB_FRACTAL_H
#define YB_FRACTAL_H

#include <jansson.h>

#include "contour_lines.h"
#include "contour_set.h"

/* Dimensions that a code is given; measured ones are clamped to them. */
#define YB_FRACTAL_LEAST 1.05
#define YB_FRACTAL_MOST 1.9

enum {
    YB_FRACTAL_LEVELS = 9,   /* of a grid: at its tenths, by area */
    YB_FRACTAL_CONTOURS = 20 /* most that a report tells of */
};

/* A straight line through log(count) against log(1/size). */
typedef struct {
    double dimension; /* its slope, not clamped; 0: too few sizes, and so are the rest */
    double r2;        /* share of the variance that the line explains */
    double from_m, to_m;
    int sizes;
} yb_fractal_fit_t;

typedef struct {
    double height_m;
    yb_fractal_fit_t boxes;
} yb_fractal_level_t;

typedef struct {
    double height_m;
    bool closed;
    double length_m;
    yb_fractal_fit_t divider;
    double dimension; /* the divider's, converted by yb_fractal_from_loop; 0: not measured */
} yb_fractal_contour_t;

typedef struct {
    yb_fractal_fit_t boxes; /* of all levels: their counts are added */
    double dimension;       /* the same clamped, as a code is given it; least if not measured */
    yb_fractal_level_t *level;
    int level_count;
    yb_fractal_contour_t contour[YB_FRACTAL_CONTOURS]; /* the longest, longest first */
    int contour_count;
} yb_fractal_report_t;

/* Measures lines in full detail, in any order; spot heights are left out. cell_m: the resolution
 * they have. False with a sentence: no memory. Free by yb_fractal_free.
 */
bool yb_fractal_of_lines(const yb_lines_t *lines, double cell_m, yb_fractal_report_t *report,
                         yb_error_t *error);

/* The same for the lines of a grid, at the heights that a tenth, two tenths ... of it lie below. */
bool yb_fractal_of_grid(const yb_grid_t *grid, yb_fractal_report_t *report, yb_error_t *error);

/* The same for what an encoder is given: `lines`, with the cells of the grid made from them, or, if
 * that is NULL, the grid.
 */
bool yb_fractal_of_relief(const yb_grid_t *grid, const yb_lines_t *lines,
                          yb_fractal_report_t *report, yb_error_t *error);

void yb_fractal_free(yb_fractal_report_t *report);

/* All of it. A new reference. */
json_t *yb_fractal_json(const yb_fractal_report_t *report);

/* Dividers on one line. False: no memory. */
bool yb_fractal_divider(const yb_line_t *line, double cell_m, yb_fractal_fit_t *fit);

/* The dimension of a surface's level sets from that of a single line of them: D = 2 - H with
 * H = 3 - 2 D_loop, clamped.
 */
double yb_fractal_from_loop(double loop);

/* The code's byte for a dimension (1 to 2), and H of the surface. */
uint8_t yb_fractal_coded(double dimension);
static inline double yb_fractal_dimension(uint8_t coded)
{
    return 1 + coded / 256.0;
}
static inline double yb_fractal_hurst(double dimension)
{
    return 2 - dimension;
}

/* Gives a set the nearest dimension that its profile has. */
void yb_fractal_dimension_of(yb_contour_set_t *set, double dimension);

/* Sets set->gain so that the map is as rough as the grid: that the rises over 1, 2, 4 and 8 cells
 * are as few octaves off as can be (roughness.h). False, with the gain as it was, if the code is
 * impossible or memory short. Cost: some fifteen reference surfaces.
 */
bool yb_fractal_gain(yb_contour_set_t *set, const yb_grid_t *grid);

#endif
