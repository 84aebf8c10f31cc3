/* From plans to maps, other than by a code. */
#ifndef TEST_MAPS_H
#define TEST_MAPS_H

#include <yamabiko/yamabiko.h>

#include "plan.h"
#include "rng.h"

/* Sets a map and its working memory to what yb_map_build wants of the plan. */
void map_set(yb_map_t *map, yb_load_t *load, const plan_t *plan);

/* Builds only the constrained Delaunay triangulation and its regions: what the rules start from. */
YB_MUST_CHECK yb_status_t map_triangulate(yb_map_t *map, yb_load_t *load, const plan_t *plan);

/* Goes on from map_triangulate to the summits and links: what the skeletons start from. */
YB_MUST_CHECK yb_status_t map_link(yb_map_t *map, yb_load_t *load, const plan_t *plan);

/* The same in all that is said, whatever lies in the arrays beyond their counts. */
bool map_same(const yb_map_t *a, const yb_map_t *b);

/* Does the engine take the plan's code? */
bool map_fits(const plan_t *plan);

/* A random plan whose code the engine takes: see random_plan. */
void random_fitting_plan(plan_t *plan, rng_t *rng);

/* The same, with no more than so much gain, and relief of some hundred metres. */
void random_gentle_plan(plan_t *plan, rng_t *rng, int most_gain);

/* The vertex at a place, in steps, or -1. */
int map_vertex_at(const yb_map_t *map, double x, double y);

/* The rule of the edge between two vertices, or -1: there is none. */
int map_edge(const yb_map_t *map, const yb_load_t *load, int a, int b);

#endif
