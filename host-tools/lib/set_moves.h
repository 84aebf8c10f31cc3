/* Random changes of a contour set that both searches try. */
#ifndef YB_SET_MOVES_H
#define YB_SET_MOVES_H

#include "contour_set.h"

/* A height that is higher or lower by a multiple of `unit` that is not 0, mostly within `spread` of
 * them.
 */
uint16_t yb_move_height(uint64_t *random, uint16_t height, double spread, int unit);

/* Raises or lowers a corner, or the frame if no corner is coded, by about `spread` units. False: it
 * was the turn of a corner that is not coded.
 */
bool yb_move_corner(uint64_t *random, yb_contour_set_t *set, double spread);

/* Codes a corner's height, or no longer. */
void yb_move_toggle_corner(uint64_t *random, yb_contour_set_t *set);

/* Another start or direction for a closed line, another direction for an open one: the surface
 * stays, the size does not.
 */
void yb_move_turn(uint64_t *random, yb_contour_set_t *set, int line);

#endif
