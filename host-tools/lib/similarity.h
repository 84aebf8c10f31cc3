/* How much a rebuilt contour resembles the original: the similarity K (quasi-coding paper 4.2).
 *
 * docs/similarity.md is the definition, with its reasons; this is how its words map to the fields.
 * All lines lie in one frame, the rectangle from (0, 0) to (east, north); regions of lines are as
 * region.h has them.
 */
#ifndef YB_SIMILARITY_H
#define YB_SIMILARITY_H

#include "isolines.h"

/* Equal steps of the original on which the signs of curvature are compared. */
#define YB_SIMILARITY_STEPS 16

/* The larger part of the frame beside an open line is matched only by at least this overlap. */
#define YB_SIMILARITY_LARGER_PART 0.25

typedef struct {
    double area;       /* a: intersection over union of the two regions */
    double distance;   /* d: 1 - min(1, Hausdorff distance / radius of a disc of equal area) */
    double curvature;  /* c: share of the steps that turn the same way */
    double k;          /* (a + d + c) / 3; all four are 0 if a line is missing */
    double length;     /* of the coded polygon: its weight */
    double hausdorff;  /* greatest distance of the two boundaries */
    size_t original;   /* index of the original line; YB_NO_LINE: none overlaps the polygon */
    size_t reproduced; /* index of the reproduced line; YB_NO_LINE: none overlaps the original */
} yb_similarity_t;

#define YB_NO_LINE ((size_t)-1)

/* K_i of one coded line against the isolines of the original and of the reproduced relief at its
 * height. False: no memory.
 */
bool yb_similarity_measure(yb_similarity_t *similarity, const yb_isoline_t *coded,
                           const yb_isolines_t *originals, const yb_isolines_t *reproductions,
                           double east, double north);

/* K: the mean of the K_i weighted by their lengths; 0 if there is no length. */
double yb_similarity_mean(const yb_similarity_t *similarity, size_t count);

#endif
