/* How a map is looked at, and a frame of it, drawn band by band. yamabiko.h is the manual. */
#ifndef YAMABIKO_FRAME_H
#define YAMABIKO_FRAME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "yamabiko/map.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- The view --------------------------------------------------------------------------------- */

/* Whole degrees, 0 to 359, as a binary angle. */
#define YB_DEGREES(d) ((uint16_t)(((uint32_t)(d)*65536u + 180u) / 360u))

/* A water level below every map. */
#define YB_NO_WATER INT32_MIN

/* Intervals of contour lines beyond these are cut: a quarter of a step, 256 steps. */
#define YB_LEAST_CONTOUR_Q8 64
#define YB_MOST_CONTOUR_Q8 65535

/* Where the sun reaches the ground, or the water: a square grid of so many cells a side, 16, 32, 64
 * (the standard), 128 or 256, that covers 256 x 256 steps from the map's south-west corner. The
 * caller gives the memory; side 64 takes 512 bytes.
 */
typedef struct {
    uint16_t side;
    uint8_t *lit;           /* YB_SHADOW_BYTES(side): a bit a cell, rows from the south, the western
                             * cell in the lowest bit */
    uint16_t columns, rows; /* cells that are on the map: set by yb_shadow_cast */
} yb_shadow_t;
#define YB_SHADOW_BYTES(side) ((size_t)(side) * (side) / 8)
/* Working memory of yb_shadow_cast, in bytes; what lies there may be a yb_load_t at other times. */
#define YB_SHADOW_WORK(side) ((size_t)(side) * (side))

/* Colours of a screen that has them: 16 hues of the ground by height, each in 14 shades. */
typedef enum {
    YB_PALETTE_NATURAL,     /* woods, meadows, soil, rock, snow */
    YB_PALETTE_HYPSOMETRIC, /* an atlas: green, yellow, brown, white */
    YB_PALETTE_MONO,        /* one ink */
    YB_PALETTE_NIGHT        /* dim and blue */
} yb_palette_t;
#define YB_PALETTES 4

/* How a map is looked at. Lengths are in 1/256 step, heights above the base *after* exaggeration
 * for eye and look, before it for water. Any values give a correct frame: positions are clamped to
 * ±4096 steps, the zoom to 1024 or more (127 degrees), exaggeration to 8.
 */
typedef struct {
    int32_t eye_q8[3];
    int32_t look_q8[3];
    uint16_t azimuth_bam;   /* of the picture's upward direction when looking straight down */
    uint16_t zoom_q12;      /* focal length in frame widths: 4392 is 50 degrees across */
    uint16_t exaggerate_q8; /* vertical scale: 256 is true */
    uint16_t edge_q4;       /* split edges longer than this on the screen, in 1/16 pixel; 0: than
                             * about a sixteenth of the screen's width, and where the map is near
                             * some pixels more, most where it is rough. What is turned away is
                             * split less. */
    int16_t sun_q14[3];     /* unit vector towards the sun */
    bool lamp; /* instead of the sun a lamp shines from lamp_q8, placed as the eye is */
    int32_t lamp_q8[3];
    bool walls;                /* draw the block's sides, down to its base */
    int32_t water_q8;          /* water level, or YB_NO_WATER */
    const yb_shadow_t *shadow; /* cast by yb_shadow_cast, or NULL: nothing casts shadows */
    int32_t contour_q8;        /* interval of the lines drawn on the relief; 0: none */
    int32_t contour_at_q8;     /* the height of one of them */
    yb_palette_t palette;
    int32_t haze_q8;     /* distance from the eye at which haze begins, twice as far it is half
                          * of what is seen; 0: the air is clear */
    uint32_t max_leaves; /* at most so many leaves of the ground in a frame, or as many as the
                          * mesh has triangles; 0: no bound */
} yb_view_t;

/* The standard: 50 degrees across, true scale, edges up to about a sixteenth of the screen's width,
 * sun in the north-west 30 degrees high, walls, no water, no shadows, no lines, clear air, natural
 * colours, no bound; eye and look as by yb_view_orbit south of the map.
 */
void yb_view_init(yb_view_t *view, const yb_map_t *map);

/* Puts the eye on a sphere round the middle of the map's bounding box (exaggerated by the view's
 * scale). azimuth: clockwise from north, where the camera looks; elevation: of the eye above the
 * horizon, up to YB_DEGREES(90); distance in map widths, 8 fractional bits.
 */
