/* Dimensions measured on surfaces and lines whose dimension is known, and noise that is as rough as
 * the code says.
 */
#include "contour_code.h"
#include "fractal.h"
#include "fractional.h"
#include "roughness.h"
#include "scratch.h"
#include "sketch.h"
#include "surface.h"

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
    SIDE = FRACTIONAL_SIDE,
    SEEDS = 2, /* of two surfaces each */
    SURFACES = 2 * SEEDS
};

static const double hursts[] = {0.2, 0.35, 0.5, 0.65, 0.8};
enum {
    HURSTS = sizeof(hursts) / sizeof(hursts[0])
};

static void make_fractional(yb_grid_t *grid[SURFACES], double hurst)
{
    for (int i = 0; i < SURFACES; i++) {
        grid[i] = yb_grid_new(SIDE, SIDE, 30);
        assert_non_null(grid[i]);
    }
    for (int seed = 0; seed < SEEDS; seed++)
        assert_true(fractional_surfaces(hurst, (uint32_t)seed + 1, 500, grid[2 * seed]->height_m,
                                        grid[2 * seed + 1]->height_m));
    for (int i = 0; i < SURFACES; i++)
        yb_grid_measure(grid[i]);
}

static void expect_near(const char *what, double hurst, double found, double wanted, double off)
{
    if (!(fabs(found - wanted) <= off))
        fail_msg("H %.2f: %s is %.3f, not %.3f +- %.2f", hurst, what, found, wanted, off);
}

/* The increments are what they are said to be, or nothing of this means anything. */
static void expect_increments(yb_grid_t *grid[SURFACES], double hurst)
{
    double near = 0, far = 0;
    for (int i = 0; i < SURFACES; i++) {
        near += pow(yb_roughness_rise_m(grid[i]->height_m, SIDE, SIDE, 1), 2) / SURFACES;
        far += pow(yb_roughness_rise_m(grid[i]->height_m, SIDE, SIDE, 8), 2) / SURFACES;
    }
    expect_near("log2 of rises", hurst, log2(far / near) / 6, hurst, 0.03);
    expect_near("rise over a cell", hurst, sqrt(near) / (500 * pow(1 / 512.0, hurst)), 1, 0.1);
}

/* What is measured on the surfaces of one H: sums and numbers. */
typedef struct {
    double boxes, levels, lines, loops;
    int level_count, line_count, loop_count;
} sums_t;

static void add_report(sums_t *sums, const yb_grid_t *grid)
{
    yb_error_t error;
    yb_fractal_report_t report;
    assert_true(yb_fractal_of_grid(grid, &report, &error));
    assert_int_equal(report.level_count, YB_FRACTAL_LEVELS);
    assert_true(report.boxes.r2 > 0.998);
    assert_true(report.boxes.from_m == 4 * grid->cell_m && report.boxes.to_m == 32 * grid->cell_m);
    sums->boxes += report.boxes.dimension;
    for (int i = 0; i < report.level_count; i++) {
        sums->levels += report.level[i].boxes.dimension;
        sums->level_count += report.level[i].boxes.sizes > 0;
    }
    for (int i = 0; i < report.contour_count; i++) {
        const yb_fractal_contour_t *contour = &report.contour[i];
        assert_true(i == 0 || contour->length_m <= contour[-1].length_m);
        sums->lines += contour->dimension;
        sums->line_count += contour->divider.sizes > 0;
        if (contour->closed) {
            sums->loops += contour->dimension;
            sums->loop_count += contour->divider.sizes > 0;
        }
    }
    yb_fractal_free(&report);
}

/* All lines of a level have 2 - H by boxes, single ones (3 - H) / 2 by dividers. Both would be met
 * by H = D - 1 at H = 0.5 alone.
 */
