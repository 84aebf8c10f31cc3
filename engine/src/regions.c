/* The regions between the contours: what the triangles fall into when the mesh is cut along them.
 *
 * Closed contours and frame-to-frame lines cut the square into regions whose adjacency is a tree,
 * each line being an edge of it: it cuts one region off, as lines neither cross nor touch. The
 * triangulation already knows: triangles that share an edge which no contour runs along belong
 * together. Union-find in one array does it in two passes.
 */
#include "mesh.h"

static int root_of(yb_load_t *load, int t)
{
    yb_triangle_t *root = load->scratch->root;
    while ((int)root[t] != t) {
        root[t] = root[root[t]]; /* halve the path */
        t = (int)root[t];
    }
    return t;
}

void regions_find(yb_load_t *load)
{
    const int count = (int)load->map->triangle_count;
    for (int t = 0; t < count; t++)
        load->scratch->root[t] = (yb_triangle_t)t;
    for (half_t e = 0; e != NO_HALF; e = half_after(load, e)) {
        int t = triangle_of(e);
        int u = entry_of(load, e);
        if (u >= t) /* each edge once; not across the frame, not across a contour */
            continue;
        /* The smaller index wins: a root is the first triangle of its region. */
        int a = root_of(load, t);
        int b = root_of(load, u);
        load->scratch->root[fix_max(a, b)] = (yb_triangle_t)fix_min(a, b);
    }
    /* From roots to numbers: a triangle's parent has a smaller index, so it is done. */
    load->region_count = 0;
    for (int t = 0; t < count; t++) {
        int parent = (int)load->scratch->root[t];
        load->region[t] = load->region[parent];
        if (parent == t)
            load->region[t] = (yb_index_t)load->region_count++;
    }
    load->all_contours = load->contour_count;
    for (int i = 0; i < load->contour_count; i++) {
        yb_contour_t *contour = &load->contour[i];
        int a = contour->first;
        contour->left = contour->right = (yb_index_t)region_at(load, a);
        if (contour->count > 1) {
            half_t e = spoke_to(load, a, a + 1);
            contour->left = (yb_index_t)region_of(load, e);
            contour->right = (yb_index_t)region_of(load, twin_of(load, e));
        }
    }
}

int region_beside(const yb_load_t *load, int k)
{
    const yb_contour_t *contour = &load->contour[k >> 1];
    return (k & 1) == 0 ? contour->left : contour->right;
}
