#include "cli.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <model_bus.h>
#include <recorder.h>
#include <turntable.h>
#include <window.h>

#include "code_file.h"
#include "config.h"
#include "keys.h"
#include "output.h"
#include "picture.h"
#include "play.h"

enum {
    OPTION_SCALE = 256,
    OPTION_FULL_SCREEN,
    OPTION_PNG,
    OPTION_RECORD,
    OPTION_FORCE,
    OPTION_FAST,
    OPTION_HELP,

    MAP_MOST = 65536 /* bytes of a code in the handheld's slot */
};

static const struct option options[] = {{"scale", required_argument, NULL, OPTION_SCALE},
                                        {"full-screen", no_argument, NULL, OPTION_FULL_SCREEN},
                                        {"png", required_argument, NULL, OPTION_PNG},
                                        {"record", required_argument, NULL, OPTION_RECORD},
                                        {"force", no_argument, NULL, OPTION_FORCE},
                                        {"fast", no_argument, NULL, OPTION_FAST},
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        CLI_PLAY_LONG_OPTIONS,
                                        {0}};

typedef struct {
    cli_play_t play;
    long scale;
    const char *png, *record;
    bool full_screen, force, fast, help;
} request_t;

/* A panel of which only the picture is real. */
typedef struct {
    const request_t *request;
    yb_model_bus_t wires;
    yb_recorder_t recorder;
    const yb_panel_bus_t *bus; /* that of the wires, or the recorder's */
    yb_map_list_t *list;
    yb_sim_window_t *window;    /* NULL: headless */
    yb_picture_t picture;       /* the last one, as it was shown */
    uint64_t real_ns, wires_ns; /* clocks of the desktop and of the wires, when they were even */
    int shots;
    bool failed; /* and it has been said why */
} scene_t;

static void help(void)
{
    fputs(
        "Usage: yamabiko sim [MAP.yb] [OPTION ...]\n"
        "       yamabiko sim MAP.yb|FOLDER ... --panel NAME [OPTION ...]\n"
        "\n"
        "A device in a window. Without --panel it is the handheld: the firmware's own program on\n"
        "its OLED, with MAP.yb in its map slot, and the keys are its console: p, n, N, r, s, l.\n"
        "With --panel it is what 'yamabiko show' would show on that panel: the bytes that would\n"
        "go over its wires, at their speed, taken by a model of the panel, which refuses whatever\n"
        "its datasheet does not allow.\n"
        "\n"
        "  --scale N           pixels of the desktop to one of the panel (default: what fits)\n"
        "  --full-screen       fill the screen; F11 goes there and back\n"
        "  --png FILE          the last frame as a PNG file; F12 writes shot-1.png and so on\n"
        "  --record FILE       what went over the wires, a line a transfer: 'command 2a',\n"
        "                      'data 00 ef'\n"
        "  --force             overwrite what exists\n"
        "  --fast              no slower than the PC can: wires take no time\n"
        "  --help              this text\n"
        "\n"
        "With --frames and --png there is no window: time goes by frames, and no desktop is\n"
        "needed.\n"
        "\n",
        stdout);
    fputs(cli_play_help, stdout);
    fputs("\nKeys, with --panel:\n", stdout);
    fputs(cli_keys_help, stdout);
    fputs("\nView, with --panel:\n", stdout);
    fputs(yb_view_options_help, stdout);
    fputs("\n"
          "Examples:\n"
          "  yamabiko sim fuji.yb\n"
          "  yamabiko sim maps --panel ili9341 --turn 90 --orbit --slide 10 --shadows 64\n"
          "  yamabiko sim fuji.yb --panel ssd1306 --orbit --frames 90 --png frame-90.png\n",
          stdout);
}

static int take(request_t *request, int answer, int argc, char **argv)
{
    if (cli_play_owns(answer))
        return cli_play_take(&request->play, answer, argc, argv);
    switch (answer) {
    case OPTION_SCALE:
        return cli_integer(optarg, 1, 32, &request->scale)
                   ? CLI_OK
                   : cli_usage("--scale: '%s' is not a whole number from 1 to 32", optarg);
    case OPTION_FULL_SCREEN:
        request->full_screen = true;
        return CLI_OK;
    case OPTION_PNG:
        request->png = optarg;
        return CLI_OK;
    case OPTION_RECORD:
        request->record = optarg;
        return CLI_OK;
    case OPTION_FORCE:
        request->force = true;
        return CLI_OK;
    case OPTION_FAST:
        request->fast = true;
        return CLI_OK;
    case OPTION_HELP:
        request->help = true;
        return CLI_OK;
    default:
        return cli_bad_option(answer, argc, argv);
    }
}

