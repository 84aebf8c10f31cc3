/* Refinement for a frame: edges that look long are split, triangles out of sight are dropped.
 *
 * Whether an edge is split is a function of the edge alone, so triangles that share one agree. For
 * an edge that lies nearly across the view, or is short, one look at its ends says how often it is
 * to be halved: its halves, and theirs, follow. Of one that comes towards the eye each half is
 * asked anew. Edges inside a base triangle are shared by its own parts only: in slivers they are
 * left whole.
 */
#ifndef YB_REFINE_H
#define YB_REFINE_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

/* --- Views: outside.c ------------------------------------------------------------------------- */

/* The pyramid that some rows of the screen are seen through. */
enum {
    REFINE_NEAR,
    REFINE_LEFTMOST,
    REFINE_RIGHTMOST,
    REFINE_TOP,
    REFINE_BOTTOM,
    REFINE_PLANES
};

/* yb_spot_t.out: the sides of those rows that a point is beyond, or that it has no spot. */
enum {
    REFINE_NOWHERE = 1 << REFINE_NEAR,
    REFINE_LEFT = 1 << REFINE_LEFTMOST,
    REFINE_RIGHT = 1 << REFINE_RIGHTMOST,
    REFINE_ABOVE = 1 << REFINE_TOP,
    REFINE_BELOW = 1 << REFINE_BOTTOM,
    REFINE_ALL = (1 << REFINE_PLANES) - 1,
    REFINE_SIDES = REFINE_ALL - REFINE_NOWHERE
};

typedef struct {
    int32_t slope_q8; /* of depth */
    int32_t near;
    int32_t lift_q9; /* what one unit of height changes, at most */
} refine_plane_t;

/* Some rows of the screen: as a box on it, and as a pyramid. What is in the box has a spot. */
typedef struct {
    int32_t left_q4, top_q4;   /* what is not in the box from here on … */
    uint32_t wide_q4, high_q4; /* … so wide and high draws nothing */
    refine_plane_t plane[REFINE_PLANES];
} refine_view_t;

/* The rows from first_row up to end_row. */
void refine_see(const yb_frame_t *frame, int32_t first_row, int32_t end_row, refine_view_t *view);

/* --- Edges and base triangles: edges.c -------------------------------------------------------- */

/* An edge: its plan length in 1/128 step, foreshortened as the view does it, and as far as it is
 * open to the eye, in the lower 16 bits; its length class (yb_map_t.noise) and 4 in the next 7;
 * REFINE_TURNED, if it is not all open; how often it is to be halved in the upper 8, or
 * REFINE_AGAIN and how often it may be.
 *
 * A base triangle's edges may be halved YB_MAX_HALVINGS times, and no edge of a part as often as
 * the one of the whole that may be most often. So a triangle is split so often at most on the way
 * to a leaf, and as each time takes up to REFINE_PIECES places, the stack has room for all of them.
 */
#define REFINE_CLASS ((yb_edge_t)0x7f << 16)
#define REFINE_TURNED ((yb_edge_t)1 << 23) /* it may be long, and yet left whole */
#define REFINE_ONCE ((yb_edge_t)1 << 24)
#define REFINE_AGAIN ((yb_edge_t)0x80 << 24) /* once; then ask each half anew */
#define REFINE_WHOLE (REFINE_ONCE - 1)       /* what stays of an edge that is left whole */

/* How often it is to be halved, or may be. Of several, one by one OR'ed: no less than each. */
static inline int refine_often(yb_edge_t edge)
{
    return (int)(edge >> 24 & 0x7f);
}

static inline int refine_class(yb_edge_t edge)
{
    return (int)(edge >> 16 & 0x7f) - 4;
}

/* Either half of an edge that is split, to be asked anew if that is REFINE_AGAIN. Its class is its
 * own only if it can be split on, and if it is no part of a line across (refine.c).
 */
TINY yb_edge_t refine_half(yb_edge_t edge)
{
    return ((edge & 0xffff) >> 1) + ((edge & 0xffff0000) - 0x01040000);
}

