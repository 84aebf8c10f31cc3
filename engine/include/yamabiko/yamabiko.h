/* Yamabiko: a whole mountain coded in about a hundred bytes, rebuilt and drawn in 3-D.
 *
 *     code ──► contours ──► mesh ──► (refined on the fly) ──► pixels, band by band
 *
 * What it is. A *code* is one map: the feature points of its contour lines, their heights and one
 * fractal dimension (docs/SPEC.md). The engine decodes it as its bytes arrive, triangulates the
 * contours, and draws the surface from any eye: every edge that looks long on the screen is split
 * at its midpoint, which a smooth bulge and a place-keyed noise lift or lower.
 *
 * Coordinates. x east, y north, z up, right-handed. Plan positions are 8.8 fixed point in steps of
 * the map's lattice (1 step = cell_m metres), heights are signed, in 1/256 step, above the code's
 * base. A name ending in _q8 has 8 fractional bits, _q12 has 12; _bam is an angle of which 65536
 * make a full turn.
 *
 * Memory. The engine allocates nothing, keeps no globals, never recurses and uses no floating
 * point. The caller places three structs:
 *   yb_map_t    the mesh: as long as the map is used              (6.9 KB with 255 vertices)
 *   yb_load_t   working memory of decoding: until YB_OK           (3.2 KB)
 *   yb_frame_t  working memory of drawing: one frame at a time    (5.5 KB)
 * A yb_load_t and a yb_frame_t are never needed at once: a union of both saves RAM. What a map
 * leaves of its own makes bands taller: yb_frame_place.
 *
 * Threads. Calls on different structs are independent; a loaded map is only read by the frames, but
 * for a map that yb_frame_place has packed: that belongs to its one frame.
 *
 * Trust. Code bytes may be hostile: any byte string ends in YB_OK or an error, in bounded time
 * (about n² steps for n vertices) and in the memory above. Struct contents are trusted.
 *
 * Example (tests/unit/test_example.c compiles it):
 *
 *     static yb_map_t map;
 *     static union { yb_load_t load; yb_frame_t frame; } work;
 *     static uint8_t pixels[64 * 8];
 *
 *     if (yb_map_load(&map, &work.load, code, code_bytes) != YB_OK)
 *         return;
 *     yb_view_t view;
 *     yb_screen_t screen = {.width = 128, .height = 64, .format = YB_GREY4};
 *     yb_view_init(&view, &map);
 *     yb_view_orbit(&view, &map, YB_DEGREES(45), YB_DEGREES(30), 307);
 *     yb_frame_begin(&work.frame, &map, &view, &screen);
 *     yb_band_t band = {.rows = 8, .pixels = pixels, .pitch = 64};
 *     for (band.y = 0; band.y < 64; band.y = (uint16_t)(band.y + 8)) {
 *         yb_frame_band(&work.frame, &band);
 *         send_to_panel(band.y, pixels);
 *     }
 */
#ifndef YAMABIKO_YAMABIKO_H
#define YAMABIKO_YAMABIKO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "yamabiko/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- Versions --------------------------------------------------------------------------------- */

#define YB_VERSION_MAJOR 0
#define YB_VERSION_MINOR 1
#define YB_VERSION_PATCH 0
/* The one version of the format (bytes and reconstruction) that this engine reads. */
#define YB_FORMAT_VERSION 2

/* How the relief is coded: the low nibble of the first byte. */
typedef enum {
    YB_PAPER,  /* as in the paper of 1985, plain bits */
    YB_COMPACT /* the same contours in about half as many */
} yb_profile_t;

/* Sections that may follow the relief (docs/SPEC.md 1.4). */
enum {
    YB_SECTION_CERTIFICATE = 1,
    YB_SECTION_PLACE = 2,
    YB_SECTION_NAME = 3
};

/* --- Limits ----------------------------------------------------------------------------------- */

/* Of n vertices at least four lie on the frame: they make at most 2n - 6 triangles. */
#define YB_MAX_TRIANGLES (2 * YB_MAX_VERTICES - 6)
/* Contours of a map, summits among them. A code has at most 255. */
#define YB_MAX_CONTOURS YB_MAX_VERTICES
/* Regions of a map: one more than lines, which have two points or more. */
#define YB_MAX_REGIONS (YB_MAX_VERTICES / 2 + 1)
/* Longest legal code of the paper profile, in bytes: 255 summits. */
#define YB_MAX_CODE_BYTES 1299
/* |height| of a decoded vertex: 512 steps, twice the width of the map. */
#define YB_MAX_HEIGHT_Q8 131072
/* |slope| of a vertex: 4, about 76 degrees. */
#define YB_MAX_SLOPE_Q11 8192

