/* What the encoder's search is made of: changes in batches, and how the judge divides them. */
#include "contour_code.h"
#include "encode.h"
#include "scratch.h"
#include "search_batch.h"
#include "simplify.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "compact_code.h"

/* A relief, a code of it, and its judge. */
typedef struct {
    yb_grid_t *grid;
    yb_judge_t *judge;
    yb_contour_set_t set;
    double score_m;
} scene_t;

static double judge(const scene_t *scene, const yb_contour_set_t *set)
{
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    size_t size = yb_contour_code_write(set, code, sizeof(code), NULL);
    return size > 0 ? yb_judge_score_m(scene->judge, code, size) : -1;
}

static int set_up(void **state)
{
    static scene_t scene;
    scene.grid = scratch_grid(64, 64, relief_range);
    const yb_encode_task_t task = {
        .profile = YB_COMPACT, .most_bytes = 150, .seed = 1, .effort = 1, .threads = 1};
    yb_encode_result_t result;
    yb_error_t error;
    if (!yb_encode_grid(scene.grid, &task, &result, &error))
        return -1;
    yb_compact_read(result.code, &scene.set);
    yb_encode_result_free(&result);
    scene.set.most_vertices = 0;
    scene.set.sections = NULL;
    scene.judge = yb_judge_new(scene.grid, 48);
    scene.score_m = judge(&scene, &scene.set);
    yb_judge_keep(scene.judge);
    *state = &scene;
    return scene.score_m > 0 ? 0 : -1;
}

static int tear_down(void **state)
{
    scene_t *scene = *state;
    yb_judge_free(scene->judge);
    yb_grid_free(scene->grid);
    return 0;
}

/* Every contour beside all others. */
static bool all_apart(const yb_contour_set_t *set)
{
    for (int i = 0; i < set->contour_count; i++) {
        yb_contour_set_t others = *set;
        yb_contour_set_drop(&others, i);
        if (!yb_simplify_fits(&others, &set->point[yb_contour_set_first(set, i)],
                              set->contour[i].count, set->contour[i].open))
            return false;
    }
    return true;
}

static void test_batches(void **state)
{
    scene_t *scene = *state;
    const yb_search_t search = {
        .grid = scene->grid, .judge = scene->judge, .most_bytes = 150, .many = true};
    static yb_contour_set_t next;
    yb_search_mover_t mover = {.search = &search, .random = 5, .heat = 0.5, .set = &next};
    assert_true(all_apart(&scene->set));
    int kinds[YB_MOVE_SPOT + 1] = {0};
    for (int i = 0; i < 300; i++) {
        yb_batch_t batch;
        yb_judge_site_t site[YB_BATCH_SITES];
        yb_batch_draw(&batch, &mover, &scene->set, 1 + i % YB_BATCH_CHANGES);
        assert_in_range(batch.count, 0, 1 + i % YB_BATCH_CHANGES);
        assert_true(all_apart(&next));
        int points = scene->set.point_count;
        for (int k = 0; k < batch.count; k++) {
            yb_local_move_t kind = batch.change[k].kind;
            kinds[kind]++;
            points += kind == YB_MOVE_INSERT || kind == YB_MOVE_SPOT ? 1 : 0;
            points -= kind == YB_MOVE_REMOVE ? 1 : 0;
            assert_true(k == 0 || batch.change[k].point < batch.change[k - 1].point);
        }
        assert_int_equal(next.point_count, points);
        int sites = yb_batch_sites(&batch, &scene->set, site);
        assert_in_range(sites, batch.count, YB_BATCH_SITES);
        /* Without changes it is what it was. */
        batch.count = 0;
        yb_batch_apply(&batch, &scene->set, &next);
        assert_memory_equal(&next, &scene->set, sizeof(next));
    }
    for (int k = 0; k <= YB_MOVE_SPOT; k++)
        assert_true(kinds[k] > 10);
}

/* However many sites share it, it is the same difference; and it falls to the site where it is. */
static void test_difference_is_divided(void **state)
{
    scene_t *scene = *state;
    yb_contour_set_t moved = scene->set;
    moved.corner[0] = (uint16_t)(moved.corner[0] + 5);
    moved.corners |= 1;
    double score_m = judge(scene, &moved);
    assert_true(score_m > 0);
    const yb_judge_site_t site[] = {{0.9, 0.9, 0}, {0.05, 0.05, 1}, {0.8, 0.1, 2}};
    double one[1];
    double three[3];
    yb_judge_divide(scene->judge, site, 1, one, 1);
    yb_judge_divide(scene->judge, site, 3, three, 3);
    assert_true(one[0] != 0);
    assert_true(fabs(three[0] + three[1] + three[2] - one[0]) < 1e-9);
    assert_true(fabs(three[1]) > 10 * fabs(three[0]));
    /* The highest place counts in the score only. */
    double square = (score_m * score_m / (scene->score_m * scene->score_m) - 1) / 2;
    assert_true(fabs(one[0] - square) < 0.1 * fabs(square) + 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_batches),
        cmocka_unit_test(test_difference_is_divided),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
