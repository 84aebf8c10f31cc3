/* Light and colour: 14 shades of a hue that depends on the height (colour paper). */
#ifndef YB_SHADE_H
#define YB_SHADE_H

#include <yamabiko/yamabiko.h>

#include "raster.h"

/* What a triangle looks like: its pixel value, and its shade without cast shadows. Aligned as a
 * number, it is handed on as one.
 */
typedef struct {
    _Alignas(uint32_t) uint16_t pixel;
    uint16_t light;
} shade_t;

/* Of a triangle of the ground (or of the water, where all three corners are in it). */
shade_t shade_ground(const yb_frame_t *frame, const yb_point_t *const corner[3]);

/* The line that a triangle that looks like this is cut by, if there is one: the shore, or contour
 * lines.
 */
bool shade_cut(const yb_frame_t *frame, const yb_point_t *const corner[3], shade_t shade,
               raster_cut_t *cut);

/* The pixel value of the wall below the edge ab of the frame, ground to its left. */
uint16_t shade_wall(const yb_frame_t *frame, const yb_point_t *a, const yb_point_t *b);

#endif
