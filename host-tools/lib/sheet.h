/* The papers' result sheet: a map and the relief it stands for on one page.
 *
 *   given contours     | feature polygons | extracted contours
 *   rebuilt relief     | real relief      | difference of height
 *
 * The given contours are the real relief's isolines at the coded heights in full detail, the
 * extracted ones those of the map's reference surface. The rebuilt relief is the engine's picture,
 * the real one has the same camera (relief_picture.h). The difference is that of the surface
 * without detail. N, M, F, K and the errors stand below.
 */
#ifndef YB_SHEET_H
#define YB_SHEET_H

#include "comparison.h"
#include "fidelity.h"
#include "picture.h"

/* A picture of three channels, to be freed. `name` is the page's title. False: no memory. */
bool yb_sheet_draw(yb_picture_t *sheet, const char *name, const yb_code_file_t *file,
                   const yb_comparison_t *comparison, const yb_fidelity_t *fidelity,
                   const yb_view_t *view);

#endif
