#include "cli.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "code_file.h"
#include "compact_code.h"
#include "contour_code.h"
#include "panels.h"
#include "part.h"

enum {
    OPTION_JSON = 256,
    OPTION_PANEL,
    OPTION_HELP,
    HEADER_BITS = 14 * 8
};

static const struct option options[] = {{"json", no_argument, NULL, OPTION_JSON},
                                        {"panel", no_argument, NULL, OPTION_PANEL},
                                        CLI_PART_LONG_OPTIONS,
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        {0}};

/* Where the bits of a code went; they add up to its size. Those of the compact profile are
 * fractions of bits.
 */
enum {
    MOST_KINDS = 12
};

typedef struct {
    int kinds;
    struct {
        const char *name, *key;
        double bits;
    } of[MOST_KINDS];
    int sections; /* bytes */
} budget_t;

/* What the regions between the contours are to each other. */
typedef struct {
    int parent[YB_MAX_CONTOURS + 1];  /* of a region, seen from region 0; -1: none */
    int contour[YB_MAX_CONTOURS + 1]; /* the line between a region and its parent */
    int depth[YB_MAX_CONTOURS + 1];
} tree_t;

typedef struct {
    const char *name;
    const yb_code_file_t *file;
    budget_t budget;
    tree_t tree;
    int points, spots, corners;
    double cell_m, unit_m;
} info_t;

static int help(void)
{
    fputs(
        "Usage: yamabiko info MAP.yb [OPTION ...]\n"
        "       yamabiko info --panel [NAME ...] [--json]\n"
        "\n"
        "Says what is in a code: size and scale of the map, its contours and how they lie in\n"
        "each other, the mesh that the engine makes of them, where each bit went; its name, its\n"
        "place on earth and what it certifies, if it says so. MAP.yb may be - for the standard\n"
        "input, or a vector file of contour lines.\n"
        "\n"
        "N is the number of points, M of contours (spot heights among them); F = 12 N + 20 M + 8\n"
        "is the length of the body in bits. The header, the points of each contour and the\n"
        "check byte come on top.\n"
        "\n"
        "D is the fractal dimension of the contours of a level together, H = 2 - D is that of\n"
        "the surface: the smaller H, the rougher it is.\n"
        "\n"
        "\"certificate\" is what --certify of yamabiko encode found: the error that nine tenths "
        "of\n"
        "all heights keep within, fractal detail included, and the similarity K of the contours.\n"
        "For a code of contour lines or of a sheet they hold against the surface that was laid\n"
        "through the lines.\n"
        "\n"
        "  --panel             instead of a map: the panels that there are, or those named; their\n"
        "                      size and pixels, the turns that their chip does, the fastest clock\n"
        "                      that it is rated for, and what that makes of whole frames\n"
        "  --json              the same for machines\n"
        "  --help              this text\n"
        "\n",
        stdout);
    fputs(cli_part_help, stdout);
    fputs("\n"
          "Examples:\n"
          "  yamabiko info fuji.yb\n"
          "  yamabiko encode sheet.png --base 100 --interval 20 --certify -o hill.yb\n"
          "  yamabiko info hill.yb --json\n",
          stdout);
    return CLI_OK;
}

static double height_m(const info_t *info, int32_t z_q8)
{
    return info->file->map.base_m + z_q8 * info->cell_m / 256;
}

static double contour_m(const info_t *info, int contour)
{
    return height_m(info, info->file->map.vertex[info->file->load.contour[contour].first].z_q8);
}

static bool is_compact(const info_t *info)
{
    return info->file->load.profile == YB_COMPACT;
}

static void spend(budget_t *budget, const char *name, const char *key, double bits)
{
    budget->of[budget->kinds].name = name;
    budget->of[budget->kinds].key = key;
    budget->of[budget->kinds++].bits = bits;
}

static void find_paper_budget(info_t *info)
{
    int contours = info->file->load.contour_count;
    int coded = info->corners > 0 ? info->corners : 1;
    budget_t *budget = &info->budget;
    spend(budget, "header", "header", HEADER_BITS);
    spend(budget, "frame heights", "frame_heights", 16 * coded);
    spend(budget, "points per contour", "counts", 8 * contours);
    spend(budget, "dimension", "dimension", 8);
    spend(budget, "heights", "heights", 16 * contours);
    spend(budget, "first points", "starts", 16 * contours);
    spend(budget, "differences", "differences", 12 * (info->points - contours));
}

