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

/* A frame whose camera has begun has no order yet. The eye is taken as where it is to 1/64 step. */
void order_begin(yb_frame_t *frame);

/* Has the base triangles in frame->order as some rows show them, and says up to which, after `row`
 * and `end` at most: where the camera looks down, rows show what lies ahead of it, and below that
 * what lies behind.
 */
int32_t order_rows(yb_frame_t *frame, int32_t row, int32_t end);

/* Where the eye is, for a base triangle with these corners. */
void order_root(const yb_frame_t *frame, const yb_index_t *corner, yb_part_t *part);

#endif
