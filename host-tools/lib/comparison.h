/* A code beside the real relief it stands for: both as heights at the real relief's cells, as
 * meshes and as isolines at the coded heights. What fidelity is measured on and what the result
 * sheet shows. The real relief is laid on the map's frame, corner on corner.
 */
#ifndef YB_COMPARISON_H
#define YB_COMPARISON_H

#include "code_file.h"
#include "contour_lines.h"
#include "grid.h"
#include "isolines.h"
#include "surface.h"

typedef struct {
    uint32_t columns, rows; /* the real relief's cells; row 0 of the heights is in the south */
    double east_m, north_m; /* size of the frame, which runs through the outermost cells' centres */
    float *reference_m;     /* the real relief */
    float *smooth_m;        /* the reference surface without detail */
    float *detail_m;        /* and with it */
    yb_mesh_t reference;    /* the real relief */
    yb_mesh_t surface;      /* the reference surface with detail */
    yb_isolines_t coded;    /* the code's polygons, spot heights left out */
    yb_isolines_t original; /* of the real relief, at the coded heights */
    yb_isolines_t reproduced;
} yb_comparison_t;

/* The original lines are the isolines of the reference's grid, or `lines` if these are what it was
 * made from: those within half a unit of height of a coded one. NULL: a real relief.
 *
 * False with a sentence if the reference's frame has another size than the map's (by more than one
 * part in fifty, or in shape if it does not say how large its cells are), or memory is short.
 */
bool yb_comparison_make(yb_comparison_t *comparison, const yb_code_file_t *file,
                        const yb_grid_t *reference, const yb_lines_t *lines, yb_error_t *error);

void yb_comparison_free(yb_comparison_t *comparison);

#endif
