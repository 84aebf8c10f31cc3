#include "judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a difference of rise from one sample to the next counts against one of height: enough to
 * keep the search from hiding cliffs where few samples see them.
 */
static const double slope_weight = 0.5;

enum {
    REFINE_Q8 = 16 * 256,
    MOST_SIDE = 256
};

/* Samples along one side of the frame. */
typedef struct {
    int count;
    int size; /* of the frame in steps, for which the rest holds; 0: none yet */
    int at_q8[MOST_SIDE];
    int from[MOST_SIDE];
} axis_t;

struct yb_judge {
    double width_m, depth_m;
    axis_t across, up;
    float *truth_m; /* row 0 is the southernmost */
    float *found_m;
    float metres_per_q8;
    float base_m;
    yb_map_t map;
    yb_load_t load;
};

yb_judge_t *yb_judge_new(const yb_grid_t *grid, int side)
{
    yb_judge_t *judge = calloc(1, sizeof(*judge));
    if (judge == NULL)
        return NULL;
    judge->width_m = yb_grid_width_m(grid);
    judge->depth_m = yb_grid_depth_m(grid);
    double longest = fmax(judge->width_m, judge->depth_m);
    judge->across.count = 1 + (int)ceil((side - 1) * judge->width_m / longest);
    judge->up.count = 1 + (int)ceil((side - 1) * judge->depth_m / longest);
    size_t samples = (size_t)judge->across.count * (size_t)judge->up.count;
    judge->truth_m = malloc(samples * sizeof(float));
    judge->found_m = malloc(samples * sizeof(float));
    if (judge->truth_m == NULL || judge->found_m == NULL) {
        yb_judge_free(judge);
        return NULL;
    }
    for (int row = 0; row < judge->up.count; row++)
        for (int column = 0; column < judge->across.count; column++)
            judge->truth_m[row * judge->across.count + column] =
                (float)yb_grid_height(grid, column * judge->width_m / (judge->across.count - 1),
                                      row * judge->depth_m / (judge->up.count - 1));
    return judge;
}

void yb_judge_free(yb_judge_t *judge)
{
    if (judge == NULL)
        return;
    free(judge->truth_m);
    free(judge->found_m);
    free(judge);
}

static int least(int a, int b, int c)
{
    int low = a < b ? a : b;
    return low < c ? low : c;
}

static int greatest(int a, int b, int c)
{
    int high = a > b ? a : b;
    return high > c ? high : c;
}

/* Where the samples of one axis lie on a frame of `size` steps, and for each step the first sample
 * at it or beyond.
 */
static void lay_axis(axis_t *axis, int size)
{
    if (axis->size == size)
        return;
    axis->size = size;
    int sample = 0;
    for (int i = 0; i < axis->count; i++)
        axis->at_q8[i] = i * size * 256 / (axis->count - 1);
    for (int step = 0; step <= size; step++) {
        while (axis->at_q8[sample] < step * 256)
            sample++;
        axis->from[step] = sample;
    }
}

/* Writes the heights of a small triangle at the samples in it, borders included. No edge is longer
 * than 16 steps, so that products of differences stay below 2^26.
 */
static void sample_triangle(void *context, const yb_vertex_t *a, const yb_vertex_t *b,
                            const yb_vertex_t *c)
{
    yb_judge_t *judge = context;
    const axis_t *across = &judge->across;
    const axis_t *up = &judge->up;
    int east = greatest(a->x_q8, b->x_q8, c->x_q8);
    int north = greatest(a->y_q8, b->y_q8, c->y_q8);
    int first = across->from[least(a->x_q8, b->x_q8, c->x_q8) >> 8];
    int row = up->from[least(a->y_q8, b->y_q8, c->y_q8) >> 8];
    if (first >= across->count || across->at_q8[first] > east)
        return;
    int bx = b->x_q8 - a->x_q8;
    int by = b->y_q8 - a->y_q8;
    int cx = c->x_q8 - a->x_q8;
    int cy = c->y_q8 - a->y_q8;
    int area = bx * cy - by * cx;
    if (area <= 0)
        return;
    for (; row < up->count && up->at_q8[row] <= north; row++) {
        int y = up->at_q8[row] - a->y_q8;
        for (int column = first; column < across->count && across->at_q8[column] <= east;
             column++) {
            int x = across->at_q8[column] - a->x_q8;
            int of_b = x * cy - y * cx;
            int of_c = bx * y - by * x;
            if (of_b < 0 || of_c < 0 || of_b + of_c > area)
                continue;
            float z_q8 = (float)a->z_q8 + ((float)of_b * (float)(b->z_q8 - a->z_q8) +
                                           (float)of_c * (float)(c->z_q8 - a->z_q8)) /
                                              (float)area;
            judge->found_m[row * across->count + column] =
                judge->base_m + z_q8 * judge->metres_per_q8;
        }
    }
}