static bool is_headless(const request_t *request)
{
    return request->png != NULL && request->play.frames > 0;
}

/* The handheld has no options but the window's. */
static int check_handheld(const request_t *request, size_t maps)
{
    const cli_play_t *play = &request->play;
    if (maps > 1)
        return cli_usage("the handheld's slot holds one map; several need a --panel");
    if (play->view.given != 0 || play->turn != YB_TURN_0 || play->orbit_deg != 0 ||
        play->sun_deg != 0 || play->slide_s != 0 || play->brightness >= 0 || play->invert ||
        play->whole || play->stats)
        return cli_usage("the handheld has a view of its own: that option needs a --panel");
    return CLI_OK;
}

static int check(request_t *request, size_t maps)
{
    yb_error_t error;
    const bool handheld = request->play.panel == NULL;
    if (!handheld && maps == 0)
        return cli_usage("name a code, MAP.yb, or a folder of them");
    if (request->png != NULL && strcmp(request->png, "-") == 0 && (handheld || request->play.stats))
        return cli_usage("'--png -' is for a --panel without --stats: what else is told would "
                         "stand in the picture");
    const int status = handheld ? check_handheld(request, maps) : cli_play_check(&request->play);
    if (status != CLI_OK)
        return status;
    if ((request->png != NULL && !yb_output_allowed(request->png, request->force, &error)) ||
        (request->record != NULL && !yb_output_allowed(request->record, request->force, &error)))
        return cli_fail("%s", error.text);
    return CLI_OK;
}

/* ---- The picture ----------------------------------------------------------------------------- */

static bool fail(scene_t *scene, const char *why)
{
    if (!scene->failed)
        (void)cli_fail("%s", why);
    scene->failed = true;
    return false;
}

/* What the panel shows, as somebody sees it who has turned it as --turn wants; grey if it has no
 * colours, so that the file is the very one that 'yamabiko render' writes. */
static bool take_picture(scene_t *scene, yb_picture_t *picture)
{
    const bool grey = scene->wires.panel->screen.format != YB_RGB565;
    yb_model_picture_t glass;
    yb_picture_t upright;
    if (!yb_panel_model_picture(scene->wires.model, &glass))
        return fail(scene, yb_panel_model_error(scene->wires.model));
    if (!yb_picture_init(&upright, glass.width, glass.height, grey ? 1 : 3))
        return fail(scene, "out of memory");
    const size_t samples = (size_t)glass.width * glass.height * upright.channels;
    for (size_t i = 0; i < samples; i++)
        upright.samples[i] = glass.rgb[grey ? 3 * i : i];
    const bool good = yb_picture_turn(picture, &upright, 4 - (unsigned)scene->request->play.turn);
    yb_picture_free(&upright);
    return good || fail(scene, "out of memory");
}

/* A frame is on the panel. */
static bool keep_picture(scene_t *scene)
{
    yb_picture_free(&scene->picture);
    return take_picture(scene, &scene->picture);
}

static bool write_png(scene_t *scene, const char *path, bool force)
{
    yb_error_t error = {.text = "out of memory"};
    size_t size = 0;
    uint8_t *png = yb_picture_png(&scene->picture, &size);
    const bool good = png != NULL && yb_output_write(path, force, png, size, &error);
    free(png);
    return good || fail(scene, error.text);
}

static void take_shot(scene_t *scene)
{
    char path[32];
    yb_error_t error;
    do
        snprintf(path, sizeof(path), "shot-%d.png", ++scene->shots);
    while (!yb_output_allowed(path, false, &error) && scene->shots < 10000);
    if (write_png(scene, path, false))
        fprintf(stderr, "yamabiko sim: wrote %s\n", path);
}

/* ---- Time: the model's runs ahead, the window waits for it ----------------------------------- */

static uint64_t real_ns(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (uint64_t)time.tv_sec * 1000000000u + (uint64_t)time.tv_nsec;
}

/* So long as the bytes since the last frame take on a real bus. */
static void wait_for_bus(scene_t *scene)
{
    const uint64_t due = scene->real_ns + (scene->wires.nanoseconds - scene->wires_ns);
    const uint64_t now = real_ns();
    if (due > now && !scene->request->fast) {
        const struct timespec left = {.tv_sec = (time_t)((due - now) / 1000000000u),
                                      .tv_nsec = (long)((due - now) % 1000000000u)};
        (void)nanosleep(&left, NULL);
    }
    scene->real_ns = real_ns();
    scene->wires_ns = scene->wires.nanoseconds;
}