/* --- Status ----------------------------------------------------------------------------------- */

typedef enum {
    YB_OK = 0,             /* done */
    YB_MORE = 1,           /* the code goes on: feed the next bytes */
    YB_ERR_TRUNCATED = -1, /* the code ends before its last byte */
    YB_ERR_CORRUPT = -2,   /* the check fails, or the contours cross, touch or repeat a point */
    YB_ERR_VERSION = -3,   /* another format version or profile than this engine reads */
    YB_ERR_LIMIT = -4      /* the mesh has more vertices than the build, or the code, allows */
} yb_status_t;

#if defined(__GNUC__)
#define YB_MUST_CHECK __attribute__((warn_unused_result))
#else
#define YB_MUST_CHECK
#endif

/* A short English word for a status, for logs. Never NULL. */
const char *yb_status_text(yb_status_t status);

/* --- The map ---------------------------------------------------------------------------------- */

/* Numbers of vertices, contours and regions; of triangles; what lies across a triangle's three
 * edges, three numbers of triangles with a mark each.
 */
#if YB_MAX_VERTICES <= 255
typedef uint8_t yb_index_t;
typedef uint16_t yb_triangle_t;
typedef uint32_t yb_across_t;
#else
typedef uint16_t yb_index_t;
typedef uint32_t yb_triangle_t;
typedef uint64_t yb_across_t;
#endif

typedef struct {
    uint16_t x_q8, y_q8; /* plan position: a multiple of 32, an eighth of a step */
    int32_t z_q8;        /* height above the base */
    int16_t gx_q11;      /* slope of the smooth surface towards the east, ±YB_MAX_SLOPE_Q11 */
    int16_t gy_q11;      /* and towards the north */
} yb_vertex_t;

/* A length class: plan lengths within less than a third of an octave may share one. */
#define YB_LENGTH_CLASSES 64

/* A map after YB_OK. Read it freely; only the yb_map_ calls write it, and yb_frame_place.
 * Vertices: first the contours' points in code order, then those corners that no contour has, then
 * those that the rules added (yb_vertex_rule).
 * Triangles: counter-clockwise seen from above; they tile the frame without gap or overlap.
 */
typedef struct {
    uint16_t vertex_count;
    yb_triangle_t triangle_count;
    uint16_t east_q8;  /* x of the frame's eastern side; the western one is 0 */
    uint16_t north_q8; /* y of the frame's northern side */
    int32_t low_q8;    /* height of the lowest vertex */
    int32_t high_q8;   /* height of the highest vertex */
    int32_t stray_q8;  /* farthest that refinement moves any point */
    uint16_t cell;     /* metres per step, as coded: see yb_unit_ratio */
    uint16_t unit;     /* metres per unit of coded height, as coded */
    int16_t base_m;    /* metres above the datum of z = 0 */
    uint8_t seed;
    uint8_t certified_error; /* of heights; 0: nobody says, else see yb_certified_error_m */
    uint8_t certified_k;     /* similarity K of the lines in 1/255, if certified_error is not 0 */
    uint8_t hurst_q8m1;      /* (H in 1/256) - 1: 0 is H = 1/256, 255 is H = 1 */
    bool smooth;             /* midpoints follow the slopes of the ends */
    bool detail;             /* midpoints move by noise; clear it to get the smooth part alone */
    bool packed;             /* by yb_frame_place: read triangles by yb_map_triangle */
    /* Per length class: the noise's scale (q8 height for one unit of the hash sum is scale/2^9),
     * and the farthest that refinement may move a point of an edge of the class, or shorter. */
    uint16_t noise[YB_LENGTH_CLASSES];
    uint16_t reach_q8[YB_LENGTH_CLASSES];
    yb_vertex_t vertex[YB_MAX_VERTICES];
    yb_across_t across[YB_MAX_TRIANGLES]; /* what lies beside each: private */
    yb_index_t triangle[YB_MAX_TRIANGLES][3];
} yb_map_t;