static void test_dimensions(void **state)
{
    (void)state;
    for (int k = 0; k < HURSTS; k++) {
        const double hurst = hursts[k], wanted = 2 - hurst;
        yb_grid_t *grid[SURFACES];
        sums_t sums = {0};
        make_fractional(grid, hurst);
        expect_increments(grid, hurst);
        for (int i = 0; i < SURFACES; i++) {
            add_report(&sums, grid[i]);
            yb_grid_free(grid[i]);
        }
        const double boxes = sums.boxes / SURFACES, levels = sums.levels / sums.level_count;
        const double lines = sums.lines / sums.line_count, loops = sums.loops / sums.loop_count;
        print_message(
            "H %.2f: D of boxes %.3f, levels %.3f (%d), lines %.3f (%d), loops among them "
            "%.3f (%d)\n",
            hurst, boxes, levels, sums.level_count, lines, sums.line_count, loops, sums.loop_count);
        expect_near("D of boxes", hurst, boxes, wanted, 0.04);
        expect_near("mean D of levels", hurst, levels, wanted, 0.06);
        expect_near("D of lines, converted", hurst, lines, wanted, 0.08);
        expect_near("D of loops, converted", hurst, loops, wanted, 0.08);
    }
}

enum {
    PLACES = 720
};

/* Of 100 times `cell_m` and a bit, so that no opening goes into it evenly. */
static yb_line_t circle(yb_place_t place[PLACES], double radius_m)
{
    for (int i = 0; i < PLACES; i++) {
        const double turn = 2 * acos(-1.0) * i / PLACES;
        place[i] = (yb_place_t){4000 + radius_m * cos(turn), 4000 + radius_m * sin(turn)};
    }
    return (yb_line_t){.height_m = 100, .closed = true, .count = PLACES, .place = place};
}

/* A circle and a straight line of any length have one dimension. Boxes cut off bends of a circle.
 */
static void test_smooth_lines(void **state)
{
    (void)state;
    yb_place_t place[PLACES];
    yb_fractal_fit_t fit;
    for (double size_m = 2000; size_m < 3000; size_m += 130) {
        const yb_line_t ring = circle(place, size_m);
        assert_true(yb_fractal_divider(&ring, 30, &fit));
        expect_near("circle by divider", 1, fit.dimension, 1, 0.02);
        yb_lines_t *lines = yb_lines_new(8000, 8000);
        yb_error_t error;
        yb_fractal_report_t report;
        assert_true(yb_lines_add(lines, 100, true, place, PLACES));
        assert_true(yb_fractal_of_lines(lines, 30, &report, &error));
        expect_near("circle by boxes", 1, report.boxes.dimension, 1, 0.03);
        assert_true(report.dimension == YB_FRACTAL_LEAST);
        yb_fractal_free(&report);
        yb_lines_free(lines);

        yb_place_t ends[] = {{0, 1000}, {8000, 1000 + size_m}};
        const yb_line_t straight = {.height_m = 100, .count = 2, .place = ends};
        assert_true(yb_fractal_divider(&straight, 30, &fit));
        expect_near("straight line by divider", 1, fit.dimension, 1, 0.02);
        lines = yb_lines_new(8000, 8000);
        assert_true(yb_lines_add(lines, 100, false, ends, 2));
        assert_true(yb_fractal_of_lines(lines, 30, &report, &error));
        expect_near("straight line by boxes", 1, report.boxes.dimension, 1, 0.02);
        yb_fractal_free(&report);
        yb_lines_free(lines);
    }
    yb_grid_t *cone = scratch_grid(256, 256, relief_cone);
    yb_fractal_report_t report;
    yb_error_t error;
    assert_true(yb_fractal_of_grid(cone, &report, &error));
    expect_near("cone by boxes", 1, report.boxes.dimension, 0.95, 0.05);
    yb_fractal_free(&report);
    yb_grid_free(cone);
}

/* Koch's curve, by replacing each segment four times: dimension log 4 / log 3. */
static void test_divider_on_koch(void **state)
{
    (void)state;
    enum {
        DEPTH = 6,
        CORNERS = 4096 + 1
    };
    static yb_place_t place[CORNERS];
    place[0] = (yb_place_t){0, 0};
    place[CORNERS - 1] = (yb_place_t){729 * 4, 0};
    for (int span = CORNERS - 1; span > 1; span /= 4)
        for (int i = 0; i + span < CORNERS; i += span) {
            yb_place_t a = place[i];
            yb_place_t b = place[i + span];
            double x = (b.x_m - a.x_m) / 3;
            double y = (b.y_m - a.y_m) / 3;
            place[i + span / 4] = (yb_place_t){a.x_m + x, a.y_m + y};
            place[i + span / 2] =
                (yb_place_t){a.x_m + 1.5 * x - y * sqrt(0.75), a.y_m + 1.5 * y + x * sqrt(0.75)};
            place[i + 3 * span / 4] = (yb_place_t){a.x_m + 2 * x, a.y_m + 2 * y};
        }
    yb_line_t line = {.closed = false, .count = CORNERS, .place = place};
    yb_fractal_fit_t fit;
    assert_true(yb_fractal_divider(&line, 3, &fit));
    assert_true(fit.from_m == 12 && fit.to_m > 4 * fit.from_m && fit.r2 > 0.99);
    assert_true(fabs(fit.dimension - log(4) / log(3)) < 0.03);
}

