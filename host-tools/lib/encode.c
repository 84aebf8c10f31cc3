#include "encode.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "certificate.h"
#include "contour_code.h"
#include "judge.h"
#include "levels.h"
#include "line_grid.h"
#include "search.h"
#include "sketch.h"

enum {
    USUAL_TRIALS = 224000, /* at effort 5; each step is three times as many */
    FEW_BYTES = 40,        /* below that, corner heights cost too much to begin with */
    DRAFTS = 4,            /* one for each spacing of the lattice */
    FINALISTS = 2,
    MANY_BYTES = 150 /* from there on: one finalist, and several changes in one trial */
};

/* Tolerances of the drafts as shares of the frame's longer side. */
static const double tolerances[] = {0.01, 0.014, 0.02, 0.028, 0.04, 0.056, 0.08, 0.11, 0.16};
enum {
    TOLERANCES = sizeof(tolerances) / sizeof(tolerances[0])
};

/* So many levels drafts have when their heights are free. */
static const int level_counts[] = {1, 2, 3, 4, 5, 6, 8, 10, 13, 16};
enum {
    DRAFT_COUNTS = sizeof(level_counts) / sizeof(level_counts[0])
};

/* Temperatures of the search, as shares of the error. */
static const double hot = 0.0015;
static const double warm = 0.0008;
static const double cold = 0.0001;
/* Part of the trials spent on all drafts before the finalists are chosen. */
static const double first_part = 0.4;

typedef struct {
    yb_contour_set_t set;
    int spacing;
    double score_m; /* below 0: there is none */
} draft_t;

typedef struct {
    const yb_grid_t *grid;
    const yb_encode_task_t *task;
    const yb_lines_t *given; /* the input's own lines, or NULL */
    yb_judge_t *judge;
    yb_levels_t levels;
    draft_t draft[DRAFTS];
    int drafts;
    int side;     /* of the judges' samples */
    double begun; /* share of the work that is done */
} encoder_t;

/* Those who search at the same time. */
typedef struct {
    encoder_t *encoder;
    pthread_mutex_t lock;
    int next, count; /* of the drafts */
    yb_search_t pattern;
    yb_progress_t progress;
    bool failed;
} crew_t;

void yb_encode_result_free(yb_encode_result_t *result)
{
    yb_code_file_free(result->code);
    yb_fractal_free(&result->fractal);
    result->code = NULL;
}

/* Whether all levels are multiples of a height. */
static bool divides(const encoder_t *encoder, double height_m)
{
    for (int i = 0; i < encoder->levels.count; i++) {
        double multiple = encoder->levels.height_m[i] / height_m;
        if (fabs(multiple - round(multiple)) > 0.001 * fabs(multiple) + 1e-9)
            return false;
    }
    return true;
}

/* Unit and interval of the compact profile: where lines must lie at given levels, a part of the
 * least step between two of them if it fits all; else a part of the relief's deviation, the smaller
 * the longer the code: rounding must stay well below the error that is left.
 */
static void choose_unit(const encoder_t *encoder, yb_contour_set_t *set)
{
    const yb_grid_t *grid = encoder->grid;
    double step_m = encoder->levels.count > 0 ? encoder->levels.height_m[0] : 0;
    for (int i = 1; i < encoder->levels.count; i++)
        step_m = fmin(step_m, encoder->levels.height_m[i] - encoder->levels.height_m[i - 1]);
    uint16_t unit = yb_compact_unit(encoder->levels.count > 0
                                        ? (double)(grid->high_m - grid->low_m) / 256
                                        : 20 * grid->std_m / (double)encoder->task->most_bytes);
    int interval = 0;
    /* Powers of two first: lines then skip units that spot heights have. */
    static const int parts[] = {4, 2, 1, 8, 5, 3, 10, 6, 7, 20, 25, 9};
    for (size_t i = 0; i < sizeof(parts) / sizeof(parts[0]) && step_m > 0; i++) {
        uint16_t part = yb_compact_unit(step_m / parts[i]);
        if (fabs(yb_unit_m(part) * parts[i] / step_m - 1) > 1e-9 || !divides(encoder, step_m))
            continue;
        unit = part;
        interval = parts[i] <= 8 && (parts[i] & (parts[i] - 1)) == 0 ? (int)log2(parts[i]) : 0;
        break;
    }
    /* Well below the lowest height. */
    double range_m = (double)(grid->high_m - grid->low_m);
    yb_sketch_units(set, unit, interval, (double)grid->low_m - range_m);
}

static void begin_set(const encoder_t *encoder, yb_contour_set_t *set, int spacing)
{
    yb_sketch_task(set, encoder->grid, encoder->task, spacing);
    if (set->profile == YB_COMPACT)
        choose_unit(encoder, set);
    yb_sketch_corners(set, encoder->grid);
    set->corners = encoder->task->most_bytes >= FEW_BYTES ? 0xf : 0;
}

