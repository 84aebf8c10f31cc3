#include "encode.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "certificate.h"
#include "fractal.h"
#include "compact_code.h"
#include "judge.h"
#include "line_grid.h"
#include "search.h"
#include "sketch.h"

enum {
    JUDGE_SIDE = 48,
    DRAFTS = 3,          /* kept of all that are tried */
    FREE_LEVELS = 6,     /* drafts have 1 to so many levels when their heights are free */
    MEASURED_LEVELS = 9, /* for the fractal dimension */
    BASE_TRIALS = 8000,  /* at effort 1 */
    FEW_BYTES = 40       /* below that, corner heights cost too much to begin with */
};

/* Tolerances of the drafts as shares of the frame's longer side. */
static const double tolerances[] = {0.01, 0.014, 0.02, 0.028, 0.04, 0.056, 0.08, 0.11, 0.16};
enum {
    TOLERANCES = sizeof(tolerances) / sizeof(tolerances[0])
};

/* Temperatures of the search, as shares of the relief's standard deviation. */
static const double hot = 0.02;
static const double cold = 0.0005;
/* Part of the trials spent on all drafts before the best is chosen. */
static const double first_part = 0.3;

typedef struct {
    yb_paper_t paper;
    double score_m;
} draft_t;

typedef struct {
    const yb_grid_t *grid;
    const yb_encode_task_t *task;
    const yb_lines_t *given; /* the input's own lines, or NULL */
    yb_judge_t *judge;
    double level_m[YB_ENCODE_MOST_LEVELS]; /* where lines must lie; none: anywhere */
    int levels;
    draft_t draft[DRAFTS]; /* the best so far, best first */
    int drafts;
    double begun, part; /* of the progress */
} encoder_t;

static bool choose_levels(encoder_t *encoder, yb_error_t *error)
{
    const yb_encode_task_t *task = encoder->task;
    double low = (double)encoder->grid->low_m;
    double range = (double)(encoder->grid->high_m - encoder->grid->low_m);
    if (task->levels > 0) {
        encoder->levels = task->levels;
        for (int i = 0; i < task->levels; i++)
            encoder->level_m[i] = low + range * (i + 1) / (task->levels + 1);
    } else if (task->interval_m > 0) {
        double first = floor(low / task->interval_m) + 1;
        double last = ceil((double)encoder->grid->high_m / task->interval_m) - 1;
        if (last < first)
            return yb_error_set(error,
                                "no multiple of %g m lies between the lowest height, %.6g m, and "
                                "the highest, %.6g m: choose a smaller interval",
                                task->interval_m, low, low + range);
        if (last - first >= YB_ENCODE_MOST_LEVELS)
            return yb_error_set(error,
                                "an interval of %g m makes more than %d levels between %.6g m and "
                                "%.6g m: choose a larger one",
                                task->interval_m, YB_ENCODE_MOST_LEVELS, low, low + range);
        while (first + encoder->levels <= last) {
            encoder->level_m[encoder->levels] = (first + encoder->levels) * task->interval_m;
            encoder->levels++;
        }
    } else if (encoder->given != NULL) {
        encoder->levels =
            yb_line_grid_levels(encoder->given, encoder->level_m, YB_ENCODE_MOST_LEVELS);
    }
    return true;
}

static void begin_paper(const encoder_t *encoder, yb_paper_t *paper, int spacing)
{
    const yb_grid_t *grid = encoder->grid;
    double width = yb_grid_width_m(grid);
    double depth = yb_grid_depth_m(grid);
    yb_sketch_begin(paper, width, depth, (double)grid->low_m, (double)grid->high_m, spacing);
    paper->seed = encoder->task->seed;
    paper->profile = encoder->task->profile;
    paper->sections = encoder->task->sections;
    if (paper->profile == YB_COMPACT) {
        const char *e = getenv("YB_UNIT");
        paper->cell = yb_compact_cell(fmax(width / paper->east, depth / paper->north));
        paper->unit = yb_compact_unit(grid->std_m / (e ? atof(e) : 5));
        paper->base = (int)floor((double)grid->low_m / yb_paper_metres(paper->unit)) - 20;
        paper->vertex_class = 7;
    }
    const double corner[YB_CORNERS][2] = {{0, 0}, {width, 0}, {width, depth}, {0, depth}};
    double sum = 0;
    for (int i = 0; i < YB_CORNERS; i++) {
        double height = yb_grid_height(grid, corner[i][0], corner[i][1]);
        paper->corner[i] = yb_paper_height(paper, height);
        sum += height;
    }
    paper->frame = yb_paper_height(paper, sum / YB_CORNERS);
    paper->corners = encoder->task->most_bytes >= FEW_BYTES ? 0xf : 0;
}

