#include "detailed_map.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "paper_code.h"

enum {
    STEPS = 255,
    GRAIN_Q8 = 16,                       /* the lattice of points */
    GRAINS = STEPS * 256 / GRAIN_Q8 + 1, /* along a side */
};

typedef struct {
    yb_map_t *map;
    yb_load_t *load;
    double q8_per_m;
    double base_m;
    uint8_t *taken; /* a bit per lattice place */
} builder_t;

static bool take(builder_t *builder, int x, int y)
{
    size_t bit = (size_t)(y / GRAIN_Q8) * GRAINS + (size_t)(x / GRAIN_Q8);
    uint8_t mask = (uint8_t)(1 << bit % 8);
    if ((builder->taken[bit / 8] & mask) != 0)
        return false;
    builder->taken[bit / 8] |= mask;
    return true;
}

/* The lattice place nearest to a place of the frame; strictly inside if `inside`. */
static int on_lattice(double m, double q8_per_m, int size_q8, bool inside)
{
    int at = (int)lround(m * q8_per_m / GRAIN_Q8) * GRAIN_Q8;
    int low = inside ? GRAIN_Q8 : 0;
    int high = inside ? size_q8 - GRAIN_Q8 : size_q8;
    return at < low ? low : at > high ? high : at;
}

/* Adds a line without the points whose places are taken; false if there is no room. */
static bool add_line(builder_t *builder, const yb_line_t *line)
{
    yb_map_t *map = builder->map;
    yb_load_t *load = builder->load;
    int first = load->point_count;
    bool open = !line->closed && line->count > 1;
    if (first + line->count > YB_MAX_VERTICES - 4 || load->contour_count == YB_MAX_CONTOURS)
        return false;
    for (int i = 0; i < line->count; i++) {
        bool end = open && (i == 0 || i == line->count - 1);
        int x = on_lattice(line->place[i].x_m, builder->q8_per_m, map->east_q8, !end);
        int y = on_lattice(line->place[i].y_m, builder->q8_per_m, map->north_q8, !end);
        if (!take(builder, x, y))
            continue;
        map->vertex[load->point_count++] = (yb_vertex_t){
            .x_q8 = (uint16_t)x,
            .y_q8 = (uint16_t)y,
            .z_q8 = (int32_t)lround((line->height_m - builder->base_m) * builder->q8_per_m)};
    }
    int count = load->point_count - first;
    if (count == 0 || (line->count > 1 && count < 3)) {
        load->point_count = (uint16_t)first; /* smaller than the lattice can say */
        return true;
    }
    load->contour[load->contour_count++] =
        (yb_contour_t){.first = (yb_index_t)first, .count = (yb_index_t)count};
    return true;
}

bool yb_detailed_map(const yb_lines_t *lines, yb_map_t *map, yb_load_t *load, yb_error_t *error)
{
    double longest_m = fmax(lines->width_m, lines->depth_m);
    double low_m = lines->line[0].height_m;
    for (int i = 1; i < lines->count; i++)
        low_m = fmin(low_m, lines->line[i].height_m);
    yb_map_begin(map, load);
    map->cell = yb_paper_unit(longest_m / STEPS);
    map->unit = yb_paper_unit(1);
    map->base_m = (int16_t)floor(low_m);
    map->smooth = true;
    map->detail = false;
    map->hurst_q8m1 = 255;
    builder_t builder = {.map = map,
                         .load = load,
                         .q8_per_m = 256 * STEPS / longest_m,
                         .base_m = map->base_m,
                         .taken = calloc((size_t)GRAINS * GRAINS / 8 + 1, 1)};
    map->east_q8 = (uint16_t)((int)lround(lines->width_m * builder.q8_per_m / 256) * 256);
    map->north_q8 = (uint16_t)((int)lround(lines->depth_m * builder.q8_per_m / 256) * 256);
    bool good = builder.taken != NULL;
    for (int i = 0; i < lines->count && good; i++)
        good = add_line(&builder, &lines->line[i]);
    free(builder.taken);
    if (!good)
        return yb_error_set(error, "the lines have more than %d points", YB_MAX_VERTICES - 4);
    switch (yb_map_build(map, load)) {
    case YB_OK:
        return true;
    case YB_ERR_LIMIT:
        return yb_error_set(error, "the mesh of the lines has more than %d points",
                            YB_MAX_VERTICES);
    default:
        return yb_error_set(error, "the lines cross or touch");
    }
}
