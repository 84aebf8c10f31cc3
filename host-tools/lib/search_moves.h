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

/* A change that is felt near one place only. */
typedef enum {
    YB_MOVE_POINT,
    YB_MOVE_HEIGHT, /* of a spot height or a short line */
    YB_MOVE_INSERT,
    YB_MOVE_REMOVE,
    YB_MOVE_SPOT /* a new one, the last contour */
} yb_local_move_t;

/* One of these, of mover->contour and, but for heights, mover->point; a new point comes after
 * that. False: it was not possible.
 */
bool yb_search_move_locally(yb_search_mover_t *mover, yb_local_move_t kind);

#endif
