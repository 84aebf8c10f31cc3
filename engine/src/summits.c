/* A summit for every region that has none (faithful paper, section 3: "every peak has its summit").
 *
 * A region all of whose points lie at one height (the inside of an innermost contour, a ring
 * between two contours of one height, a corner that a line cuts off the frame) would be a plateau.
 * It gets a spot height at its widest place: a summit if the ground rises towards it from outside,
 * the bottom of a pit if it falls.
 */
#include "fix.h"
#include "mesh.h"

yb_status_t mesh_add_vertex(yb_map_t *map, yb_load_t *load, uint16_t x_q8, uint16_t y_q8,
                            int32_t z_q8)
{
    if (map->vertex_count >= load->vertices_promised)
        return YB_ERR_LIMIT;
    yb_vertex_t *v = &map->vertex[map->vertex_count];
    v->x_q8 = x_q8;
    v->y_q8 = y_q8;
    v->z_q8 = fix_clamp(z_q8, -YB_MAX_HEIGHT_Q8, YB_MAX_HEIGHT_Q8);
    map->vertex_count++;
    return YB_OK;
}

static bool is_flat(const yb_map_t *map, yb_triangle_t t)
{
    const yb_index_t *v = map->triangle[t];
    return map->vertex[v[0]].z_q8 == map->vertex[v[1]].z_q8 &&
           map->vertex[v[0]].z_q8 == map->vertex[v[2]].z_q8;
}

static int32_t edge_length(const yb_map_t *map, yb_index_t a, yb_index_t b)
{
    const yb_vertex_t *v = map->vertex;
    return fix_length(v[b].x_q8 - v[a].x_q8, v[b].y_q8 - v[a].y_q8);
}

static bool share_line(const yb_load_t *load, yb_triangle_t r, yb_triangle_t s)
{
    for (int c = 0; c < load->contour_count; c++) {
        const yb_contour_t *line = &load->contour[c];
        if ((line->left == r && line->right == s) || (line->left == s && line->right == r))
            return true;
    }
    return false;
}

/* The same where all ground next to the lines is flat too: from the nearest other height in the
 * regions beyond them.
 */
static int32_t rise_farther_out(const yb_map_t *map, const yb_load_t *load, yb_triangle_t region,
                                int32_t h)
{
    int32_t rise = 0;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            int32_t up = h - map->vertex[map->triangle[t][i]].z_q8;
            if (up != 0 && (rise == 0 || fix_abs(up) < fix_abs(rise)) &&
                share_line(load, load->region[t], region))
                rise = up;
        }
    }
    return rise;
}

/* How much the ground rises, on the mean along the lines round a flat region, from the next points
 * outside to the region: one interval where lines lie regularly. Where it rises on one side as much
 * as it falls on the other, it is taken to rise. 0: it does neither. Lengths are below 2^17 and
 * rises 2^18, so each term is below 2^35.
 */
static int32_t rise_outside(const yb_map_t *map, const yb_load_t *load, yb_triangle_t region)
{
    int32_t h = 0;
    int64_t rise = 0;
    int64_t change = 0;
    int64_t length = 0;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        for (int i = 0; i < 3 && load->region[t] == region; i++) {
            if (mark_of(load, t, i) != YB_RULE_CONTOUR)
                continue;
            yb_index_t a = map->triangle[t][i];
            yb_index_t b = map->triangle[t][next3(i)];
            h = map->vertex[a].z_q8;
            yb_triangle_t u = neighbour_of(load, t, i);
            yb_index_t outside = map->triangle[u][prev3(corner_of(map, u, b))];
            int32_t up = h - map->vertex[outside].z_q8;
            if (up == 0)
                continue;
            rise += (int64_t)edge_length(map, a, b) * up;
            change += (int64_t)edge_length(map, a, b) * fix_abs(up);
            length += edge_length(map, a, b);
        }
    }
    if (length == 0)
        return rise_farther_out(map, load, region, h);
    return (int32_t)(rise < 0 ? -change / length : change / length);
}

/* Where a region is widest, as far as its triangles tell. */
typedef struct {
    yb_triangle_t t;
    int edge;     /* the longest edge that no line runs along, or -1: t is all there is */
    int32_t wide; /* its length */
} widest_t;

static void find_widest(const yb_map_t *map, const yb_load_t *load, yb_triangle_t region,
                        widest_t *widest)
{
    *widest = (widest_t){.wide = -1};
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        if (load->region[t] != region)
            continue;
        if (widest->wide < 0) {
            widest->t = t;
            widest->edge = -1;
            widest->wide = 0;
        }
        for (int i = 0; i < 3; i++) {
            if (load->neighbour[t][i] >= NO_TRIANGLE)
                continue;
            int32_t wide = edge_length(map, map->triangle[t][i], map->triangle[t][next3(i)]);
            if (wide > widest->wide) {
                widest->wide = wide;
                widest->t = t;
                widest->edge = i;
            }
        }
    }
}

