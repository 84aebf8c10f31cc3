#include "cli.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "code_file.h"
#include "comparison.h"
#include "fidelity.h"
#include "grid.h"
#include "line_grid.h"
#include "output.h"
#include "part.h"
#include "picture.h"
#include "sheet.h"
#include "view_options.h"

enum {
    OPTION_JSON = 256,
    OPTION_SHEET,
    OPTION_FORCE,
    OPTION_HELP
};
enum {
    LATTICE = 256
};

static const struct option options[] = {CLI_PART_LONG_OPTIONS,
                                        CLI_PART_CELL_OPTION,
                                        {"json", no_argument, NULL, OPTION_JSON},
                                        {"sheet", required_argument, NULL, OPTION_SHEET},
                                        {"force", no_argument, NULL, OPTION_FORCE},
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        YB_VIEW_LONG_OPTIONS,
                                        {0}};

typedef struct {
    const char *input, *reference, *sheet;
    cli_part_t part;
    bool json, force, help;
    yb_view_options_t view;
} request_t;

static void help(void)
{
    fputs(
        "Usage: yamabiko evaluate MAP.yb REFERENCE [OPTION ...]\n"
        "\n"
        "Says how faithful a code is to what it was made from. REFERENCE is a raster of heights\n"
        "or a vector file of contour lines with their heights, in any format of GDAL. The map is\n"
        "compared with contour lines themselves for K, with a surface through them otherwise.\n"
        "\n"
        "MAP.yb may be a vector file of contour lines, too: then the map has all their points,\n"
        "and window and field hold for both files.\n"
        "\n"
        "  RMSE    root of the mean squared difference of height\n"
        "  NRMSE   RMSE over the standard deviation of the real heights\n"
        "  p90     what nine tenths of the differences do not exceed; max: the largest\n"
        "  slope   mean difference of slope, in degrees\n"
        "  spectrum\n"
        "          how far the root mean squared rises over 1, 2, 4 ... 64 cells are from the "
        "real\n"
        "          ones: mean of |log2(rise / real rise)|, in octaves\n"
        "  K       similarity of the contours, 0 to 1, from overlap (a), distance (d) and\n"
        "          curvature (c); K = (a + d + c) / 3, weighted by the polygons' lengths\n"
        "  N M F   points, contours and the bits of the 1985 paper's code, 12 N + 20 M + 8\n"
        "\n"
        "  --window XMIN YMIN XMAX YMAX   part of the reference, in its own coordinates\n"
        "  --center LON LAT               a square round a place on earth (WGS 84) ...\n"
        "  --km S              ... of so many kilometres a side (default 20)\n"
        "  --cell M            metres per cell of a reference that does not say (default 30)\n"
        "  --field NAME        the attribute of contour lines that is the height\n"
        "  --json              print it all as JSON\n"
        "  --sheet FILE        a page with contours, polygons, both reliefs and these figures:\n"
        "                      a PNG file; the view options below hold for its reliefs\n"
        "  --force             overwrite what exists\n"
        "  --help              this text\n"
        "\n"
        "View of --sheet (--size, --format, --band, --palette, --contours, --shadows, --haze and\n"
        "--lamp do not apply):\n",
        stdout);
    fputs(yb_view_options_help, stdout);
    fputs("\n"
          "Example:\n"
          "  yamabiko evaluate fuji.yb fuji.tif --sheet fuji.png\n",
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
    case OPTION_JSON:
        request->json = true;
        return CLI_OK;
    case OPTION_SHEET:
        request->sheet = optarg;
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
    if (request->input == NULL)
        return cli_usage("name one code and one reference: MAP.yb REFERENCE");
    if (request->json && request->sheet != NULL && strcmp(request->sheet, "-") == 0)
        return cli_usage("--json and '--sheet -' both want the standard output");
    const char *look = yb_view_options_given(&request->view, YB_OPTION_SIZE)
                           ? "size"
                           : yb_view_options_look(&request->view);
    if (look != NULL && strcmp(look, "sun") != 0)
        return cli_usage("--%s does not apply: the sheet has its own size and look", look);
    if (!yb_view_options_check(&request->view, &error))
        return cli_usage("%s", error.text);
    return cli_part_check(&request->part);
}

static void print_misfit(const char *name, const yb_misfit_t *misfit)
{
    printf("%-12s RMSE %.2f m   NRMSE %.4f   p90 %.2f m   max %.2f m   slope %.2f degrees\n", name,
           misfit->rmse_m, misfit->nrmse, misfit->p90_m, misfit->max_m, misfit->slope_deg);
}

/* Whether the map keeps what its certificate promises; it does if it has none. */
static bool keeps_promise(const yb_map_t *map, const yb_fidelity_t *fidelity)
{
    return map->certified_error == 0 ||
           (fidelity->detail.p90_m <= yb_sections_error_m(map->certified_error) &&
            fidelity->k >= map->certified_k / 255.0);
}

static void print_fidelity(const yb_fidelity_t *fidelity)
{
    if (fidelity->bytes > 0)
        printf("bytes %zu   N %u   M %u   F %u bits\n", fidelity->bytes, (unsigned)fidelity->points,
               (unsigned)fidelity->contours, (unsigned)fidelity->body_bits);
    else
        printf("no code: contour lines   N %u   M %u\n", (unsigned)fidelity->points,
               (unsigned)fidelity->contours);
    print_misfit("smooth", &fidelity->smooth);
    print_misfit("with detail", &fidelity->detail);
    printf("K %.4f\n", fidelity->k);
    if (fidelity->contour_count != 0)
        puts("\n  height m       K       a       d       c    length m");
    for (size_t i = 0; i < fidelity->contour_count; i++) {
        const yb_similarity_t *similarity = &fidelity->contour[i].similarity;
        printf("%10.1f  %6.4f  %6.4f  %6.4f  %6.4f  %10.0f%s\n", fidelity->contour[i].height_m,
               similarity->k, similarity->area, similarity->distance, similarity->curvature,
               similarity->length, similarity->reproduced == YB_NO_LINE ? "  missing" : "");
    }
    puts("\n     lag m   real rise m   smooth m   with detail m");
    for (uint32_t i = 0; i < fidelity->lag_count; i++)
        printf("%10.1f  %12.2f  %9.2f  %14.2f\n", fidelity->lag_m[i], fidelity->reference_rise_m[i],
               fidelity->smooth_rise_m[i], fidelity->detail_rise_m[i]);
    printf("spectrum: smooth %.3f octaves off, with detail %.3f\n", fidelity->smooth_spectrum,
           fidelity->detail_spectrum);
}

/* The last part of the path. */
static const char *title_of(const request_t *request)
{
    const char *slash = request->input != NULL ? strrchr(request->input, '/') : NULL;
    return slash != NULL ? slash + 1 : request->input;
}

static bool write_sheet(const request_t *request, yb_code_file_t *file,
                        const yb_comparison_t *comparison, const yb_fidelity_t *fidelity,
                        yb_error_t *error)
{
    yb_view_t view;
    yb_picture_t sheet = {0};
    size_t size = 0;
    if (!yb_view_options_apply(&request->view, &file->map, &view, error))
        return false;
    uint8_t *png = NULL;
    if (yb_sheet_draw(&sheet, title_of(request), file, comparison, fidelity, &view))
        png = yb_picture_png(&sheet, &size);
    yb_picture_free(&sheet);
    const bool good = png != NULL
                          ? yb_output_write(request->sheet, request->force, png, size, error)
                          : yb_error_set(error, "not enough memory for %s", request->sheet);
    free(png);
    return good;
}

static bool evaluate(const request_t *request, yb_code_file_t *file, const yb_grid_t *reference,
                     const yb_lines_t *lines, yb_error_t *error)
{
    yb_comparison_t comparison;
    yb_fidelity_t fidelity;
    if (!yb_comparison_make(&comparison, file, reference, lines, error))
        return false;
    bool good = yb_fidelity_measure(&fidelity, file, &comparison) ||
                yb_error_set(error, "not enough memory to compare %s with %s", request->input,
                             request->reference);
    if (!good) {
        yb_comparison_free(&comparison);
        return false;
    }
    if (request->sheet != NULL)
        good = write_sheet(request, file, &comparison, &fidelity, error);
    if (good && request->json) {
        json_t *json = yb_fidelity_json(&fidelity);
        json_dumpf(json, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(10));
        putchar('\n');
        json_decref(json);
    } else if (good && (request->sheet == NULL || strcmp(request->sheet, "-") != 0)) {
        print_fidelity(&fidelity);
    }
    if (good && !keeps_promise(&file->map, &fidelity))
        fprintf(stderr, "%s: its certificate promises more: nine tenths within %u m, K %.2f\n",
                request->input, yb_certified_error_m(file->map.certified_error),
                file->map.certified_k / 255.0);
    yb_fidelity_free(&fidelity);
    yb_comparison_free(&comparison);
    return good;
}

static int run(const request_t *request)
{
    yb_error_t error;
    if (request->sheet != NULL && !yb_output_allowed(request->sheet, request->force, &error))
        return cli_fail("%s", error.text);
    yb_code_file_t *file = cli_part_read_map(&request->part, request->input);
    if (file == NULL)
        return CLI_FAILED;
    yb_lines_t *lines = NULL;
    yb_grid_t *reference = NULL;
    if (yb_lines_is_vector(request->reference)) {
        lines = yb_lines_from_vector(request->reference, request->part.field, &request->part.window,
                                     &error);
        reference = lines != NULL ? yb_line_grid_new(lines, &error) : NULL;
    } else {
        reference = yb_grid_read(request->reference, &request->part.window, LATTICE, &error);
    }
    const bool good = reference != NULL && evaluate(request, file, reference, lines, &error);
    yb_grid_free(reference);
    yb_lines_free(lines);
    yb_code_file_free(file);
    return good ? CLI_OK : cli_fail("%s", error.text);
}

int cli_evaluate(int argc, char **argv)
{
    request_t request = {.part = {.shared = true}, .view = yb_view_options_default()};
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
    if (optind + 2 == argc) {
        request.input = argv[optind];
        request.reference = argv[optind + 1];
    }
    const int status = check(&request);
    return status != CLI_OK ? status : run(&request);
}
