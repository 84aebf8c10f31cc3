/* K of shapes whose K is known. */
#include "codes.h"
#include "similarity.h"

#include <math.h>
#include <string.h>

enum {
    MOST_POINTS = 720
};
static const double frame = 100;

typedef struct {
    yb_point2_t point[MOST_POINTS];
    yb_isoline_t line;
} shape_t;

static yb_isolines_t one(shape_t *shape)
{
    return (yb_isolines_t){&shape->line, 1};
}

static void circle(shape_t *shape, double x, double y, double radius, bool clockwise)
{
    shape->line = (yb_isoline_t){.point = shape->point, .count = MOST_POINTS, .closed = true};
    for (int i = 0; i < MOST_POINTS; i++) {
        const double angle = 2 * acos(-1.0) * i / MOST_POINTS * (clockwise ? -1 : 1);
        shape->point[i] = (yb_point2_t){x + radius * cos(angle), y + radius * sin(angle)};
    }
}

/* A square of side 40 that is cut into 160 equal segments. */
static void square(shape_t *shape, double x, double y)
{
    shape->line = (yb_isoline_t){.point = shape->point, .count = 160, .closed = true};
    for (int i = 0; i < 40; i++) {
        shape->point[i] = (yb_point2_t){x + i, y};
        shape->point[i + 40] = (yb_point2_t){x + 40, y + i};
        shape->point[i + 80] = (yb_point2_t){x + 40 - i, y + 40};
        shape->point[i + 120] = (yb_point2_t){x, y + 40 - i};
    }
}

/* From the western to the eastern side of the frame, or back. */
static void level_line(shape_t *shape, double y, bool westward)
{
    shape->line = (yb_isoline_t){.point = shape->point, .count = 101};
    for (int i = 0; i <= 100; i++)
        shape->point[i] = (yb_point2_t){westward ? 100 - i : i, y};
}

static yb_similarity_t measure(const shape_t *coded, yb_isolines_t originals,
                               yb_isolines_t reproductions)
{
    yb_similarity_t similarity;
    assert_true(
        yb_similarity_measure(&similarity, &coded->line, &originals, &reproductions, frame, frame));
    return similarity;
}

static void assert_near(double value, double expected)
{
    if (fabs(value - expected) > 1e-3)
        fail_msg("%.6f is not %.6f", value, expected);
}

static void identical_shapes_have_k_1(void **state)
{
    (void)state;
    shape_t a, b;
    circle(&a, 50, 50, 30, false);
    circle(&b, 50, 50, 30, true);
    assert_near(measure(&a, one(&a), one(&a)).k, 1);
    assert_near(measure(&a, one(&b), one(&a)).k, 1);
    assert_near(measure(&a, one(&a), one(&a)).length, 2 * acos(-1.0) * 30);
    square(&a, 20, 30);
    assert_near(measure(&a, one(&a), one(&a)).k, 1);
    level_line(&a, 40, false);
    level_line(&b, 40, true);
    assert_near(measure(&a, one(&b), one(&a)).k, 1);
}

static void a_smaller_circle(void **state)
{
    (void)state;
    shape_t large, small;
    circle(&large, 50, 50, 30, false);
    circle(&small, 50, 50, 24, false);
    const yb_similarity_t similarity = measure(&large, one(&large), one(&small));
    assert_near(similarity.area, 0.64);
    assert_near(similarity.distance, 0.8);
    assert_near(similarity.curvature, 1);
    assert_near(similarity.k, (0.64 + 0.8 + 1) / 3);
    assert_near(similarity.hausdorff, 6);
}

static void a_square_moved_aside(void **state)
{
    (void)state;
    shape_t a, b;
    square(&a, 20, 30);
    square(&b, 25, 30);
    const yb_similarity_t similarity = measure(&a, one(&a), one(&b));
    assert_near(similarity.area, 35.0 / 45);
    assert_near(similarity.hausdorff, 5);
    assert_near(similarity.distance, 1 - 5 / (40 / sqrt(acos(-1.0))));
}

static void far_apart_is_not_below_0(void **state)
{
    (void)state;
    shape_t large, small;
    circle(&large, 50, 50, 45, false);
    circle(&small, 90, 50, 3, false);
    const yb_similarity_t similarity = measure(&large, one(&large), one(&small));
    assert_near(similarity.distance, 0);
    assert_true(similarity.k > 0 && similarity.k < 0.4);
}

/* Dents turn the other way: a circle against a flower of 4 petals, each 4 steps wide. */
static void dents_cost_curvature(void **state)
{
    (void)state;
    shape_t round, flower;
    circle(&round, 50, 50, 30, false);
    circle(&flower, 50, 50, 30, false);
    for (int i = 0; i < MOST_POINTS; i++) {
        const double angle = 2 * acos(-1.0) * i / MOST_POINTS;
        const double radius = 30 + 5 * cos(4 * angle);
        flower.point[i] = (yb_point2_t){50 + radius * cos(angle), 50 + radius * sin(angle)};
    }
    const yb_similarity_t similarity = measure(&round, one(&round), one(&flower));
    assert_true(similarity.curvature < 0.7);
    assert_true(similarity.curvature > 0.3);
    assert_true(similarity.area > 0.75);
}

