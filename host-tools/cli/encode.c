#include "cli.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cpl_progress.h>
#include <jansson.h>

#include "encode.h"
#include "ground.h"
#include "line_crossings.h"
#include "output.h"
#include "part.h"
#include "scan.h"
#include "target.h"

enum {
    OPTION_BYTES = 256,
    OPTION_PROFILE,
    OPTION_LEVELS,
    OPTION_INTERVAL,
    OPTION_BASE,
    OPTION_SEED,
    OPTION_EFFORT,
    OPTION_NAME,
    OPTION_PLACE,
    OPTION_CERTIFY,
    OPTION_TARGET_K,
    OPTION_VERTICES,
    OPTION_FORCE,
    OPTION_JSON,
    OPTION_HEX,
    OPTION_HELP
};

/* Cells that a raster is read with: the lattice of a code has no more points. */
enum {
    GRID_SIDE = 256
};

static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                        {"bytes", required_argument, NULL, OPTION_BYTES},
                                        {"profile", required_argument, NULL, OPTION_PROFILE},
                                        CLI_PART_LONG_OPTIONS,
                                        CLI_PART_CELL_OPTION,
                                        {"levels", required_argument, NULL, OPTION_LEVELS},
                                        {"interval", required_argument, NULL, OPTION_INTERVAL},
                                        {"base", required_argument, NULL, OPTION_BASE},
                                        {"seed", required_argument, NULL, OPTION_SEED},
                                        {"effort", required_argument, NULL, OPTION_EFFORT},
                                        {"name", required_argument, NULL, OPTION_NAME},
                                        {"place", no_argument, NULL, OPTION_PLACE},
                                        {"certify", no_argument, NULL, OPTION_CERTIFY},
                                        {"target-k", required_argument, NULL, OPTION_TARGET_K},
                                        {"vertices", required_argument, NULL, OPTION_VERTICES},
                                        {"force", no_argument, NULL, OPTION_FORCE},
                                        {"json", no_argument, NULL, OPTION_JSON},
                                        {"hex", no_argument, NULL, OPTION_HEX},
                                        {"quiet", no_argument, NULL, 'q'},
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        {0}};

typedef struct {
    const char *input, *output;
    cli_part_t part;
    yb_encode_task_t task;
    yb_sections_t sections;
    double base_m;   /* of a drawn sheet */
    double target_k; /* 0: none */
    bool based, force, json, hex, quiet;
} request_t;

