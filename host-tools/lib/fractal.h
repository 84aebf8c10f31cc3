/* How rough a relief is: the fractal dimension of its contour lines and the strength of the noise
 * that a map needs to look like it.
 */
#ifndef YB_FRACTAL_H
#define YB_FRACTAL_H

#include "contour_lines.h"
#include "paper_code.h"

/* Dimensions that a code is given; measured ones are clamped to them. */
#define YB_FRACTAL_LEAST 1.05
#define YB_FRACTAL_MOST 1.6

/* Dimension of all lines of a level together, by counting boxes: squares of 4, 6, 8 … 32 times
 * cell_m that the lines of a level meet, summed over the levels; D is the slope of log(count)
 * against log(1/size). Below 4 cells a raster is smoother than the land, above 32 too few boxes
 * are left. Lines of one level must follow each other. Without lines: the least.
 */
double yb_fractal_boxes(const yb_lines_t *lines, double cell_m);

/* Dimension of one line by dividers: its length, measured in chords of 4 to 32 times cell_m,
 * falls as chord^(1 - D).
 */
double yb_fractal_divider(const yb_line_t *line, double cell_m);

/* The dimension of a surface's level sets from that of a single closed loop: D = 2 - H with
 * H = 3 - 2 D_loop.
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

/* Sets paper->gain so that the fine relief of the map (second differences of heights 6 steps
 * apart) is as strong as the grid's. False if the code is impossible.
 */
bool yb_fractal_gain(yb_paper_t *paper, const yb_grid_t *grid);

#endif
