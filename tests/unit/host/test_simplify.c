/* Feature points and their places on the lattice. */
#include "scratch.h"
#include "simplify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

enum {
    CIRCLE = 400
};

static void circle(yb_place_t *place, double radius_m)
{
    for (int i = 0; i < CIRCLE; i++) {
        double angle = 6.283185307179586 * i / CIRCLE;
        place[i] = (yb_place_t){5000 + radius_m * cos(angle), 5000 + radius_m * sin(angle)};
    }
}

/* Distance of p from the nearest segment of the polygon through the kept places. */
static double from_polygon(const yb_line_t *line, const int *kept, int count, yb_place_t p)
{
    double best = HUGE_VAL;
    for (int i = 0; i < (line->closed ? count : count - 1); i++) {
        yb_place_t a = line->place[kept[i]];
        yb_place_t b = line->place[kept[(i + 1) % count]];
        double length = pow(b.x_m - a.x_m, 2) + pow(b.y_m - a.y_m, 2);
        double along =
            ((p.x_m - a.x_m) * (b.x_m - a.x_m) + (p.y_m - a.y_m) * (b.y_m - a.y_m)) / length;
        along = fmin(fmax(along, 0), 1);
        best = fmin(best, hypot(p.x_m - a.x_m - along * (b.x_m - a.x_m),
                                p.y_m - a.y_m - along * (b.y_m - a.y_m)));
    }
    return best;
}

static void test_error_is_bounded(void **state)
{
    (void)state;
    static yb_place_t place[CIRCLE];
    int kept[CIRCLE];
    circle(place, 3000);
    for (int i = 0; i < CIRCLE; i++)
        place[i].x_m += 300 * sin(i * 0.2);
    for (int closed = 0; closed < 2; closed++) {
        yb_line_t line = {.closed = closed != 0, .count = CIRCLE, .place = place};
        int before = CIRCLE;
        for (double tolerance = 5; tolerance < 3000; tolerance *= 2) {
            int count = yb_simplify(&line, tolerance, kept);
            assert_in_range(count, closed != 0 ? 3 : 2, before);
            for (int i = 0; i < CIRCLE; i++)
                assert_true(from_polygon(&line, kept, count, place[i]) <= tolerance + 1e-6);
            before = count;
        }
    }
}

static void test_closed_keeps_three(void **state)
{
    (void)state;
    static yb_place_t place[CIRCLE];
    int kept[CIRCLE];
    circle(place, 3000);
    yb_line_t line = {.closed = true, .count = CIRCLE, .place = place};
    assert_int_equal(yb_simplify(&line, 1e9, kept), 3);
}

static void test_lattice(void **state)
{
    (void)state;
    static yb_place_t place[CIRCLE];
    yb_step_t point[YB_SET_POINTS];
    circle(place, 3000);
    yb_line_t line = {.closed = true, .count = CIRCLE, .place = place};
    const int spacings[] = {1, 2, 4, 8, 5};
    for (int s = 0; s < 5; s++) {
        int side = 248 / spacings[s] * spacings[s];
        yb_lattice_t lattice = {10000, 10000, side, side, spacings[s]};
        int count = yb_simplify_to_lattice(&line, 400, &lattice, point, YB_SET_POINTS);
        assert_in_range(count, 4, 16);
        for (int i = 0; i < count; i++) {
            assert_int_equal(point[i].x % spacings[s], 0);
            assert_int_equal(point[i].y % spacings[s], 0);
        }
    }
    yb_place_t across[] = {{0, 3333}, {4000, 3100}, {10000, 7777}};
    yb_line_t open = {.closed = false, .count = 3, .place = across};
    yb_lattice_t lattice = {10000, 10000, 248, 248, 8};
    int count = yb_simplify_to_lattice(&open, 1, &lattice, point, YB_SET_POINTS);
    assert_int_equal(count, 3);
    assert_int_equal(point[0].x, 0);
    assert_int_equal(point[2].x, 248);
    assert_in_range(point[1].x, 1, 247);
    circle(place, 10);
    for (int i = 0; i < CIRCLE; i++)
        place[i].x_m += 100, place[i].y_m += 100;
    assert_int_equal(yb_simplify_to_lattice(&line, 1, &lattice, point, YB_SET_POINTS), 0);
}