/* In any order, twice, with spot heights among them: the same. */
static void test_order_of_lines(void **state)
{
    (void)state;
    yb_place_t place[3][PLACES];
    const double height_m[] = {100, 200, 100};
    const double radius_m[] = {3000, 2000, 900};
    yb_lines_t *plain = yb_lines_new(8000, 8000);
    yb_lines_t *mixed = yb_lines_new(8000, 8000);
    for (int i = 0; i < 3; i++) {
        circle(place[i], radius_m[i]);
        assert_true(yb_lines_add(plain, height_m[i], true, place[i], PLACES));
    }
    for (int i = 2; i >= 0; i--) {
        assert_true(yb_lines_add(mixed, height_m[i], true, place[i], PLACES));
        assert_true(yb_lines_add(mixed, 100, false, place[i], 1));
    }
    assert_true(yb_lines_add(mixed, height_m[1], true, place[1], PLACES));
    yb_error_t error;
    yb_fractal_report_t a, b;
    assert_true(yb_fractal_of_lines(plain, 30, &a, &error));
    assert_true(yb_fractal_of_lines(mixed, 30, &b, &error));
    assert_int_equal(a.level_count, 2);
    assert_int_equal(b.level_count, 2);
    assert_int_equal(b.contour_count, 3);
    assert_true(a.boxes.dimension == b.boxes.dimension && a.boxes.sizes == b.boxes.sizes);
    assert_true(b.level[0].height_m == 100 && b.contour[0].length_m > 2 * 3.14 * 2990);
    yb_fractal_free(&a);
    yb_fractal_free(&b);
    yb_lines_free(plain);
    yb_lines_free(mixed);
}

static void test_loop_and_bytes(void **state)
{
    (void)state;
    assert_true(fabs(yb_fractal_from_loop(1.15) - 1.3) < 1e-9);
    assert_true(yb_fractal_from_loop(1.9) == YB_FRACTAL_MOST);
    for (int coded = 0; coded < 256; coded++)
        assert_int_equal(yb_fractal_coded(yb_fractal_dimension((uint8_t)coded)), coded);
    yb_lines_t *none = yb_lines_new(1000, 1000);
    yb_error_t error;
    yb_fractal_report_t report;
    assert_true(yb_fractal_of_lines(none, 10, &report, &error));
    assert_true(report.dimension == YB_FRACTAL_LEAST);
    yb_fractal_free(&report);
    yb_lines_free(none);
}

static void hill(yb_contour_set_t *set)
{
    static const yb_step_t ring[] = {{60, 60}, {180, 60}, {180, 180}, {60, 180}};
    static const yb_step_t summit = {120, 120};
    yb_sketch_begin(set, (SIDE - 1) * 30.0, (SIDE - 1) * 30.0, 0, 1500, 4);
    assert_true(yb_contour_set_append(set, yb_contour_set_height(set, 500), false, ring, 4));
    assert_true(yb_contour_set_append(set, yb_contour_set_height(set, 1000), false, &summit, 1));
}

/* The reference surface at the lattice's points. */
static float *surface_m(const yb_contour_set_t *set, bool detail)
{
    yb_error_t error;
    uint16_t at_q8[256];
    yb_code_file_t *file = yb_contour_code_load(set, &error);
    assert_non_null(file);
    assert_int_equal(set->east, set->north);
    for (int i = 0; i <= set->east; i++)
        at_q8[i] = (uint16_t)(256 * i);
    file->map.detail = detail;
    const uint32_t side = set->east + 1U;
    float *z_m = yb_map_heights_m(&file->map, at_q8, side, at_q8, side);
    assert_non_null(z_m);
    yb_code_file_free(file);
    return z_m;
}

