/* What a band hands on to the next: of the base triangles that go on below it, how often their
 * edges are halved, and how far they bulge. Both bands have them in the same order, so it is a
 * queue. It lies where the stack of refinement seldom comes; if it does, all is forgotten, and
 * found anew. Where triangles are not binned nothing is handed on.
 */
#ifndef YB_KEPT_H
#define YB_KEPT_H

#include "refine.h"

/* Forgets all: of a frame that begins, or whose order is another one, so that it is binned anew. */
void kept_forget(yb_frame_t *frame);

/* Begins a band whose base triangles are binned. What the one before it has handed on is there, if
 * that is the one above.
 */
void kept_begin(yb_frame_t *frame, int32_t first_row, int32_t end_row);

/* As refine_root, of a triangle that touches the band, by what the band above has handed on of it;
 * and hands it on.
 */
void kept_root(yb_frame_t *frame, const refine_view_t *view, yb_triangle_t triangle,
               yb_part_t *part);

/* Gives the stack all its room. */
void kept_give_room(yb_frame_t *frame);

/* Makes room, on the stack as far as `top`, to split a triangle. */
static inline void kept_make_room(yb_frame_t *frame, const yb_level_t *top)
{
    if (top > frame->room)
        kept_give_room(frame);
}

#endif
