#include "cli.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

#include "code_file.h"
#include "geofile.h"
#include "output.h"
#include "part.h"
#include "surface.h"

enum {
    OPTION_CELLS = 256,
    OPTION_NO_DETAIL,
    OPTION_FORCE,
    OPTION_HELP
};

static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                        {"cells", required_argument, NULL, OPTION_CELLS},
                                        {"no-detail", no_argument, NULL, OPTION_NO_DETAIL},
                                        {"force", no_argument, NULL, OPTION_FORCE},
                                        CLI_PART_LONG_OPTIONS,
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        {0}};

typedef struct {
    const char *input, *output;
    cli_part_t part;
    long cells;
    bool smooth, force;
} request_t;

static int help(void)
{
    fputs("Usage: yamabiko dem MAP.yb -o OUT.tif [OPTION ...]\n"
          "\n"
          "Writes the heights of a map's reference surface, in metres above the datum, as a\n"
          "raster: a GeoTIFF, or any format of GDAL that the file's ending names and that holds\n"
          "32-bit floating-point numbers in one file.\n"
          "\n"
          "MAP.yb is a code, or a vector file of contour lines with their heights, in any format\n"
          "of GDAL: then the map has all their points, and no fractal detail.\n"
          "\n"
          "The map's frame runs through the centres of the outermost cells of its lattice, so the\n"
          "raster reaches half a lattice step beyond it. Coordinates are metres; the frame's\n"
          "south-west corner is 0, 0, or where contour lines say that they lie. A code that says\n"
          "its place has a transverse Mercator projection through the frame's centre, 0, 0.\n"
          "\n"
          "  -o, --output FILE   the raster; - is the standard output\n"
          "  --cells N           cells along the longer side, 2 to 4096 (default 256)\n"
          "  --no-detail         the smooth surface, without fractal detail\n"
          "  --force             overwrite what exists\n"
          "  --help              this text\n"
          "\n",
          stdout);
    fputs(cli_part_help, stdout);
    fputs("\n"
          "Examples:\n"
          "  yamabiko dem fuji.yb -o fuji.tif --cells 512\n"
          "  yamabiko dem contours.gpkg -o relief.tif\n",
          stdout);
    return CLI_OK;
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
    const yb_raster_t raster = yb_raster_on_map(&file->map, (uint32_t)request->cells);
    float *z_m = yb_raster_heights(&file->map, &raster);
    const bool good = z_m != NULL
                          ? yb_geofile_write_raster(request->output, request->force, &raster, z_m,
                                                    &file->origin, &error)
                          : yb_error_set(&error, "not enough memory for %s", request->output);
    free(z_m);
    yb_code_file_free(file);
    return good ? CLI_OK : cli_fail("%s", error.text);
}

int cli_dem(int argc, char **argv)
{
    request_t request = {.cells = 256};
    int answer = 0;
    int status = CLI_OK;
    while (status == CLI_OK && (answer = getopt_long(argc, argv, ":o:", options, NULL)) != -1) {
        switch (answer) {
        case 'o':
            request.output = optarg;
            break;
        case OPTION_CELLS:
            if (!cli_integer(optarg, 2, 4096, &request.cells))
                return cli_usage("--cells: '%s' is not a whole number from 2 to 4096", optarg);
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
        return cli_usage("name the raster: -o OUT.tif");
    return run(&request);
}