/* A packed map has its triangles right behind its last vertex, for then all that it needs is in one
 * piece: first what lies across them, then their corners. So many bytes from its beginning they
 * begin.
 */
static inline size_t yb_map_packed_at(const yb_map_t *map)
{
    const size_t first = offsetof(yb_map_t, vertex);
    const size_t each = sizeof *map->vertex;
    const size_t end = first + map->vertex_count * each;
    const size_t to = sizeof(yb_across_t);
    return first % to == 0 && each % to == 0 ? end : (end + to - 1) / to * to;
}

static inline const yb_across_t *yb_map_across(const yb_map_t *map)
{
    const void *packed = (const uint8_t *)map + yb_map_packed_at(map);
    return map->packed ? (const yb_across_t *)packed : map->across;
}

/* The three corners of a triangle. */
static inline const yb_index_t *yb_map_triangle(const yb_map_t *map, yb_triangle_t triangle)
{
    const void *packed = yb_map_across(map) + map->triangle_count;
    const yb_index_t *first = map->packed ? (const yb_index_t *)packed : map->triangle[0];
    return first + 3 * (size_t)triangle;
}

/* One contour of a code, as decoded. */
typedef struct {
    yb_index_t first; /* index of its first vertex */
    yb_index_t count; /* points: 1 is a summit (or any spot height) */
    yb_index_t left;  /* region on its left side, in the direction of its points */
    yb_index_t right; /* region on its right side; equal to left for a spot height */
} yb_contour_t;

/* Do its ends lie on the frame? Other points of contours never do. */
static inline bool yb_contour_is_open(const yb_map_t *map, const yb_contour_t *contour)
{
    const yb_vertex_t *first = &map->vertex[contour->first];
    return first->x_q8 == 0 || first->y_q8 == 0 || first->x_q8 == map->east_q8 ||
           first->y_q8 == map->north_q8;
}

/* A step from point to point: its greater difference n, and where on the square of that radius it
 * ends, 0 … 8n - 1, counter-clockwise from the east. Private to the compact profile.
 */
typedef struct {
    int length, place;
} yb_ring_t;

/* A point of a skeleton, as large as a contour. Private to loading. */
typedef struct {
    yb_index_t parent; /* the point it was reached from */
    yb_index_t other;  /* the second such point, where two branches meet; else itself */
    yb_index_t end;    /* the meeting point at its farthest end; itself: that is a dead end */
    yb_index_t grown;  /* have the bridges that it looks at been split? */
} yb_branch_t;

/* What one stage of loading alone needs; each fills it in before it reads it. Private to loading.
 */
typedef union {
    uint16_t model[128];                   /* compact.c: what it has learned */
    yb_triangle_t root[YB_MAX_TRIANGLES];  /* regions.c: union-find */
    struct {                               /* summits.c */
        yb_index_t flat[YB_MAX_REGIONS];   /* is a region of one height? */
        yb_index_t beside[YB_MAX_REGIONS]; /* a region that it shares a line with */
    };
    struct { /* links.c, saddles.c */
        /* of a point, the peak that it is to be linked with; of a peak, its line or one joined to
         * that */
        yb_index_t partner[YB_MAX_VERTICES];
        yb_index_t way_to[YB_MAX_REGIONS]; /* the line that leads to a region */
    };
    /* skeleton.c: from a branch's beginning to a point; later, to its farthest end */
    uint32_t way[YB_MAX_VERTICES];
} yb_scratch_t;

/* Working memory of decoding. contour[0 .. contour_count) and region_count stay valid after YB_OK
 * for those who want to know how the map is built; all else is private.
 */
