/* K of a code (docs/similarity.md), fast enough for a search: about a millisecond. The isolines of
 * the truth are kept by their heights; those of the code are cut out of the surface where the coded
 * heights run, nowhere else.
 */
#ifndef YB_LINE_JUDGE_H
#define YB_LINE_JUDGE_H

#include "contour_lines.h"
#include "contour_set.h"
#include "grid.h"
#include "outline.h"

typedef struct yb_line_judge yb_line_judge_t;

/* The isolines of the truth at one height, in lattice steps, as a view. */
typedef struct {
    const yb_outline_t *outline; /* an open line has two, one after the other: left and right */
    int count;
    double height_m;
} yb_line_level_t;

/* A judge for codes whose frame is east by north steps. The originals are the grid's isolines, or,
 * if `lines` is not NULL, those of its lines that lie within half a unit of the coded height. Both
 * are borrowed for the judge's life. NULL: out of memory.
 */
yb_line_judge_t *yb_line_judge_new(const yb_grid_t *grid, const yb_lines_t *lines, int east,
                                   int north);
void yb_line_judge_free(yb_line_judge_t *judge);

typedef struct {
    double k;
    int lines;   /* with a length */
    int missing; /* of them: no original, or no reproduction */
} yb_line_score_t;

/* K of a code, its surface refined to edges of longest_q8 (YB_REFERENCE_Q8: what evaluate says, but
 * for some 0.001). False: the code is impossible, or no memory. With `each` not NULL, K_i of every
 * contour goes there, spot heights as 0.
 */
bool yb_line_judge_score(yb_line_judge_t *judge, const uint8_t *code, size_t size,
                         uint16_t longest_q8, yb_line_score_t *score, double *each);

/* The originals at a height as a code would have it; {0}: none, or no memory. */
yb_line_level_t yb_line_judge_level(yb_line_judge_t *judge, double height_m, double unit_m);

#endif
