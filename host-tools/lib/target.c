#include "target.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "certificate.h"
#include "comparison.h"
#include "contour_code.h"
#include "fidelity.h"
#include "fractal.h"
#include "line_grid.h"
#include "sketch.h"
#include "target_draft.h"
#include "target_search.h"

enum {
    JUDGE_SIDE = 48,
    MOST_DRAFTS = 12,
    COARSE_Q8 = 4 * YB_REFERENCE_Q8, /* for all but the last trials */
    MEASURED_LEVELS = 9
};

/* Trials at effort 5: on each draft, on each of the best ones, on the best of all, first coarse,
 * then as evaluate measures.
 */
enum {
    ON_EACH = 400,
    ON_BETTER = 1600,
    ON_BEST = 6000,
    ON_FINE = 3000,
    BETTER = 3,
    MOST_ROUNDS = 2 /* of the last, as long as nothing was found */
};

enum {
    SPACINGS = 3
};

/* What 0.01 of K may cost at first: as much as eight points; and so many times more whenever a
 * search stays below the target.
 */
static const double first_k_fine = 6000;
static const double dearer = 4;

/* A first search that stays so far off the relief has met land of many ridges. */
static const double far_off = 0.4;

/* The gain may be so much weaker than what gives the relief's own roughness; or than what contours
 * suggest, where lines are all there is to go by.
 */
static const double weakest_gain = 0.7;
static const double weakest_of_lines = 0.25;

typedef struct {
    yb_contour_set_t set;
    yb_target_score_t score;
    yb_line_judge_t *lines;
} draft_t;

typedef struct {
    const yb_grid_t *grid;
    const yb_lines_t *given; /* or NULL */
    const yb_encode_task_t *task;
    double k;
    double dimension;
    yb_judge_t *judge;
    yb_levels_t levels;
    draft_t draft[MOST_DRAFTS];
    int drafts;
    long trials, done;
    long part; /* of the trials that run now */
    yb_target_kept_t kept;
} loop_t;

static yb_target_search_t search_of(loop_t *loop, draft_t *draft, uint64_t seed)
{
    int gain = draft->set.gain;
    return (yb_target_search_t){.grid = loop->grid,
                                .judge = loop->judge,
                                .lines = draft->lines,
                                .k = loop->k,
                                .most_bytes = loop->task->most_bytes,
                                .level_m = loop->levels.height_m,
                                .levels = loop->levels.count,
                                .least_gain = (uint8_t)gain,
                                .most_gain = (uint8_t)gain,
                                .most_off = YB_TARGET_MOST_OFF,
                                .k_fine = first_k_fine,
                                .longest_q8 = COARSE_Q8,
                                .seed = seed};
}

/* A draft is kept if a code can be made of it, however bad and long it is. */
static bool make_draft(loop_t *loop, int wanted_spacing, int lines)
{
    draft_t *draft = &loop->draft[loop->drafts];
    const yb_target_draft_t begin = {.grid = loop->grid,
                                     .task = loop->task,
                                     .dimension = loop->dimension,
                                     .levels = &loop->levels};
    bool good =
        yb_target_draft_begin(&begin, &draft->set, yb_target_draft_spacing(&begin, wanted_spacing));
    for (int i = 0; i < loop->drafts && draft->lines == NULL; i++)
        if (loop->draft[i].set.east == draft->set.east &&
            loop->draft[i].set.north == draft->set.north)
            draft->lines = loop->draft[i].lines;
    if (draft->lines == NULL)
        draft->lines =
            yb_line_judge_new(loop->grid, loop->given, draft->set.east, draft->set.north);
    if (draft->lines == NULL)
        return false;
    yb_target_search_t search = search_of(loop, draft, 1);
    if (good)
        yb_target_draft_lines(&search, &draft->set, lines);
    draft->score.cost = good ? 0 : HUGE_VAL;
    loop->drafts++;
    return true;
}

static void report(void *context, double share)
{
    const loop_t *loop = context;
    if (loop->task->progress != NULL)
        loop->task->progress(
            loop->task->context,
            fmin(((double)loop->done + share * (double)loop->part) / (double)loop->trials, 1));
}

static void improve(loop_t *loop, draft_t *draft, yb_target_search_t *search, long trials)
{
    search->trials = trials;
    search->progress = report;
    search->context = loop;
    loop->part = trials;
    if (draft->score.cost < HUGE_VAL && !yb_target_search_run(search, &draft->set, &draft->score))
        draft->score.cost = HUGE_VAL;
    loop->done += trials;
}

