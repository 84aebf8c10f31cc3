#include "target_search.h"

#include <math.h>
#include <stdlib.h>

#include "contour_code.h"
#include "random.h"
#include "target_moves.h"

/* Fines in bits: for each unit of a fault, for each bit over the budget and each height too few;
 * and once for a code that may not be kept, where codes are. A line that is missing has K_i = 0 and
 * needs no fine.
 */
static const double off_fine = 3000;
static const double gap_fine = 4000;
static const double height_fine = 400;
static const double over_fine = 4;
static const double unfit_fine = 50;
/* K of the search and of evaluate differ by about as much. */
static const double k_margin = 0.0015;
/* So that the search does not stay just beyond what may be kept. */
static const double off_margin = 0.005;

typedef struct {
    const yb_target_search_t *search;
    yb_target_mover_t mover;
    yb_contour_set_t now, next, best;
    yb_target_score_t now_score, best_score;
} state_t;

static int by_value(const void *a, const void *b)
{
    double first = *(const double *)a;
    double second = *(const double *)b;
    return (first > second) - (first < second);
}

static void measure_heights(const yb_target_search_t *search, const yb_contour_set_t *set,
                            yb_target_score_t *score)
{
    double height_m[YB_SET_CONTOURS + 2];
    int count = 0;
    double low_m = (double)search->grid->low_m;
    double high_m = (double)search->grid->high_m;
    for (int i = 0; i < set->contour_count; i++)
        if (set->contour[i].count > 1)
            height_m[count++] = yb_contour_set_height_m(set, set->contour[i].height);
    height_m[count++] = low_m;
    height_m[count++] = high_m;
    qsort(height_m, (size_t)count, sizeof(*height_m), by_value);
    score->heights = -1;
    score->gap = 0;
    for (int i = 1; i < count; i++) {
        score->heights += height_m[i] > height_m[i - 1];
        score->gap = fmax(score->gap, (height_m[i] - height_m[i - 1]) / (high_m - low_m));
    }
}

static int least_heights(const yb_target_search_t *search)
{
    return search->levels > 0 && search->levels < YB_TARGET_LEVELS ? search->levels
                                                                   : YB_TARGET_LEVELS;
}

static double fines(const yb_target_search_t *search, const yb_target_score_t *score)
{
    double over = fmax(score->bits - 8.0 * (double)search->most_bytes, 0);
    int few = least_heights(search) - score->heights;
    bool fit = yb_target_sound(search, score) && score->k >= search->k + k_margin;
    return (search->kept == NULL || fit ? 0 : unfit_fine) +
           search->k_fine * fmax(search->k + k_margin - score->k, 0) +
           off_fine * fmax(score->off - search->most_off + off_margin, 0) +
           (search->levels > 0 ? 0 : gap_fine * fmax(score->gap - YB_TARGET_MOST_GAP, 0)) +
           height_fine * (few > 0 ? few : 0) + over_fine * over;
}

/* Drafts may be far too long. */
static size_t room_of(const yb_target_search_t *search)
{
    size_t room = 2 * search->most_bytes + 100;
    return room < YB_MAX_CODE_BYTES ? room : YB_MAX_CODE_BYTES;
}

bool yb_target_possible(const yb_target_search_t *search, const yb_contour_set_t *set)
{
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    size_t size = yb_contour_code_write(set, code, room_of(search), NULL);
    return size > 0 && yb_judge_score_m(search->judge, code, size) >= 0;
}

bool yb_target_score(const yb_target_search_t *search, const yb_contour_set_t *set,
                     yb_target_score_t *score)
{
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    yb_bits_t bits = {0};
    yb_line_score_t lines;
    *score = (yb_target_score_t){0};
    score->bytes = yb_contour_code_write(set, code, room_of(search), &bits);
    if (score->bytes == 0)
        return false;
    if (!yb_line_judge_score(search->lines, code, score->bytes, search->longest_q8, &lines, NULL))
        return false;
    score->off = yb_judge_score_m(search->judge, code, score->bytes) / search->grid->std_m;
    if (score->off < 0)
        return false;
    measure_heights(search, set, score);
    score->k = lines.k;
    score->missing = lines.missing;
    score->bits = bits.all;
    score->cost = bits.all + fines(search, score);
    return true;
}

bool yb_target_sound(const yb_target_search_t *search, const yb_target_score_t *score)
{
    return score->off <= search->most_off && score->heights >= least_heights(search) &&
           (search->levels > 0 || score->gap <= YB_TARGET_MOST_GAP);
}

/* How much a code is worth telling of that does not reach the target: 2 if it is short and sound
 * enough, 1 if it is short enough.
 */
static int worth(const yb_target_search_t *search, const yb_target_score_t *score)
{
    return score->bytes > search->most_bytes ? 0 : yb_target_sound(search, score) ? 2 : 1;
}

static void keep(const yb_target_search_t *search, const yb_contour_set_t *set,
                 const yb_target_score_t *score)
{
    yb_target_kept_t *kept = search->kept;
    if (kept == NULL)
        return;
    int better = kept->nearest_score.bytes == 0
                     ? 1
                     : worth(search, score) - worth(search, &kept->nearest_score);
    if (better > 0 || (better == 0 && score->k > kept->nearest_score.k)) {
        kept->nearest = *set;
        kept->nearest_score = *score;
    }
    if (worth(search, score) < 2)
        return;
    if (score->k < search->k + k_margin / 2)
        return;
    int at = 0;
    while (at < kept->count && kept->score[at].bytes < score->bytes)
        at++;
    if (at == YB_TARGET_KEPT)
        return;
    if (at < kept->count && kept->score[at].bytes == score->bytes) {
        if (score->k <= kept->score[at].k)
            return;
    } else {
        if (kept->count < YB_TARGET_KEPT)
            kept->count++;
        for (int i = kept->count - 1; i > at; i--) {
            kept->set[i] = kept->set[i - 1];
            kept->score[i] = kept->score[i - 1];
        }
    }
    kept->set[at] = *set;
    kept->score[at] = *score;
}

static void try_move(state_t *state, double heat)
{
    const yb_target_search_t *search = state->search;
    yb_target_score_t score;
    state->next = state->now;
    if (!yb_target_move(&state->mover) || !yb_target_score(search, &state->next, &score))
        return;
    double worse = (score.cost - state->now_score.cost) / heat;
    if (worse > 0 && yb_random_share(&state->mover.random) >= exp(-worse))
        return;
    state->now = state->next;
    state->now_score = score;
    keep(search, &state->now, &score);
    if (score.cost < state->best_score.cost) {
        state->best = state->now;
        state->best_score = score;
    }
}

bool yb_target_search_run(const yb_target_search_t *search, yb_contour_set_t *set,
                          yb_target_score_t *score)
{
    state_t *state = calloc(1, sizeof(*state));
    if (state == NULL)
        return false;
    state->search = search;
    state->mover =
        (yb_target_mover_t){.search = search, .random = search->seed, .set = &state->next};
    state->now = *set;
    state->best = *set;
    bool good = yb_target_score(search, set, &state->now_score);
    state->best_score = state->now_score;
    if (good)
        keep(search, set, &state->now_score);
    for (long trial = 0; trial < search->trials && good; trial++) {
        double done = (double)trial / (double)search->trials;
        state->mover.heat = (1 - done) * (1 - done) * fmin(search->hot / 60, 1);
        if (search->progress != NULL && trial % 64 == 0)
            search->progress(search->context, done);
        try_move(state, search->hot * pow(search->cold / search->hot, done));
    }
    *set = state->best;
    *score = state->best_score;
    free(state);
    return good;
}
