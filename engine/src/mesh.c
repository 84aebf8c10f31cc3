/* The mesh while it is being built: what every stage of loading asks of it. */
#include "mesh.h"

half_t next_of(half_t e)
{
    return (e & 2) != 0 ? e - 2 : e + 1;
}

half_t last_of(half_t e)
{
    return (e & 3) != 0 ? e - 1 : e + 2;
}

half_t half_after(const yb_load_t *load, half_t e)
{
    e += 1 + (e >> 1 & 1); /* there is no edge 3 */
    return triangle_of(e) < (int)load->map->triangle_count ? e : NO_HALF;
}

int region_of(const yb_load_t *load, half_t e)
{
    return load->region[triangle_of(e)];
}

int region_at(const yb_load_t *load, int v)
{
    return load->region[load->star[v]];
}

int origin_of(const yb_load_t *load, half_t e)
{
    return load->corners[e - triangle_of(e)];
}

int end_of(const yb_load_t *load, half_t e)
{
    return origin_of(load, (e & 2) != 0 ? e - 2 : e + 1);
}

int apex_of(const yb_load_t *load, half_t e)
{
    return origin_of(load, last_of(e));
}

int32_t height_at(const yb_load_t *load, int v)
{
    return vertex_of(load, v)->z_q8;
}

int entry_of(const yb_load_t *load, half_t e)
{
    return (int)(load->across[e >> 2] >> (e & 3) * ENTRY_BITS) & ENTRY_ALL;
}

void set_entry(yb_load_t *load, half_t e, int entry)
{
    yb_across_t *word = &load->across[e >> 2];
    int shift = (e & 3) * ENTRY_BITS;
    *word = (*word & ~((yb_across_t)ENTRY_ALL << shift)) | (yb_across_t)entry << shift;
}

half_t half_at(const yb_load_t *load, int t, int v)
{
    const yb_index_t *corner = &load->corners[3 * t];
    return 4 * t + (corner[0] == v ? 0 : corner[1] == v ? 1 : 2);
}

half_t twin_of(const yb_load_t *load, half_t e)
{
    int t = entry_of(load, e) & NO_TRIANGLE;
    if (t == NO_TRIANGLE)
        return NO_HALF;
    return half_at(load, t, end_of(load, e));
}

half_t spoke_left(const yb_load_t *load, half_t e)
{
    return twin_of(load, last_of(e));
}

half_t first_spoke(const yb_load_t *load, int v)
{
    half_t e = half_at(load, (int)load->star[v], v);
    if (!on_frame(load, vertex_of(load, v)))
        return spoke_left(load, e); /* the one that a whole turn to the right would end at */
    for (;;) {
        half_t right = twin_of(load, e);
        if (right == NO_HALF)
            return e;
        e = next_of(right);
    }
}

half_t spoke_after(const yb_load_t *load, half_t e)
{
    int v = origin_of(load, e);
    bool last = (int)load->star[v] == triangle_of(e) && !on_frame(load, vertex_of(load, v));
    return last ? NO_HALF : spoke_left(load, e);
}

int neighbour_after(const yb_load_t *load, half_t *e)
{
    if (*e == NO_HALF)
        return -1;
    int q = apex_of(load, *e);
    *e = spoke_after(load, *e);
    return q;
}

half_t spoke_to(const yb_load_t *load, int a, int b)
{
    half_t e = first_spoke(load, a);
    while (end_of(load, e) != b)
        e = spoke_left(load, e);
    return e;
}

bool on_frame(const yb_load_t *load, const yb_vertex_t *v)
{
    const yb_map_t *map = load->map;
    return v->x_q8 == 0 || v->y_q8 == 0 || v->x_q8 == map->east_q8 || v->y_q8 == map->north_q8;
}

bool is_open(const yb_load_t *load, const yb_contour_t *contour)
{
    return on_frame(load, vertex_of(load, contour->first));
}

void find_way(const yb_load_t *load, int a, int b, int32_t way[3])
{
    const yb_vertex_t *v = vertex_of(load, a);
    const yb_vertex_t *w = vertex_of(load, b);
    way[0] = fix_minus(w->x_q8, v->x_q8) >> 2;
    way[1] = fix_minus(w->y_q8, v->y_q8) >> 2;
    way[2] = w->z_q8 - v->z_q8;
}

int32_t area_of(const yb_vertex_t *a, const yb_vertex_t *b, const yb_vertex_t *c)
{
    int32_t abx = fix_minus(b->x_q8, a->x_q8) >> 2;
    int32_t aby = fix_minus(b->y_q8, a->y_q8) >> 2;
    int32_t acx = fix_minus(c->x_q8, a->x_q8) >> 2;
    int32_t acy = fix_minus(c->y_q8, a->y_q8) >> 2;
    return abx * acy - aby * acx;
}

int32_t orientation(const yb_load_t *load, int a, int b, int c)
{
    return area_of(vertex_of(load, a), vertex_of(load, b), vertex_of(load, c));
}

int32_t side_of(const yb_load_t *load, half_t e, const yb_vertex_t *p)
{
    return area_of(vertex_of(load, origin_of(load, e)), vertex_of(load, end_of(load, e)), p);
}

void find_angle(const yb_load_t *load, half_t e, angle_t *angle)
{
    int o = apex_of(load, e);
    int32_t a[3];
    int32_t b[3];
    find_way(load, o, origin_of(load, e), a);
    find_way(load, o, end_of(load, e), b);
    angle->area = a[0] * b[1] - a[1] * b[0];
    angle->dot = a[0] * b[0] + a[1] * b[1];
}

int32_t edge_length(const yb_load_t *load, int a, int b)
{
    const yb_vertex_t *v = vertex_of(load, a);
    const yb_vertex_t *w = vertex_of(load, b);
    return fix_length(fix_minus(v->x_q8, w->x_q8), fix_minus(v->y_q8, w->y_q8));
}

int32_t half_length(const yb_load_t *load, half_t e)
{
    return edge_length(load, origin_of(load, e), end_of(load, e));
}

int32_t rise_of(const yb_load_t *load, half_t e)
{
    return height_at(load, end_of(load, e)) - height_at(load, origin_of(load, e));
}

uint32_t edge_key(const yb_load_t *load, half_t e)
{
    uint32_t a = (uint32_t)origin_of(load, e);
    uint32_t b = (uint32_t)end_of(load, e);
    return a < b ? a << 16 | b : b << 16 | a;
}

void find_middle_of(const yb_vertex_t *a, const yb_vertex_t *b, yb_vertex_t *middle)
{
    middle->x_q8 = fix_middle(a->x_q8, b->x_q8);
    middle->y_q8 = fix_middle(a->y_q8, b->y_q8);
}

void find_middle(const yb_load_t *load, half_t e, yb_vertex_t *middle)
{
    const yb_vertex_t *a = vertex_of(load, origin_of(load, e));
    find_middle_of(a, vertex_of(load, end_of(load, e)), middle);
    middle->z_q8 = a->z_q8;
}

bool mesh_add_vertex(yb_load_t *load, const yb_vertex_t *at)
{
    if (load->vertex_count >= load->vertices_promised)
        return false;
    yb_vertex_t *v = &load->vertex[load->vertex_count++];
    v->x_q8 = at->x_q8;
    v->y_q8 = at->y_q8;
    v->z_q8 = at->z_q8;
    return true;
}
