/* The camera (colour paper): from the map's axes to the view's, and on to the screen.
 *
 * View space: right, up and depth from the eye, in q8 steps >> frame->eye_shift. A point has a spot
 * on the screen if it lies beyond the near distance, within a screen size of the screen and where
 * |right|, |up| < 2 depth: there 32-bit arithmetic projects it, and the rasteriser takes it.
 */
#ifndef YB_CAMERA_H
#define YB_CAMERA_H

#include <yamabiko/yamabiko.h>

#include "fix.h"
#include "relief.h"

typedef struct {
    int32_t right, up, depth; /* within 2^17; in quarters, where clip.c cuts */
} camera_point_t;

/* How far a height is above the eye, in the view's unit: within 2^16. */
static inline int32_t camera_rise(const yb_frame_t *frame, int32_t top_q8)
{
    return (((top_q8 * frame->view.exaggerate_q8) >> 8) - frame->view.eye_q8[2]) >>
           frame->eye_shift;
}

/* Cuts frame's view to its limits: see yb_view_t. */
void camera_clamp(yb_frame_t *frame);

/* Fills in frame's camera constants. No refinement and no wall moves a point by more than `stray`
 * from the mesh. After it frame->seen has the map's vertices.
 */
void camera_begin(yb_frame_t *frame, int32_t stray);

/* Where a place of the map at height top_q8 lies in view space; in quarters of its unit, where
 * leaves are cut: before the feet a unit is many pixels.
 */
enum {
    CAMERA_FINER = 2 /* bits */
};
void camera_view(const yb_frame_t *frame, uint32_t place, int32_t top_q8, camera_point_t *to);
void camera_view_finely(const yb_frame_t *frame, uint32_t place, int32_t top_q8,
                        camera_point_t *to);

/* Its depth alone. */
int32_t camera_depth(const yb_frame_t *frame, uint32_t place, int32_t top_q8);

/* 1/depth as in a spot, at the near distance or beyond. */
int32_t camera_near(const yb_frame_t *frame, int32_t depth);

/* Nothing nearer is drawn. Points nearer than the near distance have no spots, but the ground
 * before the feet of who looks down is not half as far.
 */
static inline int32_t camera_least(const yb_frame_t *frame)
{
    return frame->near >> 3;
}

/* A place in view space on the screen; beyond the near distance, |right|, |up| <= 2 depth. */
void camera_project(const yb_frame_t *frame, const camera_point_t *from, yb_spot_t *spot);

/* Sets a point's spot from its place and top. */
void camera_see(const yb_frame_t *frame, yb_point_t *point);

/* Vertex i of the map as a point. */
static inline void camera_root(const yb_frame_t *frame, yb_index_t i, yb_point_t *point)
{
    const yb_vertex_t *v = &frame->map->vertex[i];
    const yb_seen_t *seen = &frame->seen[i];
    point->place = relief_place(v);
    point->slope = ((uint16_t)v->gx_q11 | (uint32_t)(uint16_t)v->gy_q11 << 16) ^ 0x80008000u;
    point->z_q8 = v->z_q8;
    point->top_q8 = fix_max(v->z_q8, frame->view.water_q8);
    point->spot.x_q4 = seen->x_q4;
    point->spot.y_q4 = seen->y_q4;
    point->spot.near = seen->near;
}

/* The point straight above or below `point` at height z, to be drawn there, under water or not. */
void camera_drop(const yb_frame_t *frame, const yb_point_t *point, int32_t z_q8, yb_point_t *to);

#endif
