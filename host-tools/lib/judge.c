#include "judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    REFINE_Q8 = 16 * 256,
    MOST_SIDE = 256
};

struct yb_judge {
    double width_m, depth_m;
    int columns, rows;
    float *truth_m; /* row 0 is the southernmost */
    float *found_m;
    double metres_per_q8;
    double base_m;
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
    judge->columns = 1 + (int)ceil((side - 1) * judge->width_m / longest);
    judge->rows = 1 + (int)ceil((side - 1) * judge->depth_m / longest);
    size_t samples = (size_t)judge->columns * (size_t)judge->rows;
    judge->truth_m = malloc(samples * sizeof(float));
    judge->found_m = malloc(samples * sizeof(float));
    if (judge->truth_m == NULL || judge->found_m == NULL) {
        yb_judge_free(judge);
        return NULL;
    }
    for (int row = 0; row < judge->rows; row++)
        for (int column = 0; column < judge->columns; column++)
            judge->truth_m[row * judge->columns + column] =
                (float)yb_grid_height(grid, column * judge->width_m / (judge->columns - 1),
                                      row * judge->depth_m / (judge->rows - 1));
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

/* Writes the heights of a small triangle at the samples in it, borders included. */
static void sample_triangle(void *context, const yb_vertex_t *a, const yb_vertex_t *b,
                            const yb_vertex_t *c)
{
    yb_judge_t *judge = context;
    int east = judge->map.east_q8;
    int north = judge->map.north_q8;
    int across = judge->columns - 1;
    int up = judge->rows - 1;
    /* First and last sample in the bounding box: sample k lies at k * size / steps, rounded down,
     * so that one just outside may be met too; the tests below keep it out. */
    int column_0 = least(a->x_q8, b->x_q8, c->x_q8) * across / east;
    int column_1 = (greatest(a->x_q8, b->x_q8, c->x_q8) + 1) * across / east;
    int row_0 = least(a->y_q8, b->y_q8, c->y_q8) * up / north;
    int row_1 = (greatest(a->y_q8, b->y_q8, c->y_q8) + 1) * up / north;
    column_1 = column_1 > across ? across : column_1;
    row_1 = row_1 > up ? up : row_1;
    int64_t area = (int64_t)(b->x_q8 - a->x_q8) * (c->y_q8 - a->y_q8) -
                   (int64_t)(b->y_q8 - a->y_q8) * (c->x_q8 - a->x_q8);
    if (area <= 0)
        return;
    for (int row = row_0; row <= row_1; row++)
        for (int column = column_0; column <= column_1; column++) {
            int x = column * east / across;
            int y = row * north / up;
            int64_t of_b = (int64_t)(x - a->x_q8) * (c->y_q8 - a->y_q8) -
                           (int64_t)(y - a->y_q8) * (c->x_q8 - a->x_q8);
            int64_t of_c = (int64_t)(b->x_q8 - a->x_q8) * (y - a->y_q8) -
                           (int64_t)(b->y_q8 - a->y_q8) * (x - a->x_q8);
            if (of_b < 0 || of_c < 0 || of_b + of_c > area)
                continue;
            double z_q8 = a->z_q8 + ((double)of_b * (b->z_q8 - a->z_q8) +
                                     (double)of_c * (c->z_q8 - a->z_q8)) /
                                        (double)area;
            judge->found_m[row * judge->columns + column] =
                (float)(judge->base_m + z_q8 * judge->metres_per_q8);
        }
}

double yb_judge_rmse_m(yb_judge_t *judge, const yb_paper_t *paper)
{
    uint8_t code[YB_MAX_CODE_BYTES];
    size_t size = yb_paper_write(paper, code);
    if (size == 0 || yb_map_load(&judge->map, &judge->load, code, size) != YB_OK)
        return -1;
    judge->map.detail = false;
    judge->metres_per_q8 = yb_paper_metres(paper->cell) / 256;
    judge->base_m = paper->base_m;
    for (uint16_t i = 0; i < judge->map.triangle_count; i++)
        yb_map_refine(&judge->map, i, REFINE_Q8, sample_triangle, judge);
    double sum = 0;
    int samples = judge->columns * judge->rows;
    for (int i = 0; i < samples; i++) {
        double off = (double)(judge->found_m[i] - judge->truth_m[i]);
        sum += off * off;
    }
    return sqrt(sum / samples);
}

void yb_judge_worst(const yb_judge_t *judge, double share, double *east_m, double *north_m)
{
    double total = 0;
    int samples = judge->columns * judge->rows;
    for (int i = 0; i < samples; i++) {
        double off = (double)(judge->found_m[i] - judge->truth_m[i]);
        total += off * off;
    }
    double until = share * total;
    int at = 0;
    for (double sum = 0; at < samples - 1; at++) {
        double off = (double)(judge->found_m[at] - judge->truth_m[at]);
        sum += off * off;
        if (sum >= until)
            break;
    }
    *east_m = at % judge->columns * judge->width_m / (judge->columns - 1);
    *north_m = at / judge->columns * judge->depth_m / (judge->rows - 1);
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
