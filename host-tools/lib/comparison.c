#include "comparison.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How much two frames may differ and still be one: a lattice has at most 255 steps, and a window
 * named by the user is cut at whole cells on both sides.
 */
static const double most_difference = 0.02;

static bool sizes_fit(const yb_comparison_t *comparison, const yb_grid_t *reference,
                      yb_error_t *error)
{
    const double wide = yb_grid_width_m(reference), deep = yb_grid_depth_m(reference);
    const double across = wide / comparison->east_m, up = deep / comparison->north_m;
    if (fabs(across / up - 1) > most_difference)
        return yb_error_set(error,
                            "the reference's window is %.0f m by %.0f m and the map %.0f m by "
                            "%.0f m: name the map's window by --window or --center and --km",
                            wide, deep, comparison->east_m, comparison->north_m);
    if (reference->placed && fabs(across - 1) > most_difference)
        return yb_error_set(error,
                            "the reference's window is %.0f m wide and the map %.0f m: name the "
                            "map's window by --window or --center and --km",
                            wide, comparison->east_m);
    return true;
}

/* Heights of the map at the real relief's cells, on the nearest 1/256 step. */
static float *map_heights(const yb_comparison_t *comparison, const yb_map_t *map)
{
    const uint32_t columns = comparison->columns, rows = comparison->rows;
    uint16_t *x_q8 = malloc(columns * sizeof(*x_q8));
    uint16_t *y_q8 = malloc(rows * sizeof(*y_q8));
    float *z_m = NULL;
    if (x_q8 != NULL && y_q8 != NULL) {
        for (uint32_t i = 0; i < columns; i++)
            x_q8[i] = (uint16_t)lround((double)map->east_q8 * i / (columns - 1));
        for (uint32_t j = 0; j < rows; j++)
            y_q8[j] = (uint16_t)lround((double)map->north_q8 * j / (rows - 1));
        z_m = yb_map_heights_m(map, x_q8, columns, y_q8, rows);
    }
    free(x_q8);
    free(y_q8);
    return z_m;
}

static bool sample_heights(yb_comparison_t *comparison, const yb_code_file_t *file,
                           const yb_grid_t *reference)
{
    const size_t columns = comparison->columns, rows = comparison->rows;
    comparison->reference_m = malloc(columns * rows * sizeof(float));
    if (comparison->reference_m == NULL)
        return false;
    for (size_t j = 0; j < rows; j++)
        memcpy(comparison->reference_m + j * columns,
               reference->height_m + (rows - 1 - j) * columns, columns * sizeof(float));
    yb_map_t smooth = file->map;
    smooth.detail = false;
    comparison->smooth_m = map_heights(comparison, &smooth);
    comparison->detail_m = map_heights(comparison, &file->map);
    return comparison->smooth_m != NULL && comparison->detail_m != NULL;
}

static bool add_polygon(yb_isolines_t *coded, const yb_map_t *map, const yb_contour_t *contour)
{
    const double step_m = yb_map_cell_m(map) / 256;
    yb_isoline_t line = {.count = contour->count,
                         .closed = !yb_contour_is_open(map, contour),
                         .height_m = yb_map_z_m(map, map->vertex[contour->first].z_q8),
                         .point = malloc(contour->count * sizeof(yb_point2_t))};
    if (line.point == NULL)
        return false;
    for (size_t i = 0; i < line.count; i++) {
        const yb_vertex_t *vertex = &map->vertex[contour->first + i];
        line.point[i] = (yb_point2_t){vertex->x_q8 * step_m, vertex->y_q8 * step_m};
    }
    coded->line[coded->count++] = line;
    return true;
}

static bool take_polygons(yb_comparison_t *comparison, const yb_code_file_t *file)
{
    const yb_load_t *load = &file->load;
    comparison->coded.line = calloc((size_t)load->contour_count + 1, sizeof(yb_isoline_t));
    if (comparison->coded.line == NULL)
        return false;
    for (uint16_t i = 0; i < load->contour_count; i++) {
        if (load->contour[i].count > 1 &&
            !add_polygon(&comparison->coded, &file->map, &load->contour[i]))
            return false;
    }
    return true;
}

