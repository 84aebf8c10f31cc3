/* What the rules of a region share: its lines, and the peaks behind them. While they are applied
 * the region is load->here, and load->way_to[r] is the line of it that leads to region r.
 */
#ifndef YB_LINKS_H
#define YB_LINKS_H

#include <stddef.h>

#include "mesh.h"

enum {
    NOWHERE = YB_MAX_CONTOURS /* no line leads there */
};

static inline bool is_line(const yb_contour_t *contour)
{
    return contour->count > 1;
}

static inline int number_of(const yb_load_t *load, const yb_contour_t *contour)
{
    return (int)(contour - load->contour);
}

/* Its height. */
int32_t height_of(const yb_load_t *load, const yb_contour_t *contour);

/* Does this contour, as a line, bound the region? */
bool bounds(const yb_load_t *load, const yb_contour_t *contour);

/* The next line round the region, the first one after NULL; NULL: there is none. */
const yb_contour_t *line_after(const yb_load_t *load, const yb_contour_t *line);

/* The line of the region behind which a spot height lies, or NULL. */
const yb_contour_t *line_before(const yb_load_t *load, const yb_contour_t *spot);

/* 5.1 and 7: link points between neighbouring peaks. False: there is no room for them. */
YB_MUST_CHECK bool saddles_add(yb_load_t *load);

#endif
