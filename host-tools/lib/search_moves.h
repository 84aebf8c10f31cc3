/* The changes that the encoder's search tries on a code. */
#ifndef YB_SEARCH_MOVES_H
#define YB_SEARCH_MOVES_H

#include "search.h"

typedef struct {
    const yb_search_t *search;
    uint64_t random;
    double heat; /* 1 at the start, 0 at the end: how far changes go */
    bool grows;  /* there is room in the code: half of the changes add something */
    yb_contour_set_t *set;
    int contour, first, point; /* what the change at hand is for, and the contour's first point */
} yb_search_mover_t;

/* One random change of mover->set. False: this one was not possible, and the set may be changed in
 * part.
 */
bool yb_search_move(yb_search_mover_t *mover);

/* The same for one move of a point, mover->point. False: the set is as it was. */
bool yb_search_move_point(yb_search_mover_t *mover);

#endif