void yb_view_orbit(yb_view_t *view, const yb_map_t *map, uint16_t azimuth_bam,
                   uint16_t elevation_bam, uint16_t distance_q8);

/* Puts the eye at a place, looking along an azimuth (clockwise from north), up or down by a tilt.
 * Above the frame it keeps `clearance` or more from the ground, or the water over it, as the view's
 * scale raises them; the frame itself draws any eye, also one in the rock.
 */
void yb_view_fly(yb_view_t *view, const yb_map_t *map, const int32_t eye_q8[3],
                 int32_t clearance_q8, uint16_t azimuth_bam, int16_t tilt_bam);

/* The same on foot: the eye is `height` above ground or water at a place of the frame. */
void yb_view_walk(yb_view_t *view, const yb_map_t *map, uint16_t x_q8, uint16_t y_q8,
                  int32_t height_q8, uint16_t azimuth_bam, int16_t tilt_bam);

/* Light from an azimuth (clockwise from north) and an elevation above the horizon. */
void yb_view_sun(yb_view_t *view, uint16_t azimuth_bam, uint16_t elevation_bam);

/* Casts the shadows of a map as a view's sun (not its lamp), vertical scale and water make them:
 * once, for all frames that share these. `work` has YB_SHADOW_WORK(shadow->side) bytes and is free
 * afterwards. A point is in shadow if the surface, refined to four cells, hides the sun; frames
 * blend from cell to cell. Cost: 64 cells a side take about 2.2 M instructions on a Cortex-M3
 * (scripts/bench instructions) and 1 KB of stack.
 */
void yb_shadow_cast(const yb_map_t *map, const yb_view_t *view, yb_shadow_t *shadow, uint8_t *work);

/* Sine and cosine of a binary angle, 14 fractional bits, within 1/8192 of the truth. */
int16_t yb_sin_q14(uint16_t angle_bam);
int16_t yb_cos_q14(uint16_t angle_bam);

/* --- The frame -------------------------------------------------------------------------------- */

typedef enum {
    YB_GREY4,  /* 16 greys, two pixels a byte, the left one in the high nibble */
    YB_RGB565, /* 16 bits, high byte first, as most panels take them; the lowest bit of green is set
                * in what is drawn and clear in the sky */
    YB_MONO    /* lit or not, eight pixels a byte, the leftmost in the highest bit: shades by
                * ordered dithering, four by four */
} yb_format_t;

typedef struct {
    uint16_t width, height; /* pixels, 1 to YB_MAX_SIDE; width even for YB_GREY4 */
    yb_format_t format;
} yb_screen_t;

/* Bytes of one row of pixels. */
static inline size_t yb_screen_pitch(const yb_screen_t *screen)
{
    size_t width = screen->width;
    return screen->format == YB_GREY4  ? width / 2
           : screen->format == YB_MONO ? (width + 7) / 8
                                       : width * 2;
}

/* Some rows of the screen, and where to draw them. While YB_MONO is drawn, its pixels are 16 greys
 * in memory of its own: the pixels may come to lie where that is, row by row, if their pitch is no
 * more than its.
 */
typedef struct {
    uint16_t y, rows; /* first row and how many; rows below the screen are left alone */
    uint8_t *pixels;  /* rows * pitch bytes, with colours at an even address */
    size_t pitch;     /* bytes from one row of pixels to the next */
    uint8_t *greys;   /* YB_MONO: rows * yb_band_row_bytes; else unused */
} yb_band_t;

/* Memory that a row of a band takes, in bytes. */
static inline size_t yb_band_row_bytes(const yb_screen_t *screen)
{
    return screen->format == YB_MONO ? (screen->width + 1u) / 2 : yb_screen_pitch(screen);
}

/* What a frame's bands have done so far: a triangle that meets three bands counts three times. */
typedef struct {
    uint32_t refined; /* triangles at the end of refinement */
    uint32_t drawn;   /* of those, front-facing (or on edge) and on the screen: rasterised */
} yb_stats_t;

#if YB_MAX_SIDE <= 512
typedef int16_t yb_side_t;
#else
typedef int32_t yb_side_t;
#endif

/* A place on the screen: 1/16 pixel, x to the right and y down, and 1/depth, 65535 at the near
 * distance. near 0: behind that, or a screen size or more beyond the screen. Private to the
 * renderer, like all that follows up to yb_frame_begin.
 */
