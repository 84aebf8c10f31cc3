/* Contour lines from a drawn sheet.
 *
 *     PNG ─► ink ─► without marks ─► thinned ─► strokes ─► closed lines and lines from side to side
 *                     (blots)        (thin)    (strokes)      │
 *                                        heights (nesting) ◄──┘
 *
 * Lines are dark on light, one to a dozen pixels thick, and neither meet nor end in the middle of
 * the sheet; small gaps are closed. A blot on its own, one and a half to eight lines thick, about
 * as broad as long and not a ring, marks a summit. The sheet's frame is the edge of the picture,
 * or the rectangle drawn along all four sides; one that
 * is too crooked for that, but that no line meets, is left out.
 */
#ifndef YB_SCAN_H
#define YB_SCAN_H

#include "contour_lines.h"

/* What a sheet does not tell. */
typedef struct {
    double base_m;     /* height of the outermost lines */
    double interval_m; /* from one line to the next, above 0 */
    double cell_m;     /* size of a pixel; 0: YB_GRID_DEFAULT_CELL_M */
} yb_scan_scale_t;

/* True for a PNG of at most 8 bits a channel that does not say where on earth it lies; one of 16
 * bits, or a placed one, holds heights.
 */
bool yb_scan_is(const char *path);

/* The lines of a sheet and its summits as spot heights; heights are those of yb_nesting_heights.
 * Takes at most eight bytes of memory a pixel. NULL with a sentence: the file is not readable,
 * there is no line, lines meet or are left open.
 */
yb_lines_t *yb_lines_from_scan(const char *path, const yb_scan_scale_t *scale, yb_error_t *error);

#endif
