/* Contour lines from grids and from vector files. */
#include "contour_lines.h"
#include "line_grid.h"
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

static bool on_frame(const yb_lines_t *lines, yb_place_t at)
{
    return at.x_m == 0 || at.y_m == 0 || at.x_m == lines->width_m || at.y_m == lines->depth_m;
}

static void test_closed_or_from_frame_to_frame(void **state)
{
    (void)state;
    yb_error_t error;
    yb_grid_t *grid = scratch_grid(120, 90, relief_range);
    const double level_m[] = {450, 600, 800, 1000};
    yb_lines_t *lines = yb_lines_from_grid(grid, level_m, 4, &error);
    assert_non_null(lines);
    assert_true(lines->count >= 4);
    int closed = 0;
    for (int i = 0; i < lines->count; i++) {
        const yb_line_t *line = &lines->line[i];
        closed += line->closed;
        if (!line->closed) {
            assert_true(on_frame(lines, line->place[0]));
            assert_true(on_frame(lines, line->place[line->count - 1]));
        }
        for (int k = 0; k < line->count; k++)
            assert_true(fabs(yb_grid_height(grid, line->place[k].x_m, line->place[k].y_m) -
                             line->height_m) < 5);
    }
    assert_in_range(closed, 1, lines->count - 1);
    yb_lines_free(lines);
    yb_grid_free(grid);
}

static void test_circle(void **state)
{
    (void)state;
    yb_error_t error;
    yb_grid_t *grid = scratch_grid(201, 201, relief_cone);
    const double level_m = 640; /* radius 0.2 of 6000 m */
    yb_lines_t *lines = yb_lines_from_grid(grid, &level_m, 1, &error);
    assert_non_null(lines);
    assert_int_equal(lines->count, 1);
    assert_true(lines->line[0].closed);
    assert_true(fabs(yb_line_length_m(&lines->line[0]) / (2 * 3.14159265 * 1200) - 1) < 0.01);
    assert_true(fabs(yb_line_area_m2(&lines->line[0]) / (3.14159265 * 1200 * 1200) - 1) < 0.01);
    yb_lines_free(lines);
    yb_grid_free(grid);
}

#define SQUARE(lo, hi)                                                                             \
    "[[" lo "," lo "],[" hi "," lo "],[" hi "," hi "],[" lo "," hi "],[" lo "," lo "]]"
#define LINE(name, height, coordinates)                                                            \
    "{\"type\":\"Feature\",\"properties\":{\"" name "\":" height "},\"geometry\":{\"type\":"       \
    "\"LineString\",\"coordinates\":" coordinates "}}"
#define LOCAL "\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:32632\"}},"

static void collection(const char *path, const char *features)
{
    char text[4096];
    snprintf(text, sizeof(text), "{\"type\":\"FeatureCollection\"," LOCAL "\"features\":[%s]}",
             features);
    scratch_text(path, text);
}

static yb_lines_t *read_lines(const char *path, const char *field, yb_error_t *error)
{
    yb_window_t window = {.kind = YB_WINDOW_WHOLE};
    return yb_lines_from_vector(path, field, &window, error);
}

static void test_nested_squares(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("squares.geojson");
    collection(
        path,
        LINE("id", "1", "[[0,0],[1,1]]") "," LINE(
            "Hoehe", "\"100 m\"",
            SQUARE("0", "1000")) "," LINE("Hoehe", "\"200\"",
                                          SQUARE("200", "800")) "," LINE("Hoehe", "\"300\"",
                                                                         SQUARE("400", "600")));
    assert_true(yb_lines_is_vector(path));
    yb_lines_t *lines = read_lines(path, NULL, &error);
    assert_non_null(lines);
    assert_int_equal(lines->count, 3);
    assert_true(lines->width_m > 1000); /* a margin round what is closed */
    double level_m[8];
    assert_int_equal(yb_line_grid_levels(lines, level_m, 8), 3);
    assert_true(level_m[0] == 100 && level_m[1] == 200 && level_m[2] == 300);
    yb_grid_t *grid = yb_line_grid_new(lines, &error);
    assert_non_null(grid);
    double middle = lines->width_m / 2;
    assert_true(yb_grid_height(grid, middle, middle) > 320);
    assert_true(yb_grid_height(grid, middle, middle) <= 351);
    assert_true(yb_grid_height(grid, 2, 2) < 100);
    assert_true(fabs(yb_grid_height(grid, middle - 400, middle) - 150) < 30);
    yb_grid_free(grid);
    yb_lines_free(lines);
}