static void test_fits(void **state)
{
    (void)state;
    yb_contour_set_t set = {.east = 200, .north = 200};
    yb_step_t square[] = {{50, 50}, {150, 50}, {150, 150}, {50, 150}};
    assert_true(yb_simplify_fits(&set, square, 4, false));
    yb_step_t bow[] = {{50, 50}, {150, 150}, {150, 50}, {50, 150}};
    assert_false(yb_simplify_fits(&set, bow, 4, false));
    yb_step_t fold[] = {{50, 50}, {150, 50}, {100, 50}, {100, 120}};
    assert_false(yb_simplify_fits(&set, fold, 4, false));
    yb_step_t thin[] = {{50, 50}, {150, 50}, {100, 50}};
    assert_false(yb_simplify_fits(&set, thin, 3, false));
    yb_step_t twice[] = {{50, 50}, {100, 60}, {150, 50}, {100, 60}, {90, 120}};
    assert_false(yb_simplify_fits(&set, twice, 5, false));
    assert_true(yb_contour_set_append(&set, 1, false, square, 4));
    yb_step_t inside = {100, 100};
    yb_step_t on_line = {100, 50};
    yb_step_t corner = {50, 50};
    assert_true(yb_simplify_fits(&set, &inside, 1, false));
    assert_false(yb_simplify_fits(&set, &on_line, 1, false));
    assert_false(yb_simplify_fits(&set, &corner, 1, false));
    yb_step_t through[] = {{0, 100}, {200, 100}};
    yb_step_t below[] = {{0, 20}, {200, 20}};
    yb_step_t touching[] = {{0, 20}, {50, 50}, {200, 20}};
    yb_step_t along[] = {{20, 0}, {100, 0}};
    assert_false(yb_simplify_fits(&set, through, 2, true));
    assert_true(yb_simplify_fits(&set, below, 2, true));
    assert_false(yb_simplify_fits(&set, touching, 3, true));
    assert_false(yb_simplify_fits(&set, along, 2, true));
}

/* Points of a set are moved: their own segments count, near and far. */
static void test_point_fits(void **state)
{
    (void)state;
    yb_contour_set_t set = {.east = 200, .north = 200};
    yb_step_t square[] = {{50, 50}, {150, 50}, {150, 150}, {50, 150}};
    yb_step_t across[] = {{0, 20}, {100, 30}, {200, 20}};
    yb_step_t spot = {100, 100};
    assert_true(yb_contour_set_append(&set, 1, false, square, 4));
    assert_true(yb_contour_set_append(&set, 1, true, across, 3));
    assert_true(yb_contour_set_append(&set, 2, false, &spot, 1));
    for (int i = 0; i < 4; i++)
        assert_true(yb_simplify_point_fits(&set, 0, i));
    for (int i = 0; i < 3; i++)
        assert_true(yb_simplify_point_fits(&set, 1, i));
    assert_true(yb_simplify_point_fits(&set, 2, 0));
    set.point[7] = (yb_step_t){100, 50};
    assert_false(yb_simplify_point_fits(&set, 2, 0)); /* on the square */
    set.point[7] = spot;
    set.point[5] = (yb_step_t){100, 60};
    assert_false(yb_simplify_point_fits(&set, 1, 1)); /* through it */
    assert_false(yb_simplify_point_fits(&set, 1, 0));
    set.point[5] = across[1];
    set.point[2] = (yb_step_t){100, 20};
    assert_false(yb_simplify_point_fits(&set, 0, 2)); /* through itself and the open line */
    set.point[2] = (yb_step_t){150, 40};
    assert_false(yb_simplify_point_fits(&set, 0, 2)); /* back over its own side */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_error_is_bounded), cmocka_unit_test(test_closed_keeps_three),
        cmocka_unit_test(test_lattice),          cmocka_unit_test(test_fits),
        cmocka_unit_test(test_point_fits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
