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

static bool weld_end(weld_t *weld)
{
    free(weld->z_q8);
    free(weld->slot);
    free(weld->key);
    if (weld->failed)
        yb_mesh_free(weld->mesh);
    return !weld->failed;
}

bool yb_mesh_from_map(yb_mesh_t *mesh, const yb_map_t *map, uint16_t longest_q8)
{
    *mesh = (yb_mesh_t){0};
    weld_t weld = {.mesh = mesh, .map = map};
    for (yb_triangle_t i = 0; i < map->triangle_count; i++)
        yb_map_refine(map, i, longest_q8, weld_triangle, &weld);
    return weld_end(&weld);
}

bool yb_mesh_from_frame(yb_mesh_t *mesh, const yb_map_t *map, const yb_view_t *view,
                        const yb_screen_t *screen)
{
    *mesh = (yb_mesh_t){0};
    yb_frame_t *frame = malloc(sizeof(*frame));
    if (frame == NULL)
        return false;
    weld_t weld = {.mesh = mesh, .map = map};
    yb_frame_begin(frame, map, view, screen);
    yb_frame_triangles(frame, weld_triangle, &weld);
    free(frame);
    return weld_end(&weld);
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

/* The places of one axis, and for every step the first of them at it or beyond. */
typedef struct {
    const uint16_t *at_q8;
    uint32_t count;
    uint32_t from[257];
} axis_t;

typedef struct {
    axis_t across, up;
    int32_t *z_q8;
} sampler_t;

static axis_t axis_of(const uint16_t *at_q8, uint32_t count)
{
    axis_t axis = {.at_q8 = at_q8, .count = count};
    uint32_t i = 0;
    for (uint32_t step = 0; step <= 256; step++) {
        while (i < count && at_q8[i] < step * 256)
            i++;
        axis.from[step] = i;
    }
    return axis;
}

/* The places from `low` to `high`, both included. */
static void places_in(const axis_t *axis, uint16_t low, uint16_t high, uint32_t *first,
                      uint32_t *end)
{
    *first = axis->from[low >> 8];
    while (*first < axis->count && axis->at_q8[*first] < low)
        ++*first;
    *end = axis->from[(high >> 8) + 1];
    while (*end > *first && axis->at_q8[*end - 1] > high)
        --*end;
}

static uint16_t least(uint16_t a, uint16_t b, uint16_t c)
{
    const uint16_t low = a < b ? a : b;
    return low < c ? low : c;
}

static uint16_t greatest(uint16_t a, uint16_t b, uint16_t c)
{
    const uint16_t high = a > b ? a : b;
    return high > c ? high : c;
}

/* Writes the heights of a triangle at the places in it, its border included: there its neighbours
 * write the same. Rounded down, as the engine does.
 */
static void sample_triangle(void *context, const yb_vertex_t *a, const yb_vertex_t *b,
                            const yb_vertex_t *c)
{
    const sampler_t *sampler = context;
    const int64_t bx = b->x_q8 - a->x_q8, by = b->y_q8 - a->y_q8;
    const int64_t cx = c->x_q8 - a->x_q8, cy = c->y_q8 - a->y_q8;
    const int64_t area = bx * cy - by * cx;
    uint32_t first = 0, end = 0, row = 0, end_row = 0;
    places_in(&sampler->across, least(a->x_q8, b->x_q8, c->x_q8),
              greatest(a->x_q8, b->x_q8, c->x_q8), &first, &end);
    places_in(&sampler->up, least(a->y_q8, b->y_q8, c->y_q8), greatest(a->y_q8, b->y_q8, c->y_q8),
              &row, &end_row);
    if (area <= 0)
        return;
    for (; row < end_row; row++) {
        const int64_t y = sampler->up.at_q8[row] - a->y_q8;
        for (uint32_t i = first; i < end; i++) {
            const int64_t x = sampler->across.at_q8[i] - a->x_q8;
            const int64_t of_b = x * cy - y * cx;
            const int64_t of_c = bx * y - by * x;
            if (of_b < 0 || of_c < 0 || of_b + of_c > area)
                continue;
            const int64_t rise = of_b * (b->z_q8 - a->z_q8) + of_c * (c->z_q8 - a->z_q8);
            const int64_t down = rise >= 0 ? rise / area : -((area - 1 - rise) / area);
            sampler->z_q8[(size_t)row * sampler->across.count + i] = (int32_t)(a->z_q8 + down);
        }
    }
}

void yb_map_heights(const yb_map_t *map, const uint16_t *x_q8, uint32_t columns,
                    const uint16_t *y_q8, uint32_t rows, int32_t *z_q8)
{
    sampler_t sampler = {axis_of(x_q8, columns), axis_of(y_q8, rows), z_q8};
    for (yb_triangle_t i = 0; i < map->triangle_count; i++)
        yb_map_refine(map, i, YB_REFERENCE_Q8, sample_triangle, &sampler);
}

float *yb_map_heights_m(const yb_map_t *map, const uint16_t *x_q8, uint32_t columns,
                        const uint16_t *y_q8, uint32_t rows)
{
    const size_t places = (size_t)columns * rows;
    int32_t *z_q8 = calloc(places, sizeof(*z_q8));
    float *z_m = malloc(places * sizeof(*z_m));
    if (z_q8 != NULL && z_m != NULL) {
        yb_map_heights(map, x_q8, columns, y_q8, rows, z_q8);
        for (size_t i = 0; i < places; i++)
            z_m[i] = (float)yb_map_z_m(map, z_q8[i]);
    } else {
        free(z_m);
        z_m = NULL;
    }
    free(z_q8);
    return z_m;
}

float *yb_raster_heights(const yb_map_t *map, const yb_raster_t *raster)
{
    const double step_m = yb_map_cell_m(map);
    uint16_t *x_q8 = malloc(raster->columns * sizeof(*x_q8));
    uint16_t *y_q8 = malloc(raster->rows * sizeof(*y_q8));
    float *z_m = NULL;
    if (x_q8 != NULL && y_q8 != NULL) {
        for (uint32_t i = 0; i < raster->columns; i++)
            x_q8[i] = place_q8(raster->west_m, raster->cell_m, i, step_m, map->east_q8);
        for (uint32_t j = 0; j < raster->rows; j++)
            y_q8[j] = place_q8(raster->south_m, raster->cell_m, j, step_m, map->north_q8);
        z_m = yb_map_heights_m(map, x_q8, raster->columns, y_q8, raster->rows);
    }
    free(x_q8);
    free(y_q8);
    return z_m;
}
