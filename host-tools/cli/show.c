#include "cli.h"

#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <linux_bus.h>
#include <linux_buttons.h>

#include "config.h"
#include "keys.h"
#include "play.h"

enum {
    OPTION_BUS = 256,
    OPTION_SPI,
    OPTION_SPI_HZ,
    OPTION_GPIOCHIP,
    OPTION_SCK,
    OPTION_MOSI,
    OPTION_CS,
    OPTION_DC,
    OPTION_RESET,
    OPTION_BACKLIGHT,
    OPTION_BUTTON,
    OPTION_RETRY,
    OPTION_KEEP,
    OPTION_ONCE,
    OPTION_HELP,

    RETRY_MOST_S = 60,
    LOOK_MS = 1000, /* for a folder that is gone */
};

static const struct option options[] = {{"bus", required_argument, NULL, OPTION_BUS},
                                        {"spi", required_argument, NULL, OPTION_SPI},
                                        {"spi-hz", required_argument, NULL, OPTION_SPI_HZ},
                                        {"gpiochip", required_argument, NULL, OPTION_GPIOCHIP},
                                        {"sck", required_argument, NULL, OPTION_SCK},
                                        {"mosi", required_argument, NULL, OPTION_MOSI},
                                        {"cs", required_argument, NULL, OPTION_CS},
                                        {"dc", required_argument, NULL, OPTION_DC},
                                        {"reset", required_argument, NULL, OPTION_RESET},
                                        {"backlight", required_argument, NULL, OPTION_BACKLIGHT},
                                        {"button", required_argument, NULL, OPTION_BUTTON},
                                        {"retry", no_argument, NULL, OPTION_RETRY},
                                        {"keep", no_argument, NULL, OPTION_KEEP},
                                        {"once", no_argument, NULL, OPTION_ONCE},
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        CLI_PLAY_LONG_OPTIONS,
                                        {0}};

typedef struct {
    cli_play_t play;
    bool spidev, bus_given;
    yb_linux_wiring_t wiring;
    char *lines[YB_LINUX_BUTTONS_MAX]; /* of buttons */
    yb_act_t acts[YB_LINUX_BUTTONS_MAX];
    size_t buttons;
    bool retry, keep, once, help;
} request_t;

/* The panel while it is reached, and what else is waited for. */
typedef struct {
    const request_t *request;
    yb_linux_bus_t *bus;
    yb_outlet_t *outlet;
    yb_linux_buttons_t *buttons;
    yb_map_list_t *list;
    int keys;
} scene_t;

static void help(void)
{
    fputs(
        "Usage: yamabiko show MAP.yb|FOLDER ... --panel NAME --bus spidev --spi DEVICE --dc LINE\n"
        "       yamabiko show MAP.yb|FOLDER ... --panel NAME --bus gpiod --sck LINE --mosi LINE\n"
        "                     --cs LINE --dc LINE\n"
        "\n"
        "Shows maps on a real SPI panel of this machine until a signal or a key ends it; then the\n"
        "panel is blank. A folder's codes are all shown, and those that come later. MAP.yb may\n"
        "be - for the standard input.\n"
        "\n"
        "  --bus spidev        the panel hangs on an SPI controller of the kernel's\n"
        "  --bus gpiod         on any GPIO lines, bit by bit\n"
        "  --spi DEVICE        for spidev: such as /dev/spidev0.0\n"
        "  --spi-hz N          for spidev: its clock (default: the panel's rated one)\n"
        "  --gpiochip CHIP     whose lines the following are: a name, number, path or label\n"
        "                      (default gpiochip0); a LINE is a number or a name, as gpioinfo\n"
        "                      shows them\n"
        "  --sck, --mosi, --cs LINE\n"
        "                      for gpiod: serial clock, data, chip select\n"
        "  --dc LINE           tells data from commands; Sharp's panels have none\n"
        "  --reset LINE        the panel's reset, if it is wired\n"
        "  --backlight LINE    high is lit, if it is wired\n"
        "  --button LINE=ACT   a button to ground; ACT is next, previous, left, right, pause,\n"
        "                      shadows, lines or quit; may be given 16 times\n"
        "  --retry             if the panel cannot be reached, try again after 1, 2, 4 … 60\n"
        "                      seconds; else exit with code 3\n"
        "  --keep              leave the last picture on the panel at the end\n"
        "  --once              one frame, which stays on the panel; exit code 1 if there is no "
        "map\n"
        "  --help              this text\n",
        stdout);
    fputs(cli_play_help, stdout);
    fputs("\nKeys, on a terminal:\n", stdout);
    fputs(cli_keys_help, stdout);
    fputs("\nView:\n", stdout);
    fputs(yb_view_options_help, stdout);
    fputs("\n"
          "Examples:\n"
          "  yamabiko show fuji.yb --panel st7789 --bus spidev --spi /dev/spidev0.0 --dc 25\n"
          "                --reset 24 --backlight 18 --orbit\n"
          "  yamabiko show maps --slide 20 --panel ssd0323 --bus gpiod --sck 11 --mosi 10 --cs 8\n"
          "                --dc 25 --button 5=next\n",
          stdout);
}

