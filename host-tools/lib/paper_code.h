/* What a code of the paper profile says (docs/SPEC.md, section 1), before it is bytes.
 *
 * Points lie in lattice steps, x to the east and y to the north, one contour after the other as in
 * the code. The struct is flat and small, so that a search can copy it.
 */
#ifndef YB_PAPER_CODE_H
#define YB_PAPER_CODE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <yamabiko/yamabiko.h>

#include "code_file.h"
#include "sections.h"

enum {
    YB_PAPER_CONTOURS = 255,
    YB_PAPER_POINTS = 1023,
    YB_CORNERS = 4,
    YB_PAPER_MOST_BYTES = 4096
};

typedef struct {
    uint8_t x, y;
} yb_step_t;

typedef struct {
    uint16_t height; /* in units above the base */
    uint16_t count;  /* points; 1 is a spot height */
    bool open;       /* from frame to frame */
} yb_paper_contour_t;

typedef struct {
    uint8_t east, north; /* size of the frame in steps, 1 to 255 */
    uint8_t shift;       /* differences are multiples of 2^shift; 0 to 3 */
    uint16_t cell;       /* metres per step, as coded: yb_paper_unit */
    uint16_t unit;       /* metres per unit of height, as coded */
    int16_t base_m;
    yb_profile_t profile;
    uint8_t spacing;      /* compact: all points are multiples of it */
    uint8_t interval;     /* compact: heights of lines are multiples of 2^interval units */
    uint8_t vertex_class; /* compact: if vertices is 0 */
    int base;             /* compact: in units, instead of base_m */
    uint8_t seed;
    uint8_t gain;      /* 32 is what the contours themselves suggest */
    uint8_t dimension; /* D = 1 + dimension/256 */
    bool straight;     /* no smoothing */
    uint8_t corners;   /* coded corner heights: bit 0 SW, 1 SE, 2 NE, 3 NW; 0: one for the frame */
    uint16_t corner[YB_CORNERS];
    uint16_t frame; /* its height if no corner is coded */
    int vertices;   /* of the mesh, which only the engine can count; 0: not known yet */
    /* compact: what follows the relief, borrowed; NULL: nothing */
    const yb_sections_t *sections;
    int contour_count;
    int point_count;
    yb_paper_contour_t contour[YB_PAPER_CONTOURS];
    yb_step_t point[YB_PAPER_POINTS];
} yb_paper_t;

/* Metres as the header codes them, rounded to the nearest of about 4000 steps an octave, and back.
 * Beyond the range (1/64 m to 2 million m) the nearest end.
 */
uint16_t yb_paper_unit(double metres);
double yb_paper_metres(uint16_t coded);

/* The height in units nearest to height_m. */
uint16_t yb_paper_height(const yb_paper_t *paper, double height_m);

/* The same for a line: a multiple of the interval. */
uint16_t yb_paper_line_height(const yb_paper_t *paper, double height_m);

/* What the bits of a code are spent on. */
typedef enum {
    YB_BITS_HEADER,  /* scale, lattice, base, roughness */
    YB_BITS_FRAME,   /* heights of corners */
    YB_BITS_STARTS,  /* where lines begin, and how many there are */
    YB_BITS_HEIGHTS, /* of lines */
    YB_BITS_LENGTHS, /* of steps, and where lines end */
    YB_BITS_TURNS,   /* of steps */
    YB_BITS_SPOT_PLACES,
    YB_BITS_SPOT_HEIGHTS,
    YB_BITS_KINDS
} yb_bits_kind_t;

/* Fractions of bits: what the decisions were worth. Set to 0 before; by_kind if that is wanted. */
typedef struct {
    bool by_kind;
    double of[YB_BITS_KINDS];
    double all; /* with version, padding and check */
} yb_bits_t;

/* Writes the code by its profile; answers its size, or 0 if it does not fit the profile or the
 * room. bits, which may be NULL, becomes its size with fractions of a bit, where it has such.
 */
size_t yb_paper_code(const yb_paper_t *paper, uint8_t *code, size_t room, yb_bits_t *bits);
bool yb_paper_fits(const yb_paper_t *paper, size_t most_bytes);

/* Bytes of the whole code, check included, as a paper code. */
size_t yb_paper_size(const yb_paper_t *paper);

/* Writes the code; answers its size, or 0 if a difference or a count does not fit. Whether the
 * contours are possible only the engine says.
 */
size_t yb_paper_write(const yb_paper_t *paper, uint8_t code[YB_MAX_CODE_BYTES]);

/* Lays further points on the segments that are longer than a difference can be. False if there are
 * too many points then.
 */
bool yb_paper_split(yb_paper_t *paper);

/* Inserts a point before index `at` of the points, into contour `contour`; takes it out again. */
bool yb_paper_insert(yb_paper_t *paper, int contour, int at, yb_step_t point);
void yb_paper_remove(yb_paper_t *paper, int contour, int at);

/* Appends a contour, or takes one out. */
bool yb_paper_append(yb_paper_t *paper, uint16_t height, bool open, const yb_step_t *point,
                     int count);
void yb_paper_drop(yb_paper_t *paper, int contour);

/* Moves a contour to another place among the contours. */
bool yb_paper_reorder(yb_paper_t *paper, int contour, int to);

/* Rounds all heights to another unit. False: that is the unit already, or heights leave the range.
 */
bool yb_paper_rescale(yb_paper_t *paper, double unit_m);

/* Index of a contour's first point. */
int yb_paper_first(const yb_paper_t *paper, int contour);

/* Writes the code and loads it with the engine: what the one decoder says of it. */
yb_code_file_t *yb_paper_check(const yb_paper_t *paper, yb_error_t *error);

#endif