/* Keeps a draft if it is among the best. */
static void offer_draft(encoder_t *encoder, const yb_paper_t *paper)
{
    uint8_t code[YB_PAPER_MOST_BYTES];
    size_t size = yb_paper_code(paper, code, encoder->task->most_bytes, NULL);
    double rmse = size > 0 ? yb_judge_score_m(encoder->judge, code, size) : -1;
    if (rmse < 0)
        return;
    int at = encoder->drafts;
    while (at > 0 && encoder->draft[at - 1].score_m > rmse)
        at--;
    if (at >= DRAFTS)
        return;
    if (encoder->drafts < DRAFTS)
        encoder->drafts++;
    memmove(&encoder->draft[at + 1], &encoder->draft[at],
            (size_t)(encoder->drafts - 1 - at) * sizeof(draft_t));
    encoder->draft[at].paper = *paper;
    encoder->draft[at].score_m = rmse;
}

/* Drafts of one set of lines, coarse and fine. */
static void draft_lines(encoder_t *encoder, const yb_lines_t *lines)
{
    double longest = fmax(lines->width_m, lines->depth_m);
    size_t bytes = encoder->task->most_bytes;
    const char *g = getenv("YB_SPACING");
    for (int spacing = g ? atoi(g) : 2; spacing <= (g ? atoi(g) : 8); spacing *= 2)
        for (int i = 0; i < TOLERANCES; i++) {
            yb_paper_t paper;
            begin_paper(encoder, &paper, spacing);
            yb_sketch_spot(&paper, lines, yb_sketch_summit(encoder->grid),
                           (double)encoder->grid->high_m, bytes);
            yb_sketch_lines(&paper, lines, tolerances[i] * longest, bytes);
            offer_draft(encoder, &paper);
        }
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

static bool make_drafts(encoder_t *encoder, yb_error_t *error)
{
    if (encoder->levels > 0 && !draft_levels(encoder, encoder->level_m, encoder->levels, error))
        return false;
    for (int levels = 1; levels <= FREE_LEVELS && encoder->levels == 0; levels++) {
        double level_m[FREE_LEVELS];
        for (int i = 0; i < levels; i++)
            level_m[i] = yb_sketch_quantile(encoder->grid, (i + 0.5) / levels);
        if (!draft_levels(encoder, level_m, levels, error))
            return false;
    }
    if (encoder->drafts == 0)
        return yb_error_set(error, "no draft of this relief fits %zu bytes",
                            encoder->task->most_bytes);
    return true;
}

static void report(void *context, double share)
{
    const encoder_t *encoder = context;
    if (encoder->task->progress != NULL)
        encoder->task->progress(encoder->task->context, encoder->begun + encoder->part * share);
}

static void better_draft(encoder_t *encoder, draft_t *draft, long trials, double begun, double part)
{
    uint16_t level[YB_ENCODE_MOST_LEVELS];
    for (int i = 0; i < encoder->levels; i++)
        level[i] = yb_paper_height(&draft->paper, encoder->level_m[i]);
    encoder->begun = begun;
    encoder->part = part;
    yb_search_t search = {.grid = encoder->grid,
                          .judge = encoder->judge,
                          .most_bytes = encoder->task->most_bytes,
                          .pinned = getenv("YB_NOPIN") == NULL && draft->paper.contour_count > 0 ? 1 : 0,
                          .level = level,
                          .levels = encoder->levels,
                          .trials = trials,
                          .hot = hot,
                          .cold = cold,
                          .seed = 1,
                          .progress = report,
                          .context = encoder};
    draft->score_m = yb_search_run(&search, &draft->paper);
}

/* A short search from each draft, a long one from what became the best. */
static draft_t *search_best(encoder_t *encoder, long trials)
{
    draft_t *best = &encoder->draft[0];
    for (int i = 0; i < encoder->drafts; i++) {
        double part = first_part / encoder->drafts;
        better_draft(encoder, &encoder->draft[i], (long)(part * (double)trials), i * part, part);
        if (encoder->draft[i].score_m < best->score_m)
            best = &encoder->draft[i];
    }
    better_draft(encoder, best, (long)((1 - first_part) * (double)trials), first_part,
                 1 - first_part);
    return best;
}

/* Dimension of the relief's contour lines in full detail. */
static bool measure_dimension(const encoder_t *encoder, double *dimension, yb_error_t *error)
{
    if (encoder->given != NULL) {
        *dimension = yb_fractal_boxes(encoder->given, encoder->grid->cell_m);
        return true;
    }
    double level_m[MEASURED_LEVELS];
    for (int i = 0; i < MEASURED_LEVELS; i++)
        level_m[i] = yb_sketch_quantile(encoder->grid, (i + 1.0) / (MEASURED_LEVELS + 1));
    yb_lines_t *lines = yb_lines_from_grid(encoder->grid, level_m, MEASURED_LEVELS, error);
    if (lines == NULL)
        return false;
    *dimension = yb_fractal_boxes(lines, encoder->grid->cell_m);
    yb_lines_free(lines);
    return true;
}

static bool encoder_run(encoder_t *encoder, yb_encode_result_t *result, yb_error_t *error)
{
    long trials = (long)BASE_TRIALS << (encoder->task->effort - 1);
    if (!choose_levels(encoder, error) || !make_drafts(encoder, error) ||
        !measure_dimension(encoder, &result->dimension, error))
        return false;
    draft_t *best = search_best(encoder, trials);
    best->paper.dimension = yb_fractal_coded(result->dimension);
    if (best->paper.profile == YB_COMPACT)
        best->paper.dimension = yb_compact_dimension(best->paper.dimension);
    /* Lines say nothing of what lies between them: the noise stays as strong as they suggest. */
    if (encoder->given == NULL)
        yb_fractal_gain(&best->paper, encoder->grid);
    result->code = yb_paper_check(&best->paper, error);
    if (result->code == NULL)
        return false;
    result->rmse_m = yb_judge_map_rmse_m(&result->code->map, encoder->grid);
    result->std_m = encoder->grid->std_m;
    result->trials = trials;
    return true;
}

static bool encode(const yb_grid_t *grid, const yb_lines_t *given, const yb_encode_task_t *task,
                   yb_encode_result_t *result, yb_error_t *error)
{
    memset(result, 0, sizeof(*result));
    size_t sections = yb_sections_size(task->sections);
    if (task->most_bytes < YB_ENCODE_LEAST_BYTES + sections)
        return yb_error_set(error, "%zu bytes are too few for a map%s: the least is %zu",
                            task->most_bytes,
                            sections > 0 ? " with the name, place or certificate asked for" : "",
                            YB_ENCODE_LEAST_BYTES + sections);
    encoder_t *encoder = calloc(1, sizeof(*encoder));
    if (encoder == NULL)
        return yb_error_set(error, "out of memory");
    encoder->grid = grid;
    encoder->task = task;
    encoder->given = given;
    encoder->judge = yb_judge_new(grid, JUDGE_SIDE);
    bool good = encoder->judge != NULL;
    if (!good)
        yb_error_set(error, "out of memory");
    good = good && encoder_run(encoder, result, error);
    if (good && task->sections != NULL && task->sections->certified)
        good = yb_certificate_fill(&result->code, grid, given, error);
    if (!good)
        yb_code_file_free(result->code);
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
