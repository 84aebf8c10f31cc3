/* The standard views: eight ways of looking at any map, for figures, golden frames and benchmarks.
 *
 * Only engine types and integer arithmetic, so that firmware draws the very same frames.
 *
 *   orbit-A     A = 45, 135, 225, 315: azimuth A, elevation 30, 307/256 map widths away
 *   summit-1/2  the eye 1/100 map width above the summit, looking out and down by 1 in 6, one way
 *               and the other along the axis (east-west or north-south) on which the summit lies
 *               farther from the frame; 1 looks east or north, 2 west or south
 *   walk-1/2    the eye 1/100 map width above the ground, or the water, at 1/3 or 2/3 of the
 *               frame's width and height, looking at the summit; where it stands less than 1/16
 *               map width from the summit it looks north instead
 *
 * The summit is the highest point of the reference surface; of several the southernmost, of those
 * the westernmost. A map width is the longer side of the frame.
 */
#ifndef YB_STANDARD_VIEWS_H
#define YB_STANDARD_VIEWS_H

#include <yamabiko/yamabiko.h>

typedef enum {
    YB_ORBIT_45,
    YB_ORBIT_135,
    YB_ORBIT_225,
    YB_ORBIT_315,
    YB_SUMMIT_1,
    YB_SUMMIT_2,
    YB_WALK_1,
    YB_WALK_2,
    YB_STANDARD_VIEWS
} yb_standard_view_t;

/* "orbit-45" and so on; NULL beyond the last. */
const char *yb_standard_view_name(int which);

/* Sets eye, look and azimuth of a view; its scale (exaggerate_q8) and water must be set before. */
void yb_standard_view_set(yb_view_t *view, const yb_map_t *map, yb_standard_view_t which);

#endif
