/* The first draft of a code: contour lines, longest first, simplified and laid on the lattice until
 * the bytes are used up, and the summits.
 */
#ifndef YB_SKETCH_H
#define YB_SKETCH_H

#include "contour_lines.h"
#include "contour_set.h"
#include "encode_task.h"
#include "simplify.h"

/* Header of a code for a frame of these metres: at most 255 steps on the longer side (a multiple
 * of the spacing, so that a line can run from one side to the other), heights from low_m to high_m
 * with half as much to spare, one frame height at low_m, no contours, middling noise.
 */
void yb_sketch_begin(yb_contour_set_t *set, double width_m, double depth_m, double low_m,
                     double high_m, int spacing);

/* The same for a task: the grid's frame and heights; the task's profile, seed, sections and bound
 * on the mesh. A compact set still wants yb_sketch_units.
 */
void yb_sketch_task(yb_contour_set_t *set, const yb_grid_t *grid, const yb_encode_task_t *task,
                    int spacing);

/* Lets the heights of a compact set that has none yet count from lowest_m, or a little below, in
 * units as coded; those of lines in multiples of 2^interval units.
 */
void yb_sketch_units(yb_contour_set_t *set, uint16_t unit, int interval, double lowest_m);

/* Gives the corners the grid's heights, and the frame their mean. */
void yb_sketch_corners(yb_contour_set_t *set, const yb_grid_t *grid);

/* Adds a spot height at a place of the frame, moved strictly inside. False: no room or taken. */
bool yb_sketch_spot(yb_contour_set_t *set, const yb_lines_t *frame, yb_place_t at, double height_m,
                    size_t most_bytes);

/* Adds as many of the lines as fit, in the order given: closed and open ones simplified to
 * tolerance_m, spot heights as they are. Lines that cross what is there already are left out.
 * Answers how many were added.
 */
int yb_sketch_lines(yb_contour_set_t *set, const yb_lines_t *lines, double tolerance_m,
                    size_t most_bytes);

/* Longest first; spot heights last, the higher ones first. */
void yb_sketch_sort(yb_lines_t *lines);

/* The highest place of a grid. */
yb_place_t yb_sketch_summit(const yb_grid_t *grid);

/* The height below which a share (0 to 1) of a grid's cells lie. */
double yb_sketch_quantile(const yb_grid_t *grid, double share);

#endif
