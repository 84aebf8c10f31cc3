#include "play.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli.h"
#include "panels.h"

enum {
    BANDS = 8, /* in a frame, about */
    STANDARD_FPS = 30,
};

const char cli_play_help[] =
    "  --panel NAME        'yamabiko info --panel' lists the panels\n"
    "  --turn DEG          how far the picture is turned clockwise on the glass: 0, 90, 180, 270\n"
    "  --orbit[=DEG]       the camera goes round, DEG clockwise a frame (default 1)\n"
    "  --spin-sun[=DEG]    the sun goes round, DEG clockwise a frame (default 1)\n"
    "  --slide SECONDS     the next map after so many seconds\n"
    "  --fps N             at most N frames a second, 0.01 to 1000 (default 30)\n"
    "  --frames N          end after N frames\n"
    "  --brightness N      percent, of an OLED; a backlight only knows on and off\n"
    "  --invert            light for dark\n"
    "  --whole             send every frame whole, not only what changed\n"
    "  --stats             tell every second on the standard error how many frames a second and\n"
    "                      bytes a frame there were, and in the end the sum on the standard "
    "output\n"
    "  --config FILE       options from an INI file, one a line: 'panel = st7789', 'orbit = yes',\n"
    "                      'sun = 315 30', 'map = fuji.yb'; the command line overrides them, maps\n"
    "                      and buttons add up\n";

cli_play_t cli_play_default(void)
{
    return (cli_play_t){.fps = STANDARD_FPS, .brightness = -1, .view = yb_view_options_default()};
}

bool cli_play_owns(int answer)
{
    return (answer >= CLI_PLAY_PANEL && answer < CLI_PLAY_END) || yb_view_options_owns(answer);
}

static int take_number(const char *name, double low, double high, double *value)
{
    if (optarg == NULL) {
        *value = 1;
        return CLI_OK;
    }
    if (!cli_number(optarg, value) || *value < low || *value > high)
        return cli_usage("--%s: '%s' is not a number from %g to %g", name, optarg, low, high);
    return CLI_OK;
}

int cli_play_take(cli_play_t *play, int answer, int argc, char **argv)
{
    yb_error_t error;
    if (yb_view_options_owns(answer))
        return yb_view_options_take(&play->view, answer, argc, argv, &error)
                   ? CLI_OK
                   : cli_usage("%s", error.text);
    switch (answer) {
    case CLI_PLAY_PANEL:
        return cli_take_panel(optarg, &play->panel);
    case CLI_PLAY_TURN:
        return cli_take_turn(optarg, &play->turn);
    case CLI_PLAY_ORBIT:
        return take_number("orbit", -180, 180, &play->orbit_deg);
    case CLI_PLAY_SPIN_SUN:
        return take_number("spin-sun", -180, 180, &play->sun_deg);
    case CLI_PLAY_SLIDE:
        return take_number("slide", 0.01, 1e6, &play->slide_s);
    case CLI_PLAY_FPS:
        return take_number("fps", 0.01, 1000, &play->fps);
    case CLI_PLAY_FRAMES:
        return cli_integer(optarg, 1, 1000000000, &play->frames)
                   ? CLI_OK
                   : cli_usage("--frames: '%s' is not a whole number from 1 to 1000000000", optarg);
    case CLI_PLAY_BRIGHTNESS:
        return cli_integer(optarg, 0, 100, &play->brightness)
                   ? CLI_OK
                   : cli_usage("--brightness: '%s' is not a whole number from 0 to 100", optarg);
    case CLI_PLAY_INVERT:
        play->invert = true;
        return CLI_OK;
    case CLI_PLAY_WHOLE:
        play->whole = true;
        return CLI_OK;
    case CLI_PLAY_STATS:
        play->stats = true;
        return CLI_OK;
    default:
        return CLI_OK; /* --config has been read before */
    }
}

int cli_play_check(cli_play_t *play)
{
    yb_error_t error;
    const char *placed = yb_view_options_placed(&play->view);
    if (play->panel == NULL)
        return cli_usage("name the panel: --panel; 'yamabiko info --panel' lists them");
    if (yb_view_options_given(&play->view, YB_OPTION_SIZE) ||
        yb_view_options_given(&play->view, YB_OPTION_FORMAT))
        return cli_usage("the panel fixes size and format: leave --size and --format out");
    if (play->orbit_deg != 0 && placed != NULL)
        return cli_usage("--orbit places the eye: leave --%s out", placed);
    if (play->sun_deg != 0 && yb_view_options_given(&play->view, YB_OPTION_LAMP))
        return cli_usage("--spin-sun moves the sun: leave --lamp out");
    const yb_screen_t screen = yb_outlet_screen(play->panel, play->turn);
    yb_view_options_panel(&play->view, &screen);
    if (!yb_view_options_check(&play->view, &error))
        return cli_usage("%s", error.text);
    if (play->view.band_rows % yb_outlet_step(play->panel, play->turn) != 0)
        return cli_usage("--band: %s takes rows by multiples of %u", play->panel->name,
                         yb_outlet_step(play->panel, play->turn));
    return CLI_OK;
}

uint16_t cli_play_band_rows(const cli_play_t *play)
{
    const uint16_t height = play->view.screen.height;
    const uint16_t step = yb_outlet_step(play->panel, play->turn);
    const uint16_t rows = play->view.band_rows > 0
                              ? play->view.band_rows
                              : (uint16_t)((height / BANDS + step - 1) / step * step);
    return rows < step ? step : rows > height ? height : rows;
}

