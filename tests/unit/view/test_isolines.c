/* Isolines of surfaces whose isolines are known. */
#include "codes.h"
#include "isolines.h"

#include <math.h>
#include <stdlib.h>

enum {
    SIDE = 41,
    MIDDLE = 20
};

typedef double (*height_fn)(double x, double y);

static yb_mesh_t mesh_of(height_fn height)
{
    static float z_m[SIDE * SIDE];
    yb_mesh_t mesh;
    for (int j = 0; j < SIDE; j++) {
        for (int i = 0; i < SIDE; i++)
            z_m[j * SIDE + i] = (float)height(i, j);
    }
    assert_true(yb_mesh_from_lattice(&mesh, z_m, SIDE, SIDE, SIDE - 1, SIDE - 1));
    return mesh;
}

static yb_isolines_t lines_of(height_fn height, double level)
{
    yb_isolines_t lines = {0};
    yb_mesh_t mesh = mesh_of(height);
    assert_true(yb_isolines_add(&lines, &mesh, level));
    yb_mesh_free(&mesh);
    return lines;
}

static bool on_frame(yb_point2_t point)
{
    return point.x == 0 || point.y == 0 || point.x == SIDE - 1 || point.y == SIDE - 1;
}

static double area_of(const yb_isoline_t *line)
{
    double sum = 0;
    for (size_t i = 0; i < line->count; i++) {
        const yb_point2_t a = line->point[i], b = line->point[(i + 1) % line->count];
        sum += (a.x * b.y - b.x * a.y) / 2;
    }
    return sum;
}

static double cone(double x, double y)
{
    return 20 - hypot(x - MIDDLE, y - MIDDLE);
}

static double pit(double x, double y)
{
    return -cone(x, y);
}

static double plane(double x, double y)
{
    (void)y;
    return x;
}

static double saddle(double x, double y)
{
    return (x - MIDDLE) * (y - MIDDLE);
}

static double plateau(double x, double y)
{
    return fabs(x - MIDDLE) <= 5 && fabs(y - MIDDLE) <= 5 ? 1 : 0;
}

static double needle(double x, double y)
{
    return x == MIDDLE && y == MIDDLE ? 1 : 0;
}

/* A few whole heights at random: nearly every corner lies exactly on a level. */
static double steps(double x, double y)
{
    const unsigned place = (unsigned)(x * 1000 + y);
    return (place * 2654435761u >> 13) % 4;
}

static void a_cone_has_circles(void **state)
{
    (void)state;
    yb_isolines_t lines = lines_of(cone, 10.25);
    assert_int_equal(lines.count, 1);
    assert_true(lines.line[0].closed);
    for (size_t i = 0; i < lines.line[0].count; i++) {
        const yb_point2_t point = lines.line[0].point[i];
        assert_true(fabs(hypot(point.x - MIDDLE, point.y - MIDDLE) - 9.75) < 0.02);
    }
    /* The higher ground is on the left. */
    assert_true(fabs(area_of(&lines.line[0]) - acos(-1.0) * 9.75 * 9.75) < 1);
    yb_isolines_free(&lines);

    lines = lines_of(pit, -10.25);
    assert_int_equal(lines.count, 1);
    assert_true(area_of(&lines.line[0]) < -290);
    yb_isolines_free(&lines);
}

static void a_plane_has_straight_lines_through_its_corners(void **state)
{
    (void)state;
    yb_isolines_t lines = lines_of(plane, 7);
    assert_int_equal(lines.count, 1);
    assert_false(lines.line[0].closed);
    for (size_t i = 0; i < lines.line[0].count; i++)
        assert_true(lines.line[0].point[i].x == 7);
    assert_true(on_frame(lines.line[0].point[0]));
    /* East is higher: with it on the left the line runs south. */
    assert_true(lines.line[0].point[0].y == SIDE - 1);
    yb_isolines_free(&lines);

    lines = lines_of(plane, 0);
    assert_int_equal(lines.count, 0);
    lines = lines_of(plane, SIDE - 1);
    assert_int_equal(lines.count, 1);
    yb_isolines_free(&lines);
}

static void a_saddle_at_its_own_height_does_not_fork(void **state)
{
    (void)state;
    yb_isolines_t lines = lines_of(saddle, 0);
    assert_int_equal(lines.count, 2);
    for (size_t i = 0; i < 2; i++) {
        assert_false(lines.line[i].closed);
        assert_true(on_frame(lines.line[i].point[0]));
        assert_true(on_frame(lines.line[i].point[lines.line[i].count - 1]));
    }
    yb_isolines_free(&lines);
}

static void flats_and_points_at_the_height(void **state)
{
    (void)state;
    yb_isolines_t lines = lines_of(plateau, 1);
    assert_int_equal(lines.count, 1);
    assert_true(fabs(area_of(&lines.line[0]) - 100) < 1e-9);
    yb_isolines_free(&lines);
    lines = lines_of(plateau, 0);
    assert_int_equal(lines.count, 0);
    lines = lines_of(needle, 1);
    assert_int_equal(lines.count, 0);
    lines = lines_of(needle, 0.5);
    assert_int_equal(lines.count, 1);
    yb_isolines_free(&lines);
}

static void no_line_forks_or_stops(void **state)
{
    (void)state;
    yb_mesh_t mesh = mesh_of(steps);
    for (int level = 0; level <= 3; level++) {
        yb_isolines_t lines = {0};
        assert_true(yb_isolines_add(&lines, &mesh, level));
        assert_int_equal(lines.count == 0, level == 0);
        for (size_t i = 0; i < lines.count; i++) {
            const yb_isoline_t *line = &lines.line[i];
            assert_true(line->count >= 2);
            if (!line->closed) {
                assert_true(on_frame(line->point[0]));
                assert_true(on_frame(line->point[line->count - 1]));
            }
            for (size_t k = 1; k < line->count; k++)
                assert_true(line->point[k].x != line->point[k - 1].x ||
                            line->point[k].y != line->point[k - 1].y);
        }
        yb_isolines_free(&lines);
    }
    yb_mesh_free(&mesh);
}

static void heights_are_found_again(void **state)
{
    (void)state;
    yb_isolines_t lines = {0};
    yb_mesh_t mesh = mesh_of(cone);
    for (int level = 1; level <= 3; level++)
        assert_true(yb_isolines_add(&lines, &mesh, level * 5));
    yb_mesh_free(&mesh);
    const yb_isolines_t at = yb_isolines_at(&lines, 10);
    assert_int_equal(at.count, 1);
    assert_true(at.line[0].height_m == 10);
    assert_int_equal(yb_isolines_at(&lines, 11).count, 0);
    yb_isolines_free(&lines);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cone_has_circles),
        cmocka_unit_test(a_plane_has_straight_lines_through_its_corners),
        cmocka_unit_test(a_saddle_at_its_own_height_does_not_fork),
        cmocka_unit_test(flats_and_points_at_the_height),
        cmocka_unit_test(no_line_forks_or_stops),
        cmocka_unit_test(heights_are_found_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