typedef struct {
    yb_side_t x_q4, y_q4;
    uint16_t near;
    uint8_t out; /* on which sides it is out of the band: see refine.h */
} yb_spot_t;

/* A vertex on the screen, as yb_spot_t in fewer bytes; x_q4 of one without: see refine.h. */
typedef struct {
    yb_side_t x_q4, y_q4;
    uint16_t near;
} yb_seen_t;

/* A point of the surface, and where it is seen. */
typedef struct {
    uint32_t place; /* x_q8, and y_q8 in the upper half */
    uint32_t slope; /* gx_q11 + 2^15, and gy_q11 + 2^15 in the upper half */
    int32_t z_q8;   /* of the ground */
    int32_t top_q8; /* of what is drawn: the ground, or the water over it */
    yb_spot_t spot; /* of top_q8 */
} yb_point_t;

/* An edge of a triangle that is being refined: see refine.h. */
typedef uint32_t yb_edge_t;

/* A triangle that is being refined; edge i goes from corner i to the next. */
typedef struct {
    const yb_point_t *point[3];
    yb_edge_t edge[3];
    int32_t eye[3]; /* where the eye is: see order.h */
    int32_t bulge;  /* how far the smooth surface may be from its plane */
} yb_part_t;

/* What refinement has laid aside: a part of a triangle that is split, until it is taken up, and the
 * middle of an edge of that triangle, until no part needs it any more.
 */
typedef struct {
    yb_part_t rest; /* point[0] is NULL: none, or it was taken up */
    yb_point_t middle;
} yb_level_t;

/* What a band hands on of a base triangle to the next one: see kept.h. */
typedef struct {
    yb_edge_t edge[3];
    int32_t bulge;
} yb_kept_t;

/* Places on the stack, three for each halving. The upper ones are lent to what bands hand on: a
 * power of two of them, and the lower ones are left.
 */
#define YB_MAX_LEVELS (3 * YB_MAX_HALVINGS)
enum {
    YB_KEPT = YB_MAX_HALVINGS >= 9 ? 64 : YB_MAX_HALVINGS >= 5 ? 32 : 8,
    YB_KEPT_LEVELS = (YB_KEPT * sizeof(yb_kept_t) + sizeof(yb_level_t) - 1) / sizeof(yb_level_t),
    YB_LOWER_LEVELS = YB_MAX_LEVELS - YB_KEPT_LEVELS
};

/* A queue of them, round and round: what the band above has handed on lies from the first up to the
 * end, what this one hands on goes from there up to the next.
 */
typedef struct {
    int16_t row;              /* the first of the band that may take them, or -1 */
    uint8_t first, end, next; /* they wrap */
    uint8_t above, below;     /* the last bin of the band above, the first of the one below */
    bool full;                /* this band hands on no more */
} yb_queue_t;

/* Working memory of a frame. Only stats is for the caller to read. From yb_frame_begin on it is not
 * to be copied or moved. */