static int help(void)
{
    fputs("Usage: yamabiko encode INPUT -o MAP.yb [OPTION ...]\n"
          "\n"
          "Codes a relief in about a hundred bytes. INPUT is a raster of heights (a DEM in any\n"
          "format of GDAL), a vector file of contour lines with their heights, or a sheet of\n"
          "contour lines drawn or scanned as a PNG; see below.\n"
          "\n"
          "The encoder chooses contour lines, their feature points, summits and heights such that\n"
          "the surface which the engine makes of the code lies as near to the relief as it can.\n"
          "The same input gives the same bytes on every machine.\n"
          "\n"
          "  -o, --output FILE     the code; - is the standard output\n"
          "  --bytes N             most bytes of the whole file, 23 to 1299 (default 100)\n"
          "  --target-k K          the smallest code, of at most --bytes, whose similarity K (see\n"
          "                        yamabiko evaluate) is K or more, above 0 to 1; a minute\n"
          "  --profile NAME        how it is coded: compact, or paper, as in the paper of 1985, "
          "with\n"
          "                        about twice the bytes (default compact)\n"
          "  --vertices N          most vertices of the mesh, 32 to 4096; more than 255 is beyond\n"
          "                        most devices (default 255)\n",
          stdout);
    fputs("\n"
          "Which part of the input:\n"
          "  --window XMIN YMIN XMAX YMAX\n"
          "                        a box in the input's own coordinates\n"
          "  --center LON LAT      a square round a place, in degrees (WGS 84) ...\n"
          "  --km S                ... of so many kilometres a side (default 20)\n"
          "  --cell METRES         size of the cells of a raster, or of the pixels of a sheet,\n"
          "                        that does not tell it (default 30)\n"
          "\n"
          "What the lines show:\n"
          "  --levels N            lines at N evenly spaced heights only, 1 to 64\n"
          "  --interval M          lines at multiples of M metres only; on a sheet, the step\n"
          "                        from each line to the next\n"
          "                        (default: a raster's lines lie wherever they tell most,\n"
          "                        those of a vector file at the heights they have there)\n"
          "  --base METRES         height of the outermost lines of a sheet\n"
          "  --field NAME          the attribute of a vector file that is the height (default:\n"
          "                        one that sounds like it, or else the z coordinate)\n"
          "  --seed N              of the fractal detail, 0 to 127 (default 1)\n",
          stdout);
    fputs("\n"
          "What the code says beside the relief (profile compact; it counts into --bytes, and\n"
          "into what --target-k makes small):\n"
          "  --name TEXT           the map's name, up to 63 bytes of UTF-8\n"
          "  --place               where on earth its centre lies, to about 2 m: 7 bytes\n"
          "  --certify             the error that nine tenths of all heights keep within, and K,\n"
          "                        as yamabiko evaluate finds them: 3 bytes\n",
          stdout);
    fputs("\n"
          "  --effort 1..9         each step triples the trials (default 5: about half a minute)\n"
          "  --force               overwrite what exists\n"
          "  --json                tell the results as JSON on the standard output\n"
          "  --hex                 tell the bytes, too\n"
          "  -q, --quiet           tell nothing\n"
          "  --help                this text\n"
          "\n"
          "Holes of a raster are filled from around them if they are no more than a quarter of\n"
          "it. Rasters in degrees are laid out in metres round the middle of the window.\n"
          "\n"
          "A PNG of 8 bits or less that does not say where on earth it lies is a sheet; one of\n"
          "16 bits, or a placed one, is a DEM. A sheet needs --base and --interval. Its lines are\n"
          "dark on light, 1 to 12 pixels thick, closed or drawn on to the edge or to a rectangle\n"
          "along it; they must not meet, and small gaps are closed. Each line is one interval\n"
          "above the one outside it; where lines run from edge to edge, the region with most of\n"
          "the edge lies lowest. A dot, a cross or a filled triangle up to 8 lines thick is a\n"
          "summit, half an interval above the line round it. Pits cannot be told. Leave out all\n"
          "lettering.\n"
          "\n",
          stdout);
    fputs("RMSE is the root of the mean squared height difference of the smooth surface, without\n"
          "fractal detail; NRMSE is the same in standard deviations of the relief. The dimension\n"
          "is that of all contour lines of a level together, measured by counting boxes.\n"
          "\n"
          "With --target-k lines are few and follow the real ones; their similarity counts with\n"
          "the fractal detail on, whose seed is the search's choice. If no code found reaches\n"
          "it, nothing is written and the exit code is 1.\n"
          "\n"
          "Examples:\n"
          "  yamabiko encode fuji.tif -o fuji.yb\n"
          "  yamabiko encode fuji.tif -o fuji.yb --target-k 0.8\n"
          "  yamabiko encode N46E009.hgt --center 9.8 46.82 --km 15 -o davos.yb --bytes 200\n"
          "  yamabiko encode contours.gpkg --field hoehe -o hill.yb\n"
          "  yamabiko encode sheet.png --base 100 --interval 20 --cell 2.5 --certify -o hill.yb\n",
          stdout);
    return CLI_OK;
}

static int take_integer(const char *name, long low, long high, long *value)
{
    if (!cli_integer(optarg, low, high, value))
        return cli_usage("%s needs a whole number from %ld to %ld", name, low, high);
    return CLI_OK;
}

static int take_coding(request_t *request, int answer)
{
    long value = 0;
    int status = CLI_OK;
    switch (answer) {
    case OPTION_BYTES:
        if (cli_integer(optarg, 0, YB_ENCODE_LEAST_BYTES - 1, &value))
            return cli_usage("--bytes %ld is too little for a map: the least is %d", value,
                             YB_ENCODE_LEAST_BYTES);
        status = take_integer("--bytes", YB_ENCODE_LEAST_BYTES, YB_MAX_CODE_BYTES, &value);
        request->task.most_bytes = (size_t)value;
        return status;
    case OPTION_PROFILE:
        if (strcmp(optarg, "compact") != 0 && strcmp(optarg, "paper") != 0)
            return cli_usage("there is no profile '%s': use compact or paper", optarg);
        request->task.profile = strcmp(optarg, "compact") == 0 ? YB_COMPACT : YB_PAPER;
        return CLI_OK;
    case OPTION_LEVELS:
        status = take_integer("--levels", 1, YB_ENCODE_MOST_LEVELS, &value);
        request->task.levels = (int)value;
        return status;
    case OPTION_INTERVAL:
        if (!cli_number(optarg, &request->task.interval_m) || request->task.interval_m <= 0)
            return cli_usage("--interval needs a number of metres above 0");
        return CLI_OK;
    case OPTION_BASE:
        request->based = true;
        if (!cli_number(optarg, &request->base_m))
            return cli_usage("--base needs a number of metres");
        return CLI_OK;
    case OPTION_TARGET_K:
        if (!cli_number(optarg, &request->target_k) || request->target_k <= 0 ||
            request->target_k > 1)
            return cli_usage("--target-k needs a number above 0, at most 1");
        return CLI_OK;
    case OPTION_SEED:
        status = take_integer("--seed", 0, 127, &value);
        request->task.seed = (uint8_t)value;
        return status;
    case OPTION_VERTICES:
        status = take_integer("--vertices", 32, 4096, &value);
        request->task.vertices = (int)value;
        return status;
    default:
        status = take_integer("--effort", 1, YB_ENCODE_MOST_EFFORT, &value);
        request->task.effort = (int)value;
        return status;
    }
}

