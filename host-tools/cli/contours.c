#include "cli.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>

#include "code_file.h"
#include "geofile.h"
#include "isolines.h"
#include "output.h"
#include "part.h"
#include "surface.h"

enum {
    OPTION_INTERVAL = 256,
    OPTION_BASE,
    OPTION_NO_DETAIL,
    OPTION_FORCE,
    OPTION_HELP
};
enum {
    MOST_HEIGHTS = 10000
};

static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                        {"interval", required_argument, NULL, OPTION_INTERVAL},
                                        {"base", required_argument, NULL, OPTION_BASE},
                                        {"no-detail", no_argument, NULL, OPTION_NO_DETAIL},
                                        {"force", no_argument, NULL, OPTION_FORCE},
                                        CLI_PART_LONG_OPTIONS,
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        {0}};

typedef struct {
    const char *input, *output;
    cli_part_t part;
    double interval_m, base_m;
    bool smooth, force;
} request_t;

static int help(void)
{
    fputs("Usage: yamabiko contours MAP.yb -o OUT.geojson --interval M [OPTION ...]\n"
          "\n"
          "Writes contour lines of a map's reference surface: GeoJSON, or any format of OGR that\n"
          "the file's ending names and that is a single file. Each line has its height in the\n"
          "field `elevation`; it is closed or ends on the map's frame, and has the higher ground\n"
          "on its left. Coordinates are metres from the frame's south-west corner, or those of\n"
          "the contour lines that the map is made of; programs that take every GeoJSON for\n"
          "degrees read the same lines rightly from a GeoPackage (.gpkg). A code that says its\n"
          "place gives lines round the frame's centre, 0, 0; as GeoJSON in degrees.\n"
          "\n"
          "MAP.yb is a code, or a vector file of contour lines with their heights, in any format\n"
          "of GDAL: then the map has all their points, and no fractal detail.\n"
          "\n"
          "  -o, --output FILE   the lines; - is the standard output\n"
          "  --interval M        height from one contour to the next, in metres\n"
          "  --base M            a height that has a contour (default 0, the datum)\n"
          "  --no-detail         of the smooth surface, without fractal detail\n"
          "  --force             overwrite what exists\n"
          "  --help              this text\n"
          "\n",
          stdout);
    fputs(cli_part_help, stdout);
    fputs("\n"
          "Examples:\n"
          "  yamabiko contours fuji.yb -o fuji.geojson --interval 100\n"
          "  yamabiko contours every-50-m.gpkg -o every-10-m.gpkg --interval 10\n",
          stdout);
    return CLI_OK;
}

/* Every height base + k * interval that the mesh reaches. */
static bool find_lines(const request_t *request, const yb_mesh_t *mesh, yb_isolines_t *lines,
                       yb_error_t *error)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (uint32_t i = 0; i < mesh->point_count; i++) {
        low = fmin(low, mesh->point[i].z);
        high = fmax(high, mesh->point[i].z);
    }
    const double first = ceil((low - request->base_m) / request->interval_m);
    const double last = floor((high - request->base_m) / request->interval_m);
    if (last - first >= MOST_HEIGHTS)
        return yb_error_set(error, "an interval of %g m gives more than %d heights: choose more",
                            request->interval_m, MOST_HEIGHTS);
    for (int i = 0; i <= (int)(last - first); i++) {
        const double height_m = request->base_m + (first + i) * request->interval_m;
        if (!yb_isolines_add(lines, mesh, height_m))
            return yb_error_set(error, "not enough memory for %s", request->output);
    }
    return true;
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
    yb_isolines_t lines = {0};
    bool good = yb_mesh_from_map(&mesh, &file->map, YB_REFERENCE_Q8) ||
                yb_error_set(&error, "not enough memory for %s", request->output);
    good = good && find_lines(request, &mesh, &lines, &error) &&
           yb_geofile_write_lines(request->output, request->force, &lines, &file->origin, &error);
    yb_isolines_free(&lines);
    yb_mesh_free(&mesh);
    yb_code_file_free(file);
    return good ? CLI_OK : cli_fail("%s", error.text);
}

int cli_contours(int argc, char **argv)
{
    request_t request = {0};
    int answer = 0;
    int status = CLI_OK;
    while (status == CLI_OK && (answer = getopt_long(argc, argv, ":o:", options, NULL)) != -1) {
        switch (answer) {
        case 'o':
            request.output = optarg;
            break;
        case OPTION_INTERVAL:
            if (!cli_number(optarg, &request.interval_m) || request.interval_m <= 0)
                return cli_usage("--interval: '%s' is not a height above 0", optarg);
            break;
        case OPTION_BASE:
            if (!cli_number(optarg, &request.base_m) || fabs(request.base_m) > 1e6)
                return cli_usage("--base: '%s' is not a height", optarg);
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
            status = cli_part_take_rest(&request.part, answer, argc, argv);
            break;
        }
    }
    status =
        status == CLI_OK ? cli_part_one_map(&request.part, argc, argv, &request.input) : status;
    if (status != CLI_OK)
        return status;
    if (request.output == NULL)
        return cli_usage("name the file of lines: -o OUT.geojson");
    if (request.interval_m == 0)
        return cli_usage("name the interval in metres: --interval M");
    return run(&request);
}
