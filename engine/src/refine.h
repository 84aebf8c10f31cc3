/* Refinement for a frame: edges that look long are split, triangles out of sight are dropped.
 *
 * Whether an edge is split is a function of the edge alone, so triangles that share one agree. For
 * an edge that lies nearly across the view, or is short, one look at its ends says how often it is
 * to be halved: its halves, and theirs, follow. Of one that comes towards the eye each half is
 * asked anew.
 */
#ifndef YB_REFINE_H
#define YB_REFINE_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

/* An edge: its plan length in 1/128 step, foreshortened as the view does it, in the lower 16 bits;
 * its length class (yb_map_t.noise) and 4 in the next 8; how often it is to be halved in the upper
 * 8, or these.
 */
#define REFINE_ONCE ((yb_edge_t)1 << 24)
#define REFINE_AGAIN ((yb_edge_t)0x80 << 24) /* once; then ask each half anew */
#define REFINE_ASK ((yb_edge_t)0xff << 24)   /* not asked yet */

static inline int refine_class(yb_edge_t edge)
{
    return (int)(edge >> 16 & 0xff) - 4;
}

/* Either half of an edge that is split. Its class is its own only if it can be split on. */
static inline yb_edge_t refine_half(yb_edge_t edge)
{
    yb_edge_t half = ((edge & 0xffff) >> 1) + ((edge & 0xffff0000) - 0x01040000);
    return edge >= REFINE_AGAIN ? half | REFINE_ASK : half;
}

/* yb_spot_t.out: the sides of some rows of the screen that a point is beyond. */
enum {
    REFINE_ABOVE = 1,
    REFINE_BELOW = 2,
    REFINE_LEFT = 4,
    REFINE_RIGHT = 8,
    REFINE_SIDES = 15,
    REFINE_NOWHERE = 16 /* it has no spot */
};

/* The pyramid that some rows of the screen are seen through: near, left, right, top, bottom. */
enum {
    REFINE_PLANES = 5
};

typedef struct {
    int8_t right, up; /* -1, 0 or 1 */
    int32_t slope_q8; /* of depth */
    int32_t near;
    int32_t lift_q9; /* what one unit of height changes, at most */
} refine_plane_t;

/* Some rows of the screen: as a box on it, and as a pyramid. */
typedef struct {
    int32_t left_q4, right_q4, top_q4, bottom_q4; /* what is beyond one of them draws nothing */
    refine_plane_t plane[REFINE_PLANES];
} refine_view_t;

/* The rows from first_row up to end_row. */
void refine_see(const yb_frame_t *frame, int32_t first_row, int32_t end_row, refine_view_t *view);

/* An edge that is no half of another one. */
yb_edge_t refine_edge(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b);

/* The edge ab, which is REFINE_ASK, with its number of halvings. */
yb_edge_t refine_ask(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                     yb_edge_t edge);

/* The midpoint of an edge that is split: its place, and where it is seen. */
void refine_middle(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                   yb_edge_t edge, yb_point_t *middle);

/* Is nothing of some points, and of what lies between them, in the view, when each may move by
 * `stray` in height?
 */
bool refine_misses(const yb_frame_t *frame, const refine_view_t *view, const yb_point_t *const *p,
                   int count, int32_t stray);

/* Height that a point of a triangle may gain or lose until it is drawn, by refinement and water. */
int32_t refine_stray(const yb_frame_t *frame, const yb_part_t *part);

/* A base triangle, with its corners in frame->root. */
void refine_root(yb_frame_t *frame, const refine_view_t *view, yb_triangle_t triangle,
                 yb_part_t *part);

/* Asks what edges of a triangle are REFINE_ASK. Is one of them split? */
bool refine_splits(const yb_frame_t *frame, yb_part_t *part);

/* Splits a triangle that is to be split: into its first part, and what is laid aside from `level`
 * on, REFINE_PIECES at most. The answer is what follows it.
 */
enum {
    REFINE_PIECES = 3
};
yb_level_t *refine_split(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                         yb_level_t *level);

/* Takes up what was laid aside last, between `bottom` and *top; false: there is nothing left. */
bool refine_next(const yb_level_t *bottom, yb_level_t **top, yb_part_t *part);

/* The bins of rows that a base triangle may touch: frame->rows. `whole` is all rows. */
void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle);

/* Refines a base triangle and draws what it becomes; with raster NULL it is only counted. */
void refine_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster,
                 yb_triangle_t triangle);

/* Notes in frame->rim whether a base triangle has an edge on the frame. */
void walls_bin(yb_frame_t *frame, yb_triangle_t triangle);

/* Draws the walls below the frame. */
void walls_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster);

#endif
