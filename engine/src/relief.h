/* The surface between the vertices, as a function of the edge alone (SPEC 3).
 *
 * Whether an edge can be split, where its midpoint lies and how high: all of it follows from the
 * edge's two ends and the map's constants, and is bit-equal for (a, b) and (b, a). So two triangles
 * that share an edge always agree, and no adjacency is stored.
 */
#ifndef YB_RELIEF_H
#define YB_RELIEF_H

#include <yamabiko/yamabiko.h>

#include "fix.h"

/* The length class of an edge: two to an octave of its squared half length. With |dx|, |dy| below
 * 2^16 the square is below 2^31 and the class at most 61.
 */
static inline int relief_class(int32_t dx, int32_t dy)
{
    dx = fix_abs(dx) >> 1;
    dy = fix_abs(dy) >> 1;
    uint32_t square = (uint32_t)(dx * dx) + (uint32_t)(dy * dy);
    if (square < 2)
        return 0;
    int top = fix_log2_floor(square);
    return 2 * top + (int)(square >> (top - 1) & 1);
}

/* Is the midpoint of an edge of these differences on the 1/256 lattice? */
static inline bool relief_splits(int32_t dx, int32_t dy)
{
    return ((dx | dy) & 1) == 0;
}

/* The midpoint of the edge ab, which relief_splits. */
void relief_middle(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b,
                   yb_vertex_t *middle);

/* What bounds the refinement of a triangle: its smooth part, and the class of its longest edge. */
typedef struct {
    int32_t bulge_q8;
    int longest;
} relief_bound_t;

void relief_bound(const yb_map_t *map, const yb_vertex_t *a, const yb_vertex_t *b,
                  const yb_vertex_t *c, relief_bound_t *bound);

/* How far refinement can move any point of the triangle from its plane, at most, if no edge of a
 * class below `shortest` is split.
 */
int32_t relief_reach(const yb_map_t *map, const relief_bound_t *bound, int shortest);

#endif
