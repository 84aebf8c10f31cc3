#include "fractal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Box sizes and divider openings in cells, and how finely a line is walked for the boxes. */
static const double size_cells[] = {4, 6, 8, 12, 16, 24, 32};
enum {
    SIZES = sizeof(size_cells) / sizeof(size_cells[0])
};
static const double walk_cells = 0.25;

/* The gain is measured between heights so many steps apart, on a grid of places. */
enum {
    GAIN_LAG = 6,
    GAIN_PLACES = 48,
    GAIN_ROUNDS = 8
};

static double clamp_dimension(double dimension)
{
    return fmin(fmax(dimension, YB_FRACTAL_LEAST), YB_FRACTAL_MOST);
}

/* Slope of the line through the points by least squares. */
static double fit_slope(const double *x, const double *y, int count)
{
    double mean_x = 0;
    double mean_y = 0;
    for (int i = 0; i < count; i++) {
        mean_x += x[i] / count;
        mean_y += y[i] / count;
    }
    double squares = 0;
    double products = 0;
    for (int i = 0; i < count; i++) {
        squares += (x[i] - mean_x) * (x[i] - mean_x);
        products += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return squares > 0 ? products / squares : 0;
}

typedef struct {
    unsigned char *met;
    int columns, rows;
    double size_m;
} boxes_t;

static void mark_line(boxes_t *boxes, const yb_line_t *line, double walk_m)
{
    int segments = line->closed ? line->count : line->count - 1;
    for (int i = 0; i < segments; i++) {
        yb_place_t a = line->place[i];
        yb_place_t b = line->place[i + 1 == line->count ? 0 : i + 1];
        int parts = 1 + (int)(hypot(b.x_m - a.x_m, b.y_m - a.y_m) / walk_m);
        for (int part = 0; part < parts; part++) {
            double along = (double)part / parts;
            int column = (int)((a.x_m + along * (b.x_m - a.x_m)) / boxes->size_m);
            int row = (int)((a.y_m + along * (b.y_m - a.y_m)) / boxes->size_m);
            if (column >= 0 && row >= 0 && column < boxes->columns && row < boxes->rows)
                boxes->met[row * boxes->columns + column] = 1;
        }
    }
}

/* Boxes of one size that the lines meet, level by level (equal heights follow each other). */
static double count_boxes(const yb_lines_t *lines, boxes_t *boxes, double walk_m)
{
    double count = 0;
    size_t all = (size_t)boxes->columns * (size_t)boxes->rows;
    for (int i = 0; i < lines->count; i++) {
        if (i == 0 || lines->line[i].height_m != lines->line[i - 1].height_m)
            memset(boxes->met, 0, all);
        mark_line(boxes, &lines->line[i], walk_m);
        if (i + 1 == lines->count || lines->line[i + 1].height_m != lines->line[i].height_m)
            for (size_t k = 0; k < all; k++)
                count += boxes->met[k];
    }
    return count;
}

double yb_fractal_boxes(const yb_lines_t *lines, double cell_m)
{
    double log_size[SIZES];
    double log_count[SIZES];
    int used = 0;
    for (int i = 0; i < SIZES; i++) {
        boxes_t boxes = {.size_m = size_cells[i] * cell_m};
        boxes.columns = 1 + (int)(lines->width_m / boxes.size_m);
        boxes.rows = 1 + (int)(lines->depth_m / boxes.size_m);
        boxes.met = malloc((size_t)boxes.columns * (size_t)boxes.rows);
        if (boxes.met == NULL)
            break;
        double count = count_boxes(lines, &boxes, walk_cells * cell_m);
        free(boxes.met);
        if (count > 0) {
            log_size[used] = -log(size_cells[i]);
            log_count[used++] = log(count);
        }
    }
    return clamp_dimension(used > 1 ? fit_slope(log_size, log_count, used) : 0);
}

/* Steps of one length along the line until its end, the last part included. */
static double divider_steps(const yb_line_t *line, double step_m)
{
    double steps = 0;
    yb_place_t foot = line->place[0];
    int places = line->closed ? line->count + 1 : line->count;
    for (int i = 1; i < places; i++) {
        yb_place_t next = line->place[i % line->count];
        double away = hypot(next.x_m - foot.x_m, next.y_m - foot.y_m);
        while (away >= step_m) {
            foot.x_m += (next.x_m - foot.x_m) * step_m / away;
            foot.y_m += (next.y_m - foot.y_m) * step_m / away;
            away -= step_m;
            steps++;
        }
        if (i == places - 1)
            steps += away / step_m;
    }
    return steps;
}

double yb_fractal_divider(const yb_line_t *line, double cell_m)
{
    double log_size[SIZES];
    double log_steps[SIZES];
    int used = 0;
    for (int i = 0; i < SIZES && line->count > 1; i++) {
        double steps = divider_steps(line, size_cells[i] * cell_m);
        if (steps < 4)
            break; /* the line is too short for this opening and for all wider ones */
        log_size[used] = -log(size_cells[i]);
        log_steps[used++] = log(steps);
    }
    return clamp_dimension(used > 1 ? fit_slope(log_size, log_steps, used) : 0);
}

double yb_fractal_from_loop(double loop)
{
    return clamp_dimension(2 - (3 - 2 * loop));
}

uint8_t yb_fractal_coded(double dimension)
{
    return (uint8_t)lround(fmin(fmax(dimension - 1, 0) * 256, 255));
}

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
