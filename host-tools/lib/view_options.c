#include "view_options.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "standard_views.h"
#include "surface.h"

/* The engine moves positions that are farther than this back to it. */
enum {
    FARTHEST_STEPS = 4096
};

const char yb_view_options_help[] =
    "  --size WxH          pixels (default 640x480)\n"
    "  --format FORMAT     rgb565 (default), grey4: 16 greys, two pixels a byte, or mono:\n"
    "                      dithered, eight pixels a byte\n"
    "  --view NAME         a standard view: orbit-45, orbit-135, orbit-225, orbit-315,\n"
    "                      summit-1, summit-2, walk-1, walk-2\n"
    "  --azimuth DEG       where the camera looks, clockwise from north (default 45);\n"
    "                      0: the eye stands in the south\n"
    "  --elevation DEG     of the eye above the horizon, 0 to 90 (default 30)\n"
    "  --distance WIDTHS   of the eye from the map's middle, in map widths (default 1.2)\n"
    "  --eye X Y Z         metres from the map's south-west corner, Z above the datum;\n"
    "                      instead of --view, --elevation and --distance\n"
    "  --look X Y Z        what the eye looks at (default: the map's middle)\n"
    "  --walk X Y          the eye stands there, metres from the map's south-west corner, and\n"
    "                      looks along --azimuth and --tilt\n"
    "  --fly X Y Z         the same from the air, Z above the datum, or higher: it keeps off\n"
    "                      the ground\n"
    "  --height M          of the eye above ground or water, for --walk; at least, for --fly\n"
    "                      (default: half a step of the map)\n"
    "  --tilt DEG          up, or down if negative, -90 to 90 (default 0)\n"
    "  --fov DEG           width of the picture, 4 to 126 (default 50)\n"
    "  --sun AZ EL         direction of the light (default 315 30)\n"
    "  --lamp X Y Z        a lamp there instead of the sun, placed as --eye; it casts no\n"
    "                      shadows\n"
    "  --water M           water up to M metres above the datum\n"
    "  --palette NAME      natural (default), hypsometric, mono or night\n"
    "  --contours M        lines on the relief at every M metres above the datum\n"
    "  --shadows N         what mountains cast, by a grid of N x N cells: 16, 32, 64, 128\n"
    "                      or 256\n"
    "  --haze WIDTHS       air that hides half of what is twice so far, in map widths\n"
    "  --exaggerate F      vertical scale, 0.01 to 8 (default 1)\n"
    "  --walls on|off      the sides of the block (default on)\n"
    "  --edge PIXELS       longest edge of a triangle on the screen (default 6; on a panel\n"
    "                      what a device does: a sixteenth of its width)\n"
    "  --max-leaves N      at most N triangles (default: no bound)\n"
    "  --band ROWS         draw so many rows at a time (default: all); same pixels\n"
    "  --no-detail         the smooth surface, without fractal detail\n";

yb_view_options_t yb_view_options_default(void)
{
    return (yb_view_options_t){.screen = {.width = 640, .height = 480, .format = YB_RGB565},
                               .azimuth_deg = 45,
                               .elevation_deg = 30,
                               .distance = 1.2,
                               .fov_deg = 50,
                               .exaggerate = 1,
                               .edge_px = 6,
                               .walls = true,
                               .detail = true};
}

const char *const yb_format_names[] = {"grey4", "rgb565", "mono", NULL};
const char *const yb_palette_names[] = {"natural", "hypsometric", "mono", "night", NULL};

bool yb_view_options_owns(int option)
{
    return option >= YB_OPTION_SIZE && option < YB_OPTION_VIEW_END;
}

int yb_view_options_values(int option)
{
    switch (option) {
    case YB_OPTION_EYE:
    case YB_OPTION_LOOK:
    case YB_OPTION_FLY:
    case YB_OPTION_LAMP:
        return 3;
    case YB_OPTION_WALK:
    case YB_OPTION_SUN:
        return 2;
    default:
        return 1;
    }
}

bool yb_view_options_given(const yb_view_options_t *options, int option)
{
    return (options->given >> (option - YB_OPTION_SIZE) & 1) != 0;
}

