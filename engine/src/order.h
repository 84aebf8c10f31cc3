/* Which triangles may hide which: the order in which a frame draws them, the nearest first.
 *
 * The surface has one height at a place, so what lies in front of what is decided in plan: along
 * any line of sight, by where the line is first. Of two triangles with a common edge the one on the
 * eye's side of it comes first; of the parts of a triangle, those on the eye's side of the line
 * that divides it. So a pixel belongs to the first triangle that covers it, and no pixel needs a
 * depth.
 *
 * A triangle knows where the eye is by three numbers (yb_part_t.eye), one a corner: how far the eye
 * is from the opposite side towards the corner, where the corner itself is as far as all three
 * together. That sum is halved when a triangle is split, whatever its shape. They are coordinates
 * in plan, and take no more than additions to follow.
 */
#ifndef YB_ORDER_H
#define YB_ORDER_H

#include <yamabiko/yamabiko.h>

#include "fix.h"
#include "mesh.h"

/* yb_frame_t.order_for: what frame->order is good for. Lines of sight that go round the eye may
 * meet triangles in a circle, each in front of the next; those that go ahead of it, or back,
 * cannot, for then there is a last one.
 */
enum {
    ORDER_NONE,
    ORDER_ALL,
    ORDER_AHEAD,
    ORDER_BACK
};

/* How far a base triangle is open to the eye (frame->open): so much of the length of its edges, or
 * of those of the one beside it, if that is more, counts for whether they are split. All of it, but
 * for a triangle that is seen nearly along its plane, and a quarter of it for one that is seen from
 * behind, and mostly hidden. ORDER_OUT: it is out of sight; to the one beside it, it is all open.
 */
enum {
    ORDER_OPEN_BITS = 7,
    ORDER_OPEN = 1 << ORDER_OPEN_BITS,
    ORDER_OUT
};

/* May anything of a base triangle be seen? */
static inline bool order_shows(const yb_frame_t *frame, yb_triangle_t triangle)
{
    return frame->open[triangle] != ORDER_OUT;
}

/* An edge of a triangle that is so far open, by the entry across it. */
static inline int32_t order_open(const yb_frame_t *frame, int32_t open, yb_across_t across)
{
    const yb_across_t beside = across & NO_TRIANGLE;
    return open == ORDER_OPEN || beside == NO_TRIANGLE ? open : fix_max(open, frame->open[beside]);
}

/* Of a frame after refine_see_vertices: finds the order of all rows, if there is one, and how far
 * its triangles are open. The eye is taken as where it is to 1/64 step.
 */
void order_begin(yb_frame_t *frame);

/* Has the base triangles in frame->order as some rows show them, and says up to which, after `row`
 * and `end` at most: where the camera looks down, rows show what lies ahead of it, and below that
 * what lies behind.
 */
int32_t order_rows(yb_frame_t *frame, int32_t row, int32_t end);

/* Where the eye is, for a base triangle with these corners. */
void order_root(const yb_frame_t *frame, const yb_index_t *corner, yb_part_t *part);

#endif
