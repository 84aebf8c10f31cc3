#include "cli.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "code_file.h"
#include "mesh_drawing.h"
#include "obj_file.h"
#include "output.h"
#include "part.h"
#include "surface.h"
#include "view_options.h"

enum {
    OPTION_DEPTH = 256,
    OPTION_REFERENCE,
    OPTION_REFINED,
    OPTION_STAGE,
    OPTION_SVG,
    OPTION_WIDTH,
    OPTION_PLAIN,
    OPTION_FORCE,
    OPTION_HELP
};
enum {
    BASE_TRIANGLES = -1,
    MOST_HALVINGS = 8,
    DRAWING_WIDTH = 1000,
    LEAST_WIDTH = 100
};

static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                        {"depth", required_argument, NULL, OPTION_DEPTH},
                                        {"reference", no_argument, NULL, OPTION_REFERENCE},
                                        {"refined", no_argument, NULL, OPTION_REFINED},
                                        {"stage", required_argument, NULL, OPTION_STAGE},
                                        {"svg", no_argument, NULL, OPTION_SVG},
                                        {"width", required_argument, NULL, OPTION_WIDTH},
                                        {"plain", no_argument, NULL, OPTION_PLAIN},
                                        {"force", no_argument, NULL, OPTION_FORCE},
                                        CLI_PART_LONG_OPTIONS,
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        YB_VIEW_LONG_OPTIONS,
                                        {0}};

typedef struct {
    const char *input, *output;
    cli_part_t part;
    long depth;
    bool reference, refined, force;
    yb_view_options_t view;
    bool svg;
    bool draws;           /* a drawing, not a mesh */
    bool drawing_options; /* some were given */
    long width;           /* 0: not given */
    yb_mesh_drawing_t drawing;
} request_t;

static const char *const stages[] = {"contours", "links", "triangles"};

static int help(void)
{
    fputs("Usage: yamabiko mesh MAP.yb -o OUT.obj|OUT.svg|OUT.png [OPTION ...]\n"
          "\n"
          "Writes a map's triangles as a Wavefront OBJ file: metres, x east and y north from the\n"
          "south-west corner of the frame, z up above the datum; corners that triangles share are\n"
          "written once. Without --depth, --reference or --refined these are the base triangles,\n"
          "whose corners are the points of the contours and those that the rules add.\n"
          "\n"
          "MAP.yb is a code, or a vector file of contour lines with their heights, in any format\n"
          "of GDAL: then the map has all their points, and no fractal detail.\n"
          "If the file ends .svg or .png, draws the base triangles in plan instead, north up.\n"
          "\n"
          "  -o, --output FILE   the mesh, ending .obj, or the drawing, ending .svg or\n"
          "                      .png; - is the standard output\n"
          "  --depth N           refine until no edge is longer than the map's width halved N\n"
          "                      times, 0 to 8\n"
          "  --reference         the reference surface: no edge longer than a lattice step\n"
          "  --refined           those triangles that 'yamabiko render' draws with the same view\n"
          "                      options, without the walls; corners under water lie on it\n"
          "  --force             overwrite what exists\n"
          "  --help              this text\n"
          "\n"
          "Of a drawing:\n"
          "  --stage STAGE       contours: the coded lines and heights, ticks on the lower side;\n"
          "                      links: the same in grey, and the points and edges that the\n"
          "                      rules added, by rule; triangles: all of them, coloured by\n"
          "                      height, flat ones pink (default)\n"
          "  --svg               SVG, whatever the file's ending; for the standard output\n"
          "  --width PIXELS      of the page, 100 to 8000, 600 or more with a legend (default\n"
          "                      1000)\n"
          "  --plain             the plan alone, without title and legend\n"
          "\n",
          stdout);
    fputs(cli_part_help, stdout);
    fputs("\nView of --refined (--no-detail is for any mesh; --format, --band, --palette, "
          "--contours,\n"
          "--shadows, --haze, --sun and --lamp do not apply):\n",
          stdout);
    fputs(yb_view_options_help, stdout);
    fputs("\n"
          "Examples:\n"
          "  yamabiko mesh fuji.yb -o fuji.obj --depth 6\n"
          "  yamabiko mesh fuji.yb -o frame.obj --refined --view orbit-45 --size 128x64\n"
          "  yamabiko mesh fuji.yb -o fuji.svg --stage links\n",
          stdout);
    return CLI_OK;
}

static uint16_t longest_q8(const request_t *request, const yb_map_t *map)
{
    if (request->reference)
        return YB_REFERENCE_Q8;
    if (request->depth == BASE_TRIANGLES)
        return UINT16_MAX;
    const uint16_t width = map->east_q8 > map->north_q8 ? map->east_q8 : map->north_q8;
    return (uint16_t)(width >> request->depth);
}

static bool write_mesh(const request_t *request, yb_map_t *map, yb_error_t *error)
{
    yb_mesh_t mesh = {0};
    yb_view_t view;
    if (!yb_view_options_apply(&request->view, map, &view, error))
        return false;
    bool good = (request->refined ? yb_mesh_from_frame(&mesh, map, &view, &request->view.screen)
                                  : yb_mesh_from_map(&mesh, map, longest_q8(request, map))) ||
                yb_error_set(error, "not enough memory for %s", request->output);
    good = good && yb_obj_file_write(request->output, request->force, &mesh, error);
    yb_mesh_free(&mesh);
    return good;
}

