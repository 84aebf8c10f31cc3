#include "camera.h"

#include "fix.h"
#include "relief.h"

#define FAR_Q8 ((int32_t)4096 * 256) /* positions are clamped to this */
#define MOST_FOCAL_Q4 61440
#define MOST_BEND ((int32_t)1 << 28)

enum {
    NEAREST_Q8 = 128, /* half a step: never draw nearer */
    LEAST_NEAR = 64,  /* in the view's own unit: what rounding does must stay small beside it */
    LEAST_ZOOM_Q12 = 1024
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

void yb_view_fly(yb_view_t *view, const yb_map_t *map, const int32_t eye_q8[3],
                 int32_t clearance_q8, uint16_t azimuth_bam, int16_t tilt_bam)
{
    for (int i = 0; i < 3; i++)
        view->eye_q8[i] = fix_clamp(eye_q8[i], -FAR_Q8, FAR_Q8);
    int32_t x = view->eye_q8[0];
    int32_t y = view->eye_q8[1];
    if (x >= 0 && y >= 0 && x <= map->east_q8 && y <= map->north_q8) {
        int32_t floor = fix_max(yb_map_height(map, (uint16_t)x, (uint16_t)y), view->water_q8);
        floor = (int32_t)(((int64_t)floor * view->exaggerate_q8) >> 8);
        clearance_q8 = fix_clamp(clearance_q8, 0, FAR_Q8);
        view->eye_q8[2] = fix_max(view->eye_q8[2], fix_min(floor, FAR_Q8) + clearance_q8);
    }
    int32_t flat = yb_cos_q14((uint16_t)tilt_bam);
    view->look_q8[0] = view->eye_q8[0] + ((flat * yb_sin_q14(azimuth_bam)) >> 14);
    view->look_q8[1] = view->eye_q8[1] + ((flat * yb_cos_q14(azimuth_bam)) >> 14);
    view->look_q8[2] = view->eye_q8[2] + yb_sin_q14((uint16_t)tilt_bam);
    view->azimuth_bam = azimuth_bam;
}

void yb_view_walk(yb_view_t *view, const yb_map_t *map, uint16_t x_q8, uint16_t y_q8,
                  int32_t height_q8, uint16_t azimuth_bam, int16_t tilt_bam)
{
    const int32_t below[3] = {fix_min(x_q8, map->east_q8), fix_min(y_q8, map->north_q8), -FAR_Q8};
    yb_view_fly(view, map, below, height_q8, azimuth_bam, tilt_bam);
}

void yb_view_init(yb_view_t *view, const yb_map_t *map)
{
    *view = (yb_view_t){
        .zoom_q12 = 4392,
        .exaggerate_q8 = 256,
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
} pose_t;

static void find_pose(const yb_view_t *view, pose_t *pose)
{
    int64_t dx = (int64_t)view->eye_q8[0] - view->look_q8[0];
    int64_t dy = (int64_t)view->eye_q8[1] - view->look_q8[1];
    int64_t dz = (int64_t)view->eye_q8[2] - view->look_q8[2];
    /* Differences are within 2^21; 8 more bits keep short vectors exact: squares below 2^59. */
    uint64_t flat = fix_sqrt((uint64_t)(dx * dx + dy * dy) << 14);
    uint64_t whole = fix_sqrt((uint64_t)(dx * dx + dy * dy + dz * dz) << 14);
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
void camera_clamp(yb_frame_t *frame)
{
    yb_view_t *view = &frame->view;
    const yb_screen_t *screen = &frame->screen;
    for (int i = 0; i < 3; i++) {
        view->eye_q8[i] = fix_clamp(view->eye_q8[i], -FAR_Q8, FAR_Q8);
        view->look_q8[i] = fix_clamp(view->look_q8[i], -FAR_Q8, FAR_Q8);
        view->lamp_q8[i] = fix_clamp(view->lamp_q8[i], -FAR_Q8, FAR_Q8);
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

/* --- The frame's constants -------------------------------------------------------------------- */

/* Rows of R (paper, DIGEST 3), and how far places are shifted so that each coordinate has 16 bits:
 * the eye's distance from the farthest corner of the map's bounding box, heights with what
 * refinement, walls and water add. A row's product is then within sqrt(3) 2^16 2^14 < 2^31.
 */
static void find_rows(yb_frame_t *frame, const pose_t *pose, int32_t stray)
{
    const yb_view_t *view = &frame->view;
    const yb_map_t *map = frame->map;
    frame->right_x = -pose->sin_b;
    frame->right_y = pose->cos_b;
    frame->up_x = -((pose->sin_a * pose->cos_b) >> 14);
    frame->up_y = -((pose->sin_a * pose->sin_b) >> 14);
    frame->up_z = pose->cos_a;
    frame->depth_x = -((pose->cos_a * pose->cos_b) >> 14);
    frame->depth_y = -((pose->cos_a * pose->sin_b) >> 14);
    frame->depth_z = -pose->sin_a;
    /* Heights are below 2^19, times an exaggeration of 2^11. */
    int32_t low = ((map->low_q8 - stray) * view->exaggerate_q8) >> 8;
    int32_t high = ((map->high_q8 + stray) * view->exaggerate_q8) >> 8;
    uint32_t all = (uint32_t)(fix_abs(view->eye_q8[0]) | fix_abs(map->east_q8 - view->eye_q8[0]) |
                              fix_abs(view->eye_q8[1]) | fix_abs(map->north_q8 - view->eye_q8[1]) |
                              fix_abs(low - view->eye_q8[2]) | fix_abs(high - view->eye_q8[2]));
    frame->eye_shift = 0;
    while (all >> frame->eye_shift >= (uint32_t)1 << 16)
        frame->eye_shift++;
}

/* The frame's 16-bit depths are spread from the nearest thing on. */
static void find_near(yb_frame_t *frame, int32_t stray)
{
    int32_t nearest = INT32_MAX;
    for (int i = 0; i < frame->map->vertex_count; i++) {
        const yb_vertex_t *v = &frame->map->vertex[i];
        camera_point_t at;
        camera_view(frame, relief_place(v), v->z_q8, &at);
        nearest = fix_min(nearest, at.depth);
    }
    int32_t lift = (fix_abs(frame->depth_z) * frame->view.exaggerate_q8) >> 8;
    nearest -= (int32_t)(((int64_t)stray * lift) >> (14 + frame->eye_shift)) + 2;
    frame->near = fix_max(nearest, fix_max(NEAREST_Q8 >> frame->eye_shift, LEAST_NEAR));
    int shift = fix_log2_floor((uint32_t)frame->near) - 14;
    frame->near_shift = shift;
    frame->near_scaled = shift >= 0 ? frame->near >> shift : frame->near * (1 << -shift);
}

/* What a change of height does on the screen. A point at depth d has 65535 near / d in its spot, so
 * r units of height times that are r / d times the constant 65535 near: a rise of r moves it up by
 * focal * lift * r / d, and changes its depth by lift_z * r.
 */
static void find_lift(yb_frame_t *frame)
{
    int64_t lift = ((int64_t)frame->up_z * frame->view.exaggerate_q8) >> 8; /* 17 bits */
    int64_t bend = ((int64_t)fix_abs(frame->depth_z) * frame->view.exaggerate_q8) >> 8;
    uint64_t whole = (uint64_t)65535 * (uint32_t)frame->near << (14 + frame->eye_shift); /* 55 */
    uint64_t most = bend > 0 ? whole / (uint64_t)(64 * bend) : INT32_MAX;
    frame->most_bend = most < MOST_BEND ? (int32_t)most : MOST_BEND;
    /* Up to a screen size off the screen, and an eighth nearer than it was: 8/7. */
    int64_t wide = frame->screen.width * 24;
    int64_t high = frame->screen.height * 24;
    uint64_t up = (uint64_t)(frame->focal_q4 * lift);
    uint64_t part[3] = {up, (uint64_t)(wide * bend) * 8 / 7,
                        (up + (uint64_t)(high * bend)) * 8 / 7};
    int shift = 20;
    while (whole >> 32 != 0) {
        whole >>= 1;
        shift++;
    }
    for (int i = 0; i < 3; i++) /* 35 bits and 20 more */
        part[i] = ((part[i] << 20) + (i > 0 ? whole - 1 : 0)) / whole;
    while (shift > 41 || part[0] >= 2047 || part[1] >= 2047 || part[2] >= 2047) {
        part[0] >>= 1;
        part[1] = (part[1] + 1) >> 1;
        part[2] = (part[2] + 1) >> 1;
        shift--;
    }
    frame->spare_q4 = 3 * frame->focal_q4 / frame->near; /* below 2^12 */
    frame->lift = (int16_t)part[0];
    frame->sway_x_q4 = (int32_t)part[1];
    frame->sway_y_q4 = (int32_t)part[2];
    frame->lift_shift = (uint8_t)fix_max(shift - 10, 0);
}

/* An edge is split by its plan length, foreshortened in the direction of view: from 30 degrees
 * above the ground on not at all, on foot to a quarter, for hills rise above their ground. There
 * triangles are wider too, so that they cover about as many pixels in every view.
 */
static void find_lengths(yb_frame_t *frame, const pose_t *pose)
{
    int32_t steep = fix_clamp(2 * fix_abs(pose->sin_a), 1 << 12, 1 << 14);
    int32_t wide = (steep + (1 << 14)) >> 1;
    int32_t high = (steep * wide) >> 14;
    frame->along_x = (pose->cos_b * high) >> 15;
    frame->along_y = (pose->sin_b * high) >> 15;
    frame->across_x = (-pose->sin_b * wide) >> 15;
    frame->across_y = (pose->cos_b * wide) >> 15;
    /* focal * 2 length_q7 / depth > edge, with depth as 65535 near / (1/depth). */
    uint32_t edge_q4 = frame->view.edge_q4;
    /* About a sixteenth of the width. A smaller screen wants a little less: more of its triangles
     * meet no pixel's centre. Made for as many on 128 and on 320 pixels. */
    int32_t width = frame->screen.width;
    if (edge_q4 == 0)
        edge_q4 = (uint32_t)fix_max(28 * width / 25 - 20, (width + 1) >> 1);
    uint64_t edge = (uint64_t)edge_q4 * 65535;
    uint64_t longest =
        (edge * (uint32_t)frame->near << frame->eye_shift) / (uint32_t)(2 * frame->focal_q4);
    frame->longest = longest < UINT32_MAX ? (uint32_t)longest : UINT32_MAX;
}

void camera_begin(yb_frame_t *frame, int32_t stray)
{
    const yb_view_t *view = &frame->view;
    pose_t pose;
    find_pose(view, &pose);
    frame->focal_q4 =
        fix_min((int32_t)(((uint32_t)frame->screen.width * view->zoom_q12) >> 8), MOST_FOCAL_Q4);
    find_rows(frame, &pose, stray);
    find_near(frame, stray);
    find_lift(frame);
    find_lengths(frame, &pose);
    for (int i = 0; i < frame->map->vertex_count; i++) {
        yb_point_t point;
        camera_root(frame, (yb_index_t)i, &point);
        camera_see(frame, &point);
        frame->seen[i].x_q4 = point.spot.x_q4;
        frame->seen[i].y_q4 = point.spot.y_q4;
        frame->seen[i].near = point.spot.near;
    }
}

/* --- The screen ------------------------------------------------------------------------------- */

void camera_view(const yb_frame_t *frame, uint32_t place, int32_t top_q8, camera_point_t *to)
{
    const int32_t *eye = frame->view.eye_q8;
    int32_t x = ((int32_t)(place & 0xffff) - eye[0]) >> frame->eye_shift;
    int32_t y = ((int32_t)(place >> 16) - eye[1]) >> frame->eye_shift;
    int32_t z = (((top_q8 * frame->view.exaggerate_q8) >> 8) - eye[2]) >> frame->eye_shift;
    to->right = (x * frame->right_x + y * frame->right_y) >> 14;
    to->up = (x * frame->up_x + y * frame->up_y + z * frame->up_z) >> 14;
    to->depth = (x * frame->depth_x + y * frame->depth_y + z * frame->depth_z) >> 14;
}

static inline int32_t shifted(int32_t a, int shift)
{
    return shift >= 0 ? a >> shift : a * (1 << -shift);
}

/* Depth as d * 2^shift with 2^14 <= d < 2^15, and 2^29 / d: above 2^14 and at most 2^15. */
static int32_t inverse_of(int32_t depth, int *shift)
{
    *shift = fix_log2_floor((uint32_t)depth) - 14;
    return fix_reciprocal(shifted(depth, *shift));
}

/* near / depth * 2^16: both factors have 15 bits, and depth is hardly nearer than near. */
static int32_t near_ratio(const yb_frame_t *frame, int32_t inverse, int shift)
{
    int32_t ratio = (frame->near_scaled * inverse) >> (13 + shift - frame->near_shift);
    return fix_clamp(ratio, 1, 65535);
}

int32_t camera_near(const yb_frame_t *frame, int32_t depth)
{
    int shift;
    int32_t inverse = inverse_of(depth, &shift);
    return near_ratio(frame, inverse, shift);
}

/* Where a place is seen from the upper left corner, 1/16 pixel, and its 1/depth. right and up are
 * at most 2 depth and some units, which are a 32nd of the least depth: x is within 1.05 * 2^15, and
 * times MOST_FOCAL_Q4 below 2^31.
 */
static inline int32_t project(const yb_frame_t *frame, const camera_point_t *from, int32_t *x_q4,
                              int32_t *y_q4)
{
    int shift;
    int32_t inverse = inverse_of(from->depth, &shift);
    int32_t x = (shifted(from->right, shift) * inverse) >> 15; /* Q14 */
    int32_t y = (shifted(from->up, shift) * inverse) >> 15;
    *x_q4 = frame->screen.width * 8 + ((x * frame->focal_q4) >> 14);
    *y_q4 = frame->screen.height * 8 - ((y * frame->focal_q4) >> 14);
    return near_ratio(frame, inverse, shift);
}

void camera_project(const yb_frame_t *frame, const camera_point_t *from, yb_spot_t *spot)
{
    int32_t x_q4;
    int32_t y_q4;
    spot->near = (uint16_t)project(frame, from, &x_q4, &y_q4);
    spot->x_q4 = (yb_side_t)x_q4;
    spot->y_q4 = (yb_side_t)y_q4;
}

void camera_see(const yb_frame_t *frame, yb_point_t *point)
{
    camera_point_t at;
    camera_view(frame, point->place, point->top_q8, &at);
    point->spot = (yb_spot_t){0};
    if (at.depth < frame->near || fix_abs(at.right) >= 2 * at.depth ||
        fix_abs(at.up) >= 2 * at.depth)
        return;
    int32_t x_q4;
    int32_t y_q4;
    int32_t near = project(frame, &at, &x_q4, &y_q4);
    uint32_t wide = frame->screen.width * (uint32_t)16;
    uint32_t high = frame->screen.height * (uint32_t)16;
    if ((uint32_t)x_q4 + wide <= 3 * wide && (uint32_t)y_q4 + high <= 3 * high)
        point->spot = (yb_spot_t){(yb_side_t)x_q4, (yb_side_t)y_q4, (uint16_t)near, 0};
}

void camera_drop(const yb_frame_t *frame, const yb_point_t *point, int32_t z_q8, yb_point_t *to)
{
    *to = *point;
    to->z_q8 = to->top_q8 = z_q8;
    camera_see(frame, to);
}
