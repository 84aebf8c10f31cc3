/* A surface as triangles, and as a grid of heights.
 *
 * Coordinates are metres: x east and y north from the south-west corner of the map's frame, z above
 * the datum. A map's reference surface (yb_map_refine with YB_REFERENCE_Q8) and the lattice of a
 * real DEM become the same kind of mesh, so that isolines and pictures of both come from the same
 * code.
 */
#ifndef YB_SURFACE_H
#define YB_SURFACE_H

#include <yamabiko/yamabiko.h>

typedef struct {
    double x, y, z;
} yb_point3_t;

/* Triangles that share corners. Counter-clockwise seen from above. Owned by whoever made it:
 * yb_mesh_free.
 */
typedef struct {
    yb_point3_t *point;
    uint32_t point_count;
    uint32_t (*triangle)[3];
    uint32_t triangle_count;
    uint32_t cracks; /* corners met at one place with different heights: 0, or the engine errs */
} yb_mesh_t;

/* Metres per step of a map, the size of its frame, and a height above the datum. */
double yb_map_cell_m(const yb_map_t *map);
double yb_map_east_m(const yb_map_t *map);
double yb_map_north_m(const yb_map_t *map);
double yb_map_z_m(const yb_map_t *map, int32_t z_q8);

/* A map refined until no edge is longer than longest_q8; equal corners become one. False: no
 * memory. */
bool yb_mesh_from_map(yb_mesh_t *mesh, const yb_map_t *map, uint16_t longest_q8);

/* The triangles that a frame draws: see yb_frame_triangles. False: no memory. */
bool yb_mesh_from_frame(yb_mesh_t *mesh, const yb_map_t *map, const yb_view_t *view,
                        const yb_screen_t *screen);

/* A lattice of columns * rows heights, row 0 in the south, at least two each way, its outermost
 * points on the frame from (0, 0) to (east_m, north_m); each square is cut from its south-west to
 * its north-east corner.
 */
bool yb_mesh_from_lattice(yb_mesh_t *mesh, const float *z_m, uint32_t columns, uint32_t rows,
                          double east_m, double north_m);

void yb_mesh_free(yb_mesh_t *mesh);

/* Heights of the reference surface at all places (x_q8[i], y_q8[j]) of its frame, both rising:
 * z_q8[j * columns + i]. Each is that of yb_map_height; all triangles are refined once.
 */
void yb_map_heights(const yb_map_t *map, const uint16_t *x_q8, uint32_t columns,
                    const uint16_t *y_q8, uint32_t rows, int32_t *z_q8);

/* The same as floats in metres above the datum, to be freed. NULL: no memory. */
float *yb_map_heights_m(const yb_map_t *map, const uint16_t *x_q8, uint32_t columns,
                        const uint16_t *y_q8, uint32_t rows);

/* How a raster of `cells` cells along the longer side lies on a map. The map's lattice points are
 * centres of cells one step wide, so the raster covers half a step beyond the frame on every side;
 * heights there are the frame's.
 */
typedef struct {
    uint32_t columns, rows;
    double cell_m;
    double west_m, south_m; /* the outer corner of the south-western cell */
} yb_raster_t;

yb_raster_t yb_raster_on_map(const yb_map_t *map, uint32_t cells);

/* Heights of the reference surface at the raster's cell centres, row 0 in the south: columns * rows
 * floats, to be freed. NULL: no memory.
 */
float *yb_raster_heights(const yb_map_t *map, const yb_raster_t *raster);

#endif
