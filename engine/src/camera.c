#include "camera.h"

#include "fix.h"
#include "relief.h"

#define FAR_Q8 ((int32_t)4096 * 256) /* positions are clamped to this */
#define MOST_FOCAL_Q4 65528

enum {
    NEAREST_Q8 = 128, /* half a step: never draw nearer */
    LEAST_ZOOM_Q12 = 1024,
    LEAST_SPLIT_Q4 = 16,
    MOST_SPLIT_Q4 = 16383
};

/* --- Views ------------------------------------------------------------------------------------ */

void yb_view_sun(yb_view_t *view, uint16_t azimuth_bam, uint16_t elevation_bam)
{
    int32_t flat = yb_cos_q14(elevation_bam);
    view->sun_q14[0] = (int16_t)((flat * yb_sin_q14(azimuth_bam)) >> 14);
    view->sun_q14[1] = (int16_t)((flat * yb_cos_q14(azimuth_bam)) >> 14);
    view->sun_q14[2] = yb_sin_q14(elevation_bam);
}

void yb_view_orbit(yb_view_t *view, const yb_map_t *map, uint16_t azimuth_bam,
                   uint16_t elevation_bam, uint16_t distance_q8)
{
    int32_t width = fix_max(map->east_q8, map->north_q8);
    int32_t distance = (int32_t)(((int64_t)width * distance_q8) >> 8);
    int32_t flat = (int32_t)(((int64_t)distance * yb_cos_q14(elevation_bam)) >> 14);
    int64_t middle = ((int64_t)map->low_q8 + map->high_q8) * view->exaggerate_q8;
    view->look_q8[0] = map->east_q8 >> 1;
    view->look_q8[1] = map->north_q8 >> 1;
    view->look_q8[2] = (int32_t)(middle >> 9);
    view->eye_q8[0] = view->look_q8[0] - (int32_t)(((int64_t)flat * yb_sin_q14(azimuth_bam)) >> 14);
    view->eye_q8[1] = view->look_q8[1] - (int32_t)(((int64_t)flat * yb_cos_q14(azimuth_bam)) >> 14);
    view->eye_q8[2] =
        view->look_q8[2] + (int32_t)(((int64_t)distance * yb_sin_q14(elevation_bam)) >> 14);
    view->azimuth_bam = azimuth_bam;
}

void yb_view_init(yb_view_t *view, const yb_map_t *map)
{
    *view = (yb_view_t){
        .zoom_q12 = 4392,
        .exaggerate_q8 = 256,
        .edge_q4 = 112,
        .walls = true,
        .water_q8 = YB_NO_WATER,
    };
    yb_view_sun(view, YB_DEGREES(315), YB_DEGREES(30));
    yb_view_orbit(view, map, 0, YB_DEGREES(30), 307);
}

/* --- View space ------------------------------------------------------------------------------- */

/* Sine and cosine of the camera's elevation and of its azimuth β (paper: eye seen from look). */
typedef struct {
    int32_t sin_a, cos_a, sin_b, cos_b; /* Q14 */
    int32_t distance;                   /* eye to look, q8 */
} pose_t;

static void find_pose(const yb_view_t *view, pose_t *pose)
{
    int64_t dx = (int64_t)view->eye_q8[0] - view->look_q8[0];
    int64_t dy = (int64_t)view->eye_q8[1] - view->look_q8[1];
    int64_t dz = (int64_t)view->eye_q8[2] - view->look_q8[2];
    /* Differences are within 2^21; 8 more bits keep short vectors exact: squares below 2^59. */
    uint64_t flat = fix_sqrt((uint64_t)(dx * dx + dy * dy) << 14);
    uint64_t whole = fix_sqrt((uint64_t)(dx * dx + dy * dy + dz * dz) << 14);
    pose->distance = (int32_t)(whole >> 7);
    /* Straight down (or up) any β would do: the picture's top is where the view's azimuth says. */
    pose->sin_b = -yb_cos_q14(view->azimuth_bam);
    pose->cos_b = -yb_sin_q14(view->azimuth_bam);
    if (flat > 0) {
        pose->sin_b = (int32_t)(dy * ((int32_t)1 << 21) / (int64_t)flat);
        pose->cos_b = (int32_t)(dx * ((int32_t)1 << 21) / (int64_t)flat);
    }
    pose->sin_a = 0;
    pose->cos_a = 1 << 14;
    if (whole > 0) {
        pose->sin_a = (int32_t)(dz * ((int32_t)1 << 21) / (int64_t)whole);
        pose->cos_a = (int32_t)((int64_t)(flat << 14) / (int64_t)whole);
    }
}

