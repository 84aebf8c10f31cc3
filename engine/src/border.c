/* The border of the map: where open contours end, and how high the frame is. */
#include "mesh.h"

/* SPEC 1.5: which points of a contour may lie on the frame. */
static bool check_contour(const yb_load_t *load, const yb_contour_t *contour)
{
    const yb_vertex_t *first = vertex_of(load, contour->first);
    const yb_vertex_t *last = first + contour->count - 1;
    int ends = 0; /* on the frame */
    for (const yb_vertex_t *v = first; v <= last; v++) {
        if (!on_frame(load, v))
            continue;
        if (v != first && v != last)
            return false;
        ends++;
    }
    if (contour->count != 2)
        return ends != 1;
    /* A straight line across: not along one side, where it would bound nothing. */
    yb_vertex_t middle;
    find_middle_of(first, last, &middle);
    return ends == 2 && !on_frame(load, &middle);
}

/* Way along the frame, counter-clockwise from the south-west corner, in q8 steps. */
static uint32_t way_of(const yb_load_t *load, const yb_vertex_t *v)
{
    uint32_t east = load->map->east_q8;
    uint32_t north = load->map->north_q8;
    if (v->y_q8 == 0)
        return v->x_q8;
    if (v->x_q8 == load->map->east_q8)
        return east + v->y_q8;
    if (v->y_q8 == load->map->north_q8)
        return east + north + (east - v->x_q8);
    return 2 * east + north + (north - v->y_q8);
}

/* The height at a corner: between the nearest known heights along the frame, both ways, of which
 * its own is one.
 */
APART int32_t interpolate(const yb_load_t *load, const yb_vertex_t *corner)
{
    uint32_t round = 2 * ((uint32_t)load->map->east_q8 + load->map->north_q8);
    uint32_t way = way_of(load, corner);
    uint32_t next = round; /* counter-clockwise from the corner */
    uint32_t last = 0;
    int32_t height_next = 0;
    int32_t height_last = 0;
    for (int i = 0; i < load->vertex_count; i++) {
        const yb_vertex_t *v = vertex_of(load, i);
        if (v->z_q8 == UNKNOWN_HEIGHT || !on_frame(load, v))
            continue;
        uint32_t d = way_of(load, v) + round - way;
        d = d >= round ? d - round : d;
        if (d < next) {
            next = d;
            height_next = v->z_q8;
        }
        if (d > last) {
            last = d;
            height_last = v->z_q8;
        }
    }
    if (next == round)
        return load->frame_height; /* none is known */
    /* Counted from the lowest height, so that the division rounds down. Then heights are at most
     * 2^18, and ways, which are multiples of 16, below 2^18 in all: the sum stays below 2^32. */
    uint32_t ahead = next >> 4;
    uint32_t behind = (round - last) >> 4;
    uint32_t sum = (uint32_t)(height_next + YB_MAX_HEIGHT_Q8) * behind +
                   (uint32_t)(height_last + YB_MAX_HEIGHT_Q8) * ahead;
    uint32_t whole = ahead + behind;
    return (int32_t)((sum + whole / 2) / whole) - YB_MAX_HEIGHT_Q8;
}

static bool same_place(const yb_vertex_t *a, const yb_vertex_t *b)
{
    return a->x_q8 == b->x_q8 && a->y_q8 == b->y_q8;
}

/* Makes corner k a vertex, unless a line ends there. */
static bool place_corner(yb_load_t *load, int k)
{
    yb_vertex_t corner = {
        .x_q8 = ((k + 1) & 2) != 0 ? load->map->east_q8 : 0,
        .y_q8 = (k & 2) != 0 ? load->map->north_q8 : 0,
        .z_q8 = load->corner_height[k],
    };
    int i = 0;
    while (i < load->vertex_count && !same_place(vertex_of(load, i), &corner))
        i++;
    load->corner[k] = (yb_index_t)i;
    return i < load->vertex_count ? corner.z_q8 == UNKNOWN_HEIGHT : mesh_add_vertex(load, &corner);
}

bool border_close(yb_load_t *load)
{
    for (int i = 0; i < load->contour_count; i++) {
        if (!check_contour(load, &load->contour[i]))
            return false;
    }
    for (int k = 0; k < 4; k++) {
        if (!place_corner(load, k))
            return false;
    }
    /* All from what the code says, none from another's interpolation: first compute, then store. */
    int32_t height[4];
    for (int k = 0; k < 4; k++)
        height[k] = interpolate(load, vertex_of(load, load->corner[k]));
    for (int k = 0; k < 4; k++)
        load->vertex[load->corner[k]].z_q8 = height[k];
    return true;
}
