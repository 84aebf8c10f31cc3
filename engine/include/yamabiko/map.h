/* A code, as its bytes arrive, and the map that it becomes. yamabiko.h is the manual. */
#ifndef YAMABIKO_MAP_H
#define YAMABIKO_MAP_H

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

#ifdef __cplusplus
}
#endif

#endif
