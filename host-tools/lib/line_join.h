/* Pieces of lines that meet end to end become one, also where more than two meet: at a saddle drawn
 * as a cross, or where two lines of a height cross by mistake. Lines part there without crossing.
 */
#ifndef YB_LINE_JOIN_H
#define YB_LINE_JOIN_H

#include "contour_lines.h"

/* At least two places; a closed piece has the same place at both ends. */
typedef struct {
    yb_place_t *place;
    int count;
} yb_piece_t;

/* Joins what meets at exactly the same place; the places, each a block of its own, are moved or
 * freed. Answers how many pieces there are then, -1: out of memory, and the pieces are as before.
 */
int yb_line_join(yb_piece_t *piece, int count);

#endif
