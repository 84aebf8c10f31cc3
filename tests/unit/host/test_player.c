/* The player: what a user wants is done on any map, and a frame that cannot be drawn stays no
 * longer than its reason. */
#include "player.h"

#include "encode.h"
#include "scratch.h"

#include <model_bus.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int told;

static void tell(const char *sentence)
{
    (void)sentence;
    told++;
}

/* 20 m of relief on cells of 30 m: contour lines for it would be nearer than the engine allows. */
static double relief_gentle(double east, double north)
{
    return relief_cone(east, north) / 50;
}

static void write_code(const char *path, relief_fn relief)
{
    yb_grid_t *grid = scratch_grid(64, 64, relief);
    const yb_encode_task_t task = {.profile = YB_COMPACT, .most_bytes = 60, .seed = 1, .effort = 1};
    yb_encode_result_t result;
    yb_error_t error;
    if (!yb_encode_grid(grid, &task, &result, &error))
        fail_msg("%s", error.text);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(result.code->bytes, 1, result.code->size, file), result.code->size);
    fclose(file);
    yb_encode_result_free(&result);
    yb_grid_free(grid);
}

typedef struct {
    yb_model_bus_t wires;
    yb_outlet_t *outlet;
    yb_map_list_t *list;
    yb_player_t *player;
} stage_t;

static void set_up(stage_t *stage, char **paths, size_t count, yb_play_t play)
{
    const yb_panel_t *panel = &yb_panel_ssd0323;
    yb_error_t error;
    told = 0;
    assert_true(yb_model_bus_open(&stage->wires, panel));
    stage->outlet = yb_outlet_open(panel, YB_TURN_0, &stage->wires.bus, 16, NULL);
    assert_true(yb_outlet_start(stage->outlet));
    stage->list = yb_map_list_open(paths, count, &error);
    assert_non_null(stage->list);
    yb_view_options_panel(&play.view, &panel->screen);
    play.band_rows = 16;
    play.tell = tell;
    stage->player = yb_player_new(&play, stage->list);
    assert_non_null(stage->player);
}

static void tear_down(stage_t *stage)
{
    yb_player_free(stage->player);
    yb_map_list_close(stage->list);
    yb_outlet_close(stage->outlet);
    yb_model_bus_close(&stage->wires);
}

/* A hash of what the next frame shows; 0: there is no map. */
static uint32_t next_frame(stage_t *stage, double now_s)
{
    static const volatile int stop = 0;
    yb_model_picture_t picture;
    const bool found = yb_player_draw(stage->player, now_s, stage->outlet, &stop);
    assert_true(yb_outlet_finish(stage->outlet));
    assert_true(yb_panel_model_picture(stage->wires.model, &picture));
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < 3u * picture.width * picture.height; i++)
        hash = (hash ^ picture.rgb[i]) * 16777619u;
    return found ? hash : 0;
}

static void lines_are_drawn_on_gentle_ground(void **state)
{
    char path[256];
    char *paths[] = {path};
    stage_t stage;
    (void)state;
    snprintf(path, sizeof(path), "%s", scratch_path("gentle.yb"));
    write_code(path, relief_gentle);
    set_up(&stage, paths, 1, (yb_play_t){.view = yb_view_options_default()});
    const uint32_t plain = next_frame(&stage, 0);
    assert_int_not_equal(plain, 0);
    yb_player_act(stage.player, YB_ACT_LINES);
    const uint32_t lined = next_frame(&stage, 1);
    assert_int_not_equal(lined, 0);
    yb_player_act(stage.player, YB_ACT_LINES);
    assert_int_equal(next_frame(&stage, 2), plain);
    assert_int_equal(told, 0);
    tear_down(&stage);
}

static void the_user_turns_moves_and_pauses(void **state)
{
    char one[256], two[256];
    char *paths[] = {one, two};
    stage_t stage;
    (void)state;
    snprintf(one, sizeof(one), "%s", scratch_path("one.yb"));
    snprintf(two, sizeof(two), "%s", scratch_path("two.yb"));
    write_code(one, relief_range);
    write_code(two, relief_cone);
    set_up(&stage, paths, 2,
           (yb_play_t){.view = yb_view_options_default(), .turn_deg = 15, .slide_s = 100});
    const uint32_t first = next_frame(&stage, 0), second = next_frame(&stage, 1);
    assert_int_not_equal(first, second);
    /* A stride back and the orbit's own step forth: where it was. */
    yb_player_act(stage.player, YB_ACT_RIGHT);
    assert_int_equal(next_frame(&stage, 2), second);
    yb_player_act(stage.player, YB_ACT_PAUSE);
    const uint32_t paused = next_frame(&stage, 3);
    assert_int_equal(next_frame(&stage, 300), paused);
    assert_true(yb_player_still_s(stage.player, 300) > 1e9);
    yb_player_act(stage.player, YB_ACT_SHADOWS);
    assert_true(yb_player_still_s(stage.player, 300) <= 0);
    assert_int_not_equal(next_frame(&stage, 301), paused);
    yb_player_act(stage.player, YB_ACT_SHADOWS);
    yb_player_act(stage.player, YB_ACT_NEXT);
    assert_int_not_equal(next_frame(&stage, 302), paused);
    yb_player_act(stage.player, YB_ACT_PREVIOUS);
    assert_int_equal(next_frame(&stage, 303), paused);
    tear_down(&stage);
}

static void a_walker_looks_about(void **state)
{
    char path[256];
    char *paths[] = {path};
    stage_t stage;
    yb_play_t play = {.view = yb_view_options_default()};
    (void)state;
    snprintf(path, sizeof(path), "%s", scratch_path("walked.yb"));
    write_code(path, relief_range);
    play.view.given = 1u << (YB_OPTION_WALK - YB_OPTION_SIZE);
    play.view.eye_m[0] = play.view.eye_m[1] = 300;
    set_up(&stage, paths, 1, play);
    const uint32_t north = next_frame(&stage, 0);
    yb_player_act(stage.player, YB_ACT_LEFT);
    assert_int_not_equal(next_frame(&stage, 1), north);
    yb_player_act(stage.player, YB_ACT_RIGHT);
    assert_int_equal(next_frame(&stage, 2), north);
    tear_down(&stage);
}

static void bad_maps_are_told_once(void **state)
{
    char bad[256], good[256];
    char *paths[] = {bad, good};
    stage_t stage;
    (void)state;
    snprintf(bad, sizeof(bad), "%s", scratch_path("bad.yb"));
    snprintf(good, sizeof(good), "%s", scratch_path("good.yb"));
    scratch_text(bad, "no code");
    write_code(good, relief_cone);
    set_up(&stage, paths, 2, (yb_play_t){.view = yb_view_options_default(), .slide_s = 1});
    for (int i = 0; i < 10; i++)
        assert_int_not_equal(next_frame(&stage, 2 * i), 0);
    assert_int_equal(told, 1);
    tear_down(&stage);

    set_up(&stage, paths, 1, (yb_play_t){.view = yb_view_options_default()});
    assert_int_equal(next_frame(&stage, 0), 0);
    assert_int_equal(next_frame(&stage, 1), 0);
    assert_int_equal(told, 1);
    /* It has been mended, and the user asks again. */
    write_code(bad, relief_cone);
    yb_player_act(stage.player, YB_ACT_NEXT);
    assert_int_not_equal(next_frame(&stage, 2), 0);
    tear_down(&stage);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_are_drawn_on_gentle_ground),
        cmocka_unit_test(the_user_turns_moves_and_pauses),
        cmocka_unit_test(a_walker_looks_about),
        cmocka_unit_test(bad_maps_are_told_once),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
