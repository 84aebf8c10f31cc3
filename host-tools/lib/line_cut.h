/* Cutting contour lines to a frame and joining their pieces, by GEOS. */
#ifndef YB_LINE_CUT_H
#define YB_LINE_CUT_H

#include "contour_lines.h"

#include <ogr_api.h>

/* Adds the lines of one height to `lines`: `geometry` is a collection of line strings in the
 * frame's metres, in any order and any pieces. Ends nearer than snap_m to the frame are moved onto
 * it; lines that end elsewhere are closed if the gap is small, otherwise counted as dropped.
 */
bool yb_line_cut(yb_lines_t *lines, double height_m, OGRGeometryH geometry, double snap_m,
                 yb_error_t *error);

#endif
