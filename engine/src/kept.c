#include "kept.h"

_Static_assert((int)YB_LOWER_LEVELS >= (int)REFINE_PIECES,
               "a triangle is split in the lower part at least");

enum {
    NO_ROW = -1
};

void kept_forget(yb_frame_t *frame)
{
    yb_queue_t *queue = &frame->queue;
    queue->row = NO_ROW;
    queue->first = queue->end = queue->next = 0;
    queue->full = true; /* as long as nothing is binned */
    frame->room = &frame->level[YB_LOWER_LEVELS - REFINE_PIECES];
}

void kept_give_room(yb_frame_t *frame)
{
    kept_forget(frame);
    frame->room = &frame->level[YB_MAX_LEVELS - REFINE_PIECES];
}

void kept_begin(yb_frame_t *frame, int32_t first_row, int32_t end_row)
{
    yb_queue_t *queue = &frame->queue;
    if (queue->row != first_row)
        kept_forget(frame);
    queue->row = (int16_t)end_row;
    queue->end = queue->next; /* the band above has taken out all that was there before */
    queue->full = false;
    queue->above = (uint8_t)refine_bin_of(frame, first_row - 1); /* not asked of the first row */
    queue->below = (uint8_t)refine_bin_of(frame, end_row);
}

void kept_root(yb_frame_t *frame, const refine_view_t *view, yb_triangle_t triangle,
               yb_part_t *part)
{
    yb_queue_t *queue = &frame->queue;
    const yb_kept_t *known = NULL;
    if (queue->first != queue->end && frame->bins[triangle] >> 4 <= queue->above)
        known = &frame->kept[queue->first++ % YB_KEPT];
    refine_root(frame, view, triangle, known, part);
    if (queue->full || (frame->bins[triangle] & 15) < queue->below)
        return;
    /* Once it is full none goes in until the next band: of what goes in none may be left out. */
    queue->full = (uint8_t)(queue->next - queue->first) == YB_KEPT;
    if (queue->full)
        return;
    yb_kept_t *kept = &frame->kept[queue->next++ % YB_KEPT];
    kept->edge[0] = part->edge[0];
    kept->edge[1] = part->edge[1];
    kept->edge[2] = part->edge[2];
    kept->bulge = part->bulge;
}
