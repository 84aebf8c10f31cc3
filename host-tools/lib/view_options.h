/* The view options of the command line, shared by every verb that draws, and what they mean in the
 * engine's units. Each value is rounded once, here.
 *
 *     static const struct option options[] = {{"output", required_argument, NULL, 'o'},
 *                                             YB_VIEW_LONG_OPTIONS, {0}};
 *     yb_view_options_t view_options = yb_view_options_default();
 *     while ((answer = getopt_long(argc, argv, ":o:", options, NULL)) != -1)
 *         if (yb_view_options_owns(answer)) {
 *             if (!yb_view_options_take(&view_options, answer, argc, argv, &error))
 *                 return cli_usage("%s", error.text);
 *         } else …
 *     if (!yb_view_options_check(&view_options, &error))
 *         return cli_usage("%s", error.text);
 *     …
 *     if (!yb_view_options_apply(&view_options, &map, &view, &error))
 *         return cli_fail("%s", error.text);
 *
 * Rounding. Lengths in metres: to the nearest 1/256 step, north-south alike; heights of eye and
 * look are taken from the map's base, scaled like the relief, then rounded. Angles: to the nearest
 * of 65536 binary angles. zoom_q12 = round(4096 / (2 tan(fov / 2))). Distance in map widths, scale:
 * to the nearest 1/256. Edge length: to the nearest 1/16 pixel.
 */
#ifndef YB_VIEW_OPTIONS_H
#define YB_VIEW_OPTIONS_H

#include <getopt.h>

#include <yamabiko/yamabiko.h>

#include "error.h"

/* What getopt_long answers for the options below. */
enum {
    YB_OPTION_SIZE = 0x1000,
    YB_OPTION_FORMAT,
    YB_OPTION_BAND,
    YB_OPTION_VIEW,
    YB_OPTION_EYE,
    YB_OPTION_LOOK,
    YB_OPTION_WALK,
    YB_OPTION_FLY,
    YB_OPTION_HEIGHT,
    YB_OPTION_TILT,
    YB_OPTION_AZIMUTH,
    YB_OPTION_ELEVATION,
    YB_OPTION_DISTANCE,
    YB_OPTION_FOV,
    YB_OPTION_SUN,
    YB_OPTION_LAMP,
    YB_OPTION_WATER,
    YB_OPTION_PALETTE,
    YB_OPTION_CONTOURS,
    YB_OPTION_HAZE,
    YB_OPTION_SHADOWS,
    YB_OPTION_EXAGGERATE,
    YB_OPTION_WALLS,
    YB_OPTION_EDGE,
    YB_OPTION_MAX_LEAVES,
    YB_OPTION_NO_DETAIL,
    YB_OPTION_VIEW_END
};

/* clang-format off */
#define YB_VIEW_LONG_OPTIONS                                            \
    {"size", required_argument, NULL, YB_OPTION_SIZE},                  \
    {"format", required_argument, NULL, YB_OPTION_FORMAT},              \
    {"band", required_argument, NULL, YB_OPTION_BAND},                  \
    {"view", required_argument, NULL, YB_OPTION_VIEW},                  \
    {"eye", required_argument, NULL, YB_OPTION_EYE},                    \
    {"look", required_argument, NULL, YB_OPTION_LOOK},                  \
    {"walk", required_argument, NULL, YB_OPTION_WALK},                  \
    {"fly", required_argument, NULL, YB_OPTION_FLY},                    \
    {"height", required_argument, NULL, YB_OPTION_HEIGHT},              \
    {"tilt", required_argument, NULL, YB_OPTION_TILT},                  \
    {"azimuth", required_argument, NULL, YB_OPTION_AZIMUTH},            \
    {"elevation", required_argument, NULL, YB_OPTION_ELEVATION},        \
    {"distance", required_argument, NULL, YB_OPTION_DISTANCE},          \
    {"fov", required_argument, NULL, YB_OPTION_FOV},                    \
    {"sun", required_argument, NULL, YB_OPTION_SUN},                    \
    {"lamp", required_argument, NULL, YB_OPTION_LAMP},                  \
    {"water", required_argument, NULL, YB_OPTION_WATER},                \
    {"palette", required_argument, NULL, YB_OPTION_PALETTE},            \
    {"contours", required_argument, NULL, YB_OPTION_CONTOURS},          \
    {"haze", required_argument, NULL, YB_OPTION_HAZE},                  \
    {"shadows", required_argument, NULL, YB_OPTION_SHADOWS},            \
    {"exaggerate", required_argument, NULL, YB_OPTION_EXAGGERATE},      \
    {"walls", required_argument, NULL, YB_OPTION_WALLS},                \
    {"edge", required_argument, NULL, YB_OPTION_EDGE},                  \
    {"max-leaves", required_argument, NULL, YB_OPTION_MAX_LEAVES},      \
    {"no-detail", no_argument, NULL, YB_OPTION_NO_DETAIL}
