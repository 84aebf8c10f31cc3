/* The views of the golden frames: the same on the PC and on every board. */
#ifndef GOLDEN_VIEWS_H
#define GOLDEN_VIEWS_H

#include <yamabiko/yamabiko.h>

#define GOLDEN_VIEWS 5

const char *golden_view_name(int which);

/* Sets up the view `which`, 0 to GOLDEN_VIEWS - 1. */
void golden_view_set(int which, yb_view_t *view, const yb_map_t *map);

#endif
