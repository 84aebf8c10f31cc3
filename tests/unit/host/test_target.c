/* Codes that reach a similarity: found on reliefs made here, and as good as they say. */
#include "target.h"

#include "comparison.h"
#include "fidelity.h"
#include "level_cut.h"
#include "line_grid.h"
#include "line_judge.h"
#include "scratch.h"
#include "surface.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* K as evaluate says it. */
static double measured_k(const yb_code_file_t *code, const yb_grid_t *grid, const yb_lines_t *lines)
{
    yb_error_t error;
    yb_comparison_t comparison;
    yb_fidelity_t fidelity;
    if (!yb_comparison_make(&comparison, code, grid, lines, &error))
        fail_msg("%s", error.text);
    assert_true(yb_fidelity_measure(&fidelity, code, &comparison));
    double k = fidelity.k;
    yb_fidelity_free(&fidelity);
    yb_comparison_free(&comparison);
    return k;
}

/* Different heights of a code's lines. */
static int heights_of(const yb_code_file_t *code)
{
    int heights = 0;
    for (int i = 0; i < code->load.contour_count; i++) {
        const yb_contour_t *contour = &code->load.contour[i];
        bool found = contour->count == 1;
        for (int k = 0; k < i; k++)
            found = found || (code->load.contour[k].count > 1 &&
                              code->map.vertex[code->load.contour[k].first].z_q8 ==
                                  code->map.vertex[contour->first].z_q8);
        heights += found ? 0 : 1;
    }
    return heights;
}

/* Whether a spot height lies within a tenth of a standard deviation of the highest place. */
static bool has_summit(const yb_code_file_t *code, const yb_grid_t *grid)
{
    for (int i = 0; i < code->load.contour_count; i++) {
        const yb_contour_t *contour = &code->load.contour[i];
        double height_m = yb_map_z_m(&code->map, code->map.vertex[contour->first].z_q8);
        if (contour->count == 1 && fabs(height_m - (double)grid->high_m) < grid->std_m / 10)
            return true;
    }
    return false;
}

/* And the same bytes again. */
static void test_target_is_reached(void **state)
{
    (void)state;
    yb_error_t error;
    yb_encode_result_t result[2];
    yb_grid_t *grid = scratch_grid(40, 30, relief_range);
    yb_encode_task_t task = {.most_bytes = 104, .profile = YB_COMPACT, .seed = 1, .effort = 1};
    for (int i = 0; i < 2; i++)
        if (!yb_target_grid(grid, &task, 0.75, &result[i], &error))
            fail_msg("%s", error.text);
    const yb_code_file_t *code = result[0].code;
    assert_true(code->size <= 104);
    assert_true(result[0].k >= 0.75);
    assert_true(fabs(result[0].k - measured_k(code, grid, NULL)) < 1e-12);
    assert_true(heights_of(code) >= 3);
    assert_true(has_summit(code, grid));
    assert_true(code->load.gain > 0);
    assert_true(result[0].rmse_m / result[0].std_m < 0.35);
    assert_int_equal(code->size, result[1].code->size);
    assert_memory_equal(code->bytes, result[1].code->bytes, code->size);
    for (int i = 0; i < 2; i++)
        yb_encode_result_free(&result[i]);
    yb_grid_free(grid);
}

static void test_paper_profile(void **state)
{
    (void)state;
    yb_error_t error;
    yb_encode_result_t result;
    yb_grid_t *grid = scratch_grid(32, 32, relief_cone);
    yb_encode_task_t task = {.most_bytes = 104, .profile = YB_PAPER, .seed = 1, .effort = 1};
    if (!yb_target_grid(grid, &task, 0.7, &result, &error))
        fail_msg("%s", error.text);
    assert_int_equal(result.code->bytes[0] & 0xf, YB_PAPER);
    assert_true(measured_k(result.code, grid, NULL) >= 0.7);
    yb_encode_result_free(&result);
    yb_grid_free(grid);
}

/* Sections and the bound on the mesh are kept, and the certificate is true. */
static void test_task_is_kept(void **state)
{
    (void)state;
    yb_error_t error;
    yb_encode_result_t result;
    yb_grid_t *grid = scratch_grid(32, 32, relief_range);
    const yb_sections_t sections = {
        .certified = true, .placed = true, .lon_deg = 9.5, .lat_deg = 46.5, .name = "Monte"};
    yb_encode_task_t task = {.most_bytes = 80,
                             .profile = YB_COMPACT,
                             .seed = 1,
                             .effort = 1,
                             .vertices = 48,
                             .sections = &sections};
    if (!yb_target_grid(grid, &task, 0.5, &result, &error))
        fail_msg("%s", error.text);
    const yb_code_file_t *code = result.code;
    assert_true(code->size <= 80);
    assert_true(code->map.vertex_count <= 48);
    assert_string_equal(code->sections.name, "Monte");
    assert_true(code->sections.placed);
    assert_true(code->sections.certified);
    assert_true(result.k >= 0.5);
    assert_true(fabs(result.k - measured_k(code, grid, NULL)) < 1e-12);
    assert_int_equal(code->map.certified_k, (int)floor(result.k * 255));
    yb_encode_result_free(&result);
    task.most_bytes = YB_ENCODE_LEAST_BYTES + 15;
    assert_false(yb_target_grid(grid, &task, 0.5, &result, &error));
    assert_non_null(strstr(error.text, "the least is 39"));
    yb_grid_free(grid);
}

