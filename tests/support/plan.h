/* A map as a plan: contours in whole steps, before it becomes a code of the paper profile.
 *
 * plan_write puts down whatever the plan says, legal or not; plan_valid says by brute force, in its
 * own arithmetic, whether it is legal (SPEC 1.5). The two together tell what the engine must
 * answer.
 */
#ifndef TEST_PLAN_H
#define TEST_PLAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    PLAN_MAX_POINTS = 300,
    PLAN_MAX_CONTOURS = 255,
    PLAN_MAX_BYTES = 1600
};

/* A plan_t.vertices that asks for the true count. */
enum {
    PLAN_COUNT = -1
};

typedef struct {
    int x, y;
} plan_point_t;

typedef struct {
    int first, count;
    int height; /* in units */
} plan_contour_t;

typedef struct {
    int east, north;
    int shift;            /* s: differences are multiples of 2^s */
    int cell, unit, base; /* as coded */
    int seed, gain;
    int dimension; /* d of D = 1 + d/256 */
    bool straight;
    int corner_height[4]; /* SW SE NE NW; -1: not coded */
    int frame_height;     /* when no corner is */
    int vertices;         /* V of the header, or PLAN_COUNT */
    int points, contours;
    plan_point_t point[PLAN_MAX_POINTS];
    plan_contour_t contour[PLAN_MAX_CONTOURS];
} plan_t;

/* An empty plan: one metre a step and a unit, D = 1.25, gain 1, frame at height 0. */
void plan_init(plan_t *plan, int east, int north);

/* Appends a contour as it is; false if there is no room. */
bool plan_add(plan_t *plan, const plan_point_t *points, int count, int height);

/* Appends a contour if the plan then still is valid and can be coded. */
bool plan_try(plan_t *plan, const plan_point_t *points, int count, int height);

/* All points, and the corners at which no line ends. */
int plan_vertices(const plan_t *plan);

/* Can the bytes say it: counts, differences, at most `most` vertices? */
bool plan_codable(const plan_t *plan, int most);

/* Is it legal by SPEC 1.5? */
bool plan_valid(const plan_t *plan);

/* Is the contour an open line (true) or a closed one or a point (false)? */
bool plan_open(const plan_t *plan, int contour);

/* Edges of a contour, and the k-th of them as two point numbers. */
int plan_edges(const plan_t *plan, int contour);
void plan_edge(const plan_t *plan, int contour, int k, int *a, int *b);

/* Writes the code, check byte included, and returns its length. */
size_t plan_write(const plan_t *plan, uint8_t bytes[PLAN_MAX_BYTES]);

/* Replaces the last byte by the right check. */
void plan_mend(uint8_t *bytes, size_t count);

#endif
