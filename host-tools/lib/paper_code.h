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

enum {
    YB_PAPER_CONTOURS = 255,
    YB_PAPER_POINTS = 255,
    YB_CORNERS = 4
};

typedef struct {
    uint8_t x, y;
} yb_step_t;

typedef struct {
    uint16_t height; /* in units above the base */
    uint8_t count;   /* points; 1 is a spot height */
    bool open;       /* from frame to frame */
} yb_paper_contour_t;

typedef struct {
    uint8_t east, north; /* size of the frame in steps, 1 to 255 */
    uint8_t shift;       /* differences are multiples of 2^shift; 0 to 3 */
    uint16_t cell;       /* metres per step, as coded: yb_paper_unit */
    uint16_t unit;       /* metres per unit of height, as coded */
    int16_t base_m;
    uint8_t seed;
    uint8_t gain;      /* 32 is what the contours themselves suggest */
    uint8_t dimension; /* D = 1 + dimension/256 */
    bool straight;     /* no smoothing */
    uint8_t corners;   /* coded corner heights: bit 0 SW, 1 SE, 2 NE, 3 NW; 0: one for the frame */
    uint16_t corner[YB_CORNERS];
    uint16_t frame; /* its height if no corner is coded */
    int vertices;   /* of the mesh, which only the engine can count; 0: not known yet */
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

/* Bytes of the whole code, check included. */
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

/* Index of a contour's first point. */
int yb_paper_first(const yb_paper_t *paper, int contour);

/* Writes the code and loads it with the engine: what the one decoder says of it. */
yb_code_file_t *yb_paper_check(const yb_paper_t *paper, yb_error_t *error);

#endif