static int take_section(request_t *request, int answer)
{
    yb_error_t error;
    if (answer == OPTION_PLACE)
        request->sections.placed = true;
    else if (answer == OPTION_CERTIFY)
        request->sections.certified = true;
    else if (!yb_sections_name(&request->sections, optarg, &error))
        return cli_usage("--name: %s", error.text);
    return CLI_OK;
}

static int take_option(request_t *request, int answer, int argc, char **argv)
{
    if (cli_part_owns(answer))
        return cli_part_take(&request->part, answer, argc, argv);
    switch (answer) {
    case 'o':
        request->output = optarg;
        return CLI_OK;
    case 'q':
        request->quiet = true;
        return CLI_OK;
    case OPTION_NAME:
    case OPTION_PLACE:
    case OPTION_CERTIFY:
        return take_section(request, answer);
    case OPTION_FORCE:
        request->force = true;
        return CLI_OK;
    case OPTION_JSON:
        request->json = true;
        return CLI_OK;
    case OPTION_HEX:
        request->hex = true;
        return CLI_OK;
    case OPTION_BYTES:
    case OPTION_PROFILE:
    case OPTION_LEVELS:
    case OPTION_INTERVAL:
    case OPTION_BASE:
    case OPTION_SEED:
    case OPTION_EFFORT:
    case OPTION_TARGET_K:
    case OPTION_VERTICES:
        return take_coding(request, answer);
    default:
        return cli_bad_option(answer, argc, argv);
    }
}

static void show_progress(void *context, double share)
{
    (void)context;
    GDALTermProgress(share, NULL, NULL);
}

static json_t *json_levels(const yb_code_file_t *code)
{
    json_t *levels = json_array();
    for (int i = 0; i < code->load.contour_count; i++) {
        const yb_contour_t *contour = &code->load.contour[i];
        if (contour->count == 1)
            continue;
        double z_q8 = code->map.vertex[contour->first].z_q8;
        double height_m = code->map.base_m + z_q8 * yb_unit_m(code->map.cell) / 256;
        json_array_append_new(levels, json_real(round(height_m * 10) / 10));
    }
    return levels;
}

static int point_count(const yb_code_file_t *code)
{
    int points = 0;
    for (int i = 0; i < code->load.contour_count; i++)
        points += code->load.contour[i].count;
    return points;
}

static void hex_of(const yb_code_file_t *code, char *text)
{
    for (size_t i = 0; i < code->size; i++)
        snprintf(text + 2 * i, 3, "%02x", code->bytes[i]);
}

static void tell_json(const request_t *request, const yb_encode_result_t *result)
{
    const yb_code_file_t *code = result->code;
    int points = point_count(code);
    json_t *root = json_object();
    json_object_set_new(root, "file", json_string(request->output));
    json_object_set_new(root, "profile",
                        json_string(request->task.profile == YB_COMPACT ? "compact" : "paper"));
    json_object_set_new(root, "bytes", json_integer((json_int_t)code->size));
    json_object_set_new(root, "n", json_integer(points));
    json_object_set_new(root, "m", json_integer(code->load.contour_count));
    json_object_set_new(root, "f_bits",
                        json_integer(12 * points + 20 * code->load.contour_count + 8));
    json_object_set_new(root, "vertices", json_integer(code->map.vertex_count));
    json_object_set_new(root, "line_heights_m", json_levels(code));
    json_object_set_new(root, "rmse_m", json_real(result->rmse_m));
    json_object_set_new(root, "nrmse", json_real(result->rmse_m / result->std_m));
    if (request->target_k > 0)
        json_object_set_new(root, "k", json_real(result->k));
    json_object_set_new(root, "dimension", json_real(result->fractal.dimension));
    json_object_set_new(root, "fractal", yb_fractal_json(&result->fractal));
    json_object_set_new(root, "trials", json_integer(result->trials));
    if (request->hex) {
        char text[2 * YB_MAX_CODE_BYTES + 1] = "";
        hex_of(code, text);
        json_object_set_new(root, "hex", json_string(text));
    }
    json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
    putchar('\n');
    json_decref(root);
}

