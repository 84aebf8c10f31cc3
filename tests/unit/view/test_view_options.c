/* From words on the command line to the engine's units. */
#include "codes.h"
#include "view_options.h"

#include <stdio.h>
#include <string.h>

enum {
    MOST_WORDS = 24
};

static const struct option long_options[] = {YB_VIEW_LONG_OPTIONS, {0}};

/* Reads words, separated by blanks; false with a sentence for those that are wrong. */
static bool parse(const char *words, yb_view_options_t *options, yb_error_t *error)
{
    char text[256];
    char *argv[MOST_WORDS + 1] = {0};
    int argc = 0;
    snprintf(text, sizeof(text), "render %s", words);
    for (char *word = strtok(text, " "); word != NULL; word = strtok(NULL, " "))
        argv[argc++] = word;
    *options = yb_view_options_default();
    optind = 0;
    opterr = 0;
    for (int answer; (answer = getopt_long(argc, argv, ":", long_options, NULL)) != -1;) {
        if (!yb_view_options_owns(answer))
            return yb_error_set(error, "unknown");
        if (!yb_view_options_take(options, answer, argc, argv, error))
            return false;
    }
    if (optind != argc)
        return yb_error_set(error, "left over: %s", argv[optind]);
    return yb_view_options_check(options, error);
}

static yb_view_t view_of(const char *words, yb_map_t *map)
{
    yb_view_options_t options;
    yb_error_t error = {""};
    yb_view_t view = {0};
    if (!parse(words, &options, &error) || !yb_view_options_apply(&options, map, &view, &error))
        fail_msg("%s: %s", words, error.text);
    return view;
}

static void metres_become_steps(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    /* 30 m a step, base 100 m. */
    yb_view_t view = view_of("--eye 300 -600 400 --look 3840 3840 100", &file->map);
    assert_int_equal(view.eye_q8[0], 10 * 256);
    assert_int_equal(view.eye_q8[1], -20 * 256);
    assert_int_equal(view.eye_q8[2], 10 * 256);
    assert_int_equal(view.look_q8[0], 128 * 256);
    assert_int_equal(view.look_q8[1], 128 * 256);
    assert_int_equal(view.look_q8[2], 0);
    assert_int_equal(view_of("--water 130", &file->map).water_q8, 256);
    assert_int_equal(view_of("--water 99.9", &file->map).water_q8, -1);
    assert_int_equal(view_of("", &file->map).water_q8, YB_NO_WATER);
    /* The eye keeps its height over the ground when the ground is raised. */
    view = view_of("--eye 0 0 400 --exaggerate 2", &file->map);
    assert_int_equal(view.exaggerate_q8, 512);
    assert_int_equal(view.eye_q8[2], 20 * 256);
    yb_code_file_free(file);
}

static void angles_are_rounded_once(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    assert_int_equal(view_of("", &file->map).zoom_q12, 4392);
    assert_int_equal(view_of("--fov 90", &file->map).zoom_q12, 2048);
    assert_int_equal(view_of("--fov 60", &file->map).zoom_q12, 3547);
    assert_int_equal(view_of("--azimuth 90", &file->map).azimuth_bam, 16384);
    assert_int_equal(view_of("--azimuth -90", &file->map).azimuth_bam, 49152);
    assert_int_equal(view_of("--azimuth 359.999", &file->map).azimuth_bam, 0);
    assert_int_equal(view_of("--azimuth 0.0055", &file->map).azimuth_bam, 1);
    assert_int_equal(view_of("--edge 2.5", &file->map).edge_q4, 40);
    assert_int_equal(view_of("", &file->map).edge_q4, 96);
    assert_int_equal(view_of("--max-leaves 12345", &file->map).max_leaves, 12345);
    assert_false(view_of("--walls off", &file->map).walls);

    yb_view_t by_engine;
    yb_view_init(&by_engine, &file->map);
    yb_view_sun(&by_engine, YB_DEGREES(200), YB_DEGREES(10));
    yb_view_orbit(&by_engine, &file->map, YB_DEGREES(77), YB_DEGREES(20), 384);
    const yb_view_t view =
        view_of("--sun 200 10 --azimuth 77 --elevation 20 --distance 1.5", &file->map);
    assert_memory_equal(view.sun_q14, by_engine.sun_q14, sizeof(view.sun_q14));
    assert_memory_equal(view.eye_q8, by_engine.eye_q8, sizeof(view.eye_q8));
    assert_memory_equal(view.look_q8, by_engine.look_q8, sizeof(view.look_q8));
    yb_code_file_free(file);
}

/* A panel shows what the device does, or what is asked for. */
static void panel(void **state)
{
    (void)state;
    const yb_screen_t screen = {96, 16, YB_GREY4};
    yb_view_options_t options = yb_view_options_default();
    yb_error_t error;
    yb_view_options_panel(&options, &screen);
    assert_int_equal(options.screen.width, 96);
    assert_true(options.edge_px <= 0);
    assert_true(parse("--edge 3", &options, &error));
    yb_view_options_panel(&options, &screen);
    assert_true(options.edge_px >= 3);
}

static void screen_and_detail(void **state)
{
    (void)state;
    yb_view_options_t options;
    yb_error_t error;
    assert_true(parse("--size 128x64 --format grey4 --band 8 --no-detail", &options, &error));
    assert_int_equal(options.screen.width, 128);
    assert_int_equal(options.screen.height, 64);
    assert_int_equal(options.screen.format, YB_GREY4);
    assert_int_equal(options.band_rows, 8);
    assert_false(options.detail);
    yb_code_file_t *file = code_rough_hill();
    yb_view_t view;
    assert_true(file->map.detail);
    assert_true(yb_view_options_apply(&options, &file->map, &view, &error));
    assert_false(file->map.detail);
    yb_code_file_free(file);
}