static int take_button(request_t *request)
{
    char *equals = strchr(optarg, '=');
    yb_act_t act = YB_ACT_NEXT;
    while (equals != NULL && act < YB_ACT_END && strcmp(equals + 1, yb_act_name(act)) != 0)
        act = (yb_act_t)(act + 1);
    if (equals == NULL || equals == optarg || act == YB_ACT_END)
        return cli_usage(
            "--button: '%s' is not LINE=ACT, where ACT is next, previous, left, right, "
            "pause, shadows, lines or quit",
            optarg);
    if (request->buttons == YB_LINUX_BUTTONS_MAX)
        return cli_usage("--button: there may be %d", YB_LINUX_BUTTONS_MAX);
    *equals = '\0';
    request->lines[request->buttons] = optarg;
    request->acts[request->buttons++] = act;
    return CLI_OK;
}

static int take_bus(request_t *request)
{
    request->bus_given = true;
    request->spidev = strcmp(optarg, "spidev") == 0;
    return request->spidev || strcmp(optarg, "gpiod") == 0
               ? CLI_OK
               : cli_usage("there is no bus '%s'; there are: gpiod, spidev", optarg);
}

static int take_wire(yb_linux_wiring_t *wiring, int answer, int argc, char **argv)
{
    long hz = 0;
    switch (answer) {
    case OPTION_SPI:
        wiring->spi = optarg;
        return CLI_OK;
    case OPTION_SPI_HZ:
        if (!cli_integer(optarg, 1000, 200000000, &hz))
            return cli_usage("--spi-hz: '%s' is not a whole number from 1000 to 200000000", optarg);
        wiring->spi_hz = (uint32_t)hz;
        return CLI_OK;
    case OPTION_GPIOCHIP:
        wiring->chip = optarg;
        return CLI_OK;
    case OPTION_SCK:
        wiring->sck = optarg;
        return CLI_OK;
    case OPTION_MOSI:
        wiring->mosi = optarg;
        return CLI_OK;
    case OPTION_CS:
        wiring->cs = optarg;
        return CLI_OK;
    case OPTION_DC:
        wiring->dc = optarg;
        return CLI_OK;
    case OPTION_RESET:
        wiring->reset = optarg;
        return CLI_OK;
    case OPTION_BACKLIGHT:
        wiring->backlight = optarg;
        return CLI_OK;
    default:
        return cli_bad_option(answer, argc, argv);
    }
}

static int take(request_t *request, int answer, int argc, char **argv)
{
    if (cli_play_owns(answer))
        return cli_play_take(&request->play, answer, argc, argv);
    switch (answer) {
    case OPTION_BUS:
        return take_bus(request);
    case OPTION_BUTTON:
        return take_button(request);
    case OPTION_RETRY:
        request->retry = true;
        return CLI_OK;
    case OPTION_KEEP:
        request->keep = true;
        return CLI_OK;
    case OPTION_ONCE:
        request->once = request->keep = true;
        return CLI_OK;
    case OPTION_HELP:
        request->help = true;
        return CLI_OK;
    default:
        return take_wire(&request->wiring, answer, argc, argv);
    }
}

