/* Contour lines in full detail, cut to the frame of a map.
 *
 * Places are metres from the frame's south-west corner, x to the east and y to the north. A line is
 * closed (its first place is not repeated at the end), or runs from the frame to the frame with
 * both ends exactly on it, or is a spot height: one place.
 */
#ifndef YB_CONTOUR_LINES_H
#define YB_CONTOUR_LINES_H

#include <stdbool.h>

#include "error.h"
#include "grid.h"

enum {
    YB_FRAME_CORNERS = 4
};

typedef struct {
    double x_m, y_m;
} yb_place_t;

typedef struct {
    double height_m;
    bool closed;
    bool mended; /* closed over a gap, or bent far to meet the frame: not as the file has it */
    int count;
    yb_place_t *place;
} yb_line_t;

/* Where on earth a frame lies: its south-west corner in a projection whose unit is the metre. */
typedef struct {
    double west_m, south_m;
    char *projection; /* WKT, or NULL if nobody says which */
} yb_origin_t;

typedef struct {
    double width_m, depth_m; /* the frame */
    yb_origin_t origin;      /* of lines from a file */
    char *input_system;      /* WKT of the file's own coordinates, if not the origin's; or NULL */
    int count;
    yb_line_t *line;
    int room;           /* of the array; private */
    int dropped;        /* lines that end in the open, away from the frame */
    double precision_m; /* that the coordinates of a file are rounded to; 0: not known */
    double interval_m;  /* from line to line, where that is known; 0: the lines tell it */
} yb_lines_t;

/* The lines of a grid at the given heights. NULL: out of memory, or GDAL says why. */
yb_lines_t *yb_lines_from_grid(const yb_grid_t *grid, const double *level_m, int levels,
                               yb_error_t *error);

/* The lines of a vector file: every line or polygon outline with a height, every point as a spot
 * height. The height is the attribute `field`; if that is NULL, the first whose name says so
 * (elevation, elev, ele, height, contour, level, hoehe, z ...); if there is none, the z
 * coordinate. Only `window` is used; without one the frame is the lines' own extent, a little
 * wider where the outermost lines are closed.
 */
yb_lines_t *yb_lines_from_vector(const char *path, const char *field, const yb_window_t *window,
                                 yb_error_t *error);

/* True if GDAL reads the file as vectors and not as a raster. */
bool yb_lines_is_vector(const char *path);

/* NULL does nothing. */
void yb_lines_free(yb_lines_t *lines);

/* An empty set; and a copy of a line added to it. False: out of memory. */
yb_lines_t *yb_lines_new(double width_m, double depth_m);
bool yb_lines_add(yb_lines_t *lines, double height_m, bool closed, const yb_place_t *place,
                  int count);

/* How far along the frame, counter-clockwise from its south-western corner, a place on it lies. */
double yb_lines_frame_way_m(const yb_lines_t *lines, yb_place_t at);

/* The corners of the frame that an open line's left side has, counter-clockwise from its end back
 * to its beginning. Answers how many.
 */
int yb_lines_corners_back(const yb_lines_t *lines, const yb_line_t *line,
                          yb_place_t corner[YB_FRAME_CORNERS]);

double yb_line_length_m(const yb_line_t *line);

/* Area inside a closed line; 0 for others. */
double yb_line_area_m2(const yb_line_t *line);

#endif
