/* The changes that the search for a similarity tries on a code. */
#ifndef YB_TARGET_MOVES_H
#define YB_TARGET_MOVES_H

#include "target_search.h"

typedef struct {
    const yb_target_search_t *search;
    uint64_t random;
    double heat; /* 1 at the start, 0 at the end: how far changes go */
    yb_contour_set_t *set;
    int contour; /* what the change at hand is for, where it is for one */
} yb_target_mover_t;

/* One random change of mover->set. False: this one was not possible. */
bool yb_target_move(yb_target_mover_t *mover);

/* Adds the isoline of the truth at a height: the longest (or, if `random`, any, long ones rather),
 * simplified to a tolerance in steps. False: there is none, or it does not fit.
 */
bool yb_target_add_line(yb_target_mover_t *mover, double height_m, double tolerance, bool random);

#endif