/* Limits that make every product below fit; documented at yb_view_t. */
static void clamp_view(yb_view_t *view, const yb_screen_t *screen)
{
    for (int i = 0; i < 3; i++) {
        view->eye_q8[i] = fix_clamp(view->eye_q8[i], -FAR_Q8, FAR_Q8);
        view->look_q8[i] = fix_clamp(view->look_q8[i], -FAR_Q8, FAR_Q8);
    }
    /* The picture must stay within the pyramid of slope 2 that camera_project tests against. */
    int32_t least = LEAST_ZOOM_Q12;
    if (screen->height > screen->width)
        least = (int32_t)LEAST_ZOOM_Q12 * screen->height / screen->width;
    view->zoom_q12 = (uint16_t)fix_clamp(view->zoom_q12, fix_min(least, 65535), 65535);
    view->exaggerate_q8 = (uint16_t)fix_min(view->exaggerate_q8, 8 * 256);
    if (view->water_q8 != YB_NO_WATER)
        view->water_q8 = fix_clamp(view->water_q8, -YB_MAX_HEIGHT_Q8, YB_MAX_HEIGHT_Q8);
}

/* Rows of R (paper, DIGEST 3) times a position, Q14: right, up and back. */
static void turn_vertices(yb_frame_t *frame, const pose_t *pose)
{
    const yb_view_t *view = &frame->view;
    int32_t up_x = -((pose->sin_a * pose->cos_b) >> 14);
    int32_t up_y = -((pose->sin_a * pose->sin_b) >> 14);
    int32_t back_x = (pose->cos_a * pose->cos_b) >> 14;
    int32_t back_y = (pose->cos_a * pose->sin_b) >> 14;
    for (int i = 0; i < frame->map->vertex_count; i++) {
        const yb_vertex_t *v = &frame->map->vertex[i];
        /* All within 2^22: a product is within 2^36, the results within 2^24. */
        int64_t x = v->x_q8 - view->look_q8[0];
        int64_t y = v->y_q8 - view->look_q8[1];
        int64_t z = (((int64_t)v->z_q8 * view->exaggerate_q8) >> 8) - view->look_q8[2];
        frame->seen[i].right_q8 = (int32_t)((y * pose->cos_b - x * pose->sin_b) >> 14);
        frame->seen[i].up_q8 = (int32_t)((x * up_x + y * up_y + z * pose->cos_a) >> 14);
        frame->seen[i].depth_q8 =
            pose->distance - (int32_t)((x * back_x + y * back_y + z * pose->sin_a) >> 14);
    }
}

/* The nearest depth of anything on a triangle's column, from the foot of the wall to the water. */
static int32_t nearest_of(const yb_frame_t *frame, const yb_index_t corner[3])
{
    const yb_map_t *map = frame->map;
    relief_bound_t bound;
    relief_bound(map, &map->vertex[corner[0]], &map->vertex[corner[1]], &map->vertex[corner[2]],
                 &bound);
    int32_t reach = relief_reach(map, &bound, 0);
    int32_t nearest = INT32_MAX;
    for (int k = 0; k < 3; k++) {
        /* Height differences are below 2^19, lift at most 2^12. */
        const int32_t z = map->vertex[corner[k]].z_q8;
        int32_t down = z - fix_min(frame->base_q8, z - reach);
        int32_t up = fix_max(frame->view.water_q8, z + reach) - z;
        int32_t rise = frame->lift_back_q9 < 0 ? -down : up;
        nearest = fix_min(nearest, frame->seen[corner[k]].depth_q8 -
                                       (int32_t)(((int64_t)rise * frame->lift_back_q9) >> 9));
    }
    return nearest;
}

/* The frame's 16-bit depths are spread from the nearest thing on. */
static void find_near(yb_frame_t *frame)
{
    int32_t nearest = INT32_MAX;
    for (yb_triangle_t t = 0; t < frame->map->triangle_count; t++)
        nearest = fix_min(nearest, nearest_of(frame, frame->map->triangle[t]));
    frame->near_q8 = fix_max(nearest - 1, NEAREST_Q8);
    int shift = fix_log2_floor((uint32_t)frame->near_q8) - 14;
    frame->near_shift = shift;
    frame->near_scaled = shift >= 0 ? frame->near_q8 >> shift : frame->near_q8 * (1 << -shift);
}