static bool parse_number(const char *name, const char *text, double low, double high, double *value,
                         yb_error_t *error)
{
    char *end = NULL;
    errno = 0;
    *value = text != NULL ? strtod(text, &end) : 0;
    if (text == NULL)
        return yb_error_set(error, "--%s lacks a value", name);
    if (end == text || *end != '\0' || errno != 0 || !isfinite(*value))
        return yb_error_set(error, "--%s: '%s' is not a number", name, text);
    if (*value < low || *value > high)
        return yb_error_set(error, "--%s: %s is not between %g and %g", name, text, low, high);
    return true;
}

/* The first value is in optarg, the others follow in argv. */
static bool parse_numbers(const char *name, int argc, char **argv, int count, const double *low,
                          const double *high, double *value, yb_error_t *error)
{
    for (int i = 0; i < count; i++) {
        const char *text = i == 0 ? optarg : optind < argc ? argv[optind++] : NULL;
        if (text == NULL)
            return yb_error_set(error, "--%s needs %d values", name, count);
        if (!parse_number(name, text, low[i], high[i], &value[i], error))
            return false;
    }
    return true;
}

static bool parse_place(const char *name, int argc, char **argv, double *place_m, yb_error_t *error)
{
    static const double low[3] = {-1e9, -1e9, -1e9}, high[3] = {1e9, 1e9, 1e9};
    return parse_numbers(name, argc, argv, 3, low, high, place_m, error);
}

static bool parse_count(const char *name, const char *text, long low, long high, long *value,
                        yb_error_t *error)
{
    char *end = NULL;
    errno = 0;
    *value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || *value < low || *value > high)
        return yb_error_set(error, "--%s: '%s' is not a whole number from %ld to %ld", name, text,
                            low, high);
    return true;
}

/* One of the words of a list that ends with NULL; its index in *which. */
static bool parse_word(const char *name, const char *const *words, int *which, yb_error_t *error)
{
    for (*which = 0; words[*which] != NULL; ++*which) {
        if (strcmp(words[*which], optarg) == 0)
            return true;
    }
    return yb_error_set(error,
                        "--%s: there is no '%s'; 'yamabiko render --help' lists what there is",
                        name, optarg);
}

static bool parse_size(yb_screen_t *screen, yb_error_t *error)
{
    char *end = NULL;
    const unsigned long width = *optarg >= '1' && *optarg <= '9' ? strtoul(optarg, &end, 10) : 0;
    unsigned long height = 0;
    if (width != 0 && *end == 'x' && end[1] >= '1' && end[1] <= '9')
        height = strtoul(end + 1, &end, 10);
    if (height == 0 || *end != '\0' || width > YB_MAX_SIDE || height > YB_MAX_SIDE)
        return yb_error_set(error, "--size: '%s' is not WIDTHxHEIGHT, each from 1 to %d", optarg,
                            YB_MAX_SIDE);
    screen->width = (uint16_t)width;
    screen->height = (uint16_t)height;
    return true;
}

static bool take_picture(yb_view_options_t *options, int option, yb_error_t *error)
{
    static const char *const switches[] = {"off", "on", NULL};
    int which = 0;
    long count = 0;
    bool good = true;
    switch (option) {
    case YB_OPTION_SIZE:
        return parse_size(&options->screen, error);
    case YB_OPTION_FORMAT:
        good = parse_word("format", yb_format_names, &which, error);
        options->screen.format = (yb_format_t)which;
        return good;
    case YB_OPTION_PALETTE:
        good = parse_word("palette", yb_palette_names, &which, error);
        options->palette = (yb_palette_t)which;
        return good;
    case YB_OPTION_SHADOWS:
        if (!parse_count("shadows", optarg, 16, 256, &options->shadows, error))
            return false;
        return (options->shadows & (options->shadows - 1)) == 0 ||
               yb_error_set(error, "--shadows: %s is not 16, 32, 64, 128 or 256", optarg);
    case YB_OPTION_CONTOURS:
        return parse_number("contours", optarg, 0.01, 1e6, &options->contours_m, error);
    case YB_OPTION_HAZE:
        return parse_number("haze", optarg, 0.01, 15, &options->haze, error);
    case YB_OPTION_WALLS:
        good = parse_word("walls", switches, &which, error);
        options->walls = which == 1;
        return good;
    case YB_OPTION_BAND:
        good = parse_count("band", optarg, 1, YB_MAX_SIDE, &count, error);
        options->band_rows = (uint16_t)count;
        return good;
    case YB_OPTION_MAX_LEAVES:
        return parse_count("max-leaves", optarg, 1, 1000000000, &options->max_leaves, error);
    case YB_OPTION_EDGE:
        return parse_number("edge", optarg, 0.5, 4095, &options->edge_px, error);
    default:
        options->detail = false;
        return true;
    }
}

