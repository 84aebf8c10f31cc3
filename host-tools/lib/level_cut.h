/* Isolines of a map's reference surface at one height, without building the surface: of each base
 * triangle only those parts are refined that the height can pass through. A search asks for them
 * thousands of times.
 */
#ifndef YB_LEVEL_CUT_H
#define YB_LEVEL_CUT_H

#include <yamabiko/yamabiko.h>

#include "isolines.h"

typedef struct yb_level_cut yb_level_cut_t;

/* NULL: out of memory. */
yb_level_cut_t *yb_level_cut_new(void);

/* NULL does nothing. */
void yb_level_cut_free(yb_level_cut_t *cut);

/* The isolines at z_q8 of the surface whose edges are at most longest_q8 long: the lines of
 * isolines.h, but in lattice steps and in another order. With YB_REFERENCE_Q8 they are those that K
 * is measured on. They belong to the cut, until its next call. NULL: out of memory.
 */
const yb_isolines_t *yb_level_cut_lines(yb_level_cut_t *cut, const yb_map_t *map, int32_t z_q8,
                                        uint16_t longest_q8);

#endif