void camera_begin(yb_frame_t *frame)
{
    yb_view_t *view = &frame->view;
    const yb_screen_t *screen = &frame->screen;
    clamp_view(view, screen);
    pose_t pose;
    find_pose(view, &pose);
    frame->lift_up_q9 = (pose.cos_a * view->exaggerate_q8) >> 13;
    frame->lift_back_q9 = (pose.sin_a * view->exaggerate_q8) >> 13;
    /* The block stands on a quarter of its relief. */
    int32_t relief = frame->map->high_q8 - frame->map->low_q8;
    frame->base_q8 = frame->map->low_q8 - (relief >> 2) - 256;
    frame->focal_q4 =
        fix_min((int32_t)(((uint32_t)screen->width * view->zoom_q12) >> 8), MOST_FOCAL_Q4);
    int32_t edge = fix_max(view->edge_q4, 1);
    frame->split_q4 = fix_clamp(frame->focal_q4 * 16 / edge, LEAST_SPLIT_Q4, MOST_SPLIT_Q4);
    turn_vertices(frame, &pose);
    find_near(frame);
}

/* --- The screen ------------------------------------------------------------------------------- */

static inline int32_t shifted(int32_t a, int shift)
{
    return shift >= 0 ? a >> shift : a * (1 << -shift);
}

void camera_place(const yb_frame_t *frame, const yb_point_t *point, camera_point_t *place)
{
    place->right_q8 = point->right_q8;
    place->up_q8 = point->up_q8;
    place->depth_q8 = point->depth_q8;
    if (frame->view.water_q8 > point->at.z_q8) {
        int64_t flood = frame->view.water_q8 - point->at.z_q8;
        place->up_q8 += (int32_t)((flood * frame->lift_up_q9) >> 9);
        place->depth_q8 -= (int32_t)((flood * frame->lift_back_q9) >> 9);
    }
}

void camera_project(const yb_frame_t *frame, const camera_point_t *place, raster_point_t *screen)
{
    /* depth = d * 2^shift with d of 15 bits, so 2^29 / d has as many. |right| < 2 depth keeps
     * right / d * 2^29 within 2^30 + 2^16 however d was rounded, and x within 2^15 + 2: times
     * MOST_FOCAL_Q4 that is below 2^31. */
    int shift = fix_log2_floor((uint32_t)place->depth_q8) - 14;
    int32_t inverse = ((int32_t)1 << 29) / shifted(place->depth_q8, shift);
    int32_t x = (shifted(place->right_q8, shift) * inverse) >> 15; /* Q14, within 2^15 */
    int32_t y = (shifted(place->up_q8, shift) * inverse) >> 15;
    screen->x_q4 = frame->screen.width * 8 + ((x * frame->focal_q4) >> 14);
    screen->y_q4 = frame->screen.height * 8 - ((y * frame->focal_q4) >> 14);
    /* near / depth * 2^16: both factors have 15 bits, and depth is hardly nearer than near. */
    int32_t ratio = (frame->near_scaled * inverse) >> (13 + shift - frame->near_shift);
    screen->near = fix_clamp(ratio, 1, 65535);
}

void camera_see(const yb_frame_t *frame, yb_point_t *point)
{
    camera_point_t place;
    camera_place(frame, point, &place);
    point->visible = place.depth_q8 >= frame->near_q8 &&
                     fix_abs(place.right_q8) < 2 * place.depth_q8 &&
                     fix_abs(place.up_q8) < 2 * place.depth_q8;
    if (!point->visible)
        return;
    raster_point_t screen;
    camera_project(frame, &place, &screen);
    point->x_q4 = screen.x_q4;
    point->y_q4 = screen.y_q4;
    point->near = (uint16_t)screen.near;
}

void camera_drop(const yb_frame_t *frame, const yb_point_t *point, int32_t z_q8, yb_point_t *to)
{
    int64_t rise = z_q8 - point->at.z_q8; /* below 2^20, the lift up to 2^12 */
    *to = *point;
    to->at.z_q8 = INT32_MAX; /* above any water: it stays where it is */
    to->up_q8 += (int32_t)((rise * frame->lift_up_q9) >> 9);
    to->depth_q8 -= (int32_t)((rise * frame->lift_back_q9) >> 9);
    camera_see(frame, to);
}
