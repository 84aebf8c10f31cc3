/* The border of the map: where open contours end, and how high the frame is. */
#include "mesh.h"

/* SPEC 1.5: which points of a contour may lie on the frame. */
static yb_status_t check_contour(const yb_load_t *load, yb_contour_t *contour)
{
    const yb_vertex_t *first = vertex_of(load, contour->first);
    const yb_vertex_t *last = first + contour->count - 1;
    contour->open = contour->count > 1 && on_frame(load, first) && on_frame(load, last);
    if (contour->count == 2) {
        /* A straight line across: not along one side, where it would bound nothing. */
        yb_vertex_t middle = {.x_q8 = fix_middle(first->x_q8, last->x_q8),
                              .y_q8 = fix_middle(first->y_q8, last->y_q8)};
        return contour->open && !on_frame(load, &middle) ? YB_OK : YB_ERR_CORRUPT;
    }
    if (contour->open) {
        first++;
        last--;
    }
    for (; first <= last; first++) {
        if (on_frame(load, first))
            return YB_ERR_CORRUPT;
    }
    return YB_OK;
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

/* The height at an unknown corner: between the nearest known heights along the frame, both ways. */
static int32_t interpolate(const yb_load_t *load, const yb_vertex_t *corner)
{
    uint32_t round = 2 * ((uint32_t)load->map->east_q8 + load->map->north_q8);
    uint32_t way = way_of(load, corner);
    uint32_t ahead = round;
    uint32_t behind = round;
    int32_t height_ahead = load->frame_height;
    int32_t height_behind = load->frame_height;
    for (int i = 0; i < load->map->vertex_count; i++) {
        const yb_vertex_t *v = &load->map->vertex[i];
        if (v->z_q8 == UNKNOWN_HEIGHT || !on_frame(load, v))
            continue;
        uint32_t d = way_of(load, v) + round - way;
        d = d >= round ? d - round : d; /* never 0: the corner itself is unknown */
        if (d < ahead) {
            ahead = d;
            height_ahead = v->z_q8;
        }
        if (round - d < behind) {
            behind = round - d;
            height_behind = v->z_q8;
        }
    }
    /* From the lower one up, so that the division rounds down. Heights are at most 2^18 apart, and
     * ways, which are multiples of 16, below 2^18 in all: products stay below 2^32. */
    bool falls = height_ahead < height_behind;
    uint32_t rise = (uint32_t)fix_abs(height_ahead - height_behind);
    uint32_t whole = (ahead + behind) >> 4;
    uint32_t part = (falls ? ahead : behind) >> 4;
    return (int32_t)((rise * part + whole / 2) / whole) + fix_min(height_ahead, height_behind);
}

/* Makes corner k a vertex, unless a line ends there. */
static yb_status_t place_corner(yb_load_t *load, int k)
{
    yb_vertex_t corner;
    corner.x_q8 = k == 1 || k == 2 ? load->map->east_q8 : 0;
    corner.y_q8 = k >= 2 ? load->map->north_q8 : 0;
    corner.z_q8 = load->corner_height[k];
    for (int i = 0; i < load->point_count; i++) {
        const yb_vertex_t *point = vertex_of(load, i);
        if (point->x_q8 == corner.x_q8 && point->y_q8 == corner.y_q8) {
            load->corner[k] = (yb_index_t)i;
            return corner.z_q8 == UNKNOWN_HEIGHT ? YB_OK : YB_ERR_CORRUPT;
        }
    }
    load->corner[k] = (yb_index_t)load->map->vertex_count;
    return mesh_add_vertex(load, &corner) == YB_OK ? YB_OK : YB_ERR_CORRUPT;
}

yb_status_t border_close(yb_load_t *load)
{
    for (int i = 0; i < load->contour_count; i++) {
        if (check_contour(load, &load->contour[i]) != YB_OK)
            return YB_ERR_CORRUPT;
    }
    for (int k = 0; k < 4; k++) {
        if (place_corner(load, k) != YB_OK)
            return YB_ERR_CORRUPT;
    }
    /* All from what the code says, none from another's interpolation: first compute, then store. */
    int32_t height[4];
    for (int k = 0; k < 4; k++) {
        const yb_vertex_t *corner = vertex_of(load, load->corner[k]);
        bool known = corner->z_q8 != UNKNOWN_HEIGHT;
        height[k] = known ? corner->z_q8 : interpolate(load, corner);
    }
    for (int k = 0; k < 4; k++)
        load->map->vertex[load->corner[k]].z_q8 = height[k];
    return YB_OK;
}