static void tell(const char *sentence)
{
    (void)cli_fail("%s", sentence);
}

yb_player_t *cli_play_player(const cli_play_t *play, yb_map_list_t *list)
{
    const yb_play_t what = {.view = play->view,
                            .turn_deg = play->orbit_deg,
                            .sun_deg = play->sun_deg,
                            .slide_s = play->slide_s,
                            .band_rows = cli_play_band_rows(play),
                            .tell = tell};
    yb_player_t *player = yb_player_new(&what, list);
    if (player == NULL)
        (void)cli_fail("out of memory");
    return player;
}

static double seconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static void tell_stats(const cli_play_t *play, cli_played_t *played, double now_s)
{
    const long frames = played->frames - played->told_frames;
    const double bytes = (double)(played->bytes - played->told_bytes) / (double)frames;
    fprintf(stderr, "frame %ld: %.1f frames/s, %.0f bytes/frame, %.0f %% of whole frames\n",
            played->frames, (double)frames / (now_s - played->told_s), bytes,
            100 * bytes / yb_panel_frame_bytes(play->panel));
    played->told_frames = played->frames;
    played->told_bytes = played->bytes;
    played->told_s = now_s;
}

void cli_play_sum(const cli_play_t *play, const cli_played_t *played)
{
    if (!play->stats || played->frames == 0)
        return;
    const double bytes = (double)played->bytes / (double)played->frames;
    printf("%ld frames, %llu bytes, %.0f bytes/frame, %.0f %% of whole frames\n", played->frames,
           (unsigned long long)played->bytes, bytes,
           100 * bytes / yb_panel_frame_bytes(play->panel));
}

bool cli_play_start(const cli_play_t *play, yb_outlet_t *outlet)
{
    const uint8_t level = (uint8_t)(play->brightness * 255 / 100);
    return yb_outlet_start(outlet) &&
           (play->brightness < 0 || yb_outlet_set_brightness(outlet, level)) &&
           (!play->invert || yb_outlet_invert(outlet, true));
}

typedef enum {
    WAIT_OVER,
    WAIT_QUIT,
    WAIT_LOST
} wait_end_t;

/* False: the bus failed. */
static bool show_frame(const cli_play_t *play, const cli_stage_t *stage, yb_player_t *player,
                       cli_played_t *played, double now_s)
{
    const uint64_t before = stage->bytes(stage->context);
    if (play->whole)
        yb_outlet_refresh(stage->outlet);
    played->black = !yb_player_draw(player, now_s, stage->outlet, stage->stop);
    if (!yb_outlet_finish(stage->outlet))
        return false;
    played->bytes += stage->bytes(stage->context) - before;
    played->frames++;
    return true;
}

/* Until the next frame is due and, unless frames are counted, differs from the one before. */
static double seconds_left(const cli_play_t *play, const cli_stage_t *stage, yb_player_t *player,
                           double due_s)
{
    const double now_s = seconds();
    if (stage->hurry)
        return 0;
    return play->frames > 0 ? due_s - now_s : fmax(due_s - now_s, yb_player_still_s(player, now_s));
}

/* While nothing is sent, a panel that must hear from us tells whether the bus is well. */
static double longest_wait_s(const cli_play_t *play)
{
    return play->panel->tick_ms > 0 ? 1 : 3600;
}

/* Waits for the time of the next frame, and does what is wanted until then. */
static wait_end_t wait_until(const cli_play_t *play, const cli_stage_t *stage, yb_player_t *player,
                             double due_s)
{
    for (;;) {
        const double left_s = fmax(seconds_left(play, stage, player, due_s), 0);
        const double wait_s = fmin(left_s, longest_wait_s(play));
        const yb_act_t act = stage->wait(stage->context, player, (int)ceil(wait_s * 1000));
        if (act == YB_ACT_QUIT || *stage->stop)
            return WAIT_QUIT;
        if (!yb_outlet_well(stage->outlet))
            return WAIT_LOST;
        yb_player_act(player, act);
        if (act == YB_ACT_NONE && left_s <= 0)
            return WAIT_OVER;
    }
}

cli_play_end_t cli_play_run(const cli_play_t *play, const cli_stage_t *stage, yb_player_t *player,
                            cli_played_t *played)
{
    double due_s = seconds();
    if (played->told_s == 0)
        played->told_s = due_s;
    while (!*stage->stop) {
        const double now_s = stage->hurry ? (double)played->frames / play->fps : seconds();
        if (!show_frame(play, stage, player, played, now_s))
            return *stage->stop ? CLI_PLAY_DONE : CLI_PLAY_BUS_LOST;
        if (stage->shown != NULL && !stage->shown(stage->context))
            return CLI_PLAY_DONE;
        if (play->stats && !stage->hurry && seconds() - played->told_s >= 1)
            tell_stats(play, played, seconds());
        if (play->frames > 0 && played->frames >= play->frames)
            return CLI_PLAY_DONE;
        /* A late frame does not make the next ones hurry. */
        due_s = fmax(due_s + 1 / play->fps, seconds());
        const wait_end_t end = wait_until(play, stage, player, due_s);
        if (end != WAIT_OVER)
            return end == WAIT_LOST ? CLI_PLAY_BUS_LOST : CLI_PLAY_DONE;
    }
    return CLI_PLAY_DONE;
}