/* Isolines of a mesh at every coded height, each height once. */
static bool cut_mesh(yb_isolines_t *lines, const yb_mesh_t *mesh, const yb_isolines_t *coded)
{
    for (size_t i = 0; i < coded->count; i++) {
        const double height_m = coded->line[i].height_m;
        if (yb_isolines_at(lines, height_m).count == 0 && !yb_isolines_add(lines, mesh, height_m))
            return false;
    }
    return true;
}

/* One given line, scaled to the map's frame, as an isoline of a coded height. */
static bool take_line(yb_isoline_t *original, const yb_comparison_t *comparison,
                      const yb_lines_t *lines, const yb_line_t *line, double height_m)
{
    const size_t count = (size_t)line->count;
    *original = (yb_isoline_t){.count = count,
                               .closed = line->closed,
                               .height_m = height_m,
                               .point = malloc(count * sizeof(yb_point2_t))};
    for (size_t i = 0; original->point != NULL && i < count; i++)
        original->point[i] =
            (yb_point2_t){line->place[i].x_m / lines->width_m * comparison->east_m,
                          line->place[i].y_m / lines->depth_m * comparison->north_m};
    return original->point != NULL;
}

/* Of every coded height the given lines that lie nearer to it than what the code can tell apart. */
static bool take_lines(yb_comparison_t *comparison, const yb_lines_t *lines, const yb_map_t *map)
{
    const double near_m = yb_unit_64th_m(map->unit) / 128.0 + yb_map_cell_m(map) / 256;
    const size_t most = comparison->coded.count * (size_t)lines->count;
    yb_isolines_t *original = &comparison->original;
    original->line = calloc(most + 1, sizeof(*original->line));
    bool good = original->line != NULL;
    for (size_t i = 0; good && i < comparison->coded.count; i++) {
        const double height_m = comparison->coded.line[i].height_m;
        if (yb_isolines_at(original, height_m).count != 0)
            continue;
        for (int k = 0; good && k < lines->count; k++) {
            const yb_line_t *line = &lines->line[k];
            if (line->count < 2 || fabs(line->height_m - height_m) > near_m)
                continue;
            good = take_line(&original->line[original->count], comparison, lines, line, height_m);
            original->count += good;
        }
    }
    return good;
}

bool yb_comparison_make(yb_comparison_t *comparison, const yb_code_file_t *file,
                        const yb_grid_t *reference, const yb_lines_t *lines, yb_error_t *error)
{
    const yb_map_t *map = &file->map;
    *comparison = (yb_comparison_t){.columns = (uint32_t)reference->columns,
                                    .rows = (uint32_t)reference->rows,
                                    .east_m = yb_map_east_m(map),
                                    .north_m = yb_map_north_m(map)};
    if (!sizes_fit(comparison, reference, error))
        return false;
    if (sample_heights(comparison, file, reference) &&
        yb_mesh_from_lattice(&comparison->reference, comparison->reference_m, comparison->columns,
                             comparison->rows, comparison->east_m, comparison->north_m) &&
        yb_mesh_from_map(&comparison->surface, map, YB_REFERENCE_Q8) &&
        take_polygons(comparison, file) &&
        (lines != NULL
             ? take_lines(comparison, lines, map)
             : cut_mesh(&comparison->original, &comparison->reference, &comparison->coded)) &&
        cut_mesh(&comparison->reproduced, &comparison->surface, &comparison->coded))
        return true;
    yb_comparison_free(comparison);
    return yb_error_set(error, "not enough memory to compare the map with the reference");
}

void yb_comparison_free(yb_comparison_t *comparison)
{
    free(comparison->reference_m);
    free(comparison->smooth_m);
    free(comparison->detail_m);
    yb_mesh_free(&comparison->reference);
    yb_mesh_free(&comparison->surface);
    yb_isolines_free(&comparison->coded);
    yb_isolines_free(&comparison->original);
    yb_isolines_free(&comparison->reproduced);
    *comparison = (yb_comparison_t){0};
}
