/* Analysis by synthesis: how far the surface that the engine makes of a code lies from the real
 * one. It is the engine itself that is asked (design: one decoder); here its triangles are only
 * sampled. Without detail: noise is not meant to hit any one place.
 */
#ifndef YB_JUDGE_H
#define YB_JUDGE_H

#include "contour_set.h"
#include "grid.h"

typedef struct yb_judge yb_judge_t;

/* A judge with `side` samples on the grid's longer side. NULL: out of memory. */
yb_judge_t *yb_judge_new(const yb_grid_t *grid, int side);
void yb_judge_free(yb_judge_t *judge);

/* How bad a code is, in metres: root of the mean square of the height differences at the samples,
 * to which those of the rises from sample to sample are added, at half weight, and that of the
 * highest place. A negative number if the code is impossible.
 */
double yb_judge_score_m(yb_judge_t *judge, const uint8_t *code, size_t size);

/* Keeps the differences of the surface judged last, to compare later ones with. */
void yb_judge_keep(yb_judge_t *judge);

/* Where the surface judged last is farthest from the truth but within `share` (0 to 1, a random
 * number) of the samples' total squared error: a place drawn in proportion to it.
 */
void yb_judge_worst(const yb_judge_t *judge, double share, double *east_m, double *north_m);

/* A place where a code was changed, in shares of the frame, and by which of several changes. */
typedef struct {
    double east, north;
    int change;
} yb_judge_site_t;

/* Divides the difference between the surface judged last and the one kept among the changes: what a
 * sample says counts for the change whose site is nearest. worse[change] becomes a share of the
 * score.
 */
void yb_judge_divide(const yb_judge_t *judge, const yb_judge_site_t *site, int sites, double *worse,
                     int changes);

/* The exact figure: yb_map_height at all cells of the grid (at most 256 a side), in metres. */
double yb_judge_map_rmse_m(const yb_map_t *map, const yb_grid_t *grid);

#endif