static bool shown(void *context)
{
    scene_t *scene = context;
    if (scene->window == NULL)
        return true;
    if (!keep_picture(scene))
        return false;
    wait_for_bus(scene);
    return yb_sim_window_show(scene->window, scene->picture.samples,
                              scene->picture.channels == 1) ||
           fail(scene, "the desktop is gone");
}

/* ---- Any panel ------------------------------------------------------------------------------- */

static yb_act_t wait_for(void *context, yb_player_t *player, int timeout_ms)
{
    enum {
        LOOK_MS = 200 /* at the folders */
    };
    scene_t *scene = context;
    yb_player_update(player);
    if (scene->window == NULL)
        return YB_ACT_NONE;
    const int most_ms = yb_map_list_fd(scene->list) >= 0 ? LOOK_MS : 60000;
    const int key = yb_sim_window_wait(
        scene->window, timeout_ms >= 0 && timeout_ms < most_ms ? timeout_ms : most_ms);
    if (key == YB_KEY_SHOT)
        take_shot(scene);
    return scene->failed ? YB_ACT_QUIT : cli_keys_act(key);
}

static uint64_t bytes_sent(void *context)
{
    const scene_t *scene = context;
    return yb_panel_model_bytes(scene->wires.model);
}

static uint64_t wires_ms(void *context)
{
    const scene_t *scene = context;
    return scene->wires.nanoseconds / 1000000;
}

static void play_maps(scene_t *scene, char **maps, size_t count)
{
    static volatile int stop;
    const cli_play_t *play = &scene->request->play;
    cli_played_t played = {0};
    yb_error_t error;
    scene->list = yb_map_list_open(maps, count, &error);
    if (scene->list == NULL) {
        fail(scene, error.text);
        return;
    }
    yb_player_t *player = cli_play_player(play, scene->list);
    const yb_outlet_clock_t clock = {.now_ms = wires_ms, .context = scene};
    yb_outlet_t *outlet =
        yb_outlet_open(play->panel, play->turn, scene->bus, cli_play_band_rows(play), &clock);
    const cli_stage_t stage = {.context = scene,
                               .outlet = outlet,
                               .wait = wait_for,
                               .shown = shown,
                               .bytes = bytes_sent,
                               .stop = &stop,
                               .hurry = scene->window == NULL};
    if (player == NULL || outlet == NULL)
        fail(scene, "out of memory");
    else if (!cli_play_start(play, outlet) ||
             cli_play_run(play, &stage, player, &played) == CLI_PLAY_BUS_LOST)
        fail(scene, yb_panel_model_error(scene->wires.model));
    yb_outlet_close(outlet);
    yb_player_free(player);
    yb_map_list_close(scene->list);
    if (!scene->failed && played.black)
        fail(scene, "no map could be drawn");
    cli_play_sum(play, &played);
}

/* ---- The handheld ---------------------------------------------------------------------------- */

typedef struct {
    scene_t *scene;
    yb_display_t display;
    int key; /* that the console reads next; -1: none */
} handheld_t;

static int read_console(void *context)
{
    handheld_t *handheld = context;
    const int key = handheld->key;
    handheld->key = -1;
    return key;
}

static void write_console(void *context, char character)
{
    (void)context;
    if (character != '\r')
        putchar(character);
}

static void send_band(void *context, uint16_t y, uint16_t rows, const uint8_t *pixels)
{
    handheld_t *handheld = context;
    if (!yb_display_write_rows(&handheld->display, y, rows, pixels))
        fail(handheld->scene, yb_panel_model_error(handheld->scene->wires.model));
}

/* False: the user closes the window. */
static bool next_key(handheld_t *handheld, int timeout_ms)
{
    scene_t *scene = handheld->scene;
    if (scene->window == NULL)
        return true;
    const int key = yb_sim_window_wait(scene->window, timeout_ms);
    if (key == YB_KEY_SHOT)
        take_shot(scene);
    if (key > 0 && key < 0x80)
        handheld->key = key;
    return key != YB_KEY_CLOSE && key != 'q';
}

static void run_handheld(handheld_t *handheld, const yb_turntable_port_t *port)
{
    scene_t *scene = handheld->scene;
    const cli_play_t *play = &scene->request->play;
    yb_turntable_t *table = malloc(sizeof(*table));
    if (table == NULL || !yb_display_start(&handheld->display)) {
        fail(scene, table == NULL ? "out of memory" : yb_panel_model_error(scene->wires.model));
        free(table);
        return;
    }
    yb_turntable_begin(table, port);
    for (long frame = 1; !scene->failed && shown(scene); frame++) {
        fflush(stdout);
        if (play->frames > 0 && frame >= play->frames)
            break;
        if (!next_key(handheld, (int)(1000 / play->fps)))
            break;
        yb_turntable_step(table);
    }
    free(table);
}

