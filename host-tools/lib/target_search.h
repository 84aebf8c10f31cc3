/* The parameter loop of the quasi-coding paper (4.3) as a search: points, heights, whole lines, the
 * noise's seed and gain are changed a little, and changes are kept when the code becomes shorter or
 * its K comes nearer to the target, or, at first, not much worse (simulated annealing).
 *
 * Bits are the currency: what K lacks of the target is fined, and so is a map that is no picture of
 * the relief any more, however well its lines run. The number of trials is fixed and the random
 * numbers are ours: equal input gives equal bytes.
 */
#ifndef YB_TARGET_SEARCH_H
#define YB_TARGET_SEARCH_H

#include "contour_set.h"
#include "judge.h"
#include "line_judge.h"

enum {
    YB_TARGET_LEVELS = 3 /* least number of heights that lines have */
};

/* The heights of the lines, with the lowest and the highest place of the relief, leave no gap that
 * is a larger share of its range.
 */
#define YB_TARGET_MOST_GAP 0.38

/* Most that a map may be off the relief, smooth, in standard deviations, slopes counted in
 * (judge.h); unless the search does not come as near as that.
 */
#define YB_TARGET_MOST_OFF 0.25

typedef struct {
    double k;
    double bits;
    size_t bytes;
    double off; /* of the smooth surface from the relief, see above */
    double gap;
    int heights; /* of lines, different ones */
    int missing; /* lines without a counterpart */
    double cost; /* in bits */
} yb_target_score_t;

enum {
    YB_TARGET_KEPT = 24
};

/* The shortest codes that reach the target, one of each size, shortest first; and the code that
 * comes nearest to it, within the bytes allowed if there is one.
 */
typedef struct {
    yb_contour_set_t set[YB_TARGET_KEPT];
    yb_target_score_t score[YB_TARGET_KEPT];
    int count;
    yb_contour_set_t nearest;
    yb_target_score_t nearest_score; /* bytes 0: none */
} yb_target_kept_t;

typedef struct {
    const yb_grid_t *grid;
    yb_judge_t *judge;
    yb_line_judge_t *lines; /* for the frame of the draft */
    double k;               /* the target */
    size_t most_bytes;
    const double *level_m; /* heights that lines may have; rising */
    int levels;            /* and how many; 0: any height */
    uint8_t least_gain, most_gain;
    double most_off;     /* from the relief */
    double k_fine;       /* bits for each unit that K lacks */
    uint16_t longest_q8; /* edges of the surface that K is measured on */
    long trials;
    double hot, cold; /* temperatures at begin and end, in bits */
    uint64_t seed;
    yb_target_kept_t *kept;                        /* may be NULL: nothing is kept */
    void (*progress)(void *context, double share); /* may be NULL */
    void *context;
} yb_target_search_t;

/* Whether the engine makes a map of a code, and one of no more vertices than it may have. */
bool yb_target_possible(const yb_target_search_t *search, const yb_contour_set_t *set);

/* False: the code is impossible. */
bool yb_target_score(const yb_target_search_t *search, const yb_contour_set_t *set,
                     yb_target_score_t *score);

/* Whether the map is one that may be kept, but for its K and its size. */
bool yb_target_sound(const yb_target_search_t *search, const yb_target_score_t *score);

/* Improves a code, whose first contour is the summit and stays; *score becomes that of the result,
 * the cheapest met. False: the code was impossible to begin with, or no memory.
 */
bool yb_target_search_run(const yb_target_search_t *search, yb_contour_set_t *set,
                          yb_target_score_t *score);

#endif
