/* Surfaces as meshes and as grids. */
#include "codes.h"
#include "surface.h"

#include <math.h>
#include <stdlib.h>

static double plan_area(const yb_mesh_t *mesh)
{
    double sum = 0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const yb_point3_t a = mesh->point[mesh->triangle[i][0]];
        const yb_point3_t b = mesh->point[mesh->triangle[i][1]];
        const yb_point3_t c = mesh->point[mesh->triangle[i][2]];
        const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        assert_true(twice > 0);
        sum += twice / 2;
    }
    return sum;
}

static void corners_are_welded(void **state)
{
    (void)state;
    yb_code_file_t *file = code_rough_hill();
    const double side_m = 255 * 30;
    yb_mesh_t mesh;
    assert_true(yb_mesh_from_map(&mesh, &file->map, UINT16_MAX));
    assert_int_equal(mesh.point_count, file->map.vertex_count);
    assert_int_equal(mesh.triangle_count, file->map.triangle_count);
    assert_true(fabs(plan_area(&mesh) - side_m * side_m) < 1);
    yb_mesh_free(&mesh);

    assert_true(yb_mesh_from_map(&mesh, &file->map, YB_REFERENCE_Q8));
    assert_int_equal(mesh.cracks, 0);
    assert_true(fabs(plan_area(&mesh) - side_m * side_m) < 1);
    /* Euler: points - edges + triangles = 1, and the boundary has at least 4 * 255 edges. */
    assert_true(mesh.triangle_count < 2 * mesh.point_count - 1020);
    yb_mesh_free(&mesh);
    yb_code_file_free(file);
}

static void heights_are_metres_above_the_datum(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    assert_true(yb_map_cell_m(&file->map) == 30);
    assert_true(yb_map_z_m(&file->map, 0) == 100);
    assert_true(yb_map_z_m(&file->map, 256) == 130);
    yb_mesh_t mesh;
    double high = -1e9;
    assert_true(yb_mesh_from_map(&mesh, &file->map, UINT16_MAX));
    for (uint32_t i = 0; i < mesh.point_count; i++)
        high = fmax(high, mesh.point[i].z);
    assert_true(fabs(high - 1100) < 0.1);
    yb_mesh_free(&mesh);
    yb_code_file_free(file);
}

static void rasters_lie_on_the_lattice(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    yb_raster_t raster = yb_raster_on_map(&file->map, 256);
    assert_int_equal(raster.columns, 256);
    assert_int_equal(raster.rows, 256);
    assert_true(raster.cell_m == 30 && raster.west_m == -15 && raster.south_m == -15);
    float *z_m = yb_raster_heights(&file->map, &raster);
    assert_non_null(z_m);
    assert_true(fabs((double)z_m[128 * 256 + 128] - 1100) < 0.2);
    assert_true(fabs((double)z_m[0] - 150) < 0.2);
    assert_true(z_m[100 * 256 + 30] ==
                (float)yb_map_z_m(&file->map, yb_map_height(&file->map, 30 * 256, 100 * 256)));
    free(z_m);
    yb_code_file_free(file);

    file = code_slope();
    raster = yb_raster_on_map(&file->map, 202);
    assert_int_equal(raster.columns, 202);
    assert_int_equal(raster.rows, 122);
    assert_true(fabs(raster.cell_m - 5) < 1e-9);
    raster = yb_raster_on_map(&file->map, 2);
    assert_int_equal(raster.rows, 1);
    yb_code_file_free(file);
}

/* At every second 1/256 of a step near the vertices, and all over the map. */
static void check_heights(const yb_map_t *map)
{
    enum {
        PLACES = 301
    };
    static int32_t z_q8[PLACES * PLACES];
    uint16_t x_q8[PLACES], y_q8[PLACES];
    for (int part = 0; part < 4; part++) {
        const yb_vertex_t *v = &map->vertex[map->vertex_count * part / 4];
        for (int i = 0; i < PLACES; i++) {
            const double all = (double)i / (PLACES - 1);
            const int x = part == 0 ? (int)(map->east_q8 * all) : v->x_q8 + 2 * (i - 150);
            const int y = part == 0 ? (int)(map->north_q8 * all) : v->y_q8 + 2 * (i - 150);
            x_q8[i] = (uint16_t)fmin(fmax(x, 0), map->east_q8);
            y_q8[i] = (uint16_t)fmin(fmax(y, 0), map->north_q8);
        }
        yb_map_heights(map, x_q8, PLACES, y_q8, PLACES, z_q8);
        for (int i = 0; i < PLACES * PLACES; i += part == 0 ? 1 : 7)
            assert_int_equal(z_q8[i], yb_map_height(map, x_q8[i % PLACES], y_q8[i / PLACES]));
    }
}

static void many_heights_are_those_of_the_engine(void **state)
{
    (void)state;
    yb_code_file_t *file[] = {code_hill(), code_eastern_hill(), code_rough_hill(), code_slope()};
    for (int i = 0; i < 4; i++) {
        check_heights(&file[i]->map);
        yb_code_file_free(file[i]);
    }
}

static void lattices_end_on_the_same_frame(void **state)
{
    (void)state;
    yb_code_file_t *file = code_slope();
    const double east_m = yb_map_east_m(&file->map);
    float *flat = calloc(101 * 61, sizeof(*flat));
    yb_mesh_t lattice, base;
    assert_true(yb_mesh_from_lattice(&lattice, flat, 101, 61, east_m, yb_map_north_m(&file->map)));
    assert_true(yb_mesh_from_map(&base, &file->map, UINT16_MAX));
    assert_int_equal(lattice.triangle_count, 2 * 100 * 60);
    assert_true(fabs(plan_area(&lattice) - plan_area(&base)) < 1e-6);
    double east = 0;
    for (uint32_t i = 0; i < base.point_count; i++)
        east = fmax(east, base.point[i].x);
    assert_true(lattice.point[100].x == east);
    yb_mesh_free(&lattice);
    yb_mesh_free(&base);
    free(flat);
    yb_code_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_are_welded),
        cmocka_unit_test(heights_are_metres_above_the_datum),
        cmocka_unit_test(rasters_lie_on_the_lattice),
        cmocka_unit_test(many_heights_are_those_of_the_engine),
        cmocka_unit_test(lattices_end_on_the_same_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