/* In words; not on the standard output if the code goes there. */
static void tell_text(const request_t *request, const yb_encode_result_t *result)
{
    FILE *to = strcmp(request->output, "-") == 0 ? stderr : stdout;
    const yb_code_file_t *code = result->code;
    int points = point_count(code);
    int spots = 0;
    for (int i = 0; i < code->load.contour_count; i++)
        spots += code->load.contour[i].count == 1;
    fprintf(to,
            "%s: %zu bytes, %d contours (%d of them spot heights) with %d points, F = %d bits\n",
            request->output, code->size, code->load.contour_count, spots, points,
            12 * points + 20 * code->load.contour_count + 8);
    fprintf(to, "RMSE %.1f m, NRMSE %.3f (without detail)\n", result->rmse_m,
            result->rmse_m / result->std_m);
    if (request->target_k > 0)
        fprintf(to, "K %.4f (with detail)\n", result->k);
    if (code->sections.certified)
        fprintf(to, "certified: nine tenths of the heights within %u m, K %.2f\n",
                yb_certified_error_m(code->map.certified_error), code->map.certified_k / 255.0);
    const yb_fractal_fit_t *boxes = &result->fractal.boxes;
    fprintf(to, "dimension %.2f ", result->fractal.dimension);
    if (boxes->sizes > 0)
        fprintf(to, "(boxes, r² %.3f, %.4g to %.4g m)\n", boxes->r2, boxes->from_m, boxes->to_m);
    else
        fprintf(to, "(the lines are too short to measure it)\n");
    if (request->hex) {
        char text[2 * YB_MAX_CODE_BYTES + 1] = "";
        hex_of(code, text);
        fprintf(to, "%s\n", text);
    }
}

/* Finds the place of a frame's centre, if that is asked for. */
static bool find_place(request_t *request, const char *projection, double x, double y,
                       yb_error_t *error)
{
    yb_sections_t *sections = &request->sections;
    return !sections->placed ||
           yb_ground_place(projection, x, y, &sections->lon_deg, &sections->lat_deg) ||
           yb_error_set(error,
                        "%s does not say where on earth it lies: --place needs an input with a "
                        "projection",
                        request->input);
}

/* The coding itself: as near to the relief as the bytes allow, or up to a similarity. */
static bool code_grid(const request_t *request, const yb_grid_t *grid, yb_encode_result_t *result,
                      yb_error_t *error)
{
    return request->target_k > 0
               ? yb_target_grid(grid, &request->task, request->target_k, result, error)
               : yb_encode_grid(grid, &request->task, result, error);
}

static bool code_lines(const request_t *request, const yb_lines_t *lines,
                       const yb_encode_task_t *task, yb_encode_result_t *result, yb_error_t *error)
{
    return request->target_k > 0 ? yb_target_lines(lines, task, request->target_k, result, error)
                                 : yb_encode_lines(lines, task, result, error);
}

static bool encode_raster(request_t *request, yb_encode_result_t *result, yb_error_t *error)
{
    yb_grid_t *grid = yb_grid_read(request->input, &request->part.window, GRID_SIDE, error);
    if (grid == NULL)
        return false;
    if (grid->holes > 0 && !request->quiet)
        fprintf(stderr, "%s: %.2g %% of the heights were missing and are filled from around\n",
                request->input, 100 * grid->holes);
    if (!grid->placed && request->part.window.cell_m <= 0 && !request->quiet)
        fprintf(stderr, "%s does not tell the size of its cells: %g m are assumed (--cell)\n",
                request->input, YB_GRID_DEFAULT_CELL_M);
    double x = grid->transform[0] + grid->columns * grid->transform[1] / 2;
    double y = grid->transform[3] + grid->rows * grid->transform[5] / 2;
    bool good = find_place(request, grid->projection, x, y, error) &&
                code_grid(request, grid, result, error);
    yb_grid_free(grid);
    return good;
}

static bool encode_vector(request_t *request, yb_encode_result_t *result, yb_error_t *error)
{
    yb_lines_t *lines =
        yb_lines_from_vector(request->input, request->part.field, &request->part.window, error);
    if (lines == NULL)
        return false;
    if (lines->dropped > 0 && !request->quiet)
        fprintf(stderr, "%s: %d lines end inside the window and are left out\n", request->input,
                lines->dropped);
    const yb_origin_t *origin = &lines->origin;
    bool good = yb_line_crossings_none(lines, request->input, error) &&
                find_place(request, origin->projection, origin->west_m + lines->width_m / 2,
                           origin->south_m + lines->depth_m / 2, error) &&
                code_lines(request, lines, &request->task, result, error);
    yb_lines_free(lines);
    return good;
}

