/* Thinned ink followed into lines.
 *
 * Places are pixels of the sheet: (0, 0) is its north-western corner, (width, height) the
 * south-eastern one, a pixel's centre lies at halves. Ends that face each other across a small gap
 * are joined in the direction in which they run; ends near the sheet's edge are led onto it.
 */
#ifndef YB_STROKES_H
#define YB_STROKES_H

#include "blots.h"
#include "contour_lines.h"
#include "ink.h"

typedef struct {
    bool closed; /* else both ends lie exactly on the edge of the sheet */
    int count;
    yb_place_t *place;
} yb_stroke_t;

typedef struct {
    int count;
    yb_stroke_t *stroke;
} yb_strokes_t;

/* Follows what yb_thin left, which must not have forks. Short strokes that lead nowhere are added
 * to the marks. False with a sentence that names the file: lines are left open, or no memory. Free
 * the strokes by yb_strokes_free in any case.
 */
bool yb_strokes_follow(yb_strokes_t *strokes, yb_ink_t *ink, yb_blots_t *marks, const char *path,
                       yb_error_t *error);

void yb_strokes_free(yb_strokes_t *strokes);

#endif
