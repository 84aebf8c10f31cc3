/* The views of the golden frames: the same on the PC and on every board. */
#ifndef GOLDEN_VIEWS_H
#define GOLDEN_VIEWS_H

#include <yamabiko/yamabiko.h>

#define GOLDEN_VIEWS 9
#define GOLDEN_SHADOW_SIDE 32

const char *golden_view_name(int which);

/* The format of a screen for this view, which usually has another one. */
yb_format_t golden_view_format(int which, yb_format_t usual);

/* Sets up the view `which`, 0 to GOLDEN_VIEWS - 1. Its shadows, if it has any, are valid until the
 * next call; `work` has YB_SHADOW_WORK(GOLDEN_SHADOW_SIDE) bytes and is free afterwards.
 */
void golden_view_set(int which, yb_view_t *view, const yb_map_t *map, uint8_t *work);

#endif
