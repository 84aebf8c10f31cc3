/* A map's base mesh drawn in plan, for people to look at: the coded lines, what the rules made of
 * them, the triangles. North is up; places are steps of the map's lattice from the frame's
 * north-west corner.
 *
 * In SVG each kind of thing is one path, of a class with the rule's name (contour, summit, saddle,
 * slope, skeleton, none), `points` beside it for vertices; a line of the path is an edge or a
 * point. Each contour and each triangle is a path by itself (contour; triangle, flat).
 */
#ifndef YB_MESH_DRAWING_H
#define YB_MESH_DRAWING_H

#include <yamabiko/yamabiko.h>

#include "error.h"

typedef enum {
    YB_STAGE_CONTOURS, /* the lines and spot heights by their heights, ticks on the lower side */
    YB_STAGE_LINKS,    /* the same in grey, and what the rules added in their colours */
    YB_STAGE_TRIANGLES /* all triangles in the colours of heights, flat ones in pink */
} yb_stage_t;

typedef struct {
    yb_stage_t stage;
    uint32_t width;   /* pixels of the page (plain: of the map's longer side) … */
    bool plain;       /* the plan alone, without title and legend */
    const char *name; /* of the map, for the title */
} yb_mesh_drawing_t;

enum {
    YB_MESH_DRAWING_LEAST = 600,
    YB_MESH_DRAWING_MOST = 8000
};

/* True if the path ends as a drawing does: .svg or .png. */
bool yb_mesh_drawing_named(const char *path);

/* Writes a PNG file if the path ends .png, else SVG; load as the map's loading left it. False with
 * a sentence. The cost is linear in the vertices.
 */
bool yb_mesh_drawing_write(const char *path, bool force, const yb_map_t *map, const yb_load_t *load,
                           const yb_mesh_drawing_t *request, yb_error_t *error);

#endif