static void contradictions_are_refused(void **state)
{
    static const char *const wrong[] = {
        "--size 0x64",
        "--size 64",
        "--size 64x",
        "--size 64x32x",
        "--size 5000x10",
        "--size -1x5",
        "--size 65x32 --format grey4",
        "--format rgb888",
        "--format",
        "--eye 1 2",
        "--eye 1 2 x",
        "--eye 1 2 nan",
        "--look 1 2 3",
        "--eye 1 2 3 --view walk-1",
        "--view up",
        "--fov 3",
        "--fov 127",
        "--elevation 91",
        "--elevation -1",
        "--distance 0",
        "--distance 1e3",
        "--sun 1",
        "--sun 1 95",
        "--water",
        "--exaggerate 0",
        "--exaggerate 9",
        "--walls maybe",
        "--edge 0",
        "--max-leaves 0",
        "--max-leaves 1.5",
        "--band 0",
        "--azimuth north",
        "--shadows 3",
        "--palette x",
        "--contours 0",
        "--shadows 48",
        "--haze -1",
        "--walk 1",
        "--walk 1 2 --fly 1 2 3",
        "--walk 1 2 --elevation 3",
        "--height 3",
        "--fly 1 2 3 --tilt 91",
        "--view orbit-45 --azimuth 3",
        "--eye 1 2 3 --distance 2",
    };
    (void)state;
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
        yb_view_options_t options;
        yb_error_t error = {""};
        if (parse(wrong[i], &options, &error))
            fail_msg("%s was taken", wrong[i]);
        assert_true(strlen(error.text) > 0);
    }
}

static void looks(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill(); /* 30 m a step, base 100 m, 256 steps wide or less */
    yb_view_t view = view_of("--contours 40 --palette night --haze 0.5", &file->map);
    assert_int_equal(view.contour_q8, (40 * 256 + 15) / 30);
    assert_int_equal(view.contour_at_q8, (20 * 256 + 15) / 30); /* 120 m */
    assert_int_equal(view.palette, YB_PALETTE_NIGHT);
    assert_in_range(view.haze_q8, file->map.east_q8 / 2, file->map.east_q8 / 2 + 1);
    view = view_of("", &file->map);
    assert_int_equal(view.contour_q8, 0);
    assert_int_equal(view.haze_q8, 0);
    assert_null(view.shadow);
    yb_view_options_t options;
    yb_error_t error = {""};
    assert_true(parse("--shadows 64 --format mono --size 37x9", &options, &error));
    assert_int_equal(options.shadows, 64);
    assert_int_equal(options.screen.format, YB_MONO);
    /* Lines so close, or so far apart, are refused: a quarter of a step, 256 steps. */
    static const char *const wrong[] = {"--contours 7", "--contours 7681"};
    for (int i = 0; i < 2; i++) {
        assert_true(parse(wrong[i], &options, &error));
        assert_false(yb_view_options_apply(&options, &file->map, &view, &error));
        assert_non_null(strstr(error.text, "8 to 7679 m"));
    }
    yb_code_file_free(file);
}

static void on_foot_and_in_the_air(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill(); /* 30 m a step, base 100 m */
    yb_view_t by_engine;
    yb_view_init(&by_engine, &file->map);
    yb_view_walk(&by_engine, &file->map, 10 * 256, 20 * 256, 51, YB_DEGREES(90), 0);
    yb_view_t view = view_of("--walk 300 600 --height 6 --azimuth 90", &file->map);
    assert_memory_equal(view.eye_q8, by_engine.eye_q8, sizeof(view.eye_q8));
    assert_memory_equal(view.look_q8, by_engine.look_q8, sizeof(view.look_q8));
    assert_int_equal(view.azimuth_bam, 16384);
    view = view_of("--fly 300 600 9100 --tilt -45", &file->map);
    assert_int_equal(view.eye_q8[2], 300 * 256);
    assert_int_equal(view.look_q8[2] - view.eye_q8[2], -11585);
    view = view_of("--fly 300 600 -500", &file->map); /* half a step above the ground */
    assert_int_equal(view.eye_q8[2], by_engine.eye_q8[2] - 51 + 128);
    yb_view_options_t options;
    yb_error_t error = {""};
    assert_true(parse("--walk -1 5", &options, &error));
    assert_false(yb_view_options_apply(&options, &file->map, &view, &error));
    assert_non_null(strstr(error.text, "is not on the map"));
    yb_code_file_free(file);
}

static void far_places_are_refused(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    static const char *const far[] = {"--eye 0 0 200000", "--eye 0 0 9 --look 1e9 0 0",
                                      "--water 1e6"};
    for (size_t i = 0; i < sizeof(far) / sizeof(far[0]); i++) {
        yb_view_options_t options;
        yb_error_t error = {""};
        yb_view_t view;
        assert_true(parse(far[i], &options, &error));
        assert_false(yb_view_options_apply(&options, &file->map, &view, &error));
        assert_true(strlen(error.text) > 0);
    }
    yb_code_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metres_become_steps),
        cmocka_unit_test(angles_are_rounded_once),
        cmocka_unit_test(screen_and_detail),
        cmocka_unit_test(panel),
        cmocka_unit_test(contradictions_are_refused),
        cmocka_unit_test(far_places_are_refused),
        cmocka_unit_test(looks),
        cmocka_unit_test(on_foot_and_in_the_air),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
