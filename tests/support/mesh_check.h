/* What a mesh must be, checked without the engine's own arithmetic. Each check returns NULL or what
 * is wrong.
 */
#ifndef TEST_MESH_CHECK_H
#define TEST_MESH_CHECK_H

#include <yamabiko/yamabiko.h>

#include "plan.h"

/* The vertices begin with the plan's points and corners, with their heights. Those that the rules
 * added lie in the frame, each at a place of its own.
 */
const char *mesh_check_vertices(const yb_map_t *map, const plan_t *plan);

/* The triangles tile the frame: counter-clockwise, areas add up, edges pair off, Euler's count,
 * and every edge of a contour is an edge of the mesh.
 */
const char *mesh_check_tiling(const yb_map_t *map, const plan_t *plan);

/* Before skeletons were added: no edge but a contour's or, where load is given, a link has a vertex
 * inside the circle of its triangle across it; of four on one circle the one with the smallest
 * index has the diagonal.
 */
const char *mesh_check_delaunay(const yb_map_t *map, const yb_load_t *load, const plan_t *plan);

/* The regions on both sides of all contours, by point in polygon; their adjacency is a tree. */
const char *mesh_check_regions(const yb_map_t *map, const yb_load_t *load, const plan_t *plan);

/* All of these that hold for every map. */
const char *mesh_check(const yb_map_t *map, const yb_load_t *load, const plan_t *plan);

/* All of these, for a mesh that no rule has been applied to: it has the plan's points and corners.
 */
const char *mesh_check_bare(const yb_map_t *map, const yb_load_t *load, const plan_t *plan);

/* Hash of vertices and triangles, whatever the triangles' order and first corner; the same from
 * every build. At most 255 vertices.
 */
uint64_t mesh_hash(const yb_map_t *map);

#endif