static void test_pieces_are_joined(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("pieces.geojson");
    collection(
        path,
        LINE("elev", "50", "[[0,100],[300,120],[500,100]]") "," LINE(
            "elev", "50",
            "[[500,100],[800,150],[1000,100]]") "," LINE("elev", "90",
                                                         "[[1000,600],[500,500],[0,600]"
                                                         "]") "," LINE("elev", "70",
                                                                       "[[400,300],["
                                                                       "500,320],[600,"
                                                                       "300]]") "," LINE("elev",
                                                                                         "70",
                                                                                         "[[0,0],["
                                                                                         "1000,0]"
                                                                                         "]"));
    yb_lines_t *lines = read_lines(path, NULL, &error);
    assert_non_null(lines);
    assert_int_equal(lines->dropped, 1); /* the one that ends inside at both ends */
    int crossing = 0;
    for (int i = 0; i < lines->count; i++)
        if (lines->line[i].height_m != 70) {
            assert_false(lines->line[i].closed);
            assert_true(on_frame(lines, lines->line[i].place[0]));
            crossing++;
        }
    assert_int_equal(crossing, 2);
    yb_lines_free(lines);
}

/* A saddle drawn as a cross, and a line that ends in the middle of another. */
static void test_lines_of_a_height_that_touch(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("cross.geojson");
    collection(path,
               LINE("elev", "50", "[[0,600],[500,500],[600,0]]") "," LINE(
                   "elev", "50",
                   "[[1000,400],[500,500],[400,1000]]") "," LINE("elev", "70",
                                                                 "[[0,800],[500,850],[1000,"
                                                                 "900]]") "," LINE("elev", "70",
                                                                                   "[[500,850]"
                                                                                   ",[520,700]"
                                                                                   "]"));
    yb_lines_t *lines = read_lines(path, NULL, &error);
    assert_non_null(lines);
    assert_int_equal(lines->count, 3);
    assert_int_equal(lines->dropped, 1);
    for (int i = 0; i < 3; i++) {
        const yb_line_t *line = &lines->line[i];
        assert_int_equal(line->count, 3);
        assert_true(on_frame(lines, line->place[0]) && on_frame(lines, line->place[2]));
    }
    /* They part without crossing, each on its side of the cross. */
    const yb_place_t *place = lines->line[0].place;
    bool south_west = place[0].x_m + place[0].y_m < 1000;
    assert_true(south_west == (place[2].x_m + place[2].y_m < 1000));
    yb_lines_free(lines);
}

static void test_refused(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("bad.geojson");
    collection(path, LINE("name", "1", SQUARE("0", "10")));
    assert_null(read_lines(path, NULL, &error));
    assert_non_null(strstr(error.text, "--field"));
    assert_null(read_lines(path, "height", &error));
    assert_non_null(strstr(error.text, "no attribute 'height'"));
    collection(path, LINE("elev", "5", "[[400,300],[500,320],[600,400]]") "," LINE(
                         "elev", "6", SQUARE("0", "1000")));
    yb_window_t window = {.kind = YB_WINDOW_BOX, .box = {5000, 5000, 6000, 6000}};
    assert_null(yb_lines_from_vector(path, NULL, &window, &error));
    assert_non_null(strstr(error.text, "outside"));
    assert_null(read_lines(scratch_path("none.geojson"), NULL, &error));
    assert_non_null(strstr(error.text, "No such file"));
    collection(path, LINE("elev", "5", "[[0,0],[1e300,1000]]"));
    assert_null(read_lines(path, NULL, &error));
    assert_non_null(strstr(error.text, "no place on earth"));
    scratch_text(path, "no lines");
    assert_null(read_lines(path, NULL, &error));
    assert_false(yb_lines_is_vector(path));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_or_from_frame_to_frame),
        cmocka_unit_test(test_circle),
        cmocka_unit_test(test_nested_squares),
        cmocka_unit_test(test_pieces_are_joined),
        cmocka_unit_test(test_lines_of_a_height_that_touch),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
