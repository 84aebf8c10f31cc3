/* The outline of a region beside a line, as docs/similarity.md has it, and the three parts of K_i
 * between two of them, fast: areas by the lengths of the region's cuts with 256 rows instead of
 * GEOS's overlay. That is near enough (to about 0.001) for a search; yb_similarity_measure gives
 * the figures that count.
 */
#ifndef YB_OUTLINE_H
#define YB_OUTLINE_H

#include <stdbool.h>
#include <stddef.h>

#include "isolines.h"

enum {
    YB_OUTLINE_ROWS = 256
};

/* The frame is the rectangle from (0, 0) to (east, north). The line runs with its region on the
 * left; behind its points come those of the frame that lead back to its start.
 */
typedef struct {
    yb_point2_t *point;
    size_t count;    /* of the line */
    size_t boundary; /* all round */
    bool closed;     /* the line */
    double area;
    double length;  /* of the line */
    double longest; /* of the boundary's segments */
    double *at;     /* distance along the line of each of its points; count + 1 values */
    int *first;     /* crossing of each row, YB_OUTLINE_ROWS + 1 values */
    float *cross;   /* where the boundary crosses the rows, rising */
} yb_outline_t;

/* Area inside a closed line. */
double yb_outline_area(const yb_isoline_t *line);

/* The region on the left of a line, or with `turned` on its right; of a closed line always the
 * inside. False: no memory, or no area; then there is nothing to free.
 */
bool yb_outline_make(yb_outline_t *outline, const yb_isoline_t *line, bool turned, double east,
                     double north);

/* Zeros are left alone. */
void yb_outline_free(yb_outline_t *outline);

/* a: area of the intersection over area of the union. */
double yb_outline_overlap(const yb_outline_t *a, const yb_outline_t *b, double north);

/* d: 1 less the Hausdorff distance of the boundaries, in radii of a disc as large as the original.
 */
double yb_outline_distance(const yb_outline_t *original, const yb_outline_t *reproduced);

/* c: share of the original's steps that turn the same way in the reproduction. */
double yb_outline_curvature(const yb_outline_t *original, const yb_outline_t *reproduced);

#endif
