/* The regions between the contours: what the triangles fall into when the mesh is cut along them.
 *
 * Closed contours and frame-to-frame lines cut the square into regions whose adjacency is a tree,
 * each contour being an edge of it. The triangulation already knows: triangles that share an edge
 * which no contour runs along belong together. Union-find in one array does it in two passes.
 */
#include "mesh.h"

static yb_triangle_t root_of(yb_load_t *load, yb_triangle_t t)
{
    while (load->root[t] != t) {
        load->root[t] = load->root[load->root[t]]; /* halve the path */
        t = load->root[t];
    }
    return t;
}

/* The region to the left of the contour edge from a to b. */
static yb_index_t left_of(const yb_map_t *map, const yb_load_t *load, yb_index_t a, yb_index_t b)
{
    yb_triangle_t t = first_at(map, load, a);
    while (corner_after(map, t, a) != b)
        t = turn_left(map, load, t, a);
    return load->region[t];
}

yb_status_t regions_find(const yb_map_t *map, yb_load_t *load)
{
    for (yb_triangle_t t = 0; t < map->triangle_count; t++)
        load->root[t] = t;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            yb_entry_t u = entry_of(load, t, i);
            if (u >= t) /* each edge once; not across the frame, not across a contour */
                continue;
            /* The smaller index wins: a root is the first triangle of its region. */
            yb_triangle_t a = root_of(load, t);
            yb_triangle_t b = root_of(load, (yb_triangle_t)u);
            load->root[a > b ? a : b] = a > b ? b : a;
        }
    }
    /* From roots to numbers: a triangle's parent has a smaller index, so it is done. */
    load->region_count = 0;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        yb_triangle_t parent = load->root[t];
        load->region[t] = load->region[parent];
        if (parent == t)
            load->region[t] = (yb_index_t)load->region_count++;
    }
    int lines = 0;
    for (int i = 0; i < load->contour_count; i++) {
        yb_contour_t *contour = &load->contour[i];
        yb_index_t a = contour->first;
        yb_index_t b = (yb_index_t)(a + 1);
        if (contour->count > 1) {
            contour->left = left_of(map, load, a, b);
            contour->right = left_of(map, load, b, a);
            lines++;
        } else {
            contour->left = contour->right = load->region[load->star[a]];
        }
    }
    /* Lines that neither cross nor touch cut one region off each: true of every mesh made here. */
    return load->region_count == lines + 1 ? YB_OK : YB_ERR_CORRUPT;
}
