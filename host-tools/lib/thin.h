/* Drawn lines as lines one pixel wide. */
#ifndef YB_THIN_H
#define YB_THIN_H

#include "ink.h"

/* Thins the ink, in time proportional to its area, by the two conditions of Z. Guo and R. W. Hall,
 * "Parallel thinning with two-subiteration algorithms", Comm. ACM 32 (1989); then takes off spurs
 * that are shorter than a line is thick twice. Afterwards a pixel with one neighbour ends a line,
 * one with two is on a line, one with three or more is a fork. False: out of memory.
 */
bool yb_thin(yb_ink_t *ink);

/* How many of the eight neighbours are ink. */
int yb_thin_neighbours(const yb_ink_t *ink, const int32_t step[8], int32_t at);

#endif