/* Twice the cosine of the angle at c in triangle abc, times |ca| |cb|: its sign. */
static bool is_acute(const yb_map_t *map, yb_index_t a, yb_index_t b, yb_index_t c)
{
    const yb_vertex_t *v = map->vertex;
    int64_t x = (int64_t)(v[a].x_q8 - v[c].x_q8) * (v[b].x_q8 - v[c].x_q8);
    int64_t y = (int64_t)(v[a].y_q8 - v[c].y_q8) * (v[b].y_q8 - v[c].y_q8);
    return x + y > 0;
}

/* The widest place: in the middle of the longest edge; or, where that edge's triangle is acute (no
 * edge of it is longer), in the triangle's middle, with double weight at the corner opposite. That
 * corner's quarter and half weights keep a quarter-step lattice.
 */
static yb_status_t place_summit(yb_map_t *map, yb_load_t *load, const widest_t *widest, int32_t z)
{
    yb_triangle_t t = widest->t;
    int edge = widest->edge;
    int i = edge;
    if (edge < 0) { /* opposite the longest edge, so that it is the largest angle */
        i = 0;
        for (int k = 1; k < 3; k++) {
            if (edge_length(map, map->triangle[t][k], map->triangle[t][next3(k)]) >
                edge_length(map, map->triangle[t][i], map->triangle[t][next3(i)]))
                i = k;
        }
    } else {
        for (int side = 0; side < 2 && edge >= 0; side++) {
            yb_triangle_t s = side == 0 ? widest->t : neighbour_of(load, widest->t, widest->edge);
            int k = side == 0 ? widest->edge
                              : corner_of(map, s, map->triangle[widest->t][next3(widest->edge)]);
            if (is_acute(map, map->triangle[s][k], map->triangle[s][next3(k)],
                         map->triangle[s][prev3(k)])) {
                t = s;
                i = k;
                edge = -1;
            }
        }
    }
    const yb_vertex_t *a = &map->vertex[map->triangle[t][i]];
    const yb_vertex_t *b = &map->vertex[map->triangle[t][next3(i)]];
    const yb_vertex_t *c = &map->vertex[map->triangle[t][prev3(i)]];
    uint16_t x = (uint16_t)((a->x_q8 + b->x_q8) >> 1);
    uint16_t y = (uint16_t)((a->y_q8 + b->y_q8) >> 1);
    if (edge < 0) {
        x = (uint16_t)((x + c->x_q8) >> 1);
        y = (uint16_t)((y + c->y_q8) >> 1);
    }
    yb_index_t p = (yb_index_t)map->vertex_count;
    if (mesh_add_vertex(map, load, x, y, z) != YB_OK)
        return YB_ERR_LIMIT;
    mesh_split(map, load, t, edge, p);
    mesh_legalise(map, load, p);
    yb_contour_t *summit = &load->contour[load->contour_count + load->summit_count++];
    summit->first = p;
    summit->count = 1;
    summit->left = summit->right = (yb_index_t)load->region[load->star[p]];
    summit->open = false;
    return YB_OK;
}

yb_status_t summits_add(yb_map_t *map, yb_load_t *load)
{
    /* Not only where the code has no summit: wherever there is one height and no other. */
    for (int r = 0; r < load->region_count; r++)
        load->scratch[r] = 1;
    for (yb_triangle_t t = 0; t < map->triangle_count; t++) {
        if (!is_flat(map, t))
            load->scratch[load->region[t]] = 0;
    }
    /* A region may have to wait for its neighbour to get a height of its own: go round until
     * nothing changes. */
    for (bool changed = true; changed;) {
        changed = false;
        for (int c = 0; c < 2 * load->contour_count; c++) {
            const yb_contour_t *contour = &load->contour[c >> 1];
            yb_index_t region = (c & 1) == 0 ? contour->left : contour->right;
            if (load->scratch[region] == 0)
                continue;
            int32_t rise = rise_outside(map, load, region);
            if (rise == 0)
                continue;
            int32_t half = rise / 2 != 0 ? rise / 2 : rise;
            widest_t widest;
            find_widest(map, load, region, &widest);
            if (place_summit(map, load, &widest, map->vertex[contour->first].z_q8 + half) != YB_OK)
                return YB_ERR_LIMIT;
            load->scratch[region] = 0;
            changed = true;
        }
    }
    return YB_OK;
}