/* Of the differences of an edge's ends: the lowest bit says whether it cannot be split, the next
 * one whether its halves cannot, and so on.
 */
static inline uint32_t refine_parity(const yb_point_t *a, const yb_point_t *b)
{
    const uint32_t parity = a->place ^ b->place;
    return parity | parity >> 16;
}

/* An edge that is no half of another one, as far as it is open: see order.h. */
yb_edge_t refine_edge(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                      int32_t open);

/* The edge ab with its number of halvings, asked anew: as often as it may be, at most. */
yb_edge_t refine_ask(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b,
                     yb_edge_t edge);

/* The midpoint of an edge that is split: its place, and where it is seen. */
void refine_middle(const yb_frame_t *frame, const refine_view_t *view, const yb_point_t *a,
                   const yb_point_t *b, yb_edge_t edge, yb_point_t *middle);

/* A corner of a base triangle: vertex i of the map. */
void refine_corner(const yb_frame_t *frame, const refine_view_t *view, yb_index_t i,
                   yb_point_t *point);

/* A base triangle, with its corners in frame->root; its edges and bulge by what is known, or NULL.
 */
void refine_root(yb_frame_t *frame, const refine_view_t *view, yb_triangle_t triangle,
                 const yb_kept_t *known, yb_part_t *part);

/* --- What is in sight: outside.c -------------------------------------------------------------- */

enum {
    REFINE_POINTS = 6,
    REFINE_LEVELS = 16 /* of midpoints, at most: plan coordinates have so many bits */
};

/* Is nothing of up to REFINE_POINTS points, and of what lies between them, in the view, when each
 * may move by `stray` in height, and edges be halved so often?
 */
bool refine_halved_misses(const yb_frame_t *frame, const refine_view_t *view,
                          const yb_point_t *const *p, int count, int often, int32_t stray);

static inline bool refine_misses(const yb_frame_t *frame, const refine_view_t *view,
                                 const yb_point_t *const *p, int count, int32_t stray)
{
    return refine_halved_misses(frame, view, p, count, REFINE_LEVELS, stray);
}

/* Height that a point of a triangle may gain or lose until it is drawn, by refinement and water. */
int32_t refine_stray(const yb_frame_t *frame, const yb_part_t *part);

/* Of a frame whose camera has begun: notes of each vertex without a spot, in seen[].x_q4, the
 * planes of the whole picture that it is beyond by more than anything there can come back, a bit
 * each.
 */
void refine_see_vertices(yb_frame_t *frame, const refine_view_t *whole);

/* Is all of a base triangle beyond one of them, as most are that lie behind the eye? */
static inline bool refine_out_of_sight(const yb_frame_t *frame, const yb_index_t *corner)
{
    const yb_seen_t *const a = &frame->seen[corner[0]];
    const yb_seen_t *const b = &frame->seen[corner[1]];
    const yb_seen_t *const c = &frame->seen[corner[2]];
    return a->near == 0 && b->near == 0 && c->near == 0 && (a->x_q4 & b->x_q4 & c->x_q4) != 0;
}

/* Is nothing that a triangle to be split can become in the view? Most lie in it as they are. */
bool refine_far_off(const yb_frame_t *frame, const refine_view_t *view, const yb_part_t *part,
                    int beyond);

static inline bool refine_part_misses(const yb_frame_t *frame, const refine_view_t *view,
                                      const yb_part_t *part)
{
    const yb_point_t *const *p = part->point;
    int some = (p[0]->spot.out | p[1]->spot.out | p[2]->spot.out) & REFINE_NOWHERE;
    int beyond = (p[0]->spot.out & p[1]->spot.out & p[2]->spot.out) | some;
    return beyond != 0 && refine_far_off(frame, view, part, beyond);
}

/* How far the smooth surface of a base triangle may be from its plane, and of parts, from theirs.
 */
int32_t refine_bulge(const yb_map_t *map, const yb_vertex_t *const corner[3]);

/* The bins of rows that a base triangle, and the walls below it, may touch: frame->bins. `whole` is
 * all rows.
 */