static void find_compact_budget(info_t *info)
{
    budget_t *budget = &info->budget;
    yb_contour_set_t *set = malloc(sizeof(*set));
    uint8_t code[YB_CONTOUR_CODE_BYTES];
    yb_bits_t bits = {.by_kind = true};
    if (set != NULL) {
        yb_compact_read(info->file, set);
        (void)yb_compact_write(set, code, sizeof(code), &bits);
    }
    free(set);
    spend(budget, "version", "version", 8);
    spend(budget, "header", "header", bits.of[YB_BITS_HEADER]);
    spend(budget, "frame heights", "frame_heights", bits.of[YB_BITS_FRAME]);
    spend(budget, "starts of lines", "starts", bits.of[YB_BITS_STARTS]);
    spend(budget, "heights of lines", "heights", bits.of[YB_BITS_HEIGHTS]);
    spend(budget, "lengths", "lengths", bits.of[YB_BITS_LENGTHS]);
    spend(budget, "turns", "turns", bits.of[YB_BITS_TURNS]);
    spend(budget, "spot heights: places", "spot_places", bits.of[YB_BITS_SPOT_PLACES]);
    spend(budget, "spot heights: heights", "spot_heights", bits.of[YB_BITS_SPOT_HEIGHTS]);
    budget->sections = (int)info->file->size - info->file->load.relief_size - 1;
    spend(budget, "sections", "sections", 8 * budget->sections);
}

static void find_budget(info_t *info)
{
    if (is_compact(info))
        find_compact_budget(info);
    else
        find_paper_budget(info);
    spend(&info->budget, "check", "check", 8);
    double rest = (double)info->file->size * 8;
    for (int i = 0; i < info->budget.kinds; i++)
        rest -= info->budget.of[i].bits;
    spend(&info->budget, "padding", "padding", rest);
}

/* Walks from region to region over the lines, each once: their adjacency is a tree. */
static void find_tree(info_t *info)
{
    const yb_load_t *load = &info->file->load;
    tree_t *tree = &info->tree;
    bool grown = true;
    for (int i = 0; i < load->region_count; i++) {
        tree->parent[i] = -1;
        tree->contour[i] = -1;
        tree->depth[i] = i == 0 ? 0 : -1;
    }
    while (grown) {
        grown = false;
        for (int i = 0; i < load->contour_count; i++) {
            int a = load->contour[i].left;
            int b = load->contour[i].right;
            if (a == b || (tree->depth[a] >= 0) == (tree->depth[b] >= 0))
                continue;
            int known = tree->depth[a] >= 0 ? a : b;
            int found = known == a ? b : a;
            tree->parent[found] = known;
            tree->contour[found] = i;
            tree->depth[found] = tree->depth[known] + 1;
            grown = true;
        }
    }
}

static void gather(info_t *info, const char *name, const yb_code_file_t *file)
{
    memset(info, 0, sizeof(*info));
    info->name = name;
    info->file = file;
    info->cell_m = yb_unit_m(file->map.cell);
    info->unit_m = yb_unit_m(file->map.unit);
    for (int i = 0; i < file->load.contour_count; i++) {
        info->points += file->load.contour[i].count;
        info->spots += file->load.contour[i].count == 1;
    }
    find_tree(info);
    if (file->size == 0) /* lines: there is no code */
        return;
    for (int bit = 4; bit < 8 && !is_compact(info); bit++)
        info->corners += file->bytes[1] >> bit & 1;
    find_budget(info);
}

static const char *kind_of(const info_t *info, int contour_at)
{
    const yb_contour_t *contour = &info->file->load.contour[contour_at];
    return contour->count == 1                             ? "spot"
           : yb_contour_is_open(&info->file->map, contour) ? "open"
                                                           : "closed";
}