typedef struct {
    yb_stats_t stats;
    /* Bytes and small numbers first, then what is used most: the shortest instructions of small
     * processors reach no farther. */
    uint8_t eye_shift;
    uint8_t lift_shift;
    uint8_t row_shift;     /* rows are binned by so many bits: at most 16 bins */
    bool even_water;       /* nothing shades it: it need not be split */
    bool lines;            /* there may be any on the ground */
    bool smooth;           /* as the map's */
    uint8_t looks;         /* what there is besides the sun's light: see colour.h */
    uint8_t contour_shift; /* which leaves 16 bits of contour_inverse */
    int16_t lift;          /* pixels that one unit of height rises on the screen, by 1/depth */
    yb_screen_t screen;
    const yb_map_t *map;
    const uint16_t *noise; /* the map's, or NULL: it has no detail … */
    uint32_t salt;         /* … and what its seed adds to the places it is asked for */
    int32_t most_bend;     /* height times 1/depth that changes a point's depth by a 64th */
    int32_t near;          /* nothing nearer is drawn: view space, q8 >> eye_shift */
    int32_t near_scaled;   /* near as 15 bits: shifted left by 10 … */
    int32_t near_shift;    /* … and then right by so many */
    int32_t focal_q4;      /* pixels */
    /* From the map to the view: rows right, up and depth, Q14. Places are taken relative to the
     * eye and shifted right by eye_shift, which gives them 16 bits. */
    int32_t right_x, right_y, up_x, up_y, up_z, depth_x, depth_y, depth_z;
    uint32_t longest; /* an edge is split while length * 1/depth is above it */
    int32_t thin_q4;  /* a sliver is thinner than this: an edge */
    int32_t along_x, along_y, across_x, across_y; /* foreshortening of plan lengths, Q13 */
    int32_t haze_near, haze_q16;                  /* 1/depth where haze begins; 256 over that */
    int32_t tone_q16;                             /* hues per height unit */
    uint32_t contour_inverse; /* 2^32 over the interval of contour lines, 0: none, … */
    uint32_t contour_zero;    /* … and what a height has added when multiplied by that */
    uint32_t contour_few;     /* two thirds of the interval */
    int32_t base_q8;          /* where the walls end */
    int32_t sway_x_q4; /* farthest that one unit of height moves a point on the screen, … */
    int32_t sway_y_q4; /* … by 1/depth: see refine.c */
    int32_t spare_q4;  /* what rounding in view space does at the near distance */
    int32_t eye_x_q6, eye_y_q6; /* what triangles are ordered by */
    yb_view_t view;
    uint8_t order_for;    /* which rows: see order.c */
    uint8_t open_turn;    /* what counts of how far a triangle is turned to the eye */
    bool binned;          /* bins are found: a band of all rows needs none */
    yb_triangle_t *order; /* of the base triangles: behind what is seen */
    uint8_t *bins; /* of a base triangle: first and last bin, a nibble each; behind the order */
    uint8_t *open; /* of a base triangle: how far it is turned to the eye (order.h); behind bins */
    uint8_t rim[(YB_MAX_TRIANGLES + 7) / 8]; /* has it an edge on the frame? A bit each. */
    yb_point_t root[3];
    yb_queue_t queue;
    yb_level_t *room; /* as far up as this, what is on the stack leaves what is kept alone */
    union {
        yb_level_t level[YB_MAX_LEVELS];
        struct {
            yb_level_t lower[YB_LOWER_LEVELS];
            yb_kept_t kept[YB_KEPT];
        };
    };
    /* Last, for yb_frame_place: of a map's vertices, and right behind them of its triangles. */
    yb_seen_t seen[YB_MAX_VERTICES];
    yb_triangle_t order_memory[YB_MAX_TRIANGLES];
    uint8_t bin_memory[YB_MAX_TRIANGLES];
    uint8_t open_memory[YB_MAX_TRIANGLES];
} yb_frame_t;

/* One piece of memory for all: `bytes` bytes, a loaded map at the beginning. In what that does not
 * need this places a frame of it, and a band from the screen's top with as many rows as there is
 * room for: the fewer vertices a map has, the taller the band and the faster the frame. A map of
 * 100 vertices takes 6.6 KB with its frame, each vertex more or less 40 bytes. Its triangles are
 * moved (yb_map_triangle); the frame is shorter than its type, and not to be copied. The caller may
 * lower band->rows. NULL: there is not room for one row, as there always is in sizeof(yb_map_t) +
 * sizeof(yb_frame_t), two pointers, and yb_band_row_bytes. Frame and band are the caller's until
 * another map is loaded here.
 */
yb_frame_t *yb_frame_place(yb_map_t *map, size_t bytes, const yb_screen_t *screen, yb_band_t *band);

/* Rows of the band from row y down, where there is memory for `most`: the first band takes what is
 * left over, for there is mostly sky, and all below are as tall as they can be. y is on the screen,
 * and `most` is not 0.
 */
static inline uint16_t yb_band_rows(const yb_screen_t *screen, uint16_t y, uint16_t most)
{
    return (uint16_t)((screen->height - 1u - y) % most + 1u);
}

/* Prepares a frame: turns every vertex into the view once and finds the rows of each triangle.
 * map must stay as it is until the last band is drawn. Never fails.
 */
void yb_frame_begin(yb_frame_t *frame, const yb_map_t *map, const yb_view_t *view,
                    const yb_screen_t *screen);

/* Draws some rows, background included. Bands may come in any order and height, again and again:
 * a row's pixels are always the same. Never fails.
 */
void yb_frame_band(yb_frame_t *frame, const yb_band_t *band);

/* Hands out each triangle of the ground that the whole frame draws, as it is drawn: refined, facing
 * the eye, on the screen. z of a corner is the water's where that is above the ground, slopes are
 * the smooth surface's. frame->stats stay as they are.
 */
void yb_frame_triangles(yb_frame_t *frame, yb_triangle_fn fn, void *context);

#ifdef __cplusplus
}
#endif

#endif