static bool encode_scan(request_t *request, yb_encode_result_t *result, yb_error_t *error)
{
    yb_scan_scale_t scale = {request->base_m, request->task.interval_m,
                             request->part.window.cell_m};
    yb_lines_t *lines = yb_lines_from_scan(request->input, &scale, error);
    if (lines == NULL)
        return false;
    if (scale.cell_m <= 0 && !request->quiet)
        fprintf(stderr, "%s does not tell the size of its pixels: %g m are assumed (--cell)\n",
                request->input, YB_GRID_DEFAULT_CELL_M);
    yb_encode_task_t task = request->task;
    task.interval_m = 0; /* all lines stay at the heights they were given */
    bool good =
        find_place(request, NULL, 0, 0, error) && code_lines(request, lines, &task, result, error);
    yb_lines_free(lines);
    return good;
}

/* Whether the options fit the kind of input. */
static int check_scan(const request_t *request, bool scan)
{
    /* What is not there is told by the one who tries to read it. */
    if (!scan && request->based && access(request->input, F_OK) == 0)
        return cli_usage("--base is for drawn sheets, PNGs of 8 bits without a place on earth: "
                         "%s is none",
                         request->input);
    if (!scan)
        return CLI_OK;
    if (!request->based || request->task.interval_m <= 0)
        return cli_usage("%s is a drawn sheet (a DEM as a PNG has 16 bits): give the height of its "
                         "outermost lines, --base METRES, and from line to line, --interval METRES",
                         request->input);
    if (request->part.boxed || request->part.centered)
        return cli_usage("%s is a drawn sheet and is read whole: --window and --center are for "
                         "maps that say where they lie",
                         request->input);
    return CLI_OK;
}

static int run(request_t *request)
{
    yb_error_t error;
    yb_encode_result_t result;
    bool scan = request->part.field == NULL && yb_scan_is(request->input);
    int status = check_scan(request, scan);
    if (status != CLI_OK)
        return status;
    if (!yb_output_allowed(request->output, request->force, &error))
        return cli_fail("%s", error.text);
    bool vector = request->part.field != NULL || (!scan && yb_lines_is_vector(request->input));
    bool good = scan     ? encode_scan(request, &result, &error)
                : vector ? encode_vector(request, &result, &error)
                         : encode_raster(request, &result, &error);
    if (good && request->task.progress != NULL)
        request->task.progress(NULL, 1);
    if (!good)
        return cli_fail("%s", error.text);
    good = yb_output_write(request->output, request->force, result.code->bytes, result.code->size,
                           &error);
    if (good && request->json)
        tell_json(request, &result);
    else if (good && !request->quiet)
        tell_text(request, &result);
    yb_encode_result_free(&result);
    return good ? CLI_OK : cli_fail("%s", error.text);
}

static int check_request(request_t *request)
{
    if (request->task.levels > 0 && request->task.interval_m > 0)
        return cli_usage("--levels and --interval exclude each other");
    if (request->json && strcmp(request->output, "-") == 0)
        return cli_usage("--json and -o - both want the standard output");
    if (yb_sections_size(&request->sections) > 0) {
        if (request->task.profile == YB_PAPER)
            return cli_usage("--name, --place and --certify are for --profile compact");
        request->task.sections = &request->sections;
    }
    if (!request->quiet && isatty(STDERR_FILENO) && isatty(STDOUT_FILENO))
        request->task.progress = show_progress;
    return cli_part_check(&request->part);
}

int cli_encode(int argc, char **argv)
{
    request_t request = {.task = {.profile = YB_COMPACT,
                                  .most_bytes = YB_ENCODE_DEFAULT_BYTES,
                                  .seed = 1,
                                  .effort = YB_ENCODE_DEFAULT_EFFORT}};
    int answer = 0;
    while ((answer = getopt_long(argc, argv, ":o:q", options, NULL)) != -1) {
        if (answer == OPTION_HELP)
            return help();
        int status = take_option(&request, answer, argc, argv);
        if (status != CLI_OK)
            return status;
    }
    if (argc - optind != 1)
        return cli_usage(argc == optind ? "name the relief to code" : "more than one input");
    if (request.output == NULL)
        return cli_usage("name the code to write: -o MAP.yb");
    request.input = argv[optind];
    int status = check_request(&request);
    return status != CLI_OK ? status : run(&request);
}
