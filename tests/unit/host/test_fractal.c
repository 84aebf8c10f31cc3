/* Dimensions measured on surfaces and lines whose dimension is known. */
#include "fractal.h"
#include "scratch.h"
#include "sketch.h"

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
    SIDE = 257,
    LEVELS = 7
};

static uint32_t seed;

/* A sum of three uniform numbers: near enough to a normal one. */
static double noise(void)
{
    double sum = -1.5;
    for (int i = 0; i < 3; i++) {
        seed = seed * 1664525U + 1013904223U;
        sum += (double)(seed >> 8) / 16777216.0;
    }
    return 2 * sum;
}

static float mean_around(const float *z, int x, int y, int step, bool diagonal)
{
    static const int near[2][4][2] = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}},
                                      {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    float sum = 0;
    int count = 0;
    for (int i = 0; i < 4; i++) {
        int column = x + step * near[diagonal ? 1 : 0][i][0];
        int row = y + step * near[diagonal ? 1 : 0][i][1];
        if (column >= 0 && row >= 0 && column < SIDE && row < SIDE) {
            sum += z[row * SIDE + column];
            count++;
        }
    }
    return sum / (float)count;
}

/* A fractional surface by midpoint displacement, all points disturbed at each step. */
static yb_grid_t *rough_surface(double hurst)
{
    yb_grid_t *grid = yb_grid_new(SIDE, SIDE, 30);
    assert_non_null(grid);
    float *z = grid->height_m;
    double size = 500;
    seed = 7;
    for (int step = (SIDE - 1) / 2; step >= 1; step /= 2) {
        for (int y = step; y < SIDE; y += 2 * step)
            for (int x = step; x < SIDE; x += 2 * step)
                z[y * SIDE + x] = mean_around(z, x, y, step, true);
        for (int y = 0; y < SIDE; y += step)
            for (int x = (y / step) % 2 == 0 ? step : 0; x < SIDE; x += 2 * step)
                z[y * SIDE + x] = mean_around(z, x, y, step, false);
        for (int y = 0; y < SIDE; y += step)
            for (int x = 0; x < SIDE; x += step)
                z[y * SIDE + x] += (float)(size * noise());
        size *= pow(2, -hurst);
    }
    yb_grid_measure(grid);
    return grid;
}

static double dimension_of(const yb_grid_t *grid)
{
    yb_error_t error;
    double level_m[LEVELS];
    for (int i = 0; i < LEVELS; i++)
        level_m[i] = yb_sketch_quantile(grid, (i + 1.0) / (LEVELS + 1));
    yb_lines_t *lines = yb_lines_from_grid(grid, level_m, LEVELS, &error);
    assert_non_null(lines);
    double dimension = yb_fractal_boxes(lines, grid->cell_m);
    yb_lines_free(lines);
    return dimension;
}

static void test_rougher_is_larger(void **state)
{
    (void)state;
    double before = 2;
    for (double hurst = 0.3; hurst < 1; hurst += 0.2) {
        yb_grid_t *grid = rough_surface(hurst);
        double dimension = dimension_of(grid);
        assert_true(dimension < before);
        assert_true(fabs(dimension - (2 - hurst)) < 0.2);
        before = dimension;
        yb_grid_free(grid);
    }
}

static void test_smooth_line(void **state)
{
    (void)state;
    yb_grid_t *grid = scratch_grid(256, 256, relief_cone);
    assert_true(dimension_of(grid) < 1.1);
    yb_grid_free(grid);
}

/* Koch's curve, by replacing each segment four times: dimension log 4 / log 3. */
static void test_divider_on_koch(void **state)
{
    (void)state;
    enum {
        DEPTH = 6,
        PLACES = 4096 + 1
    };
    static yb_place_t place[PLACES];
    place[0] = (yb_place_t){0, 0};
    place[PLACES - 1] = (yb_place_t){729 * 4, 0};
    for (int span = PLACES - 1; span > 1; span /= 4)
        for (int i = 0; i + span < PLACES; i += span) {
            yb_place_t a = place[i];
            yb_place_t b = place[i + span];
            double x = (b.x_m - a.x_m) / 3;
            double y = (b.y_m - a.y_m) / 3;
            place[i + span / 4] = (yb_place_t){a.x_m + x, a.y_m + y};
            place[i + span / 2] =
                (yb_place_t){a.x_m + 1.5 * x - y * sqrt(0.75), a.y_m + 1.5 * y + x * sqrt(0.75)};
            place[i + 3 * span / 4] = (yb_place_t){a.x_m + 2 * x, a.y_m + 2 * y};
        }
    yb_line_t line = {.closed = false, .count = PLACES, .place = place};
    double dimension = yb_fractal_divider(&line, 3);
    assert_true(fabs(dimension - log(4) / log(3)) < 0.06);
}

static void test_loop_and_bytes(void **state)
{
    (void)state;
    assert_true(fabs(yb_fractal_from_loop(1.15) - 1.3) < 1e-9);
    assert_true(yb_fractal_from_loop(1.9) == YB_FRACTAL_MOST);
    for (int coded = 0; coded < 256; coded++)
        assert_int_equal(yb_fractal_coded(yb_fractal_dimension((uint8_t)coded)), coded);
    yb_lines_t *none = yb_lines_new(1000, 1000);
    assert_true(yb_fractal_boxes(none, 10) == YB_FRACTAL_LEAST);
    yb_lines_free(none);
}

static void test_gain_follows_roughness(void **state)
{
    (void)state;
    yb_grid_t *rough = rough_surface(0.4);
    yb_grid_t *smooth = scratch_grid(SIDE, SIDE, relief_range);
    yb_paper_t paper;
    uint8_t gain[2];
    const yb_grid_t *grid[2] = {rough, smooth};
    for (int i = 0; i < 2; i++) {
        yb_sketch_begin(&paper, yb_grid_width_m(rough), yb_grid_depth_m(rough), 0, 1500, 2);
        yb_step_t ring[] = {{60, 60}, {180, 60}, {180, 180}, {60, 180}};
        yb_step_t summit = {120, 120};
        yb_paper_append(&paper, yb_paper_height(&paper, 500), false, ring, 4);
        yb_paper_append(&paper, yb_paper_height(&paper, 1000), false, &summit, 1);
        paper.dimension = yb_fractal_coded(1.4);
        assert_true(yb_fractal_gain(&paper, grid[i]));
        gain[i] = paper.gain;
    }
    assert_true(gain[0] > 2 * gain[1]);
    yb_grid_free(rough);
    yb_grid_free(smooth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rougher_is_larger),      cmocka_unit_test(test_smooth_line),
        cmocka_unit_test(test_divider_on_koch),        cmocka_unit_test(test_loop_and_bytes),
        cmocka_unit_test(test_gain_follows_roughness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
