/* What the rules of a region share: the region, its lines, and the peaks behind them. */
#ifndef YB_LINKS_H
#define YB_LINKS_H

#include "mesh.h"

enum {
    NOWHERE = YB_MAX_CONTOURS /* no line leads there */
};

/* A region while its rules are applied; load->way_to[r] is the line of it that leads to region r.
 */
typedef struct {
    yb_map_t *map;
    yb_load_t *load;
    yb_index_t region;
} place_t;

/* Spot heights: those of the code and those that were added. */
static inline int all_contours(const yb_load_t *load)
{
    return load->contour_count + load->summit_count;
}

static inline bool is_line(const yb_contour_t *contour)
{
    return contour->count > 1;
}

static inline const yb_vertex_t *first_of(const place_t *place, int contour)
{
    return &place->map->vertex[place->load->contour[contour].first];
}

/* Its height. */
int32_t height_of(const place_t *place, int contour);

/* Does this contour, as a line of height h, bound the region? */
bool bounds_at(const place_t *place, int contour, int32_t h);

/* Does this contour, as a line, bound the region? */
bool bounds(const place_t *place, int contour);

/* The line of the region behind which spot height s lies, or NOWHERE. */
int line_before(const place_t *place, int s);

/* 5.1 and 7: link points between neighbouring peaks. */
YB_MUST_CHECK yb_status_t saddles_add(const place_t *place);

#endif
