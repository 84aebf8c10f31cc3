#include "judge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sketch.h"

/* What a difference of rise from one sample to the next counts against one of height: enough to
 * keep the search from hiding cliffs where few samples see them.
 */
static const float slope_weight = 0.5F;
/* Share of the samples that the highest place counts as: it is what people look at first. */
static const double summit_weight = 0.01;

enum {
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
    float *found_m; /* the surface judged last; then how far it is off */
    float *kept_m;  /* the same of the one kept */
    float metres_per_q8;
    float base_m;
    double summit_east, summit_north; /* its place as shares of the frame */
    double summit_m;
    int summit_x_q8, summit_y_q8;
    float summit_found_m;
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
    judge->kept_m = malloc(samples * sizeof(float));
    if (judge->truth_m == NULL || judge->found_m == NULL || judge->kept_m == NULL) {
        yb_judge_free(judge);
        return NULL;
    }
    yb_place_t summit = yb_sketch_summit(grid);
    judge->summit_east = summit.x_m / judge->width_m;
    judge->summit_north = summit.y_m / judge->depth_m;
    judge->summit_m = (double)grid->high_m;
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
    free(judge->kept_m);
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

/* Bezier control point of an edge. */
static float middle_of(const yb_judge_t *judge, const yb_vertex_t *a, const yb_vertex_t *b)
{
    float middle = (float)(a->z_q8 + b->z_q8) / 2;
    if (!judge->map.smooth)
        return middle;
    /* Slopes in 1/2048, a quarter of their difference along the edge. */
    int64_t bulge = (int64_t)(a->gx_q11 - b->gx_q11) * (b->x_q8 - a->x_q8) +
                    (int64_t)(a->gy_q11 - b->gy_q11) * (b->y_q8 - a->y_q8);
    return middle + (float)bulge / (4 * 2048);
}

/* The smooth surface over a base triangle. It is one quadratic there: a Bezier triangle, whose
 * middle control points are the middles of the edges with twice the bulge that refinement gives
 * them.
 */
typedef struct {
    const yb_vertex_t *a, *b, *c;
    float ab, bc, ca; /* control points */
    int64_t area;     /* twice, in q16 */
    float whole;      /* one over it */
} patch_t;

/* Its height at a place, in q8. False: the place is not in the triangle, borders included. */
static bool height_at(const patch_t *patch, int x_q8, int y_q8, float *z_q8)
{
    const yb_vertex_t *a = patch->a;
    const yb_vertex_t *b = patch->b;
    const yb_vertex_t *c = patch->c;
    int x = x_q8 - a->x_q8;
    int y = y_q8 - a->y_q8;
    int64_t of_b = (int64_t)x * (c->y_q8 - a->y_q8) - (int64_t)y * (c->x_q8 - a->x_q8);
    int64_t of_c = (int64_t)y * (b->x_q8 - a->x_q8) - (int64_t)x * (b->y_q8 - a->y_q8);
    if (of_b < 0 || of_c < 0 || of_b + of_c > patch->area)
        return false;
    float v = (float)of_b * patch->whole;
    float w = (float)of_c * patch->whole;
    float u = 1 - v - w;
    *z_q8 = u * u * (float)a->z_q8 + v * v * (float)b->z_q8 + w * w * (float)c->z_q8 +
            2 * (u * v * patch->ab + v * w * patch->bc + w * u * patch->ca);
    return true;
}

/* Writes the heights over a base triangle at the samples in it, and at the summit. */
static void sample_triangle(yb_judge_t *judge, const yb_vertex_t *a, const yb_vertex_t *b,
                            const yb_vertex_t *c)
{
    const axis_t *across = &judge->across;
    const axis_t *up = &judge->up;
    int east = greatest(a->x_q8, b->x_q8, c->x_q8);
    int north = greatest(a->y_q8, b->y_q8, c->y_q8);
    int first = across->from[least(a->x_q8, b->x_q8, c->x_q8) >> 8];
    int64_t area = (int64_t)(b->x_q8 - a->x_q8) * (c->y_q8 - a->y_q8) -
                   (int64_t)(b->y_q8 - a->y_q8) * (c->x_q8 - a->x_q8);
    const patch_t patch = {.a = a,
                           .b = b,
                           .c = c,
                           .ab = middle_of(judge, a, b),
                           .bc = middle_of(judge, b, c),
                           .ca = middle_of(judge, c, a),
                           .area = area,
                           .whole = 1 / (float)area};
    float z_q8 = 0;
    for (int row = up->from[least(a->y_q8, b->y_q8, c->y_q8) >> 8];
         row < up->count && up->at_q8[row] <= north; row++) {
        for (int column = first; column < across->count && across->at_q8[column] <= east;
             column++) {
            if (height_at(&patch, across->at_q8[column], up->at_q8[row], &z_q8))
                judge->found_m[row * across->count + column] =
                    judge->base_m + z_q8 * judge->metres_per_q8;
        }
    }
    if (height_at(&patch, judge->summit_x_q8, judge->summit_y_q8, &z_q8))
        judge->summit_found_m = judge->base_m + z_q8 * judge->metres_per_q8;
}

/* What the differences at the samples add up to. Column by column, so that the compiler may take
 * several columns at once.
 */
static double sum_squares(const yb_judge_t *judge)
{
    int columns = judge->across.count;
    float sum[MOST_SIDE] = {0};
    for (int row = 0; row < judge->up.count; row++) {
        const float *off = &judge->found_m[row * columns];
        const float *north = row + 1 < judge->up.count ? off + columns : off;
        for (int i = 0; i < columns - 1; i++) {
            float east_rise = off[i + 1] - off[i];
            float north_rise = north[i] - off[i];
            sum[i] +=
                off[i] * off[i] + slope_weight * (east_rise * east_rise + north_rise * north_rise);
        }
        float rise = north[columns - 1] - off[columns - 1];
        sum[columns - 1] += off[columns - 1] * off[columns - 1] + slope_weight * rise * rise;
    }
    double all = 0;
    for (int i = 0; i < columns; i++)
        all += (double)sum[i];
    return all;
}

static int samples_of(const yb_judge_t *judge)
{
    return judge->across.count * judge->up.count;
}

double yb_judge_score_m(yb_judge_t *judge, const uint8_t *code, size_t size)
{
    if (yb_map_load(&judge->map, &judge->load, code, size) != YB_OK)
        return -1;
    judge->metres_per_q8 = (float)(yb_unit_m(judge->map.cell) / 256);
    judge->base_m = judge->map.base_m;
    judge->summit_x_q8 = (int)lround(judge->summit_east * judge->map.east_q8);
    judge->summit_y_q8 = (int)lround(judge->summit_north * judge->map.north_q8);
    lay_axis(&judge->across, judge->map.east_q8 >> 8);
    lay_axis(&judge->up, judge->map.north_q8 >> 8);
    const yb_vertex_t *vertex = judge->map.vertex;
    for (yb_triangle_t i = 0; i < judge->map.triangle_count; i++) {
        const yb_index_t *corner = judge->map.triangle[i];
        sample_triangle(judge, &vertex[corner[0]], &vertex[corner[1]], &vertex[corner[2]]);
    }
    int samples = samples_of(judge);
    for (int i = 0; i < samples; i++)
        judge->found_m[i] -= judge->truth_m[i];
    double summit = (double)judge->summit_found_m - judge->summit_m;
    return sqrt(sum_squares(judge) / samples + summit_weight * summit * summit);
}

void yb_judge_keep(yb_judge_t *judge)
{
    memcpy(judge->kept_m, judge->found_m, (size_t)samples_of(judge) * sizeof(float));
}

void yb_judge_worst(const yb_judge_t *judge, double share, double *east_m, double *north_m)
{
    double total = 0;
    int samples = samples_of(judge);
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

/* What the sample `at` adds to the sum of squares. */
static double square_at(const yb_judge_t *judge, const float *off, int column, int row)
{
    int at = row * judge->across.count + column;
    double here = (double)off[at];
    double east = column + 1 < judge->across.count ? (double)off[at + 1] - here : 0;
    double north = row + 1 < judge->up.count ? (double)off[at + judge->across.count] - here : 0;
    return here * here + (double)slope_weight * (east * east + north * north);
}

/* The change whose site is nearest. */
static int change_at(const yb_judge_site_t *site, int sites, double east, double north)
{
    int change = 0;
    double least = HUGE_VAL;
    for (int i = 0; i < sites; i++) {
        double x = site[i].east - east;
        double y = site[i].north - north;
        if (x * x + y * y < least) {
            least = x * x + y * y;
            change = site[i].change;
        }
    }
    return change;
}

void yb_judge_divide(const yb_judge_t *judge, const yb_judge_site_t *site, int sites, double *worse,
                     int changes)
{
    double total = 0;
    for (int i = 0; i < changes; i++)
        worse[i] = 0;
    for (int row = 0; row < judge->up.count; row++)
        for (int column = 0; column < judge->across.count; column++) {
            double before = square_at(judge, judge->kept_m, column, row);
            double after = square_at(judge, judge->found_m, column, row);
            total += before;
            if (after != before)
                worse[change_at(site, sites, (double)column / (judge->across.count - 1),
                                (double)row / (judge->up.count - 1))] += after - before;
        }
    /* The score is a root: half of the share by which the squares grow. */
    for (int i = 0; i < changes; i++)
        worse[i] /= 2 * total;
}

double yb_judge_map_rmse_m(const yb_map_t *map, const yb_grid_t *grid)
{
    yb_map_t smooth = *map;
    smooth.detail = false;
    int columns = grid->columns < MOST_SIDE ? grid->columns : MOST_SIDE;
    int rows = grid->rows < MOST_SIDE ? grid->rows : MOST_SIDE;
    double metres_per_q8 = yb_unit_m(map->cell) / 256;
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
