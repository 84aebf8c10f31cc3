/* Contour lines on a lattice, none touching another or itself: what docs/SPEC.md 1.5 asks for.
 *
 * Lines are laid one after the other. A line is walked point by point: each goes to the nearest
 * node that the line so far can reach without touching anything, mostly the one nearest to it,
 * where lines are dense perhaps one beside that. Where there is none the line takes a short cut:
 * it goes without as few points as it can. So a line yields to those laid before it; lines that
 * touch are parted, and of two that really cross, the later one keeps to one side. All decisions
 * are made in integers.
 */
#ifndef YB_LINE_LATTICE_H
#define YB_LINE_LATTICE_H

#include "contour_lines.h"

typedef struct yb_line_lattice yb_line_lattice_t;

/* A place of the lattice. */
typedef struct {
    int x, y;
} yb_node_t;

/* What was lost. */
typedef struct {
    int points;   /* that short cuts went without */
    int lines;    /* that could not be laid at all */
    int repeated; /* lines that only said what another of the same height had said before */
} yb_line_loss_t;

/* The lattice's outermost nodes, (0, 0) and (east, north), are the corners of a frame of width_m by
 * depth_m; east and north are 2 to 32767. NULL: out of memory.
 */
yb_line_lattice_t *yb_line_lattice_new(double width_m, double depth_m, int east, int north);

/* NULL does nothing. */
void yb_line_lattice_free(yb_line_lattice_t *lattice);

/* Lays a line: its nodes go to node[0 .. line->count). Answers how many; 1 for a spot height or a
 * closed line too small for the lattice, 0 if nothing of it could be laid, -1: out of memory.
 */
int yb_line_lattice_lay(yb_line_lattice_t *lattice, const yb_line_t *line, yb_node_t *node);

yb_line_loss_t yb_line_lattice_loss(const yb_line_lattice_t *lattice);

#endif
