/* A directory for one test program, and input files made in it. */
#ifndef SCRATCH_H
#define SCRATCH_H

#include <stdbool.h>

#include "grid.h"

/* Make the directory and remove it with all that is in it: for cmocka's group set-up. */
int scratch_begin(void **state);
int scratch_end(void **state);

/* A path in the directory, in one of eight buffers that are used in turn. */
const char *scratch_path(const char *name);

bool scratch_exists(const char *path);
int scratch_files(void); /* entries in the directory, hidden ones too */

typedef double (*relief_fn)(double east, double north);

/* Reliefs over the unit square, in metres. */
double relief_cone(double east, double north);  /* one summit of 1000 m in the middle */
double relief_range(double east, double north); /* two summits, a valley, a slope */
double relief_flat(double east, double north);  /* 5 m everywhere */

/* A GeoTIFF of columns x rows cells of a relief; cell size 30 m, UTM zone 32 N, south-west corner
 * at 500000, 5000000. Cells whose height is NaN are marked as missing.
 */
void scratch_raster(const char *path, int columns, int rows, relief_fn relief);

/* The same in degrees: cells of one arc second, south-west corner at 9 E 46 N. */
void scratch_raster_degrees(const char *path, int columns, int rows, relief_fn relief);

/* The same as a bare PNG of 16 bits, without a place on earth. */
void scratch_raster_bare(const char *path, int columns, int rows, relief_fn relief);

/* A PNG of 8 bits: rings drawn round the middle of a sheet of 120 x 100 pixels. */
void scratch_sheet(const char *path, int rings);

/* The relief as a grid in memory. */
yb_grid_t *scratch_grid(int columns, int rows, relief_fn relief);

void scratch_text(const char *path, const char *text);

#endif
