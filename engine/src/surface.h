/* The walk of yb_map_refine, with a stack of the caller's. */
#ifndef YB_SURFACE_H
#define YB_SURFACE_H

#include <yamabiko/yamabiko.h>

typedef struct {
    const yb_vertex_t *corner[3];
    yb_vertex_t middle[3];
    const uint8_t *child; /* the next one: of split_child */
} surface_level_t;

/* As yb_map_refine, but what is still too long after so many levels is handed out as it is. */
void surface_refine(const yb_map_t *map, yb_triangle_t triangle, uint16_t longest_q8,
                    surface_level_t *levels, int count, yb_triangle_fn fn, void *context);

#endif
