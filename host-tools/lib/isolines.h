/* Isolines of a triangle mesh (quasi-coding paper 4.1, equations 14 to 17): the plane z = h cuts
 * every triangle that has corners on both sides of it, the cut's ends lie on the triangle's edges
 * by linear interpolation, and cuts that share an edge are chained into lines.
 *
 * A corner exactly at h counts as above. So every triangle is cut once or not at all, an edge
 * carries one end of at most two cuts, and a line can neither fork nor stop: it is closed, or it
 * runs from boundary to boundary of the mesh. Lines run with the higher ground on their left, so a
 * hill is walked round counter-clockwise. A flat area at h is left outside the higher ground's line
 * only where it meets lower ground. A line of no extent (a lone corner at h) is left out.
 */
#ifndef YB_ISOLINES_H
#define YB_ISOLINES_H

#include <stdbool.h>
#include <stddef.h>

#include "surface.h"

typedef struct {
    double x, y;
} yb_point2_t;

typedef struct {
    yb_point2_t *point; /* no two neighbours are equal */
    size_t count;
    double height_m;
    bool closed; /* the last point is joined to the first, which is not repeated */
} yb_isoline_t;

typedef struct {
    yb_isoline_t *line;
    size_t count;
} yb_isolines_t;

/* Appends the isolines at one height to *lines, which starts as {0}. The order of the lines depends
 * on the mesh alone. False: no memory; what is in *lines stays valid.
 */
bool yb_isolines_add(yb_isolines_t *lines, const yb_mesh_t *mesh, double height_m);

/* The lines of one height, which were added together: a view into *lines, not to be freed. */
yb_isolines_t yb_isolines_at(const yb_isolines_t *lines, double height_m);

void yb_isolines_free(yb_isolines_t *lines);

#endif