static void print_tree(const info_t *info)
{
    const yb_load_t *load = &info->file->load;
    /* Depth first, by always taking the next unvisited child of the current region. */
    bool seen[YB_MAX_CONTOURS + 1] = {false};
    int at = 0;
    seen[0] = true;
    puts("\nregions, as seen from region 0");
    printf("  region 0\n");
    while (at >= 0) {
        int child = 0;
        while (child < load->region_count && (seen[child] || info->tree.parent[child] != at))
            child++;
        if (child == load->region_count) {
            at = info->tree.parent[at];
            continue;
        }
        at = child;
        seen[at] = true;
        int contour = info->tree.contour[at];
        printf("  %*sregion %d beyond contour %d (%s, %.0f m)\n", 2 * info->tree.depth[at], "", at,
               contour, kind_of(info, contour), contour_m(info, contour));
    }
}

static void print_contours(const info_t *info)
{
    const yb_load_t *load = &info->file->load;
    puts("\ncontours");
    for (int i = 0; i < load->contour_count; i++) {
        const yb_contour_t *contour = &load->contour[i];
        const yb_vertex_t *first = &info->file->map.vertex[contour->first];
        printf("  %3d  %-6s %9.1f m  %3d point%s  from %d,%d", i, kind_of(info, i),
               contour_m(info, i), contour->count, contour->count == 1 ? " " : "s",
               first->x_q8 >> 8, first->y_q8 >> 8);
        if (contour->count == 1)
            printf("  in region %d\n", contour->left);
        else
            printf("  between regions %d and %d\n", contour->left, contour->right);
    }
}

static void print_budget(const info_t *info)
{
    double all = (double)info->file->size * 8;
    puts("\nbits");
    for (int i = 0; i < info->budget.kinds; i++)
        printf("  %-22s %7.1f  %4.1f %%\n", info->budget.of[i].name, info->budget.of[i].bits,
               100 * info->budget.of[i].bits / all);
    printf("  %-22s %7.1f\n", "in all", all);
}

static void print_frame(const info_t *info)
{
    double east = info->file->map.east_q8 / 256.0;
    double north = info->file->map.north_q8 / 256.0;
    printf("  frame              %.6g x %.6g steps of %.6g m: %.4g x %.4g km\n", east, north,
           info->cell_m, east * info->cell_m / 1000, north * info->cell_m / 1000);
}

static void print_mesh(const info_t *info)
{
    printf("  mesh               %d vertices, %u triangles, %d regions\n",
           info->file->map.vertex_count, (unsigned)info->file->map.triangle_count,
           info->file->load.region_count);
}

/* The next section of a code; *at is 0 to begin with. */
static bool next_section(const info_t *info, size_t *at, yb_section_t *section)
{
    size_t relief = info->file->load.relief_size;
    return yb_section_next(info->file->bytes + relief, info->file->size - relief - 1, at, section);
}

static const char *section_name(int kind)
{
    return kind == YB_SECTION_CERTIFICATE ? "certificate"
           : kind == YB_SECTION_PLACE     ? "place"
           : kind == YB_SECTION_NAME      ? "name"
                                          : "unknown";
}

static void print_sections(const info_t *info)
{
    const yb_sections_t *sections = &info->file->sections;
    const yb_map_t *map = &info->file->map;
    yb_section_t section;
    size_t at = 0;
    if (sections->name[0] != '\0')
        printf("  name               %s\n", sections->name);
    if (sections->placed)
        printf("  place of centre    longitude %.5f, latitude %.5f\n", sections->lon_deg,
               sections->lat_deg);
    if (map->certified_error > 0)
        printf("  certificate        nine tenths of the heights within %u m, K %.2f\n",
               yb_certified_error_m(map->certified_error), map->certified_k / 255.0);
    while (next_section(info, &at, &section)) {
        if (at == section.whole)
            printf("  sections          ");
        printf(" %s %zu bytes%s", section_name(section.kind), section.whole,
               at < (size_t)info->budget.sections ? "," : "\n");
    }
}

