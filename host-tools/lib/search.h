/* The encoder's search: small changes to a code, kept when the judge finds the surface nearer to
 * the truth, or, at first, not much farther (simulated annealing). Changes move, add and take away
 * feature points, heights and whole contours inside a budget of bytes, one at a time or several
 * that are felt in different places. The number of trials is fixed and the random numbers are our
 * own: equal input gives equal bytes on every machine.
 */
#ifndef YB_SEARCH_H
#define YB_SEARCH_H

#include <pthread.h>

#include "contour_set.h"
#include "judge.h"

/* Several searches together are `part` each of all the work. */
typedef struct {
    pthread_mutex_t *lock;
    void (*report)(void *context, double share); /* may be NULL */
    void *context;
    double begun, part;
} yb_progress_t;

typedef struct {
    const yb_grid_t *grid;
    yb_judge_t *judge;
    size_t most_bytes;
    const uint16_t *level; /* heights that lines may have, rising, in the code's units */
    int levels;            /* and how many; 0: any height */
    bool many; /* there are many points: several changes in one trial, and where the error is */
    long trials;
    double hot, cold; /* temperatures at begin and end, as shares of the error */
    uint64_t seed;
    yb_progress_t *progress; /* where searches report; may be NULL */
} yb_search_t;

/* Improves the code in place, which must be possible at the start. Answers the
 * judge's score of it.
 */
double yb_search_run(const yb_search_t *search, yb_contour_set_t *set);

#endif
