#include "cli.h"

#include <getopt.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "code_file.h"
#include "numbered.h"
#include "outlet.h"
#include "output.h"
#include "panels.h"
#include "part.h"
#include "picture.h"
#include "still.h"
#include "view_options.h"

enum {
    OPTION_PANEL = 256,
    OPTION_TURN,
    OPTION_ORBIT,
    OPTION_JSON,
    OPTION_FORCE,
    OPTION_HELP
};

static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                        {"panel", required_argument, NULL, OPTION_PANEL},
                                        {"turn", required_argument, NULL, OPTION_TURN},
                                        {"orbit", required_argument, NULL, OPTION_ORBIT},
                                        {"json", no_argument, NULL, OPTION_JSON},
                                        {"force", no_argument, NULL, OPTION_FORCE},
                                        CLI_PART_LONG_OPTIONS,
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        YB_VIEW_LONG_OPTIONS,
                                        {0}};

typedef struct {
    const char *input, *output;
    cli_part_t part;
    const yb_panel_t *panel;
    yb_turn_t turn;
    long orbit;
    bool json, force, help;
    yb_view_options_t view;
} request_t;

static void help(void)
{
    fputs(
        "Usage: yamabiko render MAP.yb -o OUT.png [OPTION ...]\n"
        "\n"
        "Draws a map with the very code that runs in the firmware: the same pixels.\n"
        "MAP.yb may be - for the standard input, OUT.png may be - for the standard output.\n"
        "\n"
        "MAP.yb is a code, or a vector file of contour lines with their heights, in any format\n"
        "of GDAL: then the map has all their points, and no fractal detail.\n"
        "\n"
        "  -o, --output FILE   the picture, a PNG file\n"
        "  --panel NAME        the exact pixels of a panel, grey levels times 17; 'yamabiko info\n"
        "                      --panel' lists the panels\n"
        "  --turn DEG          of a panel that is mounted on its side: 0, 90, 180 or 270; the\n"
        "                      picture stands upright\n"
        "  --orbit N           N pictures from round the map, beginning at --azimuth and going\n"
        "                      on clockwise; FILE is a pattern such as f-%03d.png, numbered\n"
        "                      from 0\n"
        "  --json              print the camera in the engine's units, the numbers of triangles\n"
        "                      and the hash (FNV-1a, 32 bits) of the pixel bytes\n"
        "  --force             overwrite what exists\n"
        "  --help              this text\n"
        "\n",
        stdout);
    fputs(cli_part_help, stdout);
    fputs("\nView:\n", stdout);
    fputs(yb_view_options_help, stdout);
    fputs("\n"
          "Examples:\n"
          "  yamabiko render fuji.yb -o fuji.png --azimuth 0 --elevation 20\n"
          "  yamabiko render fuji.yb -o oled.png --panel ssd0323 --view walk-1\n"
          "  yamabiko render fuji.yb -o turn-%02d.png --orbit 36\n",
          stdout);
}