static void play_handheld(scene_t *scene, const char *map)
{
    static uint8_t slot[MAP_MOST] = {0xff, 0xff}; /* empty */
    handheld_t handheld = {
        .scene = scene, .display = {.panel = scene->wires.panel, .bus = scene->bus}, .key = -1};
    const yb_turntable_port_t port = {.board = "sim",
                                      .context = &handheld,
                                      .read = read_console,
                                      .write = write_console,
                                      .band = send_band,
                                      .slot = slot,
                                      .slot_bytes = sizeof(slot),
                                      .built_in = yb_built_in_map,
                                      .built_in_bytes = yb_built_in_map_bytes};
    yb_error_t error;
    yb_code_file_t *file = map != NULL ? yb_code_file_read(map, &error) : NULL;
    if (map != NULL && file == NULL)
        fail(scene, error.text);
    else if (file != NULL && file->size > sizeof(slot))
        fail(scene, "the map is larger than the handheld's slot");
    else if (file != NULL)
        memcpy(slot, file->bytes, file->size);
    yb_code_file_free(file);
    if (!scene->failed)
        run_handheld(&handheld, &port);
}

/* ---- The verb -------------------------------------------------------------------------------- */

static bool open_window(scene_t *scene)
{
    const request_t *request = scene->request;
    char why[YB_WINDOW_ERROR_BYTES];
    const yb_screen_t screen = yb_outlet_screen(scene->wires.panel, request->play.turn);
    if (is_headless(request))
        return true;
    scene->window = yb_sim_window_open(scene->wires.panel->title, screen.width, screen.height,
                                       (int)request->scale, request->full_screen, why);
    scene->real_ns = real_ns();
    return scene->window != NULL || fail(scene, why);
}

static void play(scene_t *scene, char **maps, size_t count)
{
    const request_t *request = scene->request;
    if (!open_window(scene))
        return;
    if (request->play.panel == NULL)
        play_handheld(scene, count > 0 ? maps[0] : NULL);
    else
        play_maps(scene, maps, count);
    if (!scene->failed && request->png != NULL)
        (void)(keep_picture(scene) && write_png(scene, request->png, request->force));
}

/* The same, and what goes over the wires is written down. */
static void play_recorded(scene_t *scene, char **maps, size_t count)
{
    const request_t *request = scene->request;
    yb_error_t error;
    yb_output_t *output = yb_output_open(request->record, request->force, &error);
    FILE *file = output != NULL ? fopen(yb_output_path(output), "w") : NULL;
    if (file != NULL) {
        yb_recorder_init(&scene->recorder, file, &scene->wires.bus);
        scene->bus = &scene->recorder.bus;
        play(scene, maps, count);
        const bool written = ferror(file) == 0;
        if (fclose(file) != 0 || !written)
            (void)yb_error_set(&error, "%s cannot be written", request->record);
        else if (yb_output_commit(output, &error))
            error.text[0] = '\0';
    } else if (output != NULL) {
        (void)yb_error_set(&error, "%s cannot be written", request->record);
    }
    yb_output_close(output);
    if (error.text[0] != '\0')
        fail(scene, error.text);
}

static int run(const request_t *request, char **maps, size_t count)
{
    const bool handheld = request->play.panel == NULL;
    scene_t scene = {.request = request};
    if (!yb_model_bus_open(&scene.wires, handheld ? &yb_panel_ssd0323 : request->play.panel))
        return cli_fail("out of memory");
    scene.bus = &scene.wires.bus;
    if (request->record != NULL)
        play_recorded(&scene, maps, count);
    else
        play(&scene, maps, count);
    yb_picture_free(&scene.picture);
    yb_sim_window_close(scene.window);
    yb_model_bus_close(&scene.wires);
    return scene.failed ? CLI_FAILED : CLI_OK;
}

static int obey(int argc, char **argv)
{
    request_t request = {.play = cli_play_default()};
    int answer = 0;
    while ((answer = getopt_long(argc, argv, ":", options, NULL)) != -1) {
        const int status = take(&request, answer, argc, argv);
        if (status != CLI_OK)
            return status;
    }
    if (request.help) {
        help();
        return CLI_OK;
    }
    const size_t maps = (size_t)(argc - optind);
    const int status = check(&request, maps);
    return status != CLI_OK ? status : run(&request, argv + optind, maps);
}

int cli_sim(int argc, char **argv)
{
    cli_config_t config;
    const int status = cli_config_read(&config, options, argc, argv);
    if (status != CLI_OK)
        return status;
    const int result = obey(config.argc, config.argv);
    cli_config_free(&config);
    return result;
}
