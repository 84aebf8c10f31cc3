/* Contour lines from grids and from vector files. */
#include "contour_lines.h"
#include "line_crossings.h"
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

#define BOX(x0, y0, x1, y1)                                                                        \
    "[[" #x0 "," #y0 "],[" #x1 "," #y0 "],[" #x1 "," #y1 "],[" #x0 "," #y1 "],[" #x0 "," #y0 "]]"

/* Reads the lines of a file and looks for crossings; true if there are none. */
static bool clean(const char *path, yb_error_t *error)
{
    yb_lines_t *lines = read_lines(path, NULL, error);
    if (lines == NULL)
        fail_msg("%s", error->text);
    bool good = yb_line_crossings_none(lines, path, error);
    yb_lines_free(lines);
    return good;
}

static bool features_clean(const char *features, yb_error_t *error)
{
    const char *path = scratch_path("crossings.geojson");
    collection(path, features);
    return clean(path, error);
}

static void test_crossings_are_found(void **state)
{
    (void)state;
    yb_error_t error;
    assert_false(features_clean(
        LINE("elev", "100", BOX(0, 0, 600, 600)) "," LINE("elev", "200", BOX(400, 300, 1000, 1000)),
        &error));
    assert_non_null(strstr(error.text, " 100 m and 200 m at "));
    assert_true(strstr(error.text, "at 600, 300;") != NULL ||
                strstr(error.text, "at 400, 600;") != NULL);
    assert_null(strstr(error.text, "others"));
    /* None has a point inside the other. */
    assert_false(features_clean(LINE("elev", "100", BOX(0, 400, 1000, 600)) "," LINE(
                                    "elev", "200.5", BOX(400, 0, 600, 1000)),
                                &error));
    assert_non_null(strstr(error.text, "100 m and 200.5 m at "));
    /* Lines from side to side, crossing each other and a closed one, in a point of theirs. */
    assert_false(features_clean(LINE("elev", "10", "[[0,0],[500,500],[1000,1000]]") "," LINE(
                                    "elev", "20", "[[0,1000],[500,500],[1000,0]]"),
                                &error));
    assert_non_null(strstr(error.text, "10 m and 20 m at 500, 500;"));
    assert_false(features_clean(
        LINE("elev", "10", "[[0,500],[1000,500]]") "," LINE(
            "elev", "20", "[[0,490],[1000,490]]") "," LINE("elev", "30", BOX(200, 495, 400, 900)),
        &error));
    assert_non_null(strstr(error.text, "10 m and 30 m at "));
    assert_null(strstr(error.text, "20 m"));
}

static void test_crossings_are_told_in_few_words(void **state)
{
    (void)state;
    yb_error_t error;
    char features[4000] = LINE("elev", "1", "[[0,500],[1000,500]]");
    for (int i = 0; i < 5; i++) {
        size_t used = strlen(features);
        snprintf(features + used, sizeof(features) - used,
                 "," LINE("elev", "%d", "[[%d,0],[%d,1000]]"), 10 + i, 100 + 150 * i,
                 100 + 150 * i);
    }
    assert_false(features_clean(features, &error));
    assert_non_null(strstr(error.text, "1 m and 10 m at 100, 500"));
    assert_non_null(strstr(error.text, "; and others;"));
    const char *third = strstr(strstr(strstr(error.text, " at ") + 1, " at ") + 1, " at ");
    assert_non_null(third);
    assert_null(strstr(third + 1, " at "));
}

/* The places are told in the file's own coordinates, degrees here. */
static void test_crossings_in_degrees(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("degrees.geojson");
    scratch_text(
        path,
        "{\"type\":\"FeatureCollection\",\"features\":[" LINE(
            "ele", "10", "[[9,46],[9.1,46.1]]") "," LINE("ele", "20", "[[9,46.1],[9.1,46]]") "]}");
    assert_false(clean(path, &error));
    const char *at = strstr(error.text, "10 m and 20 m at ");
    double lon = 0;
    double lat = 0;
    assert_non_null(at);
    assert_int_equal(sscanf(at, "10 m and 20 m at %lf, %lf", &lon, &lat), 2);
    assert_true(fabs(lon - 9.05) < 0.001 && fabs(lat - 46.05) < 0.001);
}

