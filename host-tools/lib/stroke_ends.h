/* Where the loose ends of strokes lead. */
#ifndef YB_STROKE_ENDS_H
#define YB_STROKE_ENDS_H

#include "ink.h"
#include "strokes.h"

enum {
    YB_END_LOOSE = -1,
    YB_END_EDGE = -2
};

typedef struct {
    yb_place_t at;
    double dx, dy;   /* the way the stroke runs there, of length 1 */
    int partner;     /* number of the end that it is joined to, or one of the above */
    yb_place_t edge; /* where it meets the edge of the sheet, if it does */
    bool used;       /* false: the stroke is a ring and has no ends */
} yb_end_t;

/* Finds the ends of the strokes: number 2 i begins stroke i, 2 i + 1 ends it; and where each leads.
 * False: out of memory, or too many ends to be lines (`many` says so).
 */
bool yb_ends_find(yb_end_t *end, const yb_strokes_t *strokes, const yb_ink_t *ink, bool *many);

#endif