static void print_code(const info_t *info)
{
    const yb_map_t *map = &info->file->map;
    int contours = info->file->load.contour_count;
    int f_bits = 12 * info->points + 20 * contours + 8;
    double hurst = (map->hurst_q8m1 + 1) / 256.0;
    printf("%s: %zu bytes, format %d, profile %s\n", info->name, info->file->size,
           YB_FORMAT_VERSION, is_compact(info) ? "compact" : "paper");
    printf("  N = %d points, M = %d contours (%d of them spot heights), F = %d bits = %d bytes\n",
           info->points, contours, info->spots, f_bits, (f_bits + 7) / 8);
    print_sections(info);
    print_frame(info);
    printf("  heights            %.1f to %.1f m, coded in units of %.6g m above %d m\n",
           height_m(info, map->low_q8), height_m(info, map->high_q8), info->unit_m, map->base_m);
    if (!is_compact(info)) {
        printf("  differences        multiples of %d\n", 1 << (info->file->bytes[1] & 3));
        printf("  corner heights     %d coded\n", info->corners);
    }
    printf("  D = %.3f, H = %.3f, gain %.2f, seed %d, %s midpoints\n", 2 - hurst, hurst,
           info->file->load.gain / 32.0, map->seed, map->smooth ? "smooth" : "straight");
    print_mesh(info);
    print_budget(info);
}

static void print_lines(const info_t *info)
{
    const yb_map_t *map = &info->file->map;
    printf("%s: contour lines in full detail, no code\n", info->name);
    printf("  %d points, %d contours (%d of them spot heights)\n", info->points,
           info->file->load.contour_count, info->spots);
    print_frame(info);
    printf("  heights            %.1f to %.1f m\n", height_m(info, map->low_q8),
           height_m(info, map->high_q8));
    print_mesh(info);
}

static void print_text(const info_t *info)
{
    if (info->file->size > 0)
        print_code(info);
    else
        print_lines(info);
    print_contours(info);
    print_tree(info);
}

static json_t *json_budget(const budget_t *budget)
{
    json_t *bits = json_object();
    for (int i = 0; i < budget->kinds; i++)
        json_object_set_new(bits, budget->of[i].key, json_real(budget->of[i].bits));
    return bits;
}

/* Bytes of the same contours in the paper profile, where long steps would need more points still.
 */
static int paper_bytes(const info_t *info)
{
    const yb_load_t *load = &info->file->load;
    int corners = 0;
    for (int i = 0; i < 4; i++)
        corners += load->corner_height[i] != INT32_MIN;
    int body = 12 * info->points + 20 * load->contour_count + 8;
    return HEADER_BITS / 8 + 2 * (corners > 0 ? corners : 1) + load->contour_count +
           (body + 7) / 8 + 1;
}

/* Whole steps, as in a code, are whole numbers. */
static json_t *json_steps(int at_q8)
{
    return at_q8 % 256 == 0 ? json_integer(at_q8 / 256) : json_real(at_q8 / 256.0);
}

static json_t *json_contours(const info_t *info)
{
    json_t *list = json_array();
    for (int i = 0; i < info->file->load.contour_count; i++) {
        const yb_contour_t *contour = &info->file->load.contour[i];
        json_t *points = json_array();
        for (int k = 0; k < contour->count; k++) {
            const yb_vertex_t *at = &info->file->map.vertex[contour->first + k];
            json_array_append_new(points,
                                  json_pack("[o, o]", json_steps(at->x_q8), json_steps(at->y_q8)));
        }
        json_array_append_new(list, json_pack("{s:s, s:f, s:i, s:i, s:o}", "kind", kind_of(info, i),
                                              "height_m", contour_m(info, i), "left", contour->left,
                                              "right", contour->right, "points", points));
    }
    return list;
}

static json_t *json_regions(const info_t *info)
{
    json_t *list = json_array();
    for (int i = 0; i < info->file->load.region_count; i++)
        json_array_append_new(list, json_pack("{s:i, s:i}", "parent", info->tree.parent[i],
                                              "contour", info->tree.contour[i]));
    return list;
}

/* What is not there is left out; `sections` lists all, unknown ones too. */
static void json_sections(const info_t *info, json_t *root)
{
    const yb_sections_t *sections = &info->file->sections;
    const yb_map_t *map = &info->file->map;
    json_t *list = json_array();
    yb_section_t section;
    size_t at = 0;
    while (next_section(info, &at, &section))
        json_array_append_new(list,
                              json_pack("{s:i, s:s, s:i}", "kind", section.kind, "name",
                                        section_name(section.kind), "bytes", (int)section.whole));
    json_object_set_new(root, "sections", list);
    if (sections->name[0] != '\0')
        json_object_set_new(root, "name", json_string(sections->name));
    if (sections->placed)
        json_object_set_new(
            root, "place",
            json_pack("{s:f, s:f}", "lon", sections->lon_deg, "lat", sections->lat_deg));
    if (map->certified_error > 0)
        json_object_set_new(root, "certificate",
                            json_pack("{s:f, s:f}", "p90_m",
                                      yb_sections_error_m(map->certified_error), "k",
                                      map->certified_k / 255.0));
}