typedef struct {
    uint16_t contour_count;
    uint16_t region_count;
    uint16_t all_contours;   /* contour[contour_count ..] up to here are summits that were added */
    uint16_t first_summit;   /* vertices from here on are summits that were added … */
    uint16_t first_saddle;   /* … from here on link points … */
    uint16_t first_skeleton; /* … and from here on points of skeletons */
    uint16_t relief_size;    /* bytes of the code before its sections, or its check byte */
    uint8_t profile;
    /* private: the decoder. Bytes first, then the smaller numbers: the shortest instructions of
     * small processors reach no farther. */
    uint8_t part, crc, section;
    uint8_t state, element, classes;
    uint8_t spacing, interval, columns, rows;
    uint8_t sector, turn_context, length_context, corner_at, gain;
    bool open, narrow;
    uint16_t at; /* how far the state has come; the element's model */
    uint16_t value, recent, lines, spots, run;
    uint16_t point_count;
    uint16_t vertex_count; /* the map's, once it is complete */
    uint16_t vertices_promised;
    uint16_t section_at, section_size, size;
    yb_status_t result;
    yb_map_t *map;         /* what is loaded, … */
    yb_vertex_t *vertex;   /* … its vertices, … */
    yb_across_t *across;   /* … what lies across its triangles' edges, … */
    yb_index_t *corners;   /* … and their corners, three a triangle in a row */
    yb_scratch_t *scratch; /* scratch_memory: short instructions do not reach that either */
    union {
        struct { /* compact.c */
            uint32_t range, code;
            int x, y;
            int number; /* the length of a step, or a height before its sign */
            int32_t base;
            union {
                struct { /* while lines come */
                    int start_x, start_y, start_way;
                    yb_ring_t last; /* step */
                };
                int32_t places_left; /* while spot heights do */
            };
        };
        struct { /* paper.c */
            uint32_t bits, flags;
            int bits_held;
        };
        struct {              /* links.c, saddles.c */
            int32_t level_q8; /* of lines with passes between them, … */
            int32_t other_q8; /* … and what those go down to */
            int here;         /* the region whose rules are applied */
        };
    };
    /* private: what both find */
    int32_t frame_height;
    int32_t corner_height[4];
    yb_index_t corner[4]; /* the frame's corners, counter-clockwise from the south-west */
    /* A contour has a vertex of its own with a number no smaller, and a skeleton's points come
     * after all others: contours and, from first_skeleton on, these points never want the same
     * place. */
    union {
        yb_contour_t contour[YB_MAX_CONTOURS];
        yb_branch_t branch[YB_MAX_VERTICES];
    };
    /* private: the triangulation */
    yb_index_t region[YB_MAX_TRIANGLES];
    yb_triangle_t star[YB_MAX_VERTICES]; /* one of the triangles that meet at a vertex */
    yb_scratch_t scratch_memory;         /* private */
} yb_load_t;

/* Why a point or an edge of the mesh is there (docs/SPEC.md 2). */
typedef enum {
    YB_RULE_NONE,    /* an edge that completes the triangulation */
    YB_RULE_CONTOUR, /* coded: a point, or a segment of a line; the frame's corners too */
    YB_RULE_SUMMIT,  /* the summit of a region that has none; an edge from a summit to its line */
    YB_RULE_SADDLE,  /* between two peaks; an edge to the lines it joins */
    YB_RULE_SLOPE,   /* an edge down the slope, from line to line */
    YB_RULE_SKELETON /* along the middle of a valley or a ridge */
} yb_rule_t;

/* For those who want to look; load must be as yb_map_feed or yb_map_build left it. */
yb_rule_t yb_vertex_rule(const yb_load_t *load, yb_index_t vertex);

/* Of the edge from corner `edge` of a triangle to the next one. */
yb_rule_t yb_edge_rule(const yb_map_t *map, const yb_load_t *load, yb_triangle_t triangle,
                       int edge);

/* Starts a code. Both structs may hold anything before; map is undefined until YB_OK. */
void yb_map_begin(yb_map_t *map, yb_load_t *load);

/* Feeds the next `count` bytes of the code, in pieces of any size; they are borrowed for the call
 * only. YB_MORE: go on. YB_OK: the map is ready and `load` may be used for something else. An
 * error, or bytes after the end (YB_ERR_CORRUPT), is final: later calls answer the same.
 * Cost: a hundred-byte code takes about 2.4 M instructions on a Cortex-M3, 251 scattered summits
 * 4.6 M (scripts/bench instructions), nearly all of it in the call that feeds the last byte.
 */
YB_MUST_CHECK yb_status_t yb_map_feed(yb_map_t *map, yb_load_t *load, const uint8_t *bytes,
                                      size_t count);

/* Says that no byte will follow: YB_OK if the code was complete, else what was wrong with it,
 * YB_ERR_TRUNCATED if nothing else was.
 */
