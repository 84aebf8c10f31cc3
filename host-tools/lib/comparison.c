#include "comparison.h"

#include <math.h>
#include <stdlib.h>

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

static bool sample_heights(yb_comparison_t *comparison, const yb_code_file_t *file,
                           const yb_grid_t *reference)
{
    const size_t cells = (size_t)comparison->columns * comparison->rows;
    comparison->reference_m = malloc(cells * sizeof(float));
    if (comparison->reference_m == NULL)
        return false;
    const double wide = yb_grid_width_m(reference), deep = yb_grid_depth_m(reference);
    for (uint32_t j = 0; j < comparison->rows; j++) {
        for (uint32_t i = 0; i < comparison->columns; i++) {
            const double x = wide * i / (comparison->columns - 1);
            const double y = deep * j / (comparison->rows - 1);
            comparison->reference_m[(size_t)j * comparison->columns + i] =
                (float)yb_grid_height(reference, x, y);
        }
    }
    const uint32_t longer =
        comparison->columns > comparison->rows ? comparison->columns : comparison->rows;
    const yb_raster_t raster = yb_raster_on_map(&file->map, longer);
    yb_map_t smooth = file->map;
    smooth.detail = false;
    comparison->smooth_m = yb_raster_heights(&smooth, &raster);
    comparison->detail_m = yb_raster_heights(&file->map, &raster);
    return comparison->smooth_m != NULL && comparison->detail_m != NULL;
}

static bool add_polygon(yb_isolines_t *coded, const yb_map_t *map, const yb_contour_t *contour)
{
    const double step_m = yb_map_cell_m(map) / 256;
    yb_isoline_t line = {.count = contour->count,
                         .closed = !contour->open,
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

bool yb_comparison_make(yb_comparison_t *comparison, const yb_code_file_t *file,
                        const yb_grid_t *reference, yb_error_t *error)
{
    const yb_map_t *map = &file->map;
    const double cell_m = yb_map_cell_m(map);
    /* Computed as the meshes' coordinates are: ends of open lines lie exactly on this frame. */
    *comparison = (yb_comparison_t){.columns = map->east_q8 / 256u + 1,
                                    .rows = map->north_q8 / 256u + 1,
                                    .cell_m = cell_m,
                                    .east_m = map->east_q8 * (cell_m / 256),
                                    .north_m = map->north_q8 * (cell_m / 256)};
    if (!sizes_fit(comparison, reference, error))
        return false;
    if (sample_heights(comparison, file, reference) &&
        yb_mesh_from_lattice(&comparison->reference, comparison->reference_m, comparison->columns,
                             comparison->rows, cell_m) &&
        yb_mesh_from_map(&comparison->surface, map, YB_REFERENCE_Q8) &&
        take_polygons(comparison, file) &&
        cut_mesh(&comparison->original, &comparison->reference, &comparison->coded) &&
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
