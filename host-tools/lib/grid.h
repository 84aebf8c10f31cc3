/* A relief as a grid of heights, read from any raster that GDAL can open.
 *
 * The cells are square and measured in metres, the first row is the northernmost. What the raster
 * holds in degrees, in feet or in Web Mercator is resampled to a transverse Mercator projection
 * whose meridian runs through the middle of the window. Only the window is read, at the resolution
 * asked for.
 *
 * The frame of a map made from a grid runs through the *centres* of its outer cells: its south-west
 * corner is the centre of the south-western cell, and it is (columns - 1) * cell_m wide, however
 * many lattice steps that is in the code. Places on it are metres from that corner.
 */
#ifndef YB_GRID_H
#define YB_GRID_H

#include <stdbool.h>
#include <stddef.h>

#include "error.h"

/* Metres per cell of a raster that does not say where it lies, unless the user knows better: the
 * common DEMs have one arc second.
 */
#define YB_GRID_DEFAULT_CELL_M 30.0

/* Share of missing cells up to which the holes are filled from around them. */
#define YB_GRID_MOST_HOLES 0.25

typedef enum {
    YB_WINDOW_WHOLE,  /* all of the raster */
    YB_WINDOW_BOX,    /* a box in the raster's own coordinates */
    YB_WINDOW_CENTER, /* a square round a place on earth */
} yb_window_kind_t;

typedef struct {
    yb_window_kind_t kind;
    double box[4];           /* x min, y min, x max, y max */
    double lon_deg, lat_deg; /* WGS 84 */
    double side_m;           /* of the square */
    double cell_m;           /* of a raster without georeference; 0: the default above */
} yb_window_t;

typedef struct {
    int columns, rows;
    double cell_m;
    double transform[6]; /* GDAL's geotransform, north up */
    char *projection;    /* WKT, or NULL if the raster has none */
    float *height_m;     /* rows * columns, all finite */
    float low_m, high_m;
    double std_m; /* standard deviation of the heights */
    double holes; /* share of the cells that were missing and are filled */
    bool placed;  /* false: the raster has no georeference, cell_m is an assumption */
} yb_grid_t;

/* Reads the window with at most `most` cells on its longer side. NULL with a sentence on failure:
 * no raster, the window reaches out of it, too many holes, all one height.
 */
yb_grid_t *yb_grid_read(const char *path, const yb_window_t *window, int most, yb_error_t *error);

/* A new grid of zeros, without projection; finish it by yb_grid_measure. NULL: out of memory. */
yb_grid_t *yb_grid_new(int columns, int rows, double cell_m);

/* Sets low_m, high_m and std_m from the heights. */
void yb_grid_measure(yb_grid_t *grid);

/* NULL does nothing. */
void yb_grid_free(yb_grid_t *grid);

/* Size of the frame through the centres of the outer cells. */
static inline double yb_grid_width_m(const yb_grid_t *grid)
{
    return (grid->columns - 1) * grid->cell_m;
}
static inline double yb_grid_depth_m(const yb_grid_t *grid)
{
    return (grid->rows - 1) * grid->cell_m;
}

/* Height at a place of the frame, bilinear; places outside are moved to its nearest side. */
double yb_grid_height(const yb_grid_t *grid, double east_m, double north_m);

#endif