static int by_cost(const void *a, const void *b)
{
    double first = ((const draft_t *)a)->score.cost;
    double second = ((const draft_t *)b)->score.cost;
    return (first > second) - (first < second);
}

/* The gain that makes the map as rough as the relief. */
static void fit_gain(loop_t *loop, draft_t *draft, yb_target_search_t *search)
{
    bool compact = draft->set.profile == YB_COMPACT;
    draft->set.gain = 32;
    if (loop->given == NULL)
        yb_fractal_gain(&draft->set, loop->grid);
    double gain = draft->set.gain;
    double weakest = loop->given != NULL ? weakest_of_lines : weakest_gain;
    search->least_gain = (uint8_t)fmax(gain * weakest, 1);
    search->most_gain = (uint8_t)fmax(gain, 1);
    draft->set.gain = compact ? yb_compact_gain(gain) : search->most_gain;
    if (draft->set.gain == 0)
        draft->set.gain = 1;
}

static long scaled(const loop_t *loop, int trials)
{
    return yb_encode_trials(trials, loop->task->effort) + 1;
}

static bool make_drafts(loop_t *loop, yb_error_t *error)
{
    static const int spacing[2][SPACINGS] = {{6, 9, 12}, {4, 8, 8}};
    bool paper = loop->task->profile == YB_PAPER;
    for (int lines = YB_TARGET_LEVELS; lines < YB_TARGET_LEVELS + 3; lines++)
        for (int i = 0; i < SPACINGS; i++)
            if (!make_draft(loop, spacing[paper ? 1 : 0][i], lines))
                return yb_error_set(error, "out of memory");
    return true;
}

/* A little from each draft. */
static void search_drafts(loop_t *loop)
{
    for (int i = 0; i < loop->drafts; i++) {
        yb_target_search_t search = search_of(loop, &loop->draft[i], (uint64_t)i + 1);
        search.hot = 60;
        search.cold = 15;
        improve(loop, &loop->draft[i], &search, scaled(loop, ON_EACH));
    }
    qsort(loop->draft, (size_t)loop->drafts, sizeof(draft_t), by_cost);
    for (int i = 0; i < BETTER; i++) {
        yb_target_search_t search = search_of(loop, &loop->draft[i], (uint64_t)i + 101);
        search.hot = 30;
        search.cold = 6;
        improve(loop, &loop->draft[i], &search, scaled(loop, ON_BETTER));
    }
    qsort(loop->draft, BETTER, sizeof(draft_t), by_cost);
}

/* Where K is dearer, the steps that the search must get over are higher. */
static void set_heat(yb_target_search_t *search, double hot, double cold)
{
    double height = sqrt(search->k_fine / first_k_fine);
    search->hot = hot * height;
    search->cold = cold * height;
}

/* All that is left on the best, in the end on what evaluate measures. */
static void search_best(loop_t *loop, draft_t *best)
{
    yb_target_search_t search = search_of(loop, best, 1001);
    fit_gain(loop, best, &search);
    search.k_fine *= best->score.k < loop->k ? dearer : 1;
    /* Land that such lines cannot hold is not held to what a single mountain allows. */
    search.most_off = best->score.off > far_off ? best->score.off : YB_TARGET_MOST_OFF;
    set_heat(&search, 20, 3);
    improve(loop, best, &search, scaled(loop, ON_BEST));
    search.most_off = fmax(1.05 * best->score.off, YB_TARGET_MOST_OFF);
    search.longest_q8 = YB_REFERENCE_Q8;
    search.kept = &loop->kept;
    for (int round = 0; round < MOST_ROUNDS && loop->kept.count == 0; round++) {
        fit_gain(loop, best, &search);
        search.k_fine *= best->score.k < loop->k ? dearer : 1;
        search.seed++;
        set_heat(&search, 12, 1);
        improve(loop, best, &search, scaled(loop, ON_FINE));
    }
}

static bool run_search(loop_t *loop, yb_error_t *error)
{
    if (!make_drafts(loop, error))
        return false;
    loop->trials = loop->drafts * scaled(loop, ON_EACH) + BETTER * scaled(loop, ON_BETTER) +
                   scaled(loop, ON_BEST) + scaled(loop, ON_FINE);
    search_drafts(loop);
    if (loop->draft[0].score.cost == HUGE_VAL)
        return yb_error_set(error, "no draft of this relief makes a map");
    search_best(loop, &loop->draft[0]);
    return true;
}