/* What a code says beyond the map itself. */
static void json_code(const info_t *info, json_t *root)
{
    const yb_map_t *map = &info->file->map;
    int contours = info->file->load.contour_count;
    double hurst = (map->hurst_q8m1 + 1) / 256.0;
    json_object_set_new(root, "bytes", json_integer((json_int_t)info->file->size));
    json_object_set_new(root, "format", json_integer(YB_FORMAT_VERSION));
    json_object_set_new(root, "profile", json_string(is_compact(info) ? "compact" : "paper"));
    json_object_set_new(root, "f_bits", json_integer(12 * info->points + 20 * contours + 8));
    if (!is_compact(info)) {
        json_object_set_new(root, "shift", json_integer(info->file->bytes[1] & 3));
        json_object_set_new(root, "corners_coded", json_integer(info->corners));
    }
    json_object_set_new(root, "paper_bytes", json_integer(paper_bytes(info)));
    json_object_set_new(root, "unit_m", json_real(info->unit_m));
    json_object_set_new(root, "dimension", json_real(2 - hurst));
    json_object_set_new(root, "hurst", json_real(hurst));
    json_object_set_new(root, "gain", json_real(info->file->load.gain / 32.0));
    json_object_set_new(root, "seed", json_integer(map->seed));
    json_object_set_new(root, "smooth", json_boolean(map->smooth));
    json_object_set_new(root, "bits", json_budget(&info->budget));
    json_sections(info, root);
}

static int print_json(const info_t *info)
{
    const yb_map_t *map = &info->file->map;
    json_t *root = json_pack("{s:s, s:i, s:i}", "file", info->name, "n", info->points, "m",
                             info->file->load.contour_count);
    if (root == NULL)
        return cli_fail("out of memory");
    if (info->file->size > 0)
        json_code(info, root);
    json_object_set_new(root, "east", json_steps(map->east_q8));
    json_object_set_new(root, "north", json_steps(map->north_q8));
    json_object_set_new(root, "cell_m", json_real(info->cell_m));
    json_object_set_new(root, "base_m", json_integer(map->base_m));
    json_object_set_new(root, "low_m", json_real(height_m(info, map->low_q8)));
    json_object_set_new(root, "high_m", json_real(height_m(info, map->high_q8)));
    json_object_set_new(root, "vertices", json_integer(map->vertex_count));
    json_object_set_new(root, "triangles", json_integer(map->triangle_count));
    json_object_set_new(root, "contours", json_contours(info));
    json_object_set_new(root, "regions", json_regions(info));
    json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(8));
    putchar('\n');
    json_decref(root);
    return CLI_OK;
}

int cli_info(int argc, char **argv)
{
    bool json = false, panels = false;
    cli_part_t part = {0};
    int answer = 0;
    int status = CLI_OK;
    while (status == CLI_OK && (answer = getopt_long(argc, argv, ":", options, NULL)) != -1) {
        if (answer == OPTION_HELP)
            return help();
        if (cli_part_owns(answer))
            status = cli_part_take(&part, answer, argc, argv);
        else if (answer == OPTION_JSON)
            json = true;
        else if (answer == OPTION_PANEL)
            panels = true;
        else
            status = cli_bad_option(answer, argc, argv);
    }
    status = status == CLI_OK ? cli_part_check(&part) : status;
    if (status != CLI_OK)
        return status;
    if (panels)
        return cli_info_panels(argv + optind, argc - optind, json);
    if (argc - optind != 1)
        return cli_usage(argc == optind ? "name the map" : "more than one map");
    yb_code_file_t *file = cli_part_read_map(&part, argv[optind]);
    if (file == NULL)
        return CLI_FAILED;
    info_t *info = calloc(1, sizeof(*info));
    if (info == NULL) {
        status = cli_fail("out of memory");
    } else {
        gather(info, strcmp(argv[optind], "-") == 0 ? "the standard input" : argv[optind], file);
        if (json)
            status = print_json(info);
        else
            print_text(info);
    }
    free(info);
    yb_code_file_free(file);
    return status;
}
