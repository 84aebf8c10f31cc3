#include "surface.h"

#include <math.h>
#include <stdlib.h>

/* Points found by their plan position: open addressing, at most half full. */
typedef struct {
    yb_mesh_t *mesh;
    const yb_map_t *map;
    int32_t *z_q8;  /* of each point */
    uint32_t *slot; /* index of a point + 1, 0 = free */
    uint32_t *key;  /* of each point: x and y */
    uint32_t slots; /* a power of two */
    uint32_t point_room, triangle_room;
    bool failed;
} weld_t;

double yb_map_cell_m(const yb_map_t *map)
{
    return yb_unit_64th_m(map->cell) / 64.0;
}

double yb_map_east_m(const yb_map_t *map)
{
    return map->east_q8 * (yb_map_cell_m(map) / 256);
}

double yb_map_north_m(const yb_map_t *map)
{
    return map->north_q8 * (yb_map_cell_m(map) / 256);
}

double yb_map_z_m(const yb_map_t *map, int32_t z_q8)
{
    return map->base_m + z_q8 / 256.0 * yb_map_cell_m(map);
}

void yb_mesh_free(yb_mesh_t *mesh)
{
    free(mesh->point);
    free(mesh->triangle);
    *mesh = (yb_mesh_t){0};
}

static uint32_t home_slot(uint32_t key, uint32_t slots)
{
    uint32_t hash = key * 0x9e3779b1u;
    return (hash ^ (hash >> 15)) & (slots - 1);
}

static void put_slot(weld_t *weld, uint32_t point)
{
    uint32_t at = home_slot(weld->key[point], weld->slots);
    while (weld->slot[at] != 0)
        at = (at + 1) & (weld->slots - 1);
    weld->slot[at] = point + 1;
}

static bool grow_points(weld_t *weld)
{
    const uint32_t room = weld->point_room == 0 ? 1024 : weld->point_room * 2;
    yb_point3_t *point = realloc(weld->mesh->point, room * sizeof(*point));
    if (point != NULL)
        weld->mesh->point = point;
    int32_t *z_q8 = realloc(weld->z_q8, room * sizeof(*z_q8));
    if (z_q8 != NULL)
        weld->z_q8 = z_q8;
    uint32_t *key = realloc(weld->key, room * sizeof(*key));
    if (key != NULL)
        weld->key = key;
    uint32_t *slot = calloc((size_t)room * 2, sizeof(*slot));
    if (point == NULL || z_q8 == NULL || key == NULL || slot == NULL) {
        free(slot);
        return false;
    }
    free(weld->slot);
    weld->slot = slot;
    weld->slots = room * 2;
    weld->point_room = room;
    for (uint32_t i = 0; i < weld->mesh->point_count; i++)
        put_slot(weld, i);
    return true;
}

static uint32_t weld_corner(weld_t *weld, const yb_vertex_t *vertex)
{
    yb_mesh_t *mesh = weld->mesh;
    const uint32_t key = (uint32_t)vertex->x_q8 << 16 | vertex->y_q8;
    if (mesh->point_count == weld->point_room && !grow_points(weld)) {
        weld->failed = true;
        return 0;
    }
    uint32_t at = home_slot(key, weld->slots);
    for (; weld->slot[at] != 0; at = (at + 1) & (weld->slots - 1)) {
        const uint32_t point = weld->slot[at] - 1;
        if (weld->key[point] == key) {
            mesh->cracks += weld->z_q8[point] != vertex->z_q8;
            return point;
        }
    }
    const double step_m = yb_map_cell_m(weld->map) / 256;
    const uint32_t point = mesh->point_count++;
    weld->slot[at] = point + 1;
    weld->key[point] = key;
    weld->z_q8[point] = vertex->z_q8;
    mesh->point[point] = (yb_point3_t){vertex->x_q8 * step_m, vertex->y_q8 * step_m,
                                       yb_map_z_m(weld->map, vertex->z_q8)};
    return point;
}

