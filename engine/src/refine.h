/* Refinement for a frame: edges that look long are split, triangles out of sight are dropped. */
#ifndef YB_REFINE_H
#define YB_REFINE_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

/* The pyramid that some rows of the screen are seen through: near, left, right, top, bottom. */
enum {
    REFINE_PLANES = 5,
    REFINE_ALL_PLANES = (1 << REFINE_PLANES) - 1
};

typedef struct {
    int8_t right, up; /* -1, 0 or 1 */
    int32_t slope_q8; /* of depth */
    int32_t near_q8;
    int32_t lift_q9; /* what one unit of height changes, at most */
} refine_plane_t;

typedef struct {
    refine_plane_t plane[REFINE_PLANES];
} refine_view_t;

/* The pyramid of the rows from first_row up to end_row. */
void refine_see(const yb_frame_t *frame, int32_t first_row, int32_t end_row, refine_view_t *view);

/* Height that a point of a triangle (of an edge: name one end twice) may gain or lose until it is
 * drawn: by refinement, and by the water over it.
 */
int32_t refine_stray(const yb_frame_t *frame, const yb_point_t *const p[3]);

/* Tests some points, and what lies between them, against those planes of *planes (a bit each) that
 * they may cross, when each may stray so far in height. True: nothing of it is inside. Else the
 * bits of planes that it is wholly inside of are cleared; parts of it need not look at them.
 */
bool refine_misses(const refine_view_t *view, const yb_point_t *const *p, int count, int32_t stray,
                   uint8_t *planes);

/* Is the edge ab to be split in this frame? A function of the edge alone. */
bool refine_splits(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b);

/* The midpoint of an edge that is: its place, and where it is seen. */
void refine_middle(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                   yb_point_t *middle);

/* Vertex i of the map as a point. */
void refine_root(const yb_frame_t *frame, yb_index_t i, yb_point_t *point);

/* The rows that a base triangle may touch: frame->first_row, last_row. `whole` is the pyramid of
 * all rows.
 */
void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle);

/* Refines a base triangle and draws what it becomes; with raster NULL it is only counted. */
void refine_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                 yb_triangle_t triangle);

/* Draws the walls below the frame. */
void walls_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster);

#endif