static void test_touching_is_no_crossing(void **state)
{
    (void)state;
    yb_error_t error;
    static const char *const good[] = {
        LINE("elev", "1", BOX(0, 0, 1000, 1000)) "," LINE("elev", "2", BOX(100, 100, 900, 900)),
        /* a point of one on the other, one side in common, one corner, the same place */
        LINE("elev", "1", BOX(0, 0, 1000, 1000)) "," LINE("elev", "2",
                                                          "[[0,500],[400,300],[400,700],[0,500]]"),
        LINE("elev", "1", BOX(0, 0, 1000, 1000)) "," LINE("elev", "2", BOX(0, 200, 500, 800)),
        LINE("elev", "1", BOX(0, 0, 500, 500)) "," LINE("elev", "2", BOX(500, 500, 1000, 1000)),
        LINE("elev", "1", BOX(0, 0, 500, 500)) "," LINE("elev", "2", BOX(500, 0, 1000, 500)),
        LINE("elev", "1", BOX(0, 0, 1000, 1000)) "," LINE("elev", "2", BOX(0, 0, 1000, 1000)),
        /* lines from side to side that share their way for a while: a cliff */
        LINE("elev", "1", "[[0,200],[400,500],[600,500],[1000,200]]") "," LINE(
            "elev", "2", "[[0,800],[400,500],[600,500],[1000,800]]"),
        LINE("elev", "1", "[[0,200],[400,500],[500,500],[600,500],[1000,200]]") "," LINE(
            "elev", "2", "[[0,300],[400,500],[600,500],[1000,210]]"),
        /* lines of one height may do what they like */
        LINE("elev", "1", BOX(0, 400, 1000, 600)) "," LINE("elev", "1", BOX(400, 0, 600, 1000)),
        /* rounded to centimetres */
        LINE("elev", "1", "[[0,500.01],[333.33,500],[666.67,500.01],[1000,500]]") "," LINE(
            "elev", "2", "[[0,500.02],[300,500.01],[700,500],[1000,500.02]]")};
    for (size_t i = 0; i < sizeof(good) / sizeof(good[0]); i++)
        if (!features_clean(good[i], &error))
            fail_msg("%zu: %s", i, error.text);
    assert_true(features_clean(
        LINE("elev", "1", BOX(0, 0, 500, 1000)) "," LINE("elev", "2", BOX(499.97, 300, 1000, 600)),
        &error));
    assert_false(features_clean(
        LINE("elev", "1", BOX(0, 0, 500, 1000)) "," LINE("elev", "2", BOX(498, 300, 1000, 600)),
        &error));
}

/* Crossings outside the window are nobody's business. */
static void test_crossings_outside(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("outside.geojson");
    collection(path, LINE("elev", "1", "[[0,500],[1000,500]]") "," LINE(
                         "elev", "2", "[[0,450],[500,480],[800,520],[1000,550]]"));
    yb_window_t window = {.kind = YB_WINDOW_BOX, .box = {0, 0, 500, 1000}};
    yb_lines_t *lines = yb_lines_from_vector(path, NULL, &window, &error);
    assert_non_null(lines);
    assert_int_equal(lines->count, 2);
    assert_true(yb_line_crossings_none(lines, path, &error));
    yb_lines_free(lines);
    assert_false(clean(path, &error));
    assert_non_null(strstr(error.text, "at 650, 500"));
}

/* Of two lines, one with a height that is text. */
static yb_lines_t *lines_with_text(const char *height, yb_error_t *error)
{
    char features[1000];
    snprintf(features, sizeof(features),
             LINE("elev", "\"%s\"", SQUARE("100", "900")) "," LINE("elev", "\"50\"",
                                                                   SQUARE("0", "1000")),
             height);
    const char *path = scratch_path("text.geojson");
    collection(path, features);
    return read_lines(path, NULL, error);
}

static void test_heights_as_text(void **state)
{
    (void)state;
    yb_error_t error;
    static const struct {
        const char *text;
        double height_m;
    } good[] = {{"1200", 1200}, {"1200 m", 1200},  {" 1200m ", 1200}, {"-3.5", -3.5},
                {"+7", 7},      {"1.2e3 m", 1200}, {"0", 0}};
    for (size_t i = 0; i < sizeof(good) / sizeof(good[0]); i++) {
        yb_lines_t *lines = lines_with_text(good[i].text, &error);
        double level_m[4];
        assert_non_null(lines);
        assert_int_equal(yb_line_grid_levels(lines, level_m, 4), 2);
        assert_true(level_m[0] == good[i].height_m || level_m[1] == good[i].height_m);
        yb_lines_free(lines);
    }
    static const char *const bad[] = {"1.200,5", "1200 ft", "1,200", "12 00", "high",       "m",
                                      "0x20",    "nan",     "inf",   "1200-", "1200 m high"};
    for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
        char quoted[64];
        snprintf(quoted, sizeof(quoted), "'%s' (attribute elev)", bad[i]);
        assert_null(lines_with_text(bad[i], &error));
        assert_non_null(strstr(error.text, quoted));
        assert_non_null(strstr(error.text, "feature 0 of "));
    }
    yb_lines_t *lines = lines_with_text(" ", &error); /* no height at all: left out */
    assert_non_null(lines);
    assert_int_equal(lines->count, 1);
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
        cmocka_unit_test(test_crossings_are_found),
        cmocka_unit_test(test_crossings_are_told_in_few_words),
        cmocka_unit_test(test_crossings_in_degrees),
        cmocka_unit_test(test_touching_is_no_crossing),
        cmocka_unit_test(test_crossings_outside),
        cmocka_unit_test(test_heights_as_text),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