static int take(request_t *request, int answer, int argc, char **argv)
{
    yb_error_t error;
    if (cli_part_owns(answer))
        return cli_part_take(&request->part, answer, argc, argv);
    if (yb_view_options_owns(answer)) {
        if (!yb_view_options_take(&request->view, answer, argc, argv, &error))
            return cli_usage("%s", error.text);
        return CLI_OK;
    }
    switch (answer) {
    case 'o':
        request->output = optarg;
        return CLI_OK;
    case OPTION_PANEL:
        return cli_take_panel(optarg, &request->panel);
    case OPTION_TURN:
        return cli_take_turn(optarg, &request->turn);
    case OPTION_ORBIT:
        if (!cli_integer(optarg, 1, 3600, &request->orbit))
            return cli_usage("--orbit: '%s' is not a whole number from 1 to 3600", optarg);
        return CLI_OK;
    case OPTION_JSON:
        request->json = true;
        return CLI_OK;
    case OPTION_FORCE:
        request->force = true;
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
    const yb_view_options_t *view = &request->view;
    if (request->input == NULL)
        return cli_usage("name one map, MAP.yb");
    if (request->output == NULL)
        return cli_usage("name the picture: -o OUT.png");
    if (request->panel != NULL && (yb_view_options_given(view, YB_OPTION_SIZE) ||
                                   yb_view_options_given(view, YB_OPTION_FORMAT)))
        return cli_usage("--panel fixes size and format: leave --size and --format out");
    if (request->orbit != 0 && yb_view_options_placed(view) != NULL)
        return cli_usage("--orbit places the eye: leave --%s out", yb_view_options_placed(view));
    if (request->orbit != 0 && !yb_numbered_check(request->output, &error))
        return cli_usage("--orbit: %s", error.text);
    if (request->json && request->orbit == 0 && request->output[0] == '-' &&
        request->output[1] == '\0')
        return cli_usage("--json and '-o -' both want the standard output");
    if (request->turn != YB_TURN_0 && request->panel == NULL)
        return cli_usage("--turn is for a panel: name it by --panel");
    if (request->panel != NULL) {
        const yb_screen_t screen = yb_outlet_screen(request->panel, request->turn);
        yb_view_options_panel(&request->view, &screen);
    }
    if (!yb_view_options_check(view, &error))
        return cli_usage("%s", error.text);
    return cli_part_check(&request->part);
}

static bool write_picture(const yb_still_t *still, const char *path, bool force, yb_error_t *error)
{
    yb_picture_t picture;
    if (!yb_picture_from_frame(&picture, &still->screen, still->pixels))
        return yb_error_set(error, "not enough memory for %s", path);
    size_t size = 0;
    uint8_t *png = yb_picture_png(&picture, &size);
    yb_picture_free(&picture);
    const bool good = png != NULL ? yb_output_write(path, force, png, size, error)
                                  : yb_error_set(error, "not enough memory for %s", path);
    free(png);
    return good;
}

/* One frame, drawn and written; its description in *json if the user wants it. */
static bool make_frame(const request_t *request, const yb_map_t *map, const yb_view_t *view,
                       const char *path, json_t **json, yb_error_t *error)
{
    yb_still_t still;
    if (!yb_still_draw(&still, map, view, &request->view.screen, request->view.band_rows,
                       (uint16_t)request->view.shadows))
        return yb_error_set(error, "not enough memory to draw %s", path);
    const bool good = write_picture(&still, path, request->force, error);
    if (good && request->json)
        *json = yb_still_json(&still);
    yb_still_free(&still);
    return good;
}

static bool orbit_names_free(const request_t *request, yb_error_t *error)
{
    for (int i = 0; i < request->orbit; i++) {
        char *path = yb_numbered_name(request->output, i);
        const bool good = path != NULL && yb_output_allowed(path, request->force, error);
        if (path == NULL)
            yb_error_set(error, "not enough memory");
        free(path);
        if (!good)
            return false;
    }
    return true;
}

static bool make_orbit(const request_t *request, yb_map_t *map, json_t **json, yb_error_t *error)
{
    json_t *frames = json_array();
    bool good = orbit_names_free(request, error);
    for (int i = 0; good && i < request->orbit; i++) {
        yb_view_options_t turned = request->view;
        yb_view_t view;
        json_t *frame = NULL;
        char *path = yb_numbered_name(request->output, i);
        turned.azimuth_deg = fmod(turned.azimuth_deg + 360.0 * i / (double)request->orbit, 360);
        good = path != NULL ? yb_view_options_apply(&turned, map, &view, error)
                            : yb_error_set(error, "not enough memory");
        good = good && make_frame(request, map, &view, path, &frame, error);
        if (frame != NULL)
            json_array_append_new(frames, frame);
        free(path);
    }
    *json = json_pack("{s:o}", "frames", frames);
    return good;
}

static int run(const request_t *request)
{
    yb_error_t error;
    if (request->orbit == 0 && !yb_output_allowed(request->output, request->force, &error))
        return cli_fail("%s", error.text);
    yb_code_file_t *file = cli_part_read_map(&request->part, request->input);
    if (file == NULL)
        return CLI_FAILED;

    json_t *json = NULL;
    bool good = false;
    if (request->orbit != 0) {
        good = make_orbit(request, &file->map, &json, &error);
    } else {
        yb_view_t view;
        good = yb_view_options_apply(&request->view, &file->map, &view, &error) &&
               make_frame(request, &file->map, &view, request->output, &json, &error);
    }
    yb_code_file_free(file);
    if (good && request->json) {
        json_dumpf(json, stdout, JSON_INDENT(2));
        putchar('\n');
    }
    json_decref(json);
    return good ? CLI_OK : cli_fail("%s", error.text);
}

int cli_render(int argc, char **argv)
{
    request_t request = {.view = yb_view_options_default()};
    int answer = 0;
    while ((answer = getopt_long(argc, argv, ":o:", options, NULL)) != -1) {
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