static void weld_triangle(void *context, const yb_vertex_t *a, const yb_vertex_t *b,
                          const yb_vertex_t *c)
{
    weld_t *weld = context;
    yb_mesh_t *mesh = weld->mesh;
    if (weld->failed)
        return;
    if (mesh->triangle_count == weld->triangle_room) {
        const uint32_t room = weld->triangle_room == 0 ? 2048 : weld->triangle_room * 2;
        uint32_t(*triangle)[3] = realloc(mesh->triangle, room * sizeof(*triangle));
        if (triangle == NULL) {
            weld->failed = true;
            return;
        }
        mesh->triangle = triangle;
        weld->triangle_room = room;
    }
    const uint32_t corner[3] = {weld_corner(weld, a), weld_corner(weld, b), weld_corner(weld, c)};
    if (weld->failed)
        return;
    for (int i = 0; i < 3; i++)
        mesh->triangle[mesh->triangle_count][i] = corner[i];
    mesh->triangle_count++;
}

bool yb_mesh_from_map(yb_mesh_t *mesh, const yb_map_t *map, uint16_t longest_q8)
{
    *mesh = (yb_mesh_t){0};
    weld_t weld = {.mesh = mesh, .map = map};
    for (yb_triangle_t i = 0; i < map->triangle_count; i++)
        yb_map_refine(map, i, longest_q8, weld_triangle, &weld);
    free(weld.z_q8);
    free(weld.slot);
    free(weld.key);
    if (weld.failed)
        yb_mesh_free(mesh);
    return !weld.failed;
}

/* Exactly the side for the last point: open isolines must end on the frame. */
static double lattice_place(uint32_t index, uint32_t count, double side_m)
{
    return index + 1 == count ? side_m : side_m * index / (count - 1);
}

bool yb_mesh_from_lattice(yb_mesh_t *mesh, const float *z_m, uint32_t columns, uint32_t rows,
                          double east_m, double north_m)
{
    const size_t squares = (size_t)(columns - 1) * (rows - 1);
    *mesh = (yb_mesh_t){0};
    mesh->point = malloc((size_t)columns * rows * sizeof(*mesh->point));
    mesh->triangle = malloc((squares * 2 + 1) * sizeof(*mesh->triangle));
    if (mesh->point == NULL || mesh->triangle == NULL) {
        yb_mesh_free(mesh);
        return false;
    }
    for (uint32_t j = 0; j < rows; j++) {
        for (uint32_t i = 0; i < columns; i++) {
            const uint32_t sw = j * columns + i;
            mesh->point[sw] = (yb_point3_t){lattice_place(i, columns, east_m),
                                            lattice_place(j, rows, north_m), (double)z_m[sw]};
            if (i + 1 == columns || j + 1 == rows)
                continue;
            const uint32_t corner[2][3] = {{sw, sw + 1, sw + columns + 1},
                                           {sw, sw + columns + 1, sw + columns}};
            for (int t = 0; t < 2; t++) {
                for (int k = 0; k < 3; k++)
                    mesh->triangle[mesh->triangle_count][k] = corner[t][k];
                mesh->triangle_count++;
            }
        }
    }
    mesh->point_count = columns * rows;
    return true;
}

yb_raster_t yb_raster_on_map(const yb_map_t *map, uint32_t cells)
{
    const double columns = map->east_q8 / 256.0 + 1;
    const double rows = map->north_q8 / 256.0 + 1;
    const double step = (columns > rows ? columns : rows) / cells;
    const double half_m = yb_map_cell_m(map) / 2;
    return (yb_raster_t){.columns = (uint32_t)fmax(1, round(columns / step)),
                         .rows = (uint32_t)fmax(1, round(rows / step)),
                         .cell_m = step * yb_map_cell_m(map),
                         .west_m = -half_m,
                         .south_m = -half_m};
}

static uint16_t place_q8(double first_m, double cell_m, uint32_t index, double step_m,
                         uint16_t side_q8)
{
    const double at = round((first_m + (index + 0.5) * cell_m) / step_m * 256);
    return (uint16_t)fmin(fmax(at, 0), side_q8);
}

float *yb_raster_heights(const yb_map_t *map, const yb_raster_t *raster)
{
    const double step_m = yb_map_cell_m(map);
    float *z_m = malloc((size_t)raster->columns * raster->rows * sizeof(*z_m));
    if (z_m == NULL)
        return NULL;
    for (uint32_t j = 0; j < raster->rows; j++) {
        const uint16_t y = place_q8(raster->south_m, raster->cell_m, j, step_m, map->north_q8);
        for (uint32_t i = 0; i < raster->columns; i++) {
            const uint16_t x = place_q8(raster->west_m, raster->cell_m, i, step_m, map->east_q8);
            z_m[(size_t)j * raster->columns + i] = (float)yb_map_z_m(map, yb_map_height(map, x, y));
        }
    }
    return z_m;
}