static bool parse_standard_view(int *which, yb_error_t *error)
{
    const char *names[YB_STANDARD_VIEWS + 1];
    for (int i = 0; i <= YB_STANDARD_VIEWS; i++)
        names[i] = yb_standard_view_name(i);
    return parse_word("view", names, which, error);
}

bool yb_view_options_take(yb_view_options_t *options, int option, int argc, char **argv,
                          yb_error_t *error)
{
    static const double sun_low[2] = {-360, -90}, sun_high[2] = {720, 90};
    options->given |= 1u << (option - YB_OPTION_SIZE);
    switch (option) {
    case YB_OPTION_VIEW:
        return parse_standard_view(&options->standard_view, error);
    case YB_OPTION_EYE:
        return parse_place("eye", argc, argv, options->eye_m, error);
    case YB_OPTION_LOOK:
        return parse_place("look", argc, argv, options->look_m, error);
    case YB_OPTION_LAMP:
        return parse_place("lamp", argc, argv, options->lamp_m, error);
    case YB_OPTION_FLY:
        return parse_place("fly", argc, argv, options->eye_m, error);
    case YB_OPTION_WALK:
        return parse_numbers("walk", argc, argv, 2, (const double[]){-1e9, -1e9},
                             (const double[]){1e9, 1e9}, options->eye_m, error);
    case YB_OPTION_HEIGHT:
        return parse_number("height", optarg, 0, 1e6, &options->height_m, error);
    case YB_OPTION_TILT:
        return parse_number("tilt", optarg, -90, 90, &options->tilt_deg, error);
    case YB_OPTION_AZIMUTH:
        return parse_number("azimuth", optarg, -360, 720, &options->azimuth_deg, error);
    case YB_OPTION_ELEVATION:
        return parse_number("elevation", optarg, 0, 90, &options->elevation_deg, error);
    case YB_OPTION_DISTANCE:
        return parse_number("distance", optarg, 0.01, 15, &options->distance, error);
    case YB_OPTION_FOV:
        return parse_number("fov", optarg, 4, 126, &options->fov_deg, error);
    case YB_OPTION_SUN:
        return parse_numbers("sun", argc, argv, 2, sun_low, sun_high, options->sun_deg, error);
    case YB_OPTION_WATER:
        return parse_number("water", optarg, -1e6, 1e6, &options->water_m, error);
    case YB_OPTION_EXAGGERATE:
        return parse_number("exaggerate", optarg, 0.01, 8, &options->exaggerate, error);
    default:
        return take_picture(options, option, error);
    }
}

typedef struct {
    int option;
    const char *name;
} named_t;

static const named_t places[] = {{YB_OPTION_EYE, "eye"},
                                 {YB_OPTION_VIEW, "view"},
                                 {YB_OPTION_WALK, "walk"},
                                 {YB_OPTION_FLY, "fly"},
                                 {0, NULL}};
static const named_t look[] = {{YB_OPTION_FORMAT, "format"},
                               {YB_OPTION_BAND, "band"},
                               {YB_OPTION_PALETTE, "palette"},
                               {YB_OPTION_CONTOURS, "contours"},
                               {YB_OPTION_SHADOWS, "shadows"},
                               {YB_OPTION_HAZE, "haze"},
                               {YB_OPTION_SUN, "sun"},
                               {YB_OPTION_LAMP, "lamp"},
                               {0, NULL}};

static const char *first_given(const yb_view_options_t *options, const named_t *named)
{
    while (named->name != NULL && !yb_view_options_given(options, named->option))
        named++;
    return named->name;
}

const char *yb_view_options_placed(const yb_view_options_t *options)
{
    return first_given(options, places);
}

const char *yb_view_options_look(const yb_view_options_t *options)
{
    return first_given(options, look);
}

