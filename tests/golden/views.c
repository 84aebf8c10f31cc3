#include "views.h"

static void from_north_west(yb_view_t *view, const yb_map_t *map)
{
    yb_view_orbit(view, map, YB_DEGREES(135), YB_DEGREES(30), 307);
}

static void from_far_above(yb_view_t *view, const yb_map_t *map)
{
    yb_view_orbit(view, map, YB_DEGREES(200), YB_DEGREES(75), 420);
    view->walls = false;
}

static void straight_down(yb_view_t *view, const yb_map_t *map)
{
    yb_view_orbit(view, map, YB_DEGREES(30), YB_DEGREES(90), 350);
}

static void flooded(yb_view_t *view, const yb_map_t *map)
{
    yb_view_orbit(view, map, YB_DEGREES(300), YB_DEGREES(25), 280);
    view->water_q8 = map->low_q8 + (map->high_q8 - map->low_q8) * 2 / 5;
    view->exaggerate_q8 = 512;
}

static void on_foot(yb_view_t *view, const yb_map_t *map)
{
    const uint32_t east = map->east_q8;
    const uint32_t north = map->north_q8;
    view->eye_q8[0] = (int32_t)(east / 5);
    view->eye_q8[1] = (int32_t)(north / 4);
    view->eye_q8[2] =
        yb_map_height(map, (uint16_t)view->eye_q8[0], (uint16_t)view->eye_q8[1]) + 600;
    view->look_q8[0] = (int32_t)(east * 3 / 5);
    view->look_q8[1] = (int32_t)(north / 2);
    view->look_q8[2] = view->eye_q8[2];
    yb_view_sun(view, YB_DEGREES(200), YB_DEGREES(40));
}

/* Down, to what is nearer than anything that has a place on the screen, and a line through it. */
static void to_the_feet(yb_view_t *view, const yb_map_t *map)
{
    const uint16_t x = (uint16_t)(map->east_q8 / 8 * 3);
    const uint16_t y = (uint16_t)(map->north_q8 / 8 * 5);
    yb_view_walk(view, map, x, y, 128, YB_DEGREES(70), -(int16_t)YB_DEGREES(40));
    view->contour_q8 = (map->high_q8 - map->low_q8) / 24 + YB_LEAST_CONTOUR_Q8;
    view->contour_at_q8 = yb_map_height(map, x, y) + 8;
}

/* Lines, an atlas's colours, haze. */
static void with_lines(yb_view_t *view, const yb_map_t *map)
{
    yb_view_orbit(view, map, YB_DEGREES(10), YB_DEGREES(20), 256);
    view->palette = YB_PALETTE_HYPSOMETRIC;
    view->contour_q8 = (map->high_q8 - map->low_q8) / 12 + YB_LEAST_CONTOUR_Q8;
    view->contour_at_q8 = map->low_q8 + 99;
    view->haze_q8 = map->east_q8;
    view->max_leaves = 2500;
}

/* Long shadows, on ground and water. */
static void at_dusk(yb_view_t *view, const yb_map_t *map)
{
    yb_view_orbit(view, map, YB_DEGREES(330), YB_DEGREES(35), 300);
    yb_view_sun(view, YB_DEGREES(250), YB_DEGREES(12));
    view->palette = YB_PALETTE_NIGHT;
    view->water_q8 = map->low_q8 + (map->high_q8 - map->low_q8) / 5;
}

/* One bit a pixel. */
static void in_ink(yb_view_t *view, const yb_map_t *map)
{
    at_dusk(view, map);
    yb_view_sun(view, YB_DEGREES(300), YB_DEGREES(35));
    view->palette = YB_PALETTE_MONO;
    view->contour_q8 = (map->high_q8 - map->low_q8) / 8 + YB_LEAST_CONTOUR_Q8;
}

static const struct {
    const char *name;
    void (*set)(yb_view_t *view, const yb_map_t *map);
} views[GOLDEN_VIEWS] = {
    {"orbit", from_north_west}, {"above", from_far_above}, {"down", straight_down},
    {"flood", flooded},         {"foot", on_foot},         {"lines", with_lines},
    {"dusk", at_dusk},          {"ink", in_ink},           {"feet", to_the_feet},
};

const char *golden_view_name(int which)
{
    return views[which].name;
}

static bool casts_shadows(int which)
{
    return views[which].set == at_dusk || views[which].set == in_ink;
}

yb_format_t golden_view_format(int which, yb_format_t usual)
{
    return views[which].set == in_ink ? YB_MONO : usual;
}

void golden_view_set(int which, yb_view_t *view, const yb_map_t *map, uint8_t *work)
{
    static uint8_t lit[YB_SHADOW_BYTES(GOLDEN_SHADOW_SIDE)];
    static yb_shadow_t shadow = {.side = GOLDEN_SHADOW_SIDE, .lit = lit};
    yb_view_init(view, map);
    views[which].set(view, map);
    if (!casts_shadows(which))
        return;
    yb_shadow_cast(map, view, &shadow, work);
    view->shadow = &shadow;
}