/* Keeps a draft if it is the best of its spacing. */
static void offer_draft(encoder_t *encoder, draft_t *draft, const yb_contour_set_t *set)
{
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    size_t size = yb_contour_code_write(set, code, encoder->task->most_bytes, NULL);
    double score = size > 0 ? yb_judge_score_m(encoder->judge, code, size) : -1;
    if (score < 0 || (draft->score_m >= 0 && draft->score_m <= score))
        return;
    draft->set = *set;
    draft->score_m = score;
}

/* Drafts of one set of lines, coarse and fine. */
static void draft_lines(encoder_t *encoder, const yb_lines_t *lines)
{
    double longest = fmax(lines->width_m, lines->depth_m);
    size_t bytes = encoder->task->most_bytes;
    for (int d = 0; d < encoder->drafts; d++)
        for (int i = 0; i < TOLERANCES; i++) {
            yb_contour_set_t set;
            begin_set(encoder, &set, encoder->draft[d].spacing);
            yb_sketch_spot(&set, lines, yb_sketch_summit(encoder->grid),
                           (double)encoder->grid->high_m, bytes);
            yb_sketch_lines(&set, lines, tolerances[i] * longest, bytes);
            offer_draft(encoder, &encoder->draft[d], &set);
        }
}

/* Spacings of the lattice: the more bytes, the finer. */
static void choose_spacings(encoder_t *encoder)
{
    static const struct {
        size_t least_bytes;
        int spacing[DRAFTS];
    } by_size[] = {{300, {3, 4, 5, 6}},
                   {MANY_BYTES, {4, 5, 6, 7}},
                   {75, {4, 5, 6, 8}},
                   {45, {5, 6, 8, 10}},
                   {0, {6, 8, 10, 13}}};
    static const int of_paper[] = {2, 4, 8};
    bool compact = encoder->task->profile == YB_COMPACT;
    int size = 0;
    while (encoder->task->most_bytes < by_size[size].least_bytes)
        size++;
    encoder->drafts = compact ? DRAFTS : 3;
    for (int i = 0; i < encoder->drafts; i++)
        encoder->draft[i] =
            (draft_t){.spacing = compact ? by_size[size].spacing[i] : of_paper[i], .score_m = -1};
}

static bool draft_levels(encoder_t *encoder, const double *level_m, int levels, yb_error_t *error)
{
    yb_lines_t *lines = yb_lines_from_grid(encoder->grid, level_m, levels, error);
    if (lines == NULL)
        return false;
    yb_sketch_sort(lines);
    draft_lines(encoder, lines);
    yb_lines_free(lines);
    return true;
}

static int better_first(const void *a, const void *b)
{
    const draft_t *first = a;
    const draft_t *second = b;
    if ((first->score_m < 0) != (second->score_m < 0))
        return first->score_m < 0 ? 1 : -1;
    if (first->score_m != second->score_m)
        return first->score_m < second->score_m ? -1 : 1;
    return first->spacing - second->spacing;
}

/* Best first; impossible ones are forgotten. */
static void sort_drafts(encoder_t *encoder)
{
    qsort(encoder->draft, (size_t)encoder->drafts, sizeof(draft_t), better_first);
    while (encoder->drafts > 0 && encoder->draft[encoder->drafts - 1].score_m < 0)
        encoder->drafts--;
}

static bool make_drafts(encoder_t *encoder, yb_error_t *error)
{
    choose_spacings(encoder);
    if (encoder->levels.count > 0 &&
        !draft_levels(encoder, encoder->levels.height_m, encoder->levels.count, error))
        return false;
    for (int i = 0; i < DRAFT_COUNTS && encoder->levels.count == 0; i++) {
        double level_m[YB_ENCODE_MOST_LEVELS];
        int levels = level_counts[i];
        for (int k = 0; k < levels; k++)
            level_m[k] = yb_sketch_quantile(encoder->grid, (k + 0.5) / levels);
        if (!draft_levels(encoder, level_m, levels, error))
            return false;
    }
    sort_drafts(encoder);
    if (encoder->drafts == 0)
        return yb_error_set(error, "no draft of this relief fits %zu bytes",
                            encoder->task->most_bytes);
    return true;
}

static void search_draft(const encoder_t *encoder, yb_judge_t *judge, draft_t *draft,
                         yb_search_t search)
{
    uint16_t level[YB_ENCODE_MOST_LEVELS];
    for (int i = 0; i < encoder->levels.count; i++)
        level[i] = yb_contour_set_line_height(&draft->set, encoder->levels.height_m[i]);
    search.grid = encoder->grid;
    search.judge = judge;
    search.most_bytes = encoder->task->most_bytes;
    search.many = search.most_bytes >= MANY_BYTES;
    search.level = level;
    search.levels = encoder->levels.count;
    draft->score_m = yb_search_run(&search, &draft->set);
}

/* Takes drafts from the encoder until all are searched. */
static void *work(void *context)
{
    crew_t *crew = context;
    encoder_t *encoder = crew->encoder;
    yb_judge_t *judge = yb_judge_new(encoder->grid, encoder->side);
    for (;;) {
        pthread_mutex_lock(&crew->lock);
        int next = crew->next++;
        pthread_mutex_unlock(&crew->lock);
        if (next >= crew->count)
            break;
        yb_search_t search = crew->pattern;
        search.seed += (uint64_t)next;
        search.progress = &crew->progress;
        if (judge != NULL)
            search_draft(encoder, judge, &encoder->draft[next], search);
        else
            crew->failed = true;
    }
    yb_judge_free(judge);
    return NULL;
}