double yb_judge_score_m(yb_judge_t *judge, const yb_paper_t *paper)
{
    uint8_t code[YB_MAX_CODE_BYTES];
    size_t size = yb_paper_write(paper, code);
    if (size == 0 || yb_map_load(&judge->map, &judge->load, code, size) != YB_OK)
        return -1;
    judge->map.detail = false;
    judge->metres_per_q8 = (float)(yb_paper_metres(paper->cell) / 256);
    judge->base_m = paper->base_m;
    lay_axis(&judge->across, paper->east);
    lay_axis(&judge->up, paper->north);
    for (yb_triangle_t i = 0; i < judge->map.triangle_count; i++)
        yb_map_refine(&judge->map, i, REFINE_Q8, sample_triangle, judge);
    int columns = judge->across.count;
    int samples = columns * judge->up.count;
    for (int i = 0; i < samples; i++)
        judge->found_m[i] -= judge->truth_m[i];
    const float *off = judge->found_m;
    double heights = 0;
    double slopes = 0;
    for (int i = 0; i < samples; i++) {
        float east = i % columns == columns - 1 ? 0 : off[i + 1] - off[i];
        float north = i + columns >= samples ? 0 : off[i + columns] - off[i];
        heights += (double)(off[i] * off[i]);
        slopes += (double)(east * east + north * north);
    }
    return sqrt((heights + slope_weight * slopes) / samples);
}

void yb_judge_worst(const yb_judge_t *judge, double share, double *east_m, double *north_m)
{
    double total = 0;
    int samples = judge->across.count * judge->up.count;
    for (int i = 0; i < samples; i++) {
        double off = (double)judge->found_m[i];
        total += off * off;
    }
    double until = share * total;
    int at = 0;
    for (double sum = 0; at < samples - 1; at++) {
        double off = (double)judge->found_m[at];
        sum += off * off;
        if (sum >= until)
            break;
    }
    int column = at % judge->across.count;
    int row = at / judge->across.count;
    *east_m = column * judge->width_m / (judge->across.count - 1);
    *north_m = row * judge->depth_m / (judge->up.count - 1);
}

double yb_judge_map_rmse_m(const yb_map_t *map, const yb_grid_t *grid)
{
    yb_map_t smooth = *map;
    smooth.detail = false;
    int columns = grid->columns < MOST_SIDE ? grid->columns : MOST_SIDE;
    int rows = grid->rows < MOST_SIDE ? grid->rows : MOST_SIDE;
    double metres_per_q8 = yb_paper_metres(map->cell) / 256;
    double sum = 0;
    for (int row = 0; row < rows; row++)
        for (int column = 0; column < columns; column++) {
            double east = (double)column / (columns - 1);
            double north = (double)row / (rows - 1);
            int32_t z_q8 = yb_map_height(&smooth, (uint16_t)lround(east * map->east_q8),
                                         (uint16_t)lround(north * map->north_q8));
            double off =
                map->base_m + z_q8 * metres_per_q8 -
                yb_grid_height(grid, east * yb_grid_width_m(grid), north * yb_grid_depth_m(grid));
            sum += off * off;
        }
    return sqrt(sum / ((double)columns * rows));
}