static int check(request_t *request)
{
    const yb_linux_wiring_t *wiring = &request->wiring;
    const int status = cli_play_check(&request->play);
    if (status != CLI_OK)
        return status;
    const bool needs_dc = (request->play.panel->flags & YB_PANEL_NO_DC) == 0;
    if (!request->bus_given)
        return cli_usage("say how the panel is wired: --bus spidev or --bus gpiod, and its lines");
    if (request->spidev && wiring->spi == NULL)
        return cli_usage("--bus spidev needs the device: --spi /dev/spidev0.0");
    if (request->spidev && (wiring->sck != NULL || wiring->mosi != NULL || wiring->cs != NULL))
        return cli_usage("--sck, --mosi and --cs are for --bus gpiod: spidev has its own");
    if (!request->spidev && (wiring->spi != NULL || wiring->spi_hz != 0))
        return cli_usage("--spi and --spi-hz are for --bus spidev");
    if (!request->spidev && (wiring->sck == NULL || wiring->mosi == NULL || wiring->cs == NULL))
        return cli_usage("--bus gpiod needs the lines --sck, --mosi and --cs");
    if (needs_dc && wiring->dc == NULL)
        return cli_usage("%s needs the line --dc", request->play.panel->name);
    if (!needs_dc && wiring->dc != NULL)
        return cli_usage("%s has no D/C line: leave --dc out", request->play.panel->name);
    if (request->once && (request->retry || request->play.frames > 0))
        return cli_usage("--once is one frame: leave --frames and --retry out");
    if (request->once)
        request->play.frames = 1;
    return CLI_OK;
}

/* ---- Signals: the flag stops a frame between two bands, the pipe ends a wait ----------------- */

static volatile int stop;
static int wake[2] = {-1, -1};

static void on_signal(int signal)
{
    const int before = errno;
    (void)signal;
    stop = 1;
    (void)!write(wake[1], "", 1);
    errno = before;
}