bool yb_view_options_check(const yb_view_options_t *options, yb_error_t *error)
{
    const char *placed = yb_view_options_placed(options);
    for (const named_t *place = places; place->name != NULL; place++) {
        if (yb_view_options_given(options, place->option) && placed != place->name)
            return yb_error_set(error, "--%s and --%s both say where the eye is: give one", placed,
                                place->name);
    }
    const bool eye = yb_view_options_given(options, YB_OPTION_EYE);
    const bool moves = yb_view_options_given(options, YB_OPTION_WALK) ||
                       yb_view_options_given(options, YB_OPTION_FLY);
    if (placed != NULL && (yb_view_options_given(options, YB_OPTION_ELEVATION) ||
                           yb_view_options_given(options, YB_OPTION_DISTANCE)))
        return yb_error_set(error, "--elevation and --distance place the eye, and so does --%s",
                            placed);
    if (placed != NULL && !eye && !moves && yb_view_options_given(options, YB_OPTION_AZIMUTH))
        return yb_error_set(error, "--view is complete: leave --azimuth out");
    if (yb_view_options_given(options, YB_OPTION_LAMP) &&
        (yb_view_options_given(options, YB_OPTION_SUN) ||
         yb_view_options_given(options, YB_OPTION_SHADOWS)))
        return yb_error_set(error, "a lamp shines instead of the sun and casts no shadows: leave "
                                   "--sun and --shadows out");
    if (!eye && yb_view_options_given(options, YB_OPTION_LOOK))
        return yb_error_set(error, "--look needs --eye");
    if (!moves && (yb_view_options_given(options, YB_OPTION_HEIGHT) ||
                   yb_view_options_given(options, YB_OPTION_TILT)))
        return yb_error_set(error, "--height and --tilt are for --walk and --fly");
    if (options->screen.format == YB_GREY4 && options->screen.width % 2 != 0)
        return yb_error_set(error, "--format grey4 needs an even width: two pixels share a byte");
    return true;
}

static uint16_t bam(double degrees)
{
    return (uint16_t)((uint32_t)lround((degrees + 720) / 360 * 65536) & 0xffff);
}

/* Metres to 1/256 steps; false beyond the engine's range. */
static bool to_q8(double metres, const yb_map_t *map, int32_t *q8)
{
    const double steps = metres / yb_map_cell_m(map);
    if (fabs(steps) > FARTHEST_STEPS)
        return false;
    *q8 = (int32_t)lround(steps * 256);
    return true;
}

static bool place_to_q8(const double *place_m, const yb_map_t *map, const yb_view_t *view,
                        int32_t *q8)
{
    const double z_m = (place_m[2] - map->base_m) * view->exaggerate_q8 / 256;
    return to_q8(place_m[0], map, &q8[0]) && to_q8(place_m[1], map, &q8[1]) &&
           to_q8(z_m, map, &q8[2]);
}

static bool apply_eye(const yb_view_options_t *options, const yb_map_t *map, yb_view_t *view,
                      yb_error_t *error)
{
    /* The orbit's look is the middle of the map. */
    yb_view_orbit(view, map, 0, 0, 256);
    view->azimuth_bam =
        yb_view_options_given(options, YB_OPTION_AZIMUTH) ? bam(options->azimuth_deg) : 0;
    if (!place_to_q8(options->eye_m, map, view, view->eye_q8))
        return yb_error_set(error, "--eye: the eye is more than %d steps of %g m from the map",
                            FARTHEST_STEPS, yb_map_cell_m(map));
    if (yb_view_options_given(options, YB_OPTION_LOOK) &&
        !place_to_q8(options->look_m, map, view, view->look_q8))
        return yb_error_set(error, "--look: the place is more than %d steps of %g m from the map",
                            FARTHEST_STEPS, yb_map_cell_m(map));
    return true;
}

static bool apply_walk(const yb_view_options_t *options, const yb_map_t *map, yb_view_t *view,
                       yb_error_t *error)
{
    const bool flies = yb_view_options_given(options, YB_OPTION_FLY);
    const uint16_t azimuth =
        yb_view_options_given(options, YB_OPTION_AZIMUTH) ? bam(options->azimuth_deg) : 0;
    const int16_t tilt = (int16_t)bam(options->tilt_deg);
    int32_t height_q8 = 128;
    if (yb_view_options_given(options, YB_OPTION_HEIGHT) &&
        !to_q8(options->height_m * view->exaggerate_q8 / 256, map, &height_q8))
        return yb_error_set(error, "--height: %g m is too high", options->height_m);
    int32_t eye_q8[3];
    if (!place_to_q8(options->eye_m, map, view, eye_q8))
        return yb_error_set(error, "--%s: the eye is more than %d steps of %g m from the map",
                            flies ? "fly" : "walk", FARTHEST_STEPS, yb_map_cell_m(map));
    if (flies) {
        yb_view_fly(view, map, eye_q8, height_q8, azimuth, tilt);
        return true;
    }
    if (eye_q8[0] < 0 || eye_q8[1] < 0 || eye_q8[0] > map->east_q8 || eye_q8[1] > map->north_q8)
        return yb_error_set(error, "--walk: %g %g is not on the map, which is %g m by %g m",
                            options->eye_m[0], options->eye_m[1],
                            map->east_q8 / 256.0 * yb_map_cell_m(map),
                            map->north_q8 / 256.0 * yb_map_cell_m(map));
    yb_view_walk(view, map, (uint16_t)eye_q8[0], (uint16_t)eye_q8[1], height_q8, azimuth, tilt);
    return true;
}

