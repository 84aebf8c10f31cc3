#include "search.h"

#include <math.h>
#include <stdlib.h>

#include "contour_code.h"
#include "random.h"
#include "search_batch.h"

enum {
    REPORTED = 512 /* trials */
};

/* By what share a hundredth of the budget makes a code worse: within the budget, and beyond it. */
static const double cost_of_share = 8e-4;
static const double fine_of_share = 1.6e-2;
/* A code that fills less of the budget wants to grow. */
static const double full_share = 0.97;

/* Share of the turns that try several changes at once: one for so many points. */
static const double many_share = 0.5;
enum {
    POINTS_OF_ONE = 20
};

/* What a code costs: how far it is from the truth, and so much for each bit. Codes that are a
 * little too long are let by, for a fine: the way to a better one may lead over them. Negative: the
 * code is impossible.
 */
typedef struct {
    double cost;
    double share; /* of the budget */
    bool fits;
} verdict_t;

/* Where the search stands. */
typedef struct {
    const yb_search_t *task;
    yb_search_mover_t mover;
    double heat;
    double now_cost, best_cost;
    double now_share; /* of the budget */
    long trials;      /* done */
    yb_contour_set_t now, next, best;
} state_t;

/* One trial: of the next code. */
static verdict_t judge_next(state_t *state)
{
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    yb_bits_t bits = {0};
    size_t most = state->task->most_bytes;
    size_t size = yb_contour_code_write(&state->next, code, most + most / 8, &bits);
    verdict_t verdict = {-1, bits.all / (8.0 * (double)most), size <= most};
    state->trials++;
    if (size == 0)
        return verdict;
    double score = yb_judge_score_m(state->task->judge, code, size);
    double over = fmax(verdict.share - 1, 0);
    if (score >= 0)
        verdict.cost = score * exp(100 * (cost_of_share * verdict.share + fine_of_share * over));
    return verdict;
}

/* Goes on from the code judged last. */
static void take_next(state_t *state, verdict_t verdict)
{
    state->now = state->next;
    state->now_cost = verdict.cost;
    state->now_share = verdict.share;
    state->mover.grows = verdict.share < full_share;
    yb_judge_keep(state->task->judge);
    if (verdict.fits && verdict.cost < state->best_cost) {
        state->best_cost = verdict.cost;
        state->best = state->now;
    }
}

/* Whether to take what is worse by that share of the cost (Metropolis). */
static bool is_welcome(state_t *state, double worse)
{
    return worse <= 0 || yb_random_share(&state->mover.random) < exp(-worse / state->heat);
}

static void consider(state_t *state, verdict_t verdict)
{
    if (verdict.cost >= 0 && is_welcome(state, log(verdict.cost / state->now_cost)))
        take_next(state, verdict);
}

static void try_one(state_t *state)
{
    do
        state->next = state->now;
    while (!yb_search_move(&state->mover));
    consider(state, judge_next(state));
}

/* What a bit more costs, as a share. */
static double price_of_bit(const state_t *state)
{
    double of_share = cost_of_share + (state->now_share > 1 ? fine_of_share : 0);
    return 100 * of_share / (8.0 * (double)state->task->most_bytes);
}

/* Several changes at once. Those that are not good are taken back, and the rest is judged again. */
static void try_many(state_t *state)
{
    yb_batch_t batch;
    yb_judge_site_t site[YB_BATCH_SITES];
    double worse[YB_BATCH_CHANGES];
    int most = state->now.point_count / POINTS_OF_ONE;
    yb_batch_draw(&batch, &state->mover, &state->now, most < 1 ? 1 : most);
    if (batch.count == 0)
        return;
    verdict_t verdict = judge_next(state);
    if (verdict.cost < 0)
        return;
    int sites = yb_batch_sites(&batch, &state->now, site);
    yb_judge_divide(state->task->judge, site, sites, worse, batch.count);
    yb_batch_t good = {.count = 0};
    for (int i = 0; i < batch.count; i++)
        if (is_welcome(state, worse[i] + price_of_bit(state) * yb_batch_bits(&batch.change[i])))
            good.change[good.count++] = batch.change[i];
    if (good.count == 0)
        return;
    if (good.count < batch.count) {
        yb_batch_apply(&good, &state->now, &state->next);
        verdict = judge_next(state);
    }
    consider(state, verdict);
}

static void report(yb_progress_t *progress, double share)
{
    pthread_mutex_lock(progress->lock);
    progress->begun += share * progress->part;
    if (progress->report != NULL)
        progress->report(progress->context, fmin(progress->begun, 1));
    pthread_mutex_unlock(progress->lock);
}

static void cool(state_t *state)
{
    const yb_search_t *task = state->task;
    double done = (double)state->trials / (double)task->trials;
    state->heat = task->hot * pow(task->cold / task->hot, done);
    state->mover.heat = (1 - done) * (1 - done);
}

static void run(state_t *state)
{
    const yb_search_t *task = state->task;
    for (long reported = 0; state->trials < task->trials;) {
        if (task->progress != NULL && state->trials >= reported) {
            report(task->progress, (double)REPORTED / (double)task->trials);
            reported += REPORTED;
        }
        cool(state);
        if (task->many && yb_random_share(&state->mover.random) < many_share)
            try_many(state);
        else
            try_one(state);
    }
}

double yb_search_run(const yb_search_t *search, yb_contour_set_t *set)
{
    state_t *state = calloc(1, sizeof(*state));
    if (state == NULL)
        return -1;
    state->task = search;
    state->mover =
        (yb_search_mover_t){.search = search, .random = search->seed, .set = &state->next};
    state->best = *set;
    state->next = *set;
    verdict_t verdict = judge_next(state);
    state->best_cost = HUGE_VAL;
    state->trials = 0;
    if (verdict.cost >= 0) {
        take_next(state, verdict);
        run(state);
        *set = state->best;
        verdict.cost = state->best_cost;
    }
    free(state);
    return verdict.cost;
}
