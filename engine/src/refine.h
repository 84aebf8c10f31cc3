/* Refinement for a frame: edges that look long are split, triangles out of sight are dropped. */
#ifndef YB_REFINE_H
#define YB_REFINE_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

/* Is the edge ab to be split in this frame? A function of the edge alone. */
bool refine_splits(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b);

/* The midpoint of an edge that is: its place, and where it is seen. */
void refine_middle(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                   yb_point_t *middle);

/* Vertex i of the map as a point. */
void refine_root(const yb_frame_t *frame, yb_index_t i, yb_point_t *point);

/* The rows that a base triangle may touch: frame->first_row, last_row. */
void refine_bin(yb_frame_t *frame, uint16_t triangle);

/* Refines a base triangle and draws what it becomes; with raster NULL it is only counted. */
void refine_draw(yb_frame_t *frame, const raster_t *raster, uint16_t triangle);

/* Draws one leaf, clipped where it must be. */
bool clip_draw(const yb_frame_t *frame, const raster_t *raster, const yb_point_t *const corner[3],
               uint16_t pixel);

/* Draws the walls below the frame. */
void walls_draw(yb_frame_t *frame, const raster_t *raster);

#endif
