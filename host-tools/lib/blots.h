/* What of the ink is no line: dirt, and the marks of summits. */
#ifndef YB_BLOTS_H
#define YB_BLOTS_H

#include "contour_lines.h"
#include "ink.h"

typedef struct {
    int count, room;
    yb_place_t *place; /* pixels from the left and from the top */
} yb_blots_t;

/* Takes all spots out of the ink that are smaller than a line and a half is thick, and those that
 * are as broad as long, without a hole, and up to eight lines thick: these are the marks, and
 * `marks` gets their centres. False: out of memory. Free the marks' places in any case.
 */
bool yb_blots_take(yb_ink_t *ink, yb_blots_t *marks);

/* Adds a mark. False: out of memory. */
bool yb_blots_add(yb_blots_t *marks, yb_place_t at);

/* The longest that a mark may be, in pixels. */
double yb_blots_largest(const yb_ink_t *ink);

#endif
