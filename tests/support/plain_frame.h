/* A frame drawn the plain way: by recursion, nothing binned, nothing dropped but what lies behind
 * the eye; and random views.
 */
#ifndef TEST_PLAIN_FRAME_H
#define TEST_PLAIN_FRAME_H

#include <yamabiko/yamabiko.h>

#include "refine.h"
#include "rng.h"

/* Called for each leaf of a frame, in the order in which the engine draws those it does not drop.
 */
typedef void (*plain_leaf_fn)(void *context, const yb_point_t *const corner[3]);

/* Hands out the leaves of a frame that has begun, ordered for its first row; returns how many. */
uint32_t plain_leaves(yb_frame_t *frame, plain_leaf_fn fn, void *context);

/* The same, as it is ordered. */
uint32_t plain_ordered(yb_frame_t *frame, plain_leaf_fn fn, void *context);

/* Lies a triangle, with all that it may become, behind the eye? With plenty to spare. */
bool plain_behind(const yb_frame_t *frame, const yb_part_t *part);

/* The edge ab, as one that is split: at least once. */
yb_edge_t plain_split(const yb_point_t *a, const yb_point_t *b, yb_edge_t edge);

/* A view that nothing is out of that has a spot. */
const refine_view_t *plain_view(const yb_frame_t *frame);

/* Draws all rows of a frame that has begun. */
void plain_frame(yb_frame_t *frame, const yb_band_t *band);

/* A view of a map from anywhere that makes sense: round it, in it, below it, far away, at its side,
 * on foot, straight down or up; with and without water, walls and exaggeration.
 */
void random_view(yb_view_t *view, const yb_map_t *map, rng_t *rng);

/* Colours, lines, haze and shadows for it; these are valid until the next call. */
void random_look(yb_view_t *view, rng_t *rng);

/* A view that makes none: every field anything its type can hold, or at an extreme. */
void wild_view(yb_view_t *view, rng_t *rng);

#endif
