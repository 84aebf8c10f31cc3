/* Several small changes of a code that are tried at once. Each is felt near its place only, so that
 * one look at the surface says which of them are good.
 */
#ifndef YB_SEARCH_BATCH_H
#define YB_SEARCH_BATCH_H

#include "search_moves.h"

enum {
    YB_BATCH_CHANGES = 16,
    YB_BATCH_LINE = 6, /* points of a line whose height is changed in a batch, at most */
    YB_BATCH_SITES = YB_BATCH_CHANGES * YB_BATCH_LINE
};

typedef struct {
    yb_local_move_t kind;
    int contour;
    int point; /* index in the code that is changed; of a new point: that of the one behind it */
    yb_step_t to;
    uint16_t height;
} yb_batch_change_t;

typedef struct {
    int count;
    yb_batch_change_t change[YB_BATCH_CHANGES]; /* the highest points first */
} yb_batch_t;

/* Draws up to `most` changes of the code `now` of which no two are of one point and none makes
 * lines meet. Uses mover->set, which becomes the code with all of them.
 */
void yb_batch_draw(yb_batch_t *batch, yb_search_mover_t *mover, const yb_contour_set_t *now,
                   int most);

/* The code with the changes made. */
void yb_batch_apply(const yb_batch_t *batch, const yb_contour_set_t *now, yb_contour_set_t *set);

/* Where the changes are, site by site. Answers how many. */
int yb_batch_sites(const yb_batch_t *batch, const yb_contour_set_t *now,
                   yb_judge_site_t site[YB_BATCH_SITES]);

/* About so many bits a change makes the code longer. */
double yb_batch_bits(const yb_batch_change_t *change);

#endif