static void a_missing_line_has_k_0(void **state)
{
    (void)state;
    shape_t a, b;
    circle(&a, 30, 30, 10, false);
    circle(&b, 70, 70, 10, false);
    const yb_isolines_t none = {0};
    yb_similarity_t similarity = measure(&a, one(&a), none);
    assert_true(similarity.k == 0);
    assert_true(similarity.original == 0);
    assert_true(similarity.reproduced == YB_NO_LINE);
    assert_true(similarity.length > 60);
    similarity = measure(&a, one(&a), one(&b));
    assert_true(similarity.k == 0);
    assert_true(similarity.reproduced == YB_NO_LINE);
    similarity = measure(&a, none, one(&a));
    assert_true(similarity.k == 0);
    assert_true(similarity.original == YB_NO_LINE);
}

/* All of the frame but a strip is no original of a small circle; of a large one it is. */
static void the_larger_part_must_fit(void **state)
{
    (void)state;
    shape_t polygon, line;
    circle(&polygon, 50, 50, 20, false);
    level_line(&line, 1, false);
    yb_similarity_t similarity = measure(&polygon, one(&line), one(&line));
    assert_true(similarity.k == 0);
    assert_true(similarity.original == YB_NO_LINE);
    circle(&polygon, 50, 51, 45, false);
    similarity = measure(&polygon, one(&line), one(&line));
    assert_near(similarity.k, 1);
}

static void open_lines_are_closed_along_the_frame(void **state)
{
    (void)state;
    shape_t a, b;
    level_line(&a, 40, false);
    level_line(&b, 50, true);
    const yb_similarity_t similarity = measure(&a, one(&a), one(&b));
    /* The smaller part of the frame is the southern one: 40 of 100. */
    assert_near(similarity.area, 0.8);
    assert_near(similarity.hausdorff, 10);
    assert_near(similarity.distance, 1 - 10 / sqrt(4000 / acos(-1.0)));
    assert_near(similarity.curvature, 1);
    assert_near(similarity.length, 100);
}

/* A circle that only just touches the frame is an open line; K hardly knows. */
static void touching_the_frame_costs_little(void **state)
{
    (void)state;
    shape_t round, open;
    circle(&round, 30.2, 50, 30, false);
    circle(&open, 0, 0, 1, false);
    open.line.closed = false;
    open.line.count = 0;
    for (int i = 0; i < MOST_POINTS; i++) {
        const double angle = 2 * acos(-1.0) * i / MOST_POINTS - acos(-1.0);
        const yb_point2_t point = {29.8 + 30 * cos(angle), 50 + 30 * sin(angle)};
        if (point.x > 0)
            open.point[open.line.count++] = point;
    }
    open.point[0].x = 0;
    open.point[open.line.count - 1].x = 0;
    const yb_similarity_t similarity = measure(&round, one(&round), one(&open));
    assert_true(similarity.area > 0.97);
    assert_true(similarity.distance > 0.95);
    assert_true(similarity.curvature > 0.9);
    assert_true(measure(&round, one(&open), one(&round)).k > 0.9);
}

static void the_largest_overlap_is_chosen(void **state)
{
    (void)state;
    shape_t coded, near, far, speck;
    circle(&coded, 40, 40, 20, false);
    circle(&near, 42, 40, 20, false);
    circle(&far, 60, 40, 20, false);
    circle(&speck, 40, 40, 1, false);
    yb_isoline_t list[3] = {far.line, speck.line, near.line};
    const yb_isolines_t lines = {list, 3};
    const yb_similarity_t similarity = measure(&coded, lines, lines);
    assert_int_equal(similarity.original, 2);
    assert_int_equal(similarity.reproduced, 2);
    assert_near(similarity.k, 1);
}

static void lengths_are_the_weights(void **state)
{
    (void)state;
    const yb_similarity_t all[] = {{.k = 1, .length = 30}, {.k = 0, .length = 10}};
    assert_near(yb_similarity_mean(all, 2), 0.75);
    assert_near(yb_similarity_mean(all, 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(identical_shapes_have_k_1),
        cmocka_unit_test(a_smaller_circle),
        cmocka_unit_test(a_square_moved_aside),
        cmocka_unit_test(far_apart_is_not_below_0),
        cmocka_unit_test(dents_cost_curvature),
        cmocka_unit_test(a_missing_line_has_k_0),
        cmocka_unit_test(the_larger_part_must_fit),
        cmocka_unit_test(open_lines_are_closed_along_the_frame),
        cmocka_unit_test(touching_the_frame_costs_little),
        cmocka_unit_test(the_largest_overlap_is_chosen),
        cmocka_unit_test(lengths_are_the_weights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