YB_MUST_CHECK yb_status_t yb_map_end(yb_map_t *map, yb_load_t *load);

/* Builds a map from contours that lie in no code, in full detail: for a build with a large
 * YB_MAX_VERTICES. After yb_map_begin the caller sets
 *
 *     map:  east_q8, north_q8, cell, unit, base_m, hurst_q8m1, smooth, seed; vertex[0 .. N): the
 *           contours' points with x_q8 and y_q8 multiples of 16 (1/16 step) and z_q8
 *     load: contour_count, point_count = N; contour[0 .. contour_count): first, count; gain;
 *           corner_height[4] (SW SE NE NW; left alone: from the lines that meet the frame) and
 *           frame_height (where none does)
 *
 * by the rules of docs/SPEC.md 1.5. YB_OK, YB_ERR_CORRUPT: lines cross or touch, YB_ERR_LIMIT: the
 * mesh would have more than YB_MAX_VERTICES.
 */
YB_MUST_CHECK yb_status_t yb_map_build(yb_map_t *map, yb_load_t *load);

/* All three at once, for a code that lies in one piece. */
YB_MUST_CHECK yb_status_t yb_map_load(yb_map_t *map, yb_load_t *load, const uint8_t *bytes,
                                      size_t count);

/* Height of the reference surface (all edges longer than a step split) at a place of the frame;
 * places outside are moved to its nearest side. It looks at every base triangle once, then goes
 * down one level per halving.
 */
int32_t yb_map_height(const yb_map_t *map, uint16_t x_q8, uint16_t y_q8);

/* The reference surface's longest edge: one step. */
#define YB_REFERENCE_Q8 256

/* Called once per triangle of a refined surface; corners counter-clockwise, valid for the call. */
typedef void (*yb_triangle_fn)(void *context, const yb_vertex_t *a, const yb_vertex_t *b,
                               const yb_vertex_t *c);

/* Refines one base triangle until no edge is longer than longest_q8 in plan and hands out what it
 * became. All triangles of a map, refined to one length, fit together without cracks.
 * YB_REFERENCE_Q8 gives the reference surface, 65535 the base triangle itself.
 */
void yb_map_refine(const yb_map_t *map, yb_triangle_t triangle, uint16_t longest_q8,
                   yb_triangle_fn fn, void *context);

/* A coded unit (12 bits of mantissa, 4 of exponent) in 1/64 m: mantissa << exponent. */
static inline uint32_t yb_unit_64th_m(uint16_t coded)
{
    return (uint32_t)(coded & 0xfff) << (coded >> 12);
}

/* What a map's certificate promises (docs/SPEC.md 1.4): nine tenths of all heights lie within so
 * many metres of the truth, rounded up, 1 to 15025; 0: it has none. For "±22 m" on a display.
 */
uint16_t yb_certified_error_m(uint8_t certified_error);

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
                             * up to 7 pixels more. What is turned away is split less. */
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
    uint32_t refined;       /* triangles at the end of refinement */
    uint32_t drawn;         /* of those, front-facing and on the screen: handed to the rasteriser */
    uint32_t depth_limited; /* left unsplit for want of YB_MAX_LEVELS */
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

/* A vertex on the screen, as yb_spot_t in fewer bytes. */
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
    uint8_t *open; /* of a base triangle: how far it is turned to the eye; behind the bins */
    uint8_t rim[(YB_MAX_TRIANGLES + 7) / 8]; /* has it an edge on the frame? A bit each. */
    yb_point_t root[3];
    yb_level_t level[YB_MAX_LEVELS];
    /* Last, for yb_frame_place: of a map's vertices, and right behind them of its triangles. */
    yb_seen_t seen[YB_MAX_VERTICES];
    yb_triangle_t order_memory[YB_MAX_TRIANGLES];
    uint8_t bin_memory[YB_MAX_TRIANGLES];
    uint8_t open_memory[YB_MAX_TRIANGLES];
} yb_frame_t;

/* One piece of memory for all: `bytes` bytes, a loaded map at the beginning. In what that does not
 * need this places a frame of it, and a band from the screen's top with as many rows as there is
 * room for: the fewer vertices a map has, the taller the band and the faster the frame. A map of
 * 100 vertices takes 6.7 KB with its frame, each vertex more or less 40 bytes. Its triangles are
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