static int run(const request_t *request)
{
    yb_error_t error;
    if (!yb_output_allowed(request->output, request->force, &error))
        return cli_fail("%s", error.text);
    yb_code_file_t *file = cli_part_read_map(&request->part, request->input);
    if (file == NULL)
        return CLI_FAILED;
    const bool good = request->draws
                          ? yb_mesh_drawing_write(request->output, request->force, &file->map,
                                                  &file->load, &request->drawing, &error)
                          : write_mesh(request, &file->map, &error);
    yb_code_file_free(file);
    return good ? CLI_OK : cli_fail("%s", error.text);
}

static bool take_stage(request_t *request, const char *name)
{
    for (int i = 0; i <= YB_STAGE_TRIANGLES; i++) {
        if (strcmp(name, stages[i]) == 0) {
            request->drawing.stage = (yb_stage_t)i;
            return true;
        }
    }
    return false;
}

static int check_drawing(request_t *request)
{
    if (request->reference || request->refined || !request->view.detail ||
        request->depth != BASE_TRIANGLES)
        return cli_usage("a drawing shows the base triangles: leave --depth, --reference, "
                         "--refined and --no-detail out");
    const char *slash = strrchr(request->input, '/');
    request->drawing.name = slash == NULL ? request->input : slash + 1;
    request->drawing.width = request->width == 0 ? DRAWING_WIDTH : (uint32_t)request->width;
    if (!request->drawing.plain && request->drawing.width < YB_MESH_DRAWING_LEAST)
        return cli_usage("--width: with a legend at least %d pixels; --plain leaves it out",
                         YB_MESH_DRAWING_LEAST);
    return CLI_OK;
}

static int check_view(const request_t *request)
{
    yb_error_t error;
    const uint32_t detail = 1u << (YB_OPTION_NO_DETAIL - YB_OPTION_SIZE);
    if (!request->refined && (request->view.given & ~detail) != 0)
        return cli_usage("a view is for --refined: without it leave all of its options out");
    if (yb_view_options_look(&request->view) != NULL)
        return cli_usage("--%s does not apply: a mesh has no colours",
                         yb_view_options_look(&request->view));
    return yb_view_options_check(&request->view, &error) ? CLI_OK : cli_usage("%s", error.text);
}

static int check(request_t *request)
{
    if (request->output == NULL)
        return cli_usage("name the mesh: -o OUT.obj, OUT.svg or OUT.png");
    const char *dot = strrchr(request->output, '.');
    request->draws = request->svg || yb_mesh_drawing_named(request->output);
    if (request->svg && dot != NULL && strcasecmp(dot, ".png") == 0)
        return cli_usage("--svg: '%s' ends as a PNG file does", request->output);
    const int status = check_view(request);
    if (status != CLI_OK)
        return status;
    if (request->draws)
        return check_drawing(request);
    if (request->drawing_options)
        return cli_usage("--stage, --width and --plain are for drawings: end the file .svg or "
                         ".png, or add --svg");
    if (strcmp(request->output, "-") != 0 && (dot == NULL || strcasecmp(dot, ".obj") != 0))
        return cli_usage("a mesh is written as .obj, drawn as .svg or .png: '%s' ends otherwise",
                         request->output);
    if (request->reference + request->refined + (request->depth != BASE_TRIANGLES) > 1)
        return cli_usage("give one of --depth, --reference and --refined");
    return CLI_OK;
}

/* An option of the drawing. */
static int take_drawing(request_t *request, int answer)
{
    request->drawing_options = true;
    if (answer == OPTION_STAGE && !take_stage(request, optarg))
        return cli_usage("--stage: '%s' is not contours, links or triangles", optarg);
    if (answer == OPTION_WIDTH &&
        !cli_integer(optarg, LEAST_WIDTH, YB_MESH_DRAWING_MOST, &request->width))
        return cli_usage("--width: '%s' is not a whole number from %d to %d", optarg, LEAST_WIDTH,
                         YB_MESH_DRAWING_MOST);
    if (answer == OPTION_PLAIN)
        request->drawing.plain = true;
    return CLI_OK;
}

int cli_mesh(int argc, char **argv)
{
    request_t request = {.depth = BASE_TRIANGLES,
                         .view = yb_view_options_default(),
                         .drawing = {.stage = YB_STAGE_TRIANGLES}};
    int answer = 0;
    int status = CLI_OK;
    yb_error_t error;
    while (status == CLI_OK && (answer = getopt_long(argc, argv, ":o:", options, NULL)) != -1) {
        switch (answer) {
        case 'o':
            request.output = optarg;
            break;
        case OPTION_DEPTH:
            if (!cli_integer(optarg, 0, MOST_HALVINGS, &request.depth))
                return cli_usage("--depth: '%s' is not a whole number from 0 to %d", optarg,
                                 MOST_HALVINGS);
            break;
        case OPTION_REFERENCE:
            request.reference = true;
            break;
        case OPTION_REFINED:
            request.refined = true;
            break;
        case OPTION_SVG:
            request.svg = true;
            break;
        case OPTION_STAGE:
        case OPTION_WIDTH:
        case OPTION_PLAIN:
            status = take_drawing(&request, answer);
            break;
        case OPTION_FORCE:
            request.force = true;
            break;
        case OPTION_HELP:
            return help();
        default:
            if (yb_view_options_owns(answer)) {
                if (!yb_view_options_take(&request.view, answer, argc, argv, &error))
                    return cli_usage("%s", error.text);
                break;
            }
            status = cli_part_take_rest(&request.part, answer, argc, argv);
            break;
        }
    }
    status =
        status == CLI_OK ? cli_part_one_map(&request.part, argc, argv, &request.input) : status;
    if (status != CLI_OK)
        return status;
    status = check(&request);
    return status != CLI_OK ? status : run(&request);
}
