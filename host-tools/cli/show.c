#include "cli.h"

#include <assert.h>
#include <getopt.h>
#include <stdio.h>
#include <string.h>

#include <linux_bus.h>
#include <panel.h>

#include "code_file.h"
#include "still.h"
#include "view_options.h"

enum {
    OPTION_PANEL = 256,
    OPTION_BUS,
    OPTION_GPIOCHIP,
    OPTION_SCK,
    OPTION_MOSI,
    OPTION_CS,
    OPTION_DC,
    OPTION_RESET,
    OPTION_HELP
};

static const struct option options[] = {{"panel", required_argument, NULL, OPTION_PANEL},
                                        {"bus", required_argument, NULL, OPTION_BUS},
                                        {"gpiochip", required_argument, NULL, OPTION_GPIOCHIP},
                                        {"sck", required_argument, NULL, OPTION_SCK},
                                        {"mosi", required_argument, NULL, OPTION_MOSI},
                                        {"cs", required_argument, NULL, OPTION_CS},
                                        {"dc", required_argument, NULL, OPTION_DC},
                                        {"reset", required_argument, NULL, OPTION_RESET},
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        YB_VIEW_LONG_OPTIONS,
                                        {0}};

typedef struct {
    const char *input, *bus;
    const yb_panel_t *panel;
    yb_linux_wiring_t pins;
    bool help;
    yb_view_options_t view;
} request_t;

static void help(void)
{
    fputs("Usage: yamabiko show MAP.yb --panel NAME --bus gpiod --sck N --mosi N --cs N --dc N\n"
          "                     [OPTION ...]\n"
          "\n"
          "Draws a map on a real SPI panel that hangs on GPIO lines of this machine. The picture\n"
          "stays there until something else is drawn. MAP.yb may be - for the standard input.\n"
          "\n"
          "  --panel NAME        ssd0323 (128x64, 16 greys)\n"
          "  --bus gpiod         bit by bit on any GPIO lines, through libgpiod\n"
          "  --gpiochip CHIP     whose lines they are: a name, number, path or label; standard\n"
          "                      gpiochip0\n"
          "  --sck N             line of the serial clock\n"
          "  --mosi N            line of the data\n"
          "  --cs N              line of the chip select\n"
          "  --dc N              line that tells data from commands\n"
          "  --reset N           line of the panel's reset, if it is wired\n"
          "  --help              this text\n"
          "\n"
          "View:\n",
          stdout);
    fputs(yb_view_options_help, stdout);
    fputs("\n"
          "Example:\n"
          "  yamabiko show fuji.yb --panel ssd0323 --bus gpiod --sck 11 --mosi 10 --cs 8 --dc 25\n",
          stdout);
}

static int take(request_t *request, int answer, int argc, char **argv)
{
    yb_error_t error;
    if (yb_view_options_owns(answer)) {
        if (!yb_view_options_take(&request->view, answer, argc, argv, &error))
            return cli_usage("%s", error.text);
        return CLI_OK;
    }
    switch (answer) {
    case OPTION_PANEL:
        request->panel = yb_panel_find(optarg);
        return request->panel != NULL ? CLI_OK : cli_usage("there is no panel '%s'", optarg);
    case OPTION_BUS:
        request->bus = optarg;
        return strcmp(optarg, "gpiod") == 0
                   ? CLI_OK
                   : cli_usage("there is no bus '%s'; there is: gpiod", optarg);
    case OPTION_GPIOCHIP:
        request->pins.chip = optarg;
        return CLI_OK;
    case OPTION_SCK:
        request->pins.sck = optarg;
        return CLI_OK;
    case OPTION_MOSI:
        request->pins.mosi = optarg;
        return CLI_OK;
    case OPTION_CS:
        request->pins.cs = optarg;
        return CLI_OK;
    case OPTION_DC:
        request->pins.dc = optarg;
        return CLI_OK;
    case OPTION_RESET:
        request->pins.reset = optarg;
        return CLI_OK;
    case OPTION_HELP:
        request->help = true;
        return CLI_OK;
    default:
        return cli_bad_option(answer, argc, argv);
    }
}

static int check(request_t *request)
{
    yb_error_t error;
    const yb_linux_wiring_t *pins = &request->pins;
    if (request->input == NULL)
        return cli_usage("name one code, MAP.yb");
    if (request->panel == NULL)
        return cli_usage("name the panel: --panel ssd0323");
    if (request->bus == NULL)
        return cli_usage("say how the panel is wired: --bus gpiod and its lines");
    if (pins->sck == NULL || pins->mosi == NULL || pins->cs == NULL || pins->dc == NULL)
        return cli_usage("--bus gpiod needs the lines --sck, --mosi, --cs and --dc");
    if (yb_view_options_given(&request->view, YB_OPTION_SIZE) ||
        yb_view_options_given(&request->view, YB_OPTION_FORMAT))
        return cli_usage("the panel fixes size and format: leave --size and --format out");
    yb_view_options_panel(&request->view, &request->panel->screen);
    return yb_view_options_check(&request->view, &error) ? CLI_OK : cli_usage("%s", error.text);
}

static int show(const request_t *request, const yb_still_t *still)
{
    assert(request->panel != NULL); /* check() has seen to it */
    char why[YB_LINUX_ERROR_BYTES];
    yb_linux_bus_t *bus = yb_linux_bus_open(&request->pins, request->panel, why);
    if (bus == NULL)
        return cli_fail("%s", why);
    yb_display_t display = {.panel = request->panel, .bus = yb_linux_bus_panel(bus)};
    const bool good = yb_display_start(&display) &&
                      yb_display_write_rows(&display, 0, still->screen.height, still->pixels);
    const int status = good ? CLI_OK : cli_fail("%s", yb_linux_bus_error(bus));
    yb_linux_bus_close(bus);
    return status;
}

static int run(const request_t *request)
{
    yb_error_t error;
    yb_code_file_t *file = yb_code_file_read(request->input, &error);
    if (file == NULL)
        return cli_fail("%s", error.text);
    yb_view_t view;
    yb_still_t still = {.pixels = NULL};
    int status = CLI_OK;
    if (!yb_view_options_apply(&request->view, &file->map, &view, &error))
        status = cli_fail("%s", error.text);
    else if (!yb_still_draw(&still, &file->map, &view, &request->view.screen,
                            request->view.band_rows, (uint16_t)request->view.shadows))
        status = cli_fail("not enough memory to draw %s", request->input);
    else
        status = show(request, &still);
    yb_still_free(&still);
    yb_code_file_free(file);
    return status;
}

int cli_show(int argc, char **argv)
{
    request_t request = {
        .view = yb_view_options_default(),
    };
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
    if (optind + 1 == argc)
        request.input = argv[optind];
    const int status = check(&request);
    return status != CLI_OK ? status : run(&request);
}
