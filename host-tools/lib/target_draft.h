/* Where the search for a similarity begins: a lattice, units, the summit and a few lines. */
#ifndef YB_TARGET_DRAFT_H
#define YB_TARGET_DRAFT_H

#include "encode_task.h"
#include "levels.h"
#include "target_search.h"

typedef struct {
    const yb_grid_t *grid;
    const yb_encode_task_t *task;
    double dimension;
    const yb_levels_t *levels; /* that lines must have */
} yb_target_draft_t;

/* The spacing nearest to the wanted one on which the frame keeps its shape. */
int yb_target_draft_spacing(const yb_target_draft_t *draft, int wanted);

/* A code with the summit alone. False: there is no place for it. */
bool yb_target_draft_begin(const yb_target_draft_t *draft, yb_contour_set_t *set, int spacing);

/* Adds the longest lines at so many heights, as far as they fit beside each other. */
void yb_target_draft_lines(const yb_target_search_t *search, yb_contour_set_t *set, int count);

#endif
