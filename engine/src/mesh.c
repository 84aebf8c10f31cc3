/* The mesh while it is being built: what every stage of loading asks of it. */
#include "mesh.h"

int corner_of(const yb_map_t *map, yb_triangle_t t, yb_index_t v)
{
    return map->triangle[t][0] == v ? 0 : map->triangle[t][1] == v ? 1 : 2;
}

yb_index_t corner_after(const yb_map_t *map, yb_triangle_t t, yb_index_t v)
{
    return map->triangle[t][next3(corner_of(map, t, v))];
}

yb_index_t corner_before(const yb_map_t *map, yb_triangle_t t, yb_index_t v)
{
    return map->triangle[t][prev3(corner_of(map, t, v))];
}

yb_entry_t entry_of(const yb_load_t *load, yb_triangle_t t, int edge)
{
    return (yb_entry_t)(load->across[t] >> (edge * ENTRY_BITS)) & ENTRY_ALL;
}

void set_entry(yb_load_t *load, yb_triangle_t t, int edge, yb_entry_t entry)
{
    int shift = edge * ENTRY_BITS;
    yb_across_t others = load->across[t] & ~((yb_across_t)ENTRY_ALL << shift);
    load->across[t] = others | (yb_across_t)entry << shift;
}

bool on_frame(const yb_map_t *map, const yb_vertex_t *v)
{
    return v->x_q8 == 0 || v->y_q8 == 0 || v->x_q8 == map->east_q8 || v->y_q8 == map->north_q8;
}

int32_t area_of(const yb_vertex_t *a, const yb_vertex_t *b, const yb_vertex_t *c)
{
    int32_t abx = fix_minus(b->x_q8, a->x_q8) >> 2;
    int32_t aby = fix_minus(b->y_q8, a->y_q8) >> 2;
    int32_t acx = fix_minus(c->x_q8, a->x_q8) >> 2;
    int32_t acy = fix_minus(c->y_q8, a->y_q8) >> 2;
    return abx * acy - aby * acx;
}

int32_t orientation(const yb_map_t *map, yb_index_t a, yb_index_t b, yb_index_t c)
{
    return area_of(&map->vertex[a], &map->vertex[b], &map->vertex[c]);
}

int32_t edge_length(const yb_map_t *map, yb_index_t a, yb_index_t b)
{
    const yb_vertex_t *v = map->vertex;
    return fix_length(fix_minus(v[b].x_q8, v[a].x_q8), fix_minus(v[b].y_q8, v[a].y_q8));
}

yb_triangle_t turn_left(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, yb_index_t v)
{
    return neighbour_of(load, t, prev3(corner_of(map, t, v)));
}

yb_triangle_t turn_right(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, yb_index_t v)
{
    return neighbour_of(load, t, corner_of(map, t, v));
}

yb_triangle_t first_at(const yb_map_t *map, const yb_load_t *load, yb_index_t v)
{
    yb_triangle_t t = load->star[v];
    if (!on_frame(map, &map->vertex[v]))
        return turn_left(map, load, t, v); /* the one that a whole turn to the right would end at */
    for (;;) {
        yb_triangle_t before = turn_right(map, load, t, v);
        if (before == NO_TRIANGLE)
            return t;
        t = before;
    }
}

yb_triangle_t turn_on(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, yb_index_t v,
                      yb_triangle_t first)
{
    t = turn_left(map, load, t, v);
    return t == first ? NO_TRIANGLE : t;
}

yb_triangle_t across(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int i,
                     int *corner)
{
    yb_triangle_t u = neighbour_of(load, t, i);
    *corner = prev3(corner_of(map, u, map->triangle[t][next3(i)]));
    return u;
}

yb_index_t apex_across(const yb_map_t *map, const yb_load_t *load, yb_triangle_t t, int i)
{
    int apex = 0;
    yb_triangle_t u = across(map, load, t, i, &apex);
    return map->triangle[u][apex];
}

bool is_flat(const yb_map_t *map, yb_triangle_t t)
{
    const yb_index_t *v = map->triangle[t];
    return map->vertex[v[0]].z_q8 == map->vertex[v[1]].z_q8 &&
           map->vertex[v[0]].z_q8 == map->vertex[v[2]].z_q8;
}

yb_status_t mesh_add_vertex(yb_map_t *map, yb_load_t *load, uint16_t x_q8, uint16_t y_q8,
                            int32_t z_q8)
{
    if (map->vertex_count >= load->vertices_promised)
        return YB_ERR_LIMIT;
    yb_vertex_t *v = &map->vertex[map->vertex_count];
    v->x_q8 = x_q8;
    v->y_q8 = y_q8;
    v->z_q8 = z_q8;
    map->vertex_count++;
    return YB_OK;
}

uint32_t mesh_edge_key(const yb_map_t *map, yb_triangle_t t, int i)
{
    uint32_t a = map->triangle[t][i];
    uint32_t b = map->triangle[t][next3(i)];
    return a < b ? a << 16 | b : b << 16 | a;
}