static bool apply_water(const yb_view_options_t *options, const yb_map_t *map, yb_view_t *view)
{
    view->water_q8 = YB_NO_WATER;
    return !yb_view_options_given(options, YB_OPTION_WATER) ||
           to_q8(options->water_m - map->base_m, map, &view->water_q8);
}

static bool apply_contours(const yb_view_options_t *options, const yb_map_t *map, yb_view_t *view,
                           yb_error_t *error)
{
    if (options->contours_m <= 0)
        return true;
    const double step_m = yb_map_cell_m(map);
    const double steps_q8 = options->contours_m / step_m * 256;
    if (steps_q8 < YB_LEAST_CONTOUR_Q8 || steps_q8 > YB_MOST_CONTOUR_Q8)
        return yb_error_set(error, "--contours: on this map lines may be %g to %g m apart",
                            ceil(step_m * YB_LEAST_CONTOUR_Q8 / 256),
                            floor(step_m * YB_MOST_CONTOUR_Q8 / 256));
    view->contour_q8 = (int32_t)lround(steps_q8);
    /* The first multiple above the base: the interval's rounding adds up from there. */
    const double first_m = ceil(map->base_m / options->contours_m) * options->contours_m;
    view->contour_at_q8 = (int32_t)lround((first_m - map->base_m) / step_m * 256);
    return true;
}

void yb_view_options_panel(yb_view_options_t *options, const yb_screen_t *screen)
{
    options->screen = *screen;
    if (!yb_view_options_given(options, YB_OPTION_EDGE))
        options->edge_px = 0;
}

bool yb_view_options_apply(const yb_view_options_t *options, yb_map_t *map, yb_view_t *view,
                           yb_error_t *error)
{
    const double half_fov = options->fov_deg / 2 * acos(-1.0) / 180;
    map->detail = map->detail && options->detail;
    yb_view_init(view, map);
    view->zoom_q12 = (uint16_t)lround(4096 / (2 * tan(half_fov)));
    view->exaggerate_q8 = (uint16_t)lround(options->exaggerate * 256);
    view->walls = options->walls;
    view->max_leaves = (uint32_t)options->max_leaves;
    view->edge_q4 = (uint16_t)lround(options->edge_px * 16);
    if (yb_view_options_given(options, YB_OPTION_SUN))
        yb_view_sun(view, bam(options->sun_deg[0]), bam(options->sun_deg[1]));
    view->lamp = yb_view_options_given(options, YB_OPTION_LAMP);
    if (view->lamp && !place_to_q8(options->lamp_m, map, view, view->lamp_q8))
        return yb_error_set(error, "--lamp: the lamp is more than %d steps of %g m from the map",
                            FARTHEST_STEPS, yb_map_cell_m(map));
    if (!apply_water(options, map, view))
        return yb_error_set(error, "--water: %g m is too far from the map's heights",
                            options->water_m);
    if (!apply_contours(options, map, view, error))
        return false;
    view->palette = options->palette;
    view->haze_q8 = (int32_t)lround(options->haze * fmax(map->east_q8, map->north_q8));
    if (yb_view_options_given(options, YB_OPTION_EYE))
        return apply_eye(options, map, view, error);
    if (yb_view_options_given(options, YB_OPTION_WALK) ||
        yb_view_options_given(options, YB_OPTION_FLY))
        return apply_walk(options, map, view, error);
    if (yb_view_options_given(options, YB_OPTION_VIEW))
        yb_standard_view_set(view, map, (yb_standard_view_t)options->standard_view);
    else
        yb_view_orbit(view, map, bam(options->azimuth_deg), bam(options->elevation_deg),
                      (uint16_t)lround(options->distance * 256));
    return true;
}
