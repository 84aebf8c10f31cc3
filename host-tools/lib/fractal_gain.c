#include <math.h>
#include <stdlib.h>

#include "contour_code.h"
#include "fractal.h"
#include "roughness.h"
#include "surface.h"

/* Distances over which map and relief are to rise alike, in cells: there the noise does most. */
static const uint32_t lags[] = {1, 2, 4, 8};
enum {
    LAGS = sizeof(lags) / sizeof(lags[0]),
    MOST_GAIN = 255,
    FIRST_STEP = 32
};

/* Where the cells of a grid lie on a map's frame. */
typedef struct {
    const yb_grid_t *grid;
    uint16_t *x_q8, *y_q8;
    double real_m[LAGS];
} target_t;

static uint16_t *places(int count, int steps)
{
    uint16_t *at_q8 = malloc((size_t)count * sizeof(*at_q8));
    for (int i = 0; at_q8 != NULL && i < count; i++)
        at_q8[i] = (uint16_t)lround(256.0 * steps * i / (count - 1));
    return at_q8;
}

static void measure_rises(const yb_grid_t *grid, const float *z_m, double *rise_m)
{
    for (int i = 0; i < LAGS; i++)
        rise_m[i] =
            yb_roughness_rise_m(z_m, (uint32_t)grid->columns, (uint32_t)grid->rows, lags[i]);
}

typedef struct {
    const target_t *target;
    yb_contour_set_t *set;
    int best;
    double least; /* octaves that the map is off with it */
} search_t;

/* Keeps the gain if it is better. False: the code is impossible, or no memory. */
static bool try_gain(search_t *search, int gain)
{
    yb_error_t error;
    double rise_m[LAGS];
    const yb_grid_t *grid = search->target->grid;
    search->set->gain = (uint8_t)gain;
    yb_code_file_t *file = yb_contour_code_load(search->set, &error);
    if (file == NULL)
        return false;
    float *z_m = yb_map_heights_m(&file->map, search->target->x_q8, (uint32_t)grid->columns,
                                  search->target->y_q8, (uint32_t)grid->rows);
    yb_code_file_free(file);
    if (z_m == NULL)
        return false;
    measure_rises(grid, z_m, rise_m);
    free(z_m);
    const double octaves = yb_roughness_octaves(rise_m, search->target->real_m, LAGS);
    if (octaves < search->least) {
        search->least = octaves;
        search->best = gain;
    }
    return true;
}

/* Wide steps as long as they help, because rises grow with the gain; then ever shorter ones to both
 * sides of the best. Some fifteen maps are made.
 */
static bool search_gain(search_t *search)
{
    int gain = 0;
    bool good = true;
    for (; good && gain <= MOST_GAIN && search->best >= gain - FIRST_STEP; gain += FIRST_STEP)
        good = try_gain(search, gain);
    for (int step = FIRST_STEP / 2; good && step >= 1; step /= 2) {
        const int middle = search->best;
        good = middle < step || try_gain(search, middle - step);
        good = good && (middle + step > MOST_GAIN || try_gain(search, middle + step));
    }
    return good;
}

bool yb_fractal_gain(yb_contour_set_t *set, const yb_grid_t *grid)
{
    const uint8_t before = set->gain;
    target_t target = {.grid = grid,
                       .x_q8 = places(grid->columns, set->east),
                       .y_q8 = places(grid->rows, set->north)};
    measure_rises(grid, grid->height_m, target.real_m);
    search_t search = {.target = &target, .set = set, .least = HUGE_VAL};
    const bool good = target.x_q8 != NULL && target.y_q8 != NULL && search_gain(&search);
    set->gain = good ? (uint8_t)search.best : before;
    free(target.x_q8);
    free(target.y_q8);
    return good;
}
