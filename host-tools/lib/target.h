/* The smallest code whose lines resemble the real ones well enough: the parameter loop of the
 * quasi-coding paper (4.3), with K as docs/similarity.md has it and the fractal detail on.
 *
 * The code is a map all the same: its lines have three heights or more with no wide gap between
 * them, the summit is a spot height, the smooth surface is not far off the relief
 * (target_search.h), and the noise is about as strong as the relief's own roughness.
 */
#ifndef YB_TARGET_H
#define YB_TARGET_H

#include "encode.h"

/* As yb_encode_grid, but task->most_bytes is a limit, and task->seed where the search begins;
 * result->k is the similarity that was reached. False with a sentence also if no code found within
 * the limit reaches the target (above 0, at most 1). Equal input gives equal bytes.
 */
bool yb_target_grid(const yb_grid_t *grid, const yb_encode_task_t *task, double target_k,
                    yb_encode_result_t *result, yb_error_t *error);

/* The same for contour lines, which are the originals; all coded lines have heights of theirs, so
 * that the task may not name other ones.
 */
bool yb_target_lines(const yb_lines_t *lines, const yb_encode_task_t *task, double target_k,
                     yb_encode_result_t *result, yb_error_t *error);

#endif