void refine_bin(yb_frame_t *frame, const refine_view_t *whole, yb_triangle_t triangle);

static inline int refine_bin_of(const yb_frame_t *frame, int32_t row)
{
    return (int)(row >> frame->row_shift);
}

/* May a base triangle touch some bins of rows? One that is not on the screen has its last bin
 * before the first.
 */
static inline bool refine_touches(const yb_frame_t *frame, yb_triangle_t triangle, int first_bin,
                                  int last_bin)
{
    const int bins = frame->bins[triangle];
    return bins >> 4 <= last_bin && (bins & 15) >= first_bin;
}

/* --- Splitting: refine.c ---------------------------------------------------------------------- */

/* REFINE_ONCE or more if one of a triangle's edges is split; below twice that, none of its parts
 * is.
 */
static inline yb_edge_t refine_edges(const yb_part_t *part)
{
    return part->edge[0] | part->edge[1] | part->edge[2];
}

static inline bool refine_splits(const yb_part_t *part)
{
    return refine_edges(part) >= REFINE_ONCE;
}

/* Of a triangle that is to be split, the corner a from which of the edges that are split ab is the
 * first.
 */
static inline int refine_first_corner(const yb_part_t *part)
{
    if (part->edge[0] < REFINE_ONCE)
        return part->edge[1] < REFINE_ONCE ? 2 : 1;
    return part->edge[1] < REFINE_ONCE && part->edge[2] >= REFINE_ONCE ? 2 : 0;
}

/* How far the eye would be from a side if it were half way to the corner. */
static inline int32_t refine_half_way(const yb_part_t *part)
{
    return (part->eye[0] + part->eye[1] + part->eye[2]) >> 1;
}

/* Is a triangle to become many and yet seen as little more than a line? What is inside it is left
 * whole: else a sliver that is to become n pieces along its sides would become n times n.
 */
bool refine_is_sliver(const yb_frame_t *frame, const yb_part_t *part);

/* Splits a triangle that is to be split, where kept_make_room has made room: into the part that
 * comes first, in its place, and what is laid aside from `level` on, REFINE_PIECES at most. The
 * answer is what follows it.
 */
enum {
    REFINE_PIECES = 3
};
yb_level_t *refine_split(const yb_frame_t *frame, const refine_view_t *view, yb_part_t *part,
                         yb_level_t *level);

/* Of a part that is done with, the next: what was laid aside last between `bottom` and `from`, the
 * end of what its splitting laid aside or, if it was not split, where it lies itself. It stays
 * there until it is done with. NULL: there is nothing left.
 */
static inline yb_level_t *refine_next(const yb_level_t *bottom, yb_level_t *from, yb_part_t *done)
{
    done->point[0] = NULL;
    while (from != bottom) {
        if ((--from)->rest.point[0] != NULL)
            return from;
    }
    return NULL;
}

/* From where on what a part that was laid aside is split into may be. */
static inline yb_level_t *refine_top(yb_level_t *level)
{
    return level + (level->rest.point[2] == &level[1].middle ? 2 : 1);
}

/* --- Drawing: draw.c, walls.c ----------------------------------------------------------------- */

/* Refines the base triangles that may touch the rows of a raster, in the frame's order, and draws
 * what they become.
 */
void refine_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster);

/* The leaves of the whole screen, or somewhat more; where there are more than enough, any number
 * above that.
 */
uint32_t refine_count(yb_frame_t *frame, const refine_view_t *whole, uint64_t enough);

/* Notes in frame->rim which base triangles have an edge on the frame whose wall shows its outside.
 */
void walls_begin(yb_frame_t *frame);

static inline bool walls_are_below(const yb_frame_t *frame, yb_triangle_t triangle)
{
    return (frame->rim[triangle >> 3] & 1 << (triangle & 7)) != 0;
}

/* Draws the walls below the frame, which hide the ground where they are seen from outside. */
void walls_draw(yb_frame_t *frame, const refine_view_t *view, const raster_t *raster);

#endif
