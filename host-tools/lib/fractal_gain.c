#include "fractal.h"

/* The gain is measured between heights so many steps apart, on a grid of places. */
enum {
    GAIN_LAG = 6,
    GAIN_PLACES = 48,
    GAIN_ROUNDS = 8
};

/* Where the gain is measured: a place, and its neighbours GAIN_LAG steps to both sides. */
static double place_steps(int index, int size)
{
    return GAIN_LAG + (size - 2 * GAIN_LAG) * (index + 0.5) / GAIN_PLACES;
}

static double map_roughness_m2(const yb_map_t *map)
{
    int east = map->east_q8 >> 8;
    int north = map->north_q8 >> 8;
    double sum = 0;
    for (int row = 0; row < GAIN_PLACES; row++)
        for (int column = 0; column < GAIN_PLACES; column++) {
            int x = (int)(256 * place_steps(column, east));
            int y = (int)(256 * place_steps(row, north));
            double middle = yb_map_height(map, (uint16_t)x, (uint16_t)y);
            double bend_x = yb_map_height(map, (uint16_t)(x - GAIN_LAG * 256), (uint16_t)y) +
                            yb_map_height(map, (uint16_t)(x + GAIN_LAG * 256), (uint16_t)y) -
                            2 * middle;
            double bend_y = yb_map_height(map, (uint16_t)x, (uint16_t)(y - GAIN_LAG * 256)) +
                            yb_map_height(map, (uint16_t)x, (uint16_t)(y + GAIN_LAG * 256)) -
                            2 * middle;
            sum += bend_x * bend_x + bend_y * bend_y;
        }
    double metres = yb_paper_metres(map->cell) / 256;
    return sum * metres * metres;
}

static double grid_roughness_m2(const yb_grid_t *grid, const yb_paper_t *paper)
{
    double step_x = yb_grid_width_m(grid) / paper->east;
    double step_y = yb_grid_depth_m(grid) / paper->north;
    double sum = 0;
    for (int row = 0; row < GAIN_PLACES; row++)
        for (int column = 0; column < GAIN_PLACES; column++) {
            double x = place_steps(column, paper->east) * step_x;
            double y = place_steps(row, paper->north) * step_y;
            double lag_x = GAIN_LAG * step_x;
            double lag_y = GAIN_LAG * step_y;
            double middle = yb_grid_height(grid, x, y);
            double bend_x = yb_grid_height(grid, x - lag_x, y) +
                            yb_grid_height(grid, x + lag_x, y) - 2 * middle;
            double bend_y = yb_grid_height(grid, x, y - lag_y) +
                            yb_grid_height(grid, x, y + lag_y) - 2 * middle;
            sum += bend_x * bend_x + bend_y * bend_y;
        }
    return sum;
}

bool yb_fractal_gain(yb_paper_t *paper, const yb_grid_t *grid)
{
    yb_error_t error;
    double wanted = grid_roughness_m2(grid, paper);
    int low = 0; /* the gain lies in [low, high): roughness grows with it */
    int high = 256;
    if (paper->east <= 2 * GAIN_LAG || paper->north <= 2 * GAIN_LAG)
        return true;
    for (int round = 0; round < GAIN_ROUNDS && high - low > 1; round++) {
        int middle = (low + high) / 2;
        paper->gain = (uint8_t)middle;
        yb_code_file_t *file = yb_paper_check(paper, &error);
        if (file == NULL)
            return false;
        if (map_roughness_m2(&file->map) > wanted)
            high = middle;
        else
            low = middle;
        yb_code_file_free(file);
    }
    paper->gain = (uint8_t)low;
    return true;
}
