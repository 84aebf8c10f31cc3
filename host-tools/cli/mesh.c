#include "cli.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "code_file.h"
#include "obj_file.h"
#include "output.h"
#include "part.h"
#include "surface.h"

enum {
    OPTION_DEPTH = 256,
    OPTION_REFERENCE,
    OPTION_NO_DETAIL,
    OPTION_FORCE,
    OPTION_HELP
};
enum {
    BASE_TRIANGLES = -1,
    MOST_HALVINGS = 8
};

static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                        {"depth", required_argument, NULL, OPTION_DEPTH},
                                        {"reference", no_argument, NULL, OPTION_REFERENCE},
                                        {"no-detail", no_argument, NULL, OPTION_NO_DETAIL},
                                        {"force", no_argument, NULL, OPTION_FORCE},
                                        CLI_PART_LONG_OPTIONS,
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        {0}};

typedef struct {
    const char *input, *output;
    cli_part_t part;
    long depth;
    bool reference, smooth, force;
} request_t;

static int help(void)
{
    fputs("Usage: yamabiko mesh MAP.yb -o OUT.obj [OPTION ...]\n"
          "\n"
          "Writes a map's triangles as a Wavefront OBJ file: metres, x east and y north from the\n"
          "south-west corner of the frame, z up above the datum; corners that triangles share are\n"
          "written once. Without --depth or --reference these are the base triangles, whose\n"
          "corners are the points of the contours and those that the rules add.\n"
          "\n"
          "MAP.yb is a code, or a vector file of contour lines with their heights, in any format\n"
          "of GDAL: then the map has all their points, and no fractal detail.\n"
          "\n"
          "  -o, --output FILE   the mesh, ending .obj; - is the standard output\n"
          "  --depth N           refine until no edge is longer than the map's width halved N\n"
          "                      times, 0 to 8\n"
          "  --reference         the reference surface: no edge longer than a lattice step\n"
          "  --no-detail         of the smooth surface, without fractal detail\n"
          "  --force             overwrite what exists\n"
          "  --help              this text\n"
          "\n",
          stdout);
    fputs(cli_part_help, stdout);
    fputs("\n"
          "Example:\n"
          "  yamabiko mesh fuji.yb -o fuji.obj --depth 6\n",
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

static int run(const request_t *request)
{
    yb_error_t error;
    if (!yb_output_allowed(request->output, request->force, &error))
        return cli_fail("%s", error.text);
    yb_code_file_t *file = cli_part_read_map(&request->part, request->input);
    if (file == NULL)
        return CLI_FAILED;
    file->map.detail = file->map.detail && !request->smooth;
    yb_mesh_t mesh = {0};
    bool good = yb_mesh_from_map(&mesh, &file->map, longest_q8(request, &file->map)) ||
                yb_error_set(&error, "not enough memory for %s", request->output);
    good = good && yb_obj_file_write(request->output, request->force, &mesh, &error);
    yb_mesh_free(&mesh);
    yb_code_file_free(file);
    return good ? CLI_OK : cli_fail("%s", error.text);
}

static int check(const request_t *request)
{
    if (request->output == NULL)
        return cli_usage("name the mesh: -o OUT.obj");
    const char *dot = strrchr(request->output, '.');
    if (strcmp(request->output, "-") != 0 && (dot == NULL || strcasecmp(dot, ".obj") != 0))
        return cli_usage("a mesh is written as .obj: '%s' ends otherwise", request->output);
    if (request->reference && request->depth != BASE_TRIANGLES)
        return cli_usage("give --depth or --reference, not both");
    return CLI_OK;
}

int cli_mesh(int argc, char **argv)
{
    request_t request = {.depth = BASE_TRIANGLES};
    int answer = 0;
    int status = CLI_OK;
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
        case OPTION_NO_DETAIL:
            request.smooth = true;
            break;
        case OPTION_FORCE:
            request.force = true;
            break;
        case OPTION_HELP:
            return help();
        default:
            status = cli_part_owns(answer) ? cli_part_take(&request.part, answer, argc, argv)
                                           : cli_bad_option(answer, argc, argv);
            break;
        }
    }
    status = status == CLI_OK ? cli_part_check(&request.part) : status;
    if (status != CLI_OK)
        return status;
    if (optind + 1 != argc)
        return cli_usage("name one map, MAP.yb");
    request.input = argv[optind];
    status = check(&request);
    return status != CLI_OK ? status : run(&request);
}
