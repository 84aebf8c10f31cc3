/* A contour set: what a code says, before it is bytes, whatever its profile (docs/SPEC.md 1).
 *
 * Points lie in lattice steps, x to the east and y to the north, one contour after the other as in
 * the code. The struct is flat and small, so that a search can copy it.
 */
#ifndef YB_CONTOUR_SET_H
#define YB_CONTOUR_SET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <yamabiko/yamabiko.h>

#include "coded_values.h"
#include "sections.h"

enum {
    YB_SET_CONTOURS = 255,
    YB_SET_POINTS = 1023,
    YB_CORNERS = 4
};

typedef struct {
    uint8_t x, y;
} yb_step_t;

typedef struct {
    uint16_t height; /* in units above the base */
    uint16_t count;  /* points; 1 is a spot height */
    bool open;       /* from frame to frame */
} yb_coded_contour_t;

typedef struct {
    yb_profile_t profile;
    uint8_t east, north; /* size of the frame in steps, 1 to 255 */
    uint8_t spacing;     /* of the lattice: the encoder's points are multiples of it */
    uint8_t shift;       /* paper: differences are multiples of 2^shift; 0 to 3 */
    uint8_t interval;    /* compact: heights of lines are multiples of 2^interval units */
    uint16_t cell;       /* metres per step, as coded: yb_unit_coded */
    uint16_t unit;       /* metres per unit of height, as coded */
    int16_t base_m;      /* paper */
    int base;            /* compact: in units, instead of base_m */
    uint8_t seed;
    uint8_t gain;      /* 32 is what the contours themselves suggest */
    uint8_t dimension; /* D = 1 + dimension/256 */
    bool straight;     /* no smoothing */
    uint8_t corners;   /* coded corner heights: bit 0 SW, 1 SE, 2 NE, 3 NW; 0: one for the frame */
    uint16_t corner[YB_CORNERS];
    uint16_t frame;    /* its height if no corner is coded */
    int vertices;      /* of the mesh, which only the engine can count; 0: not known yet … */
    int most_vertices; /* … then the most that it may have; 0: 255 */
    /* compact: what follows the relief, borrowed; NULL: nothing */
    const yb_sections_t *sections;
    int contour_count;
    int point_count;
    yb_coded_contour_t contour[YB_SET_CONTOURS];
    yb_step_t point[YB_SET_POINTS];
} yb_contour_set_t;

/* The height in units nearest to height_m, within what a set can say. */
uint16_t yb_contour_set_height(const yb_contour_set_t *set, double height_m);

/* The same for a line: a multiple of the interval. */
uint16_t yb_contour_set_line_height(const yb_contour_set_t *set, double height_m);

/* What a height in units is in metres. */
double yb_contour_set_height_m(const yb_contour_set_t *set, int height);

/* The most vertices that the mesh may have, whether they are known or not. */
int yb_contour_set_most_vertices(const yb_contour_set_t *set);

/* Index of a contour's first point. */
int yb_contour_set_first(const yb_contour_set_t *set, int contour);

/* Whether a contour's point, counted from its first, is an end on the frame. */
bool yb_contour_set_is_end(const yb_contour_set_t *set, int contour, int at);

/* Inserts a point before index `at` of all points, into contour `contour`; takes it out again.
 * False: there are too many.
 */
bool yb_contour_set_insert(yb_contour_set_t *set, int contour, int at, yb_step_t point);
void yb_contour_set_remove(yb_contour_set_t *set, int contour, int at);

/* Appends a contour of 1 or more points, or takes one out. False: there are too many. */
bool yb_contour_set_append(yb_contour_set_t *set, uint16_t height, bool open,
                           const yb_step_t *point, int count);
void yb_contour_set_drop(yb_contour_set_t *set, int contour);

/* Moves a contour to another place among the contours. False: it is there. */
bool yb_contour_set_reorder(yb_contour_set_t *set, int contour, int to);

/* Lets a contour begin with its point `from`, and run `back` from there: the surface stays. An open
 * one can only be turned round, from its last point.
 */
void yb_contour_set_turn(yb_contour_set_t *set, int contour, int from, bool back);

/* Rounds all heights of a compact set to another coded unit. False: that is the unit already. */
bool yb_contour_set_rescale(yb_contour_set_t *set, uint16_t unit);

#endif
