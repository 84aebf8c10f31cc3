#include "standard_views.h"

enum {
    ORBIT_DISTANCE_Q8 = 307,
    EYE_PARTS = 100,
    LOOK_DOWN_PARTS = 6,
    NEAR_PARTS = 16
};

static const char *const names[YB_STANDARD_VIEWS] = {
    "orbit-45", "orbit-135", "orbit-225", "orbit-315", "summit-1", "summit-2", "walk-1", "walk-2"};

typedef struct {
    bool found;
    uint16_t x_q8, y_q8;
    int32_t z_q8;
} summit_t;

const char *yb_standard_view_name(int which)
{
    return which >= 0 && which < YB_STANDARD_VIEWS ? names[which] : NULL;
}

/* The order of triangles and corners must not matter: the place decides between equals. */
static bool higher(const yb_vertex_t *vertex, const summit_t *summit)
{
    if (!summit->found || vertex->z_q8 != summit->z_q8)
        return !summit->found || vertex->z_q8 > summit->z_q8;
    if (vertex->y_q8 != summit->y_q8)
        return vertex->y_q8 < summit->y_q8;
    return vertex->x_q8 < summit->x_q8;
}

static void take_highest(void *context, const yb_vertex_t *a, const yb_vertex_t *b,
                         const yb_vertex_t *c)
{
    summit_t *summit = context;
    const yb_vertex_t *corner[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        if (higher(corner[i], summit))
            *summit = (summit_t){true, corner[i]->x_q8, corner[i]->y_q8, corner[i]->z_q8};
    }
}

static summit_t find_summit(const yb_map_t *map)
{
    summit_t summit = {.found = false};
    for (yb_triangle_t i = 0; i < map->triangle_count; i++)
        yb_map_refine(map, i, YB_REFERENCE_Q8, take_highest, &summit);
    return summit;
}

static int32_t map_width_q8(const yb_map_t *map)
{
    return map->east_q8 > map->north_q8 ? map->east_q8 : map->north_q8;
}

static int32_t raised(const yb_view_t *view, int32_t z_q8)
{
    return (int32_t)(((int64_t)z_q8 * view->exaggerate_q8) >> 8);
}

static int32_t room(int32_t at, int32_t side)
{
    return at < side - at ? at : side - at;
}

static void look_from_summit(yb_view_t *view, const yb_map_t *map, bool back)
{
    const int32_t width = map_width_q8(map);
    const summit_t summit = find_summit(map);
    const bool along_x = room(summit.x_q8, map->east_q8) >= room(summit.y_q8, map->north_q8);
    const int32_t ahead = back ? -width : width;

    view->eye_q8[0] = summit.x_q8;
    view->eye_q8[1] = summit.y_q8;
    view->eye_q8[2] = raised(view, summit.z_q8) + width / EYE_PARTS;
    view->look_q8[0] = view->eye_q8[0] + (along_x ? ahead : 0);
    view->look_q8[1] = view->eye_q8[1] + (along_x ? 0 : ahead);
    view->look_q8[2] = view->eye_q8[2] - width / LOOK_DOWN_PARTS;
    view->azimuth_bam = YB_DEGREES((along_x ? 90 : 0) + (back ? 180 : 0));
}

static void look_from_ground(yb_view_t *view, const yb_map_t *map, int32_t thirds)
{
    const int32_t width = map_width_q8(map);
    const summit_t summit = find_summit(map);
    const int32_t x = map->east_q8 * thirds / 3;
    const int32_t y = map->north_q8 * thirds / 3;
    int32_t ground = yb_map_height(map, (uint16_t)x, (uint16_t)y);
    if (view->water_q8 > ground)
        ground = view->water_q8;

    view->eye_q8[0] = x;
    view->eye_q8[1] = y;
    view->eye_q8[2] = raised(view, ground) + width / EYE_PARTS;
    view->look_q8[0] = summit.x_q8;
    view->look_q8[1] = summit.y_q8;
    view->look_q8[2] = raised(view, summit.z_q8);
    view->azimuth_bam = 0;

    /* Up to 65280 * 1.5 each way: the squares need 64 bits. */
    const int64_t dx = view->look_q8[0] - x, dy = view->look_q8[1] - y;
    const int64_t near = width / NEAR_PARTS;
    if (dx * dx + dy * dy < near * near) {
        view->look_q8[0] = x;
        view->look_q8[1] = y + width;
        view->look_q8[2] = view->eye_q8[2];
    }
}

void yb_standard_view_set(yb_view_t *view, const yb_map_t *map, yb_standard_view_t which)
{
    static const uint16_t orbit[] = {45, 135, 225, 315};
    if (which <= YB_ORBIT_315)
        yb_view_orbit(view, map, YB_DEGREES(orbit[which]), YB_DEGREES(30), ORBIT_DISTANCE_Q8);
    else if (which == YB_SUMMIT_1 || which == YB_SUMMIT_2)
        look_from_summit(view, map, which == YB_SUMMIT_2);
    else
        look_from_ground(view, map, which == YB_WALK_1 ? 1 : 2);
}