/* Searches from the first `count` drafts, two at a time where there are processors. What comes out
 * depends on neither their number nor the clock: each search has its own random numbers.
 */
static bool search_drafts(encoder_t *encoder, int count, double from, double share)
{
    if (count < 1)
        return false;
    long trials = (long)(share * (double)yb_encode_trials(USUAL_TRIALS, encoder->task->effort));
    crew_t crew = {.encoder = encoder,
                   .count = count,
                   .pattern = {.trials = trials / count,
                               .hot = from,
                               .cold = cold,
                               .seed = from < hot ? 1 + DRAFTS : 1},
                   .progress = {.report = encoder->task->progress,
                                .context = encoder->task->context,
                                .begun = encoder->begun,
                                .part = share / count}};
    pthread_mutex_init(&crew.lock, NULL);
    crew.progress.lock = &crew.lock;
    pthread_t other;
    int threads = encoder->task->threads;
    bool two = (threads == 0 ? sysconf(_SC_NPROCESSORS_ONLN) > 1 : threads > 1) && count > 1 &&
               pthread_create(&other, NULL, work, &crew) == 0;
    work(&crew);
    if (two)
        pthread_join(other, NULL);
    pthread_mutex_destroy(&crew.lock);
    encoder->begun += share;
    sort_drafts(encoder);
    return !crew.failed;
}

/* A short search from each draft, long ones from what became the best. */
static bool search_best(encoder_t *encoder)
{
    if (!search_drafts(encoder, encoder->drafts, hot, first_part))
        return false;
    int finalists = encoder->task->most_bytes < MANY_BYTES ? FINALISTS : 1;
    if (encoder->drafts > finalists)
        encoder->drafts = finalists;
    return search_drafts(encoder, encoder->drafts, warm, 1 - first_part);
}

static bool encoder_run(encoder_t *encoder, yb_encode_result_t *result, yb_error_t *error)
{
    if (!yb_levels_choose(&encoder->levels, encoder->task, encoder->grid, encoder->given, error) ||
        !make_drafts(encoder, error) ||
        !yb_fractal_of_relief(encoder->grid, encoder->given, &result->fractal, error))
        return false;
    if (!search_best(encoder))
        return yb_error_set(error, "out of memory");
    draft_t *best = &encoder->draft[0];
    yb_fractal_dimension_of(&best->set, result->fractal.dimension);
    /* Lines say nothing of what lies between them: the noise stays as strong as they suggest. */
    if (encoder->given == NULL)
        yb_fractal_gain(&best->set, encoder->grid);
    result->code = yb_contour_code_load(&best->set, error);
    if (result->code == NULL)
        return false;
    result->rmse_m = yb_judge_map_rmse_m(&result->code->map, encoder->grid);
    result->std_m = encoder->grid->std_m;
    result->trials = yb_encode_trials(USUAL_TRIALS, encoder->task->effort);
    return true;
}

/* Samples on a side: the more points a code may have, the closer. */
static int judge_side(size_t bytes)
{
    return (int)fmin(fmax(48 * sqrt((double)bytes / 100), 40), 96);
}

static bool encode(const yb_grid_t *grid, const yb_lines_t *given, const yb_encode_task_t *task,
                   yb_encode_result_t *result, yb_error_t *error)
{
    memset(result, 0, sizeof(*result));
    if (!yb_encode_has_room(task, error))
        return false;
    encoder_t *encoder = calloc(1, sizeof(*encoder));
    if (encoder == NULL)
        return yb_error_set(error, "out of memory");
    encoder->grid = grid;
    encoder->task = task;
    encoder->given = given;
    encoder->side = judge_side(task->most_bytes - yb_sections_size(task->sections));
    encoder->judge = yb_judge_new(grid, encoder->side);
    bool good = encoder->judge != NULL;
    if (!good)
        yb_error_set(error, "out of memory");
    good = good && encoder_run(encoder, result, error);
    if (good && task->sections != NULL && task->sections->certified)
        good = yb_certificate_fill(&result->code, grid, given, error);
    if (!good)
        yb_encode_result_free(result);
    yb_judge_free(encoder->judge);
    free(encoder);
    return good;
}

bool yb_encode_grid(const yb_grid_t *grid, const yb_encode_task_t *task, yb_encode_result_t *result,
                    yb_error_t *error)
{
    return encode(grid, NULL, task, result, error);
}

bool yb_encode_lines(const yb_lines_t *lines, const yb_encode_task_t *task,
                     yb_encode_result_t *result, yb_error_t *error)
{
    yb_grid_t *grid = yb_line_grid_new(lines, error);
    if (grid == NULL)
        return false;
    bool good = encode(grid, lines, task, result, error);
    yb_grid_free(grid);
    return good;
}