/* Those that end a program; but under nohup a terminal that goes ends nothing. */
static bool catch_signals(void)
{
    static const int ends[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    const struct sigaction action = {.sa_handler = on_signal};
    const struct sigaction ignore = {.sa_handler = SIG_IGN};
    struct sigaction before;
    bool good = pipe(wake) == 0 && fcntl(wake[1], F_SETFL, O_NONBLOCK) == 0 &&
                sigaction(SIGPIPE, &ignore, NULL) == 0;
    for (size_t i = 0; good && i < sizeof(ends) / sizeof(ends[0]); i++)
        good = sigaction(ends[i], NULL, &before) == 0 &&
               ((ends[i] == SIGHUP && before.sa_handler == SIG_IGN) ||
                sigaction(ends[i], &action, NULL) == 0);
    return good;
}

/* ---- The panel ------------------------------------------------------------------------------- */

static void leave(scene_t *scene, bool dark)
{
    if (scene->outlet != NULL && dark) {
        (void)yb_outlet_blank(scene->outlet);
        (void)yb_linux_bus_backlight(scene->bus, false);
    }
    yb_outlet_close(scene->outlet);
    yb_linux_bus_close(scene->bus);
    yb_linux_buttons_close(scene->buttons);
    scene->outlet = NULL;
    scene->bus = NULL;
    scene->buttons = NULL;
}

static bool open_buttons(scene_t *scene, char *why)
{
    const request_t *request = scene->request;
    if (request->buttons > 0)
        scene->buttons = yb_linux_buttons_open(
            request->wiring.chip, (const char *const *)request->lines, request->buttons, why);
    return request->buttons == 0 || scene->buttons != NULL;
}

/* False: it has been said why not. */
static bool reach(scene_t *scene)
{
    const cli_play_t *play = &scene->request->play;
    char why[YB_LINUX_ERROR_BYTES];
    if (open_buttons(scene, why))
        scene->bus = yb_linux_bus_open(&scene->request->wiring, play->panel, why);
    if (scene->bus == NULL) {
        (void)cli_fail("%s", why);
        leave(scene, false);
        return false;
    }
    scene->outlet = yb_outlet_open(play->panel, play->turn, yb_linux_bus_panel(scene->bus),
                                   cli_play_band_rows(play), NULL);
    if (scene->outlet == NULL)
        (void)cli_fail("out of memory");
    else if (cli_play_start(play, scene->outlet) &&
             yb_linux_bus_backlight(scene->bus, play->brightness != 0))
        return true;
    else
        (void)cli_fail("%s", yb_linux_bus_error(scene->bus));
    leave(scene, false);
    return false;
}

/* ---- What happens while a frame is shown ----------------------------------------------------- */

static yb_act_t button_act(scene_t *scene)
{
    const int pressed = yb_linux_buttons_read(scene->buttons);
    if (pressed == -2) {
        (void)cli_fail(
            "the buttons' GPIO chip is gone: they do nothing until the panel is reached anew");
        yb_linux_buttons_close(scene->buttons);
        scene->buttons = NULL;
    }
    return pressed >= 0 ? scene->request->acts[pressed] : YB_ACT_NONE;
}

static yb_act_t wait_for(void *context, yb_player_t *player, int timeout_ms)
{
    scene_t *scene = context;
    const int buttons = scene->buttons != NULL ? yb_linux_buttons_fd(scene->buttons) : -1;
    struct pollfd fds[] = {{.fd = wake[0], .events = POLLIN},
                           {.fd = yb_map_list_fd(scene->list), .events = POLLIN},
                           {.fd = buttons, .events = POLLIN},
                           {.fd = scene->keys, .events = POLLIN}};
    const bool looks = yb_map_list_misses(scene->list);
    const int most_ms = looks && timeout_ms > LOOK_MS ? LOOK_MS : timeout_ms;
    const int ready = poll(fds, sizeof(fds) / sizeof(fds[0]), most_ms);
    if (looks || (ready > 0 && fds[1].revents != 0))
        yb_player_update(player);
    if (ready <= 0 || fds[0].revents != 0)
        return YB_ACT_NONE;
    if (fds[2].revents != 0)
        return button_act(scene);
    if ((fds[3].revents & (POLLERR | POLLHUP)) != 0)
        scene->keys = -1; /* the terminal is gone */
    return fds[3].revents != 0 ? cli_keys_read() : YB_ACT_NONE;
}

static uint64_t bytes_sent(void *context)
{
    const scene_t *scene = context;
    return yb_linux_bus_bytes(scene->bus);
}

/* Until the next try; false: the end is wanted. */
static bool wait_to_retry(scene_t *scene, yb_player_t *player, int seconds)
{
    fprintf(stderr, "yamabiko show: trying again in %d s\n", seconds);
    for (int tenths = 10 * seconds; tenths > 0 && !stop; tenths--) {
        const yb_act_t act = wait_for(scene, player, 100);
        if (act == YB_ACT_QUIT)
            return false;
        yb_player_act(player, act);
    }
    return !stop;
}

/* ---- The show -------------------------------------------------------------------------------- */

static int play_on(scene_t *scene, yb_player_t *player)
{
    const request_t *request = scene->request;
    cli_played_t played = {0};
    int status = CLI_OK;
    int delay_s = 1;
    while (!stop) {
        const long before = played.frames;
        cli_play_end_t end = CLI_PLAY_BUS_LOST;
        if (reach(scene)) {
            const cli_stage_t stage = {.context = scene,
                                       .outlet = scene->outlet,
                                       .wait = wait_for,
                                       .bytes = bytes_sent,
                                       .stop = &stop};
            end = cli_play_run(&request->play, &stage, player, &played);
            if (end == CLI_PLAY_BUS_LOST)
                (void)cli_fail("%s", yb_linux_bus_error(scene->bus));
            leave(scene, end == CLI_PLAY_DONE && !request->keep);
        }
        if (end == CLI_PLAY_DONE)
            break;
        if (!request->retry) {
            status = CLI_UNREACHED;
            break;
        }
        delay_s = played.frames > before ? 1 : delay_s;
        if (!wait_to_retry(scene, player, delay_s))
            break;
        delay_s = delay_s * 2 < RETRY_MOST_S ? delay_s * 2 : RETRY_MOST_S;
    }
    cli_play_sum(&request->play, &played);
    return status == CLI_OK && played.black && request->once ? CLI_FAILED : status;
}

static int run(const request_t *request, char **maps, size_t count)
{
    yb_error_t error;
    scene_t scene = {.request = request, .keys = -1};
    int status = CLI_FAILED;
    if (!catch_signals())
        return cli_fail("cannot catch signals: %s", strerror(errno));
    scene.list = yb_map_list_open(maps, count, &error);
    if (scene.list == NULL)
        return cli_fail("%s", error.text);
    yb_player_t *player = cli_play_player(&request->play, scene.list);
    if (player != NULL) {
        scene.keys = request->once ? -1 : cli_keys_open();
        status = play_on(&scene, player);
        cli_keys_close();
    }
    yb_player_free(player);
    yb_map_list_close(scene.list);
    return status;
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
    if (optind == argc)
        return cli_usage("name a code, MAP.yb, or a folder of them");
    const int status = check(&request);
    return status != CLI_OK ? status : run(&request, argv + optind, (size_t)(argc - optind));
}

int cli_show(int argc, char **argv)
{
    cli_config_t config;
    const int status = cli_config_read(&config, options, argc, argv);
    if (status != CLI_OK)
        return status;
    const int result = obey(config.argc, config.argv);
    cli_config_free(&config);
    return result;
}