/* What detail adds to a hill that is coded with the dimension: how far it rises over a few lags. */
static void noise_rises(double dimension, double rise_m[3])
{
    yb_contour_set_t set;
    hill(&set);
    set.gain = 16;
    set.dimension = yb_fractal_coded(dimension);
    float *z_m = surface_m(&set, true);
    float *smooth_m = surface_m(&set, false);
    const uint32_t side = set.east + 1U;
    for (uint32_t i = 0; i < side * side; i++)
        z_m[i] -= smooth_m[i];
    for (uint32_t i = 0; i < 3; i++)
        rise_m[i] = yb_roughness_rise_m(z_m, side, side, 1U << i);
    free(z_m);
    free(smooth_m);
}

/* H = 2 - D and not D - 1, which the paper prints: more dimension makes more fine relief, and the
 * noise grows less over distance. If H were D - 1, each D would do what 3 - D does, so that both
 * would go the other way.
 */
static void test_larger_dimension_is_rougher(void **state)
{
    (void)state;
    double before_m = 0, before_hurst = 1;
    for (double dimension = 1.15; dimension < 1.7; dimension += 0.15) {
        double rise_m[3];
        noise_rises(dimension, rise_m);
        const double hurst = log2(rise_m[2] / rise_m[0]) / 2;
        print_message("D %.2f: noise rises %.2f m over a step, as lag^%.2f\n", dimension, rise_m[0],
                      hurst);
        assert_true(rise_m[0] > 1.5 * before_m);
        assert_true(hurst < before_hurst - 0.03);
        before_m = rise_m[0];
        before_hurst = hurst;
    }
}

/* A map's own surface has its own gain. */
static void test_gain_is_found_again(void **state)
{
    (void)state;
    static const uint8_t gains[] = {0, 5, 24, 100};
    for (int i = 0; i < 4; i++) {
        yb_contour_set_t set;
        hill(&set);
        set.dimension = yb_fractal_coded(1.3);
        set.gain = gains[i];
        float *z_m = surface_m(&set, true);
        const int side = set.east + 1;
        yb_grid_t *grid = yb_grid_new(side, side, yb_unit_m(set.cell));
        for (int row = 0; row < side; row++)
            memcpy(grid->height_m + row * side, z_m + (side - 1 - row) * side,
                   (size_t)side * sizeof(float));
        free(z_m);
        yb_grid_measure(grid);
        set.gain = 77;
        assert_true(yb_fractal_gain(&set, grid));
        if (abs(set.gain - gains[i]) > gains[i] / 25)
            fail_msg("gain %d is found as %d", gains[i], set.gain);
        yb_grid_free(grid);
    }
}

static void test_gain_follows_roughness(void **state)
{
    (void)state;
    uint8_t gain[2];
    yb_contour_set_t set;
    static float other_m[SIDE * SIDE];
    for (int i = 0; i < 2; i++) {
        yb_grid_t *grid = yb_grid_new(SIDE, SIDE, 30);
        assert_true(fractional_surfaces(i == 0 ? 0.3 : 0.8, 1, 500, grid->height_m, other_m));
        yb_grid_measure(grid);
        hill(&set);
        set.dimension = yb_fractal_coded(1.4);
        assert_true(yb_fractal_gain(&set, grid));
        gain[i] = set.gain;
        yb_grid_free(grid);
    }
    assert_true(gain[0] > 2 * gain[1]);
}

static void test_gain_of_the_impossible(void **state)
{
    (void)state;
    static const yb_step_t across[] = {{120, 20}, {130, 20}, {130, 200}, {120, 200}};
    yb_grid_t *grid = scratch_grid(SIDE, SIDE, relief_range);
    yb_contour_set_t set;
    hill(&set);
    assert_true(yb_contour_set_append(&set, yb_contour_set_height(&set, 700), false, across, 4));
    set.gain = 77;
    assert_false(yb_fractal_gain(&set, grid));
    assert_int_equal(set.gain, 77);
    yb_grid_free(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dimensions),
        cmocka_unit_test(test_smooth_lines),
        cmocka_unit_test(test_divider_on_koch),
        cmocka_unit_test(test_order_of_lines),
        cmocka_unit_test(test_loop_and_bytes),
        cmocka_unit_test(test_larger_dimension_is_rougher),
        cmocka_unit_test(test_gain_is_found_again),
        cmocka_unit_test(test_gain_follows_roughness),
        cmocka_unit_test(test_gain_of_the_impossible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