/* clang-format on */

/* Of every yb_format_t and yb_palette_t; each ends with NULL. */
extern const char *const yb_format_names[];
extern const char *const yb_palette_names[];

/* The lines of --help that describe them. */
extern const char yb_view_options_help[];

/* Which options were given, by 1u << (option - YB_OPTION_SIZE). */
typedef struct {
    uint32_t given;
    yb_screen_t screen;
    uint16_t band_rows;         /* 0: all at once */
    int standard_view;          /* a yb_standard_view_t, if --view was given */
    double eye_m[3], look_m[3]; /* eye: of --walk and --fly too */
    double height_m;            /* above the ground */
    double tilt_deg;
    double azimuth_deg, elevation_deg, distance; /* map widths */
    double fov_deg;
    double sun_deg[2]; /* azimuth, elevation */
    double lamp_m[3];
    double water_m;
    yb_palette_t palette;
    double contours_m; /* 0: none */
    double haze;       /* map widths; 0: none */
    long shadows;      /* cells along a side of the grid; 0: none */
    double exaggerate;
    double edge_px; /* 0: as yb_view_init */
    long max_leaves;
    bool walls;
    bool detail;
} yb_view_options_t;

/* 640 x 480 in RGB565, azimuth 45, elevation 30, distance 1.2, edges up to 6 pixels, the rest as by
 * yb_view_init.
 */
yb_view_options_t yb_view_options_default(void);

bool yb_view_options_owns(int option);

/* How many values an option takes: 1 also for those of others and for those without any. */
int yb_view_options_values(int option);

bool yb_view_options_given(const yb_view_options_t *options, int option);

/* The name of the option that was given to say where the eye is, but for --azimuth, --elevation and
 * --distance, or NULL.
 */
const char *yb_view_options_placed(const yb_view_options_t *options);

/* The name of an option that was given and says how a picture looks, not what is seen: --format,
 * --band, --palette, --contours, --shadows, --haze, --sun, --lamp; or NULL.
 */
const char *yb_view_options_look(const yb_view_options_t *options);

/* Takes the option that getopt_long has just answered, its value from optarg and, where it has two
 * or three, from argv[optind …]. False with a sentence for a wrong value.
 */
bool yb_view_options_take(yb_view_options_t *options, int option, int argc, char **argv,
                          yb_error_t *error);

/* After the last option: false with a sentence if two of them contradict each other. */
bool yb_view_options_check(const yb_view_options_t *options, yb_error_t *error);

/* For what a device with this screen shows: by its standard, unless the options say otherwise. */
void yb_view_options_panel(yb_view_options_t *options, const yb_screen_t *screen);

/* The view on this map, in the engine's units; map->detail is set as well. False if a place or a
 * level lies too far from the map.
 */
bool yb_view_options_apply(const yb_view_options_t *options, yb_map_t *map, yb_view_t *view,
                           yb_error_t *error);

#endif