/* K as evaluate says it; negative: impossible, or no memory. */
static double exact_k(const loop_t *loop, const yb_code_file_t *file)
{
    yb_error_t error;
    yb_comparison_t comparison;
    yb_fidelity_t fidelity;
    double k = -1;
    if (!yb_comparison_make(&comparison, file, loop->grid, loop->given, &error))
        return -1;
    if (yb_fidelity_measure(&fidelity, file, &comparison)) {
        k = fidelity.k;
        yb_fidelity_free(&fidelity);
    }
    yb_comparison_free(&comparison);
    return k;
}

static bool tell_failure(const loop_t *loop, yb_error_t *error)
{
    if (loop->kept.nearest_score.bytes == 0)
        return yb_error_set(error, "no code of this relief could be measured");
    yb_code_file_t *file = yb_contour_code_load(&loop->kept.nearest, error);
    if (file == NULL)
        return false;
    double k = exact_k(loop, file);
    yb_error_set(error,
                 "K %.2f was not reached: the best code found has K %.4f in %zu bytes; allow more "
                 "bytes by --bytes, or more trials by --effort",
                 loop->k, k, file->size);
    yb_code_file_free(file);
    return false;
}

/* The shortest of the kept codes whose K is what the search took it for. */
static bool finish(loop_t *loop, yb_encode_result_t *result, yb_error_t *error)
{
    for (int i = 0; i < loop->kept.count; i++) {
        yb_code_file_t *file = yb_contour_code_load(&loop->kept.set[i], error);
        if (file == NULL)
            return false;
        result->k = exact_k(loop, file);
        if (result->k >= loop->k && file->size <= loop->task->most_bytes) {
            result->code = file;
            result->rmse_m = yb_judge_map_rmse_m(&file->map, loop->grid);
            result->std_m = loop->grid->std_m;
            result->trials = loop->done;
            return !file->sections.certified ||
                   yb_certificate_fill(&result->code, loop->grid, loop->given, error);
        }
        yb_code_file_free(file);
    }
    return tell_failure(loop, error);
}

static void free_loop(loop_t *loop)
{
    for (int i = 0; i < loop->drafts; i++) {
        bool shared = false;
        for (int k = 0; k < i; k++)
            shared = shared || loop->draft[k].lines == loop->draft[i].lines;
        if (!shared)
            yb_line_judge_free(loop->draft[i].lines);
    }
    yb_judge_free(loop->judge);
    free(loop);
}

static bool run(const yb_grid_t *grid, const yb_lines_t *given, const yb_encode_task_t *task,
                double target_k, yb_encode_result_t *result, yb_error_t *error)
{
    memset(result, 0, sizeof(*result));
    if (!yb_encode_has_room(task, error))
        return false;
    if (given != NULL && (task->levels > 0 || task->interval_m > 0))
        return yb_error_set(error, "the similarity of lines is measured at their own heights: "
                                   "leave out --levels and --interval");
    loop_t *loop = calloc(1, sizeof(*loop));
    if (loop == NULL)
        return yb_error_set(error, "out of memory");
    loop->grid = grid;
    loop->given = given;
    loop->task = task;
    loop->k = target_k;
    loop->judge = yb_judge_new(grid, JUDGE_SIDE);
    bool good = loop->judge != NULL || yb_error_set(error, "out of memory");
    good = good && yb_levels_choose(&loop->levels, task, grid, given, error) &&
           yb_fractal_of_relief(grid, given, &result->fractal, error);
    loop->dimension = result->fractal.dimension;
    good = good && run_search(loop, error) && finish(loop, result, error);
    if (!good)
        yb_encode_result_free(result);
    free_loop(loop);
    return good;
}

bool yb_target_grid(const yb_grid_t *grid, const yb_encode_task_t *task, double target_k,
                    yb_encode_result_t *result, yb_error_t *error)
{
    return run(grid, NULL, task, target_k, result, error);
}

bool yb_target_lines(const yb_lines_t *lines, const yb_encode_task_t *task, double target_k,
                     yb_encode_result_t *result, yb_error_t *error)
{
    yb_grid_t *grid = yb_line_grid_new(lines, error);
    if (grid == NULL)
        return false;
    bool good = run(grid, lines, task, target_k, result, error);
    yb_grid_free(grid);
    return good;
}
