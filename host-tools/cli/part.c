#include "part.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>

#include "cli.h"

enum {
    DEFAULT_KM = 20
};

const char cli_part_help[] =
    "If MAP is a vector file of contour lines:\n"
    "  --window XMIN YMIN XMAX YMAX\n"
    "                      a box of it, in its own coordinates\n"
    "  --center LON LAT    a square round a place, in degrees (WGS 84) ...\n"
    "  --km S              ... of so many kilometres a side (default 20)\n"
    "  --field NAME        the attribute that is the height (default: one that sounds like\n"
    "                      it, or else the z coordinate)\n";

bool cli_part_owns(int answer)
{
    return answer >= CLI_PART_WINDOW && answer < CLI_PART_END;
}

/* The numbers of an option that has several: the first in optarg, the others in argv. */
static bool take_numbers(int argc, char **argv, double *value, int count)
{
    for (int i = 0; i < count; i++) {
        const char *text = i == 0 ? optarg : optind < argc ? argv[optind++] : "";
        if (!cli_number(text, &value[i]))
            return false;
    }
    return true;
}

int cli_part_take(cli_part_t *part, int answer, int argc, char **argv)
{
    double place[2] = {0};
    const double *box = part->window.box;
    switch (answer) {
    case CLI_PART_WINDOW:
        part->boxed = true;
        if (!take_numbers(argc, argv, part->window.box, 4))
            return cli_usage("--window needs four numbers: XMIN YMIN XMAX YMAX");
        if (box[0] >= box[2] || box[1] >= box[3])
            return cli_usage("--window is empty: XMIN must be less than XMAX, YMIN less than YMAX");
        return CLI_OK;
    case CLI_PART_CENTER:
        part->centered = true;
        if (!take_numbers(argc, argv, place, 2) || fabs(place[0]) > 180 || fabs(place[1]) > 90)
            return cli_usage("--center needs a longitude (-180 to 180) and a latitude (-90 to 90)");
        part->window.lon_deg = place[0];
        part->window.lat_deg = place[1];
        return CLI_OK;
    case CLI_PART_KM:
        if (!cli_number(optarg, &part->km) || part->km <= 0 || part->km > 20000)
            return cli_usage("--km needs a number above 0");
        return CLI_OK;
    case CLI_PART_CELL:
        if (!cli_number(optarg, &part->window.cell_m) || part->window.cell_m <= 0)
            return cli_usage("--cell needs a number of metres above 0");
        return CLI_OK;
    default:
        part->field = optarg;
        return CLI_OK;
    }
}

int cli_part_check(cli_part_t *part)
{
    if (part->boxed && part->centered)
        return cli_usage("--window and --center exclude each other");
    if (part->km > 0 && !part->centered)
        return cli_usage("--km needs --center");
    part->window.side_m = 1000 * (part->km > 0 ? part->km : DEFAULT_KM);
    part->window.kind = part->boxed      ? YB_WINDOW_BOX
                        : part->centered ? YB_WINDOW_CENTER
                                         : YB_WINDOW_WHOLE;
    return CLI_OK;
}

int cli_part_take_rest(cli_part_t *part, int answer, int argc, char **argv)
{
    return cli_part_owns(answer) ? cli_part_take(part, answer, argc, argv)
                                 : cli_bad_option(answer, argc, argv);
}

int cli_part_one_map(cli_part_t *part, int argc, char **argv, const char **path)
{
    int status = cli_part_check(part);
    if (status != CLI_OK)
        return status;
    if (optind + 1 != argc)
        return cli_usage("name one map, MAP.yb");
    *path = argv[optind];
    return CLI_OK;
}

yb_code_file_t *cli_part_read_map(const cli_part_t *part, const char *path)
{
    yb_error_t error;
    yb_map_note_t note;
    yb_code_file_t *file = yb_map_file_read(path, part->field, &part->window, &note, &error);
    if (file == NULL) {
        cli_fail("%s", error.text);
    } else if (file->size > 0 && !part->shared &&
               (part->boxed || part->centered || part->field != NULL)) {
        cli_fail("%s is a code, a whole map: --window, --center and --field are for contour lines",
                 path);
        yb_code_file_free(file);
        return NULL;
    } else if (note.text[0] != '\0') {
        fprintf(stderr, "%s\n", note.text);
    }
    return file;
}
