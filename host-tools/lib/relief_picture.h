/* A shaded picture of any mesh, seen as the engine would see it: for reliefs that are no code, to
 * be laid beside the engine's pictures. In floating point, so its pixels are not the engine's, but
 * the camera, the sun, the scale of hues by height and the light by the normal are.
 */
#ifndef YB_RELIEF_PICTURE_H
#define YB_RELIEF_PICTURE_H

#include "picture.h"
#include "surface.h"

/* Draws onto a picture of three channels. `map` gives the unit of the view and the heights of the
 * lowest and the highest hue. The ground alone: no walls, no water; triangles that come nearer to
 * the eye than half a step are left out. False: no memory.
 */
bool yb_relief_picture_draw(yb_picture_t *picture, const yb_mesh_t *mesh, const yb_map_t *map,
                            const yb_view_t *view);

#endif
