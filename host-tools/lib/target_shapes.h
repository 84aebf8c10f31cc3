/* Changes that put in or take out a whole line or a spot height, for target_moves.c; and what both
 * files need.
 */
#ifndef YB_TARGET_SHAPES_H
#define YB_TARGET_SHAPES_H

#include "target_moves.h"

bool yb_target_new_line(yb_target_mover_t *mover);

/* Takes out the contour that was picked; puts another line in its place. */
bool yb_target_drop_contour(yb_target_mover_t *mover);
bool yb_target_other_line(yb_target_mover_t *mover);

/* The same line anew, or one near it in height. */
bool yb_target_redraw_line(yb_target_mover_t *mover);

bool yb_target_add_spot(yb_target_mover_t *mover);
bool yb_target_change_spot(yb_target_mover_t *mover);

bool yb_target_is_inner(const yb_contour_set_t *set, int x, int y);
int yb_target_step(yb_target_mover_t *mover);

/* Moves a point of a contour; ends of open lines slide along the frame. False: it cannot go there.
 */
bool yb_target_shift(yb_target_mover_t *mover, int contour, int at, int x, int y);

/* The coded height nearest to a height that lines may have. */
uint16_t yb_target_allowed(const yb_target_mover_t *mover, double height_m);

/* How far the heights of corners and spot heights go, in units. */
double yb_target_spread(const yb_target_mover_t *mover);

#endif