static void test_out_of_reach(void **state)
{
    (void)state;
    yb_error_t error;
    yb_encode_result_t result;
    yb_grid_t *grid = scratch_grid(32, 32, relief_range);
    yb_encode_task_t task = {.most_bytes = 40, .profile = YB_COMPACT, .seed = 1, .effort = 1};
    assert_false(yb_target_grid(grid, &task, 0.99, &result, &error));
    assert_non_null(strstr(error.text, "--bytes"));
    task.most_bytes = YB_ENCODE_LEAST_BYTES - 1;
    assert_false(yb_target_grid(grid, &task, 0.5, &result, &error));
    assert_non_null(strstr(error.text, "the least is 23"));
    yb_grid_free(grid);
}

/* Rings round the middle of a frame of 4000 m by 3000 m. */
static yb_lines_t *make_rings(void)
{
    enum {
        PLACES = 60
    };
    yb_lines_t *lines = yb_lines_new(4000, 3000);
    assert_non_null(lines);
    for (int ring = 0; ring < 4; ring++) {
        yb_place_t place[PLACES];
        for (int i = 0; i < PLACES; i++) {
            double angle = 2 * acos(-1.0) * i / PLACES;
            double radius = (1200 - 250 * ring) * (1 + 0.15 * sin(3 * angle));
            place[i] = (yb_place_t){2000 + radius * cos(angle), 1500 + radius * sin(angle)};
        }
        assert_true(yb_lines_add(lines, 100 + 50 * ring, true, place, PLACES));
    }
    return lines;
}

static void test_lines(void **state)
{
    (void)state;
    yb_error_t error;
    yb_encode_result_t result;
    yb_lines_t *lines = make_rings();
    yb_encode_task_t task = {.most_bytes = 104, .profile = YB_COMPACT, .seed = 1, .effort = 2};
    if (!yb_target_lines(lines, &task, 0.75, &result, &error))
        fail_msg("%s", error.text);
    yb_grid_t *grid = yb_line_grid_new(lines, &error);
    assert_non_null(grid);
    assert_true(result.k >= 0.75);
    assert_true(fabs(result.k - measured_k(result.code, grid, lines)) < 1e-12);
    yb_grid_free(grid);
    yb_encode_result_free(&result);
    task.levels = 3;
    assert_false(yb_target_lines(lines, &task, 0.75, &result, &error));
    assert_non_null(strstr(error.text, "leave out --levels"));
    yb_lines_free(lines);
}

/* What the search measures is what is measured in the end; and the isolines cut at one height are
 * those of the whole surface.
 */
static void test_fast_figures(void **state)
{
    (void)state;
    yb_error_t error;
    yb_encode_result_t made;
    yb_grid_t *grid = scratch_grid(64, 64, relief_range);
    yb_encode_task_t task = {.most_bytes = 100, .profile = YB_COMPACT, .seed = 1, .effort = 1};
    if (!yb_encode_grid(grid, &task, &made, &error))
        fail_msg("%s", error.text);
    const yb_map_t *map = &made.code->map;
    yb_line_score_t score;
    yb_line_judge_t *judge = yb_line_judge_new(grid, NULL, map->east_q8 / 256, map->north_q8 / 256);
    assert_non_null(judge);
    assert_true(yb_line_judge_score(judge, made.code->bytes, made.code->size, YB_REFERENCE_Q8,
                                    &score, NULL));
    assert_true(fabs(score.k - measured_k(made.code, grid, NULL)) < 0.01);
    yb_mesh_t mesh;
    assert_true(yb_mesh_from_map(&mesh, map, YB_REFERENCE_Q8));
    yb_level_cut_t *cut = yb_level_cut_new();
    assert_non_null(cut);
    int32_t middle_q8 = map->low_q8 + (map->high_q8 - map->low_q8) / 2;
    yb_isolines_t whole = {0};
    assert_true(yb_isolines_add(&whole, &mesh, yb_map_z_m(map, middle_q8)));
    const yb_isolines_t *part = yb_level_cut_lines(cut, map, middle_q8, YB_REFERENCE_Q8);
    assert_non_null(part);
    size_t longest[2] = {0, 0};
    for (size_t i = 0; i < whole.count; i++)
        longest[0] = whole.line[i].count > longest[0] ? whole.line[i].count : longest[0];
    for (size_t i = 0; i < part->count; i++)
        longest[1] = part->line[i].count > longest[1] ? part->line[i].count : longest[1];
    assert_true(longest[0] > 10);
    assert_int_equal(longest[0], longest[1]);
    yb_isolines_free(&whole);
    yb_level_cut_free(cut);
    yb_mesh_free(&mesh);
    yb_line_judge_free(judge);
    yb_encode_result_free(&made);
    yb_grid_free(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_target_is_reached), cmocka_unit_test(test_paper_profile),
        cmocka_unit_test(test_out_of_reach),      cmocka_unit_test(test_lines),
        cmocka_unit_test(test_fast_figures),      cmocka_unit_test(test_task_is_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
