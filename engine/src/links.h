/* What the rules of a region share: its lines, and the peaks behind them. While they are applied
 * the region is load->here, and load->way_to[r] is the line of it that leads to region r.
 */
#ifndef YB_LINKS_H
#define YB_LINKS_H

#include "mesh.h"

enum {
    NOWHERE = YB_MAX_CONTOURS /* no line leads there */
};

/* Spot heights: those of the code and those that were added. */
static inline int all_contours(const yb_load_t *load)
{
    return load->contour_count + load->summit_count;
}

static inline bool is_line(const yb_contour_t *contour)
{
    return contour->count > 1;
}

static inline const yb_vertex_t *first_of(const yb_load_t *load, int contour)
{
    return &load->map->vertex[load->contour[contour].first];
}

/* Its height. */
int32_t height_of(const yb_load_t *load, int contour);

/* Does this contour, as a line of height h, bound the region? */
bool bounds_at(const yb_load_t *load, int contour, int32_t h);

/* Does this contour, as a line, bound the region? */
bool bounds(const yb_load_t *load, int contour);

/* The line of the region behind which spot height s lies, or NOWHERE. */
int line_before(const yb_load_t *load, int s);

/* 5.1 and 7: link points between neighbouring peaks. */
YB_MUST_CHECK yb_status_t saddles_add(yb_load_t *load);

#endif
