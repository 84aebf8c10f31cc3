/* Random maps of every awkward kind. */
#ifndef TEST_RANDOM_PLAN_H
#define TEST_RANDOM_PLAN_H

#include "plan.h"
#include "rng.h"

/* A legal, codable plan: nested blobs, bows, canyons, combs, spirals, open lines, spot heights
 * scattered, clustered, in a row, on a circle or a grid; sometimes nearly full.
 */
void random_plan(plan_t *plan, rng_t *rng);

/* A legal, codable plan of what the rules between contours speak of: peaks and pits by ones, twos
 * and many in one parent, with and without summits; canyons, bows, combs, spirals; craters and
 * other nests of one height; spot heights as high as a line; coasts at height 0; lines round the
 * frame's corners.
 */
void random_mountain(plan_t *plan, rng_t *rng);

/* Of a seed: one in four a random_plan, else a random_mountain. */
void random_map(plan_t *plan, uint64_t seed);

/* A codable plan whose points and lines may do anything: cross, touch, repeat. */
void random_mess(plan_t *plan, rng_t *rng);

/* Shapes, each added only if legal and codable; true if it was. */
bool random_open_line(plan_t *plan, rng_t *rng, int height);
bool shape_comb(plan_t *plan, int x, int y, int teeth, int pitch, int length, int height);
bool shape_blob(plan_t *plan, rng_t *rng, int x, int y, int radius, int height);

#endif
