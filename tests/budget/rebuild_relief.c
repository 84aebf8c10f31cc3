/* What the group `relief` of the benchmarks measures: rebuild_relief WINDOW.tif FOLDER
 *
 * Takes contour lines of a DEM at nine heights, a tenth of the relief apart, and writes to the
 * folder the lines (contours.gpkg, metres from the middle of the south-western cell) and heights at
 * the DEM's cells as raw 32-bit floats, the northernmost row first: the DEM's own (dem.f32), those
 * of the map of all the lines' points, without fractal detail (yamabiko.f32), and those of the
 * plain constrained Delaunay triangulation of the same points and the frame's corners, linear in
 * each triangle (tin.f32). Prints columns, rows, metres per cell, lowest height and interval.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <math.h>

#include "contour_lines.h"
#include "detailed_map.h"
#include "geofile.h"
#include "grid.h"
#include "mesh.h"
#include "surface.h"

enum {
    SIDE = 256,
    LEVELS = 9
};

static yb_map_t map, plain;
static yb_load_t load, plain_load;

static bool write_heights(const char *folder, const char *name, const float *height_m, size_t count)
{
    char path[4096];
    snprintf(path, sizeof(path), "%s/%s.f32", folder, name);
    FILE *file = fopen(path, "wb");
    bool good = file != NULL && fwrite(height_m, sizeof(float), count, file) == count;
    if (file != NULL)
        good = fclose(file) == 0 && good;
    return good;
}

/* The map's heights at the grid's cells, by interpolation along its frame. */
static bool write_surface(const char *folder, const char *name, const yb_map_t *of,
                          const yb_grid_t *grid)
{
    uint16_t x_q8[SIDE];
    uint16_t y_q8[SIDE];
    float *row = malloc((size_t)grid->columns * (size_t)grid->rows * sizeof(*row));
    for (int i = 0; i < grid->columns; i++)
        x_q8[i] = (uint16_t)lround((double)of->east_q8 * i / (grid->columns - 1));
    for (int j = 0; j < grid->rows; j++)
        y_q8[j] = (uint16_t)lround((double)of->north_q8 * j / (grid->rows - 1));
    float *z_m = yb_map_heights_m(of, x_q8, (uint32_t)grid->columns, y_q8, (uint32_t)grid->rows);
    bool good = row != NULL && z_m != NULL;
    for (int j = 0; good && j < grid->rows; j++)
        memcpy(row + j * grid->columns, z_m + (grid->rows - 1 - j) * grid->columns,
               (size_t)grid->columns * sizeof(*row));
    good = good && write_heights(folder, name, row, (size_t)grid->columns * (size_t)grid->rows);
    free(row);
    free(z_m);
    return good;
}

/* The same contours without any rule. */
static bool triangulate_plainly(void)
{
    yb_map_begin(&plain, &plain_load);
    plain.east_q8 = map.east_q8;
    plain.north_q8 = map.north_q8;
    plain.cell = map.cell;
    plain.unit = map.unit;
    plain.base_m = map.base_m;
    plain.detail = false;
    plain_load.contour_count = load.contour_count;
    plain_load.point_count = load.point_count;
    plain_load.vertex_count = load.point_count;
    memcpy(plain.vertex, map.vertex, load.point_count * sizeof(map.vertex[0]));
    for (int i = 0; i < load.contour_count; i++)
        plain_load.contour[i] =
            (yb_contour_t){.first = load.contour[i].first, .count = load.contour[i].count};
    bool fits = border_close(&plain_load) && mesh_triangulate(&plain_load);
    plain.vertex_count = plain_load.vertex_count;
    return fits;
}

static bool write_lines(const char *folder, const yb_lines_t *lines, yb_error_t *error)
{
    char path[4096];
    snprintf(path, sizeof(path), "%s/contours.gpkg", folder);
    yb_isolines_t isolines = {.line = calloc((size_t)lines->count, sizeof(yb_isoline_t))};
    bool good = isolines.line != NULL;
    for (int i = 0; good && i < lines->count; i++) {
        const yb_line_t *line = &lines->line[i];
        yb_isoline_t *isoline = &isolines.line[isolines.count++];
        *isoline = (yb_isoline_t){.count = (size_t)line->count,
                                  .height_m = line->height_m,
                                  .closed = line->closed,
                                  .point = malloc((size_t)line->count * sizeof(yb_point2_t))};
        good = isoline->point != NULL;
        for (int k = 0; good && k < line->count; k++)
            isoline->point[k] = (yb_point2_t){line->place[k].x_m, line->place[k].y_m};
    }
    good = good ? yb_geofile_write_lines(path, true, &isolines, NULL, error)
                : yb_error_set(error, "out of memory");
    yb_isolines_free(&isolines);
    return good;
}

static bool rebuild(const yb_grid_t *grid, const char *folder, yb_error_t *error)
{
    double interval_m = ((double)grid->high_m - (double)grid->low_m) / (LEVELS + 1);
    double level_m[LEVELS];
    for (int i = 0; i < LEVELS; i++)
        level_m[i] = (double)grid->low_m + interval_m * (i + 1);
    yb_lines_t *lines = yb_lines_from_grid(grid, level_m, LEVELS, error);
    bool good = lines != NULL && write_lines(folder, lines, error) &&
                yb_detailed_map(lines, &map, &load, NULL, NULL, error);
    yb_lines_free(lines);
    if (!good)
        return false;
    printf("%d\t%d\t%.17g\t%.17g\t%.17g\n", grid->columns, grid->rows, grid->cell_m,
           (double)grid->low_m, interval_m);
    return (triangulate_plainly() && write_surface(folder, "yamabiko", &map, grid) &&
            write_surface(folder, "tin", &plain, grid) &&
            write_heights(folder, "dem", grid->height_m,
                          (size_t)grid->columns * (size_t)grid->rows)) ||
           yb_error_set(error, "cannot write to %s", folder);
}

int main(int argc, char **argv)
{
    yb_error_t error = {""};
    const yb_window_t whole = {.kind = YB_WINDOW_WHOLE};
    if (argc != 3) {
        fprintf(stderr, "usage: rebuild_relief WINDOW.tif FOLDER\n");
        return 2;
    }
    yb_grid_t *grid = yb_grid_read(argv[1], &whole, SIDE, &error);
    bool good = grid != NULL && rebuild(grid, argv[2], &error);
    yb_grid_free(grid);
    if (!good)
        fprintf(stderr, "rebuild_relief: %s: %s\n", argv[1], error.text);
    return good ? 0 : 1;
}
