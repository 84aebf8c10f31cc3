#include "search.h"

#include <math.h>
#include <stdlib.h>

#include "contour_code.h"
#include "random.h"
#include "search_moves.h"

enum {
    REPORTED = 512 /* trials */
};

/* By what share a hundredth of the budget makes a code worse: within the budget, and beyond it. */
static const double cost_of_share = 8e-4;
static const double fine_of_share = 1.6e-2;
/* A code that fills less of the budget wants to grow. */
static const double full_share = 0.97;

/* Where the search stands. */
typedef struct {
    const yb_search_t *task;
    yb_search_mover_t mover;
    yb_contour_set_t now, next, best;
} state_t;

/* What a code costs: how far it is from the truth, and so much for each bit. Codes that are a
 * little too long are let by, for a fine: the way to a better one may lead over them. Negative: the
 * code is impossible. *share: how much of the budget it fills.
 */
static double cost_of(state_t *state, const yb_contour_set_t *set, bool *fits, double *share)
{
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    yb_bits_t bits = {0};
    size_t most = state->task->most_bytes;
    size_t size = yb_contour_code_write(set, code, most + most / 8, &bits);
    if (size == 0)
        return -1;
    *fits = size <= most;
    *share = bits.all / (8.0 * (double)most);
    double score = yb_judge_score_m(state->task->judge, code, size);
    double over = fmax(*share - 1, 0);
    return score < 0 ? -1 : score * exp(100 * (cost_of_share * *share + fine_of_share * over));
}

static void report(yb_progress_t *progress, double share)
{
    pthread_mutex_lock(progress->lock);
    progress->begun += share * progress->part;
    if (progress->report != NULL)
        progress->report(progress->context, fmin(progress->begun, 1));
    pthread_mutex_unlock(progress->lock);
}

double yb_search_run(const yb_search_t *search, yb_contour_set_t *set)
{
    state_t *state = calloc(1, sizeof(*state));
    if (state == NULL)
        return -1;
    state->task = search;
    state->mover =
        (yb_search_mover_t){.search = search, .random = search->seed, .set = &state->next};
    state->now = *set;
    state->best = *set;
    bool fits = false;
    double share = 0;
    double now = cost_of(state, set, &fits, &share);
    state->mover.grows = share < full_share;
    double best = now;
    for (long trial = 0; trial < search->trials && best >= 0; trial++) {
        double done = (double)trial / (double)search->trials;
        double heat = search->hot * pow(search->cold / search->hot, done);
        state->mover.heat = (1 - done) * (1 - done);
        if (search->progress != NULL && trial % REPORTED == 0)
            report(search->progress, (double)REPORTED / (double)search->trials);
        do
            state->next = state->now;
        while (!yb_search_move(&state->mover));
        double next = cost_of(state, &state->next, &fits, &share);
        if (next < 0)
            continue;
        double worse = log(next / now) / heat;
        if (worse > 0 && yb_random_share(&state->mover.random) >= exp(-worse))
            continue;
        state->now = state->next;
        now = next;
        state->mover.grows = share < full_share;
        if (now < best && fits) {
            best = now;
            state->best = state->now;
        }
    }
    *set = state->best;
    free(state);
    return best;
}
