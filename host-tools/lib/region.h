/* Regions of lines in a rectangular frame, the rectangle from (0, 0) to (east, north).
 *
 * A closed line has one region, its inside. An open line, whose ends lie on the frame, has two,
 * each bounded by the line and by the part of the frame on one side of it.
 */
#ifndef YB_REGION_H
#define YB_REGION_H

#include <geos_c.h>

#include "isolines.h"

/* A region and the line that bounds it, run so that the region is on its left. */
typedef struct {
    yb_point2_t *point;  /* the line, then the part of the frame back to its start */
    size_t count;        /* points of the line; a closed one does not repeat its first point */
    size_t boundary;     /* points of both: all round the region */
    bool closed;         /* the line */
    GEOSGeometry *shape; /* valid: a polygon, or several that touch */
    double area;
} yb_region_t;

/* GEOS without its messages. NULL: no memory. The caller ends it by GEOS_finish_r. */
GEOSContextHandle_t yb_region_geos(void);

/* Regions of a line: regions[0] is the inside, or the left of an open line, regions[1] the right.
 * Returns how many there are; a line that bounds no area has none.
 */
int yb_region_make(GEOSContextHandle_t geos, yb_region_t regions[2], const yb_isoline_t *line,
                   double east, double north);

enum {
    YB_REGION_FRAME_POINTS = 4 * 256 + 8 /* the most that a part of the frame can have */
};

/* Points of the frame between two of its points, counter-clockwise: the corners, and between them
 * as many as it takes to come from one to the next in small steps. Without the two points. Answers
 * how many; `point` has room for YB_REGION_FRAME_POINTS.
 */
size_t yb_region_frame_points(yb_point2_t from, yb_point2_t to, double east, double north,
                              yb_point2_t *point);

/* A region of zeros is left alone. */
void yb_region_free(GEOSContextHandle_t geos, yb_region_t *region);

/* Area of the intersection over area of the union, 0 to 1. */
double yb_region_overlap(GEOSContextHandle_t geos, const yb_region_t *a, const yb_region_t *b);

/* Greatest distance from a point of either region's boundary to the other boundary (Hausdorff),
 * measured at their vertices; where they are the frame, these are 1/256 of its longer side apart or
 * closer. Negative if GEOS fails.
 */
double yb_region_distance(GEOSContextHandle_t geos, const yb_region_t *a, const yb_region_t *b);

#endif
