#include "camera.h"

#include "fix.h"
#include "relief.h"

#define FAR_Q8 ((int32_t)4096 * 256) /* positions are clamped to this */
#define MOST_FOCAL_Q4 61440
#define MOST_BEND ((int32_t)1 << 28)

enum {
    NEAREST_Q8 = 128, /* half a step: never draw nearer */
    LEAST_NEAR = 64,  /* in the view's own unit: what rounding does must stay small beside it */
    LEAST_ZOOM_Q12 = 1024,
    NEARER_Q8 = 88, /* near the eye edges may be longer: as if noise moved a step so far, and … */
    ROUGH_Q8 = 160, /* … by a sixteenth of the width where it does move one so far */
    STEP_CLASS = 28, /* of an edge of one step */
    OPEN_TURN = 2    /* triangles are open where they are seen from 30 degrees or more: a half */
};

/* --- Views ------------------------------------------------------------------------------------ */

/* So far, up to 2^24, towards an azimuth and an elevation: to the east, to the north and up. */
static void aim(uint16_t azimuth_bam, uint16_t elevation_bam, int32_t length, int32_t way[3])
{
    int32_t flat = fix_product(length, yb_cos_q14(elevation_bam), 14);
    way[0] = fix_product(flat, yb_sin_q14(azimuth_bam), 14);
    way[1] = fix_product(flat, yb_cos_q14(azimuth_bam), 14);
    way[2] = fix_product(length, yb_sin_q14(elevation_bam), 14);
}

static void clamp_place(int32_t place_q8[3])
{
    for (int i = 0; i < 3; i++)
        place_q8[i] = fix_clamp(place_q8[i], -FAR_Q8, FAR_Q8);
}

void yb_view_sun(yb_view_t *view, uint16_t azimuth_bam, uint16_t elevation_bam)
{
    int32_t way[3];
    aim(azimuth_bam, elevation_bam, (int32_t)1 << 14, way);
    for (int i = 0; i < 3; i++)
        view->sun_q14[i] = (int16_t)way[i];
}

void yb_view_orbit(yb_view_t *view, const yb_map_t *map, uint16_t azimuth_bam,
                   uint16_t elevation_bam, uint16_t distance_q8)
{
    uint32_t width = (uint32_t)fix_max(map->east_q8, map->north_q8);
    int32_t way[3];
    aim(azimuth_bam, elevation_bam, (int32_t)(width * distance_q8 >> 8), way);
    view->look_q8[0] = map->east_q8 >> 1;
    view->look_q8[1] = map->north_q8 >> 1;
    view->look_q8[2] = fix_product(map->low_q8 + map->high_q8, view->exaggerate_q8, 9);
    view->eye_q8[0] = view->look_q8[0] - way[0];
    view->eye_q8[1] = view->look_q8[1] - way[1];
    view->eye_q8[2] = view->look_q8[2] + way[2];
    view->azimuth_bam = azimuth_bam;
}

void yb_view_fly(yb_view_t *view, const yb_map_t *map, const int32_t eye_q8[3],
                 int32_t clearance_q8, uint16_t azimuth_bam, int16_t tilt_bam)
{
    int32_t *eye = view->eye_q8;
    for (int i = 0; i < 3; i++)
        eye[i] = eye_q8[i];
    clamp_place(eye);
    /* As unsigned numbers, what is below zero is far beyond the map's other sides. */
    if ((uint32_t)eye[0] <= map->east_q8 && (uint32_t)eye[1] <= map->north_q8) {
        int32_t floor = yb_map_height(map, (uint16_t)eye[0], (uint16_t)eye[1]);
        floor = fix_product(fix_max(floor, view->water_q8), view->exaggerate_q8, 8);
        clearance_q8 = fix_clamp(clearance_q8, 0, FAR_Q8);
        eye[2] = fix_max(eye[2], fix_min(floor, FAR_Q8) + clearance_q8);
    }
    int32_t way[3];
    aim(azimuth_bam, (uint16_t)tilt_bam, (int32_t)1 << 14, way);
    for (int i = 0; i < 3; i++)
        view->look_q8[i] = eye[i] + way[i];
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

/* Limits that make every product below fit; documented at yb_view_t. */
void camera_clamp(yb_frame_t *frame)
{
    yb_view_t *view = &frame->view;
    const yb_screen_t *screen = &frame->screen;
    clamp_place(view->eye_q8);
    clamp_place(view->look_q8);
    clamp_place(view->lamp_q8);
    /* The picture must stay within the pyramid of slope 2 that camera_project tests against. */
    int32_t least = LEAST_ZOOM_Q12;
    if (screen->height > screen->width)
        least = (int32_t)LEAST_ZOOM_Q12 * screen->height / screen->width;
    view->zoom_q12 = (uint16_t)fix_clamp(view->zoom_q12, fix_min(least, 65535), 65535);
    view->exaggerate_q8 = (uint16_t)fix_min(view->exaggerate_q8, 8 * 256);
    if (view->water_q8 != YB_NO_WATER)
        view->water_q8 = fix_clamp(view->water_q8, -YB_MAX_HEIGHT_Q8, YB_MAX_HEIGHT_Q8);
}

/* How far a depth is shifted left by 10 and then right until it has 15 bits. It is LEAST_NEAR or
 * more, or, in quarters, an eighth of that, rounded: it has 5 bits or more.
 */
static inline int shift_of(int32_t depth)
{
    return fix_log2_floor((uint32_t)depth) - (14 - 10);
}

/* A depth, or another coordinate of up to 20 bits, shifted so. */
static inline int32_t shifted(int32_t a, int shift)
{
    return a * ((int32_t)1 << 10) >> shift;
}

/* A place as the eye sees it, before it is turned. */
typedef struct {
    int32_t x, y, z;
} way_t;

static inline way_t way_to(const yb_frame_t *frame, uint32_t place, int32_t top_q8)
{
    const int32_t *eye = frame->view.eye_q8;
    return (way_t){
        ((int32_t)(place & 0xffff) - eye[0]) >> frame->eye_shift,
        ((int32_t)(place >> 16) - eye[1]) >> frame->eye_shift,
        camera_rise(frame, top_q8),
    };
}

static inline int32_t depth_of(const yb_frame_t *frame, way_t way)
{
    return (way.x * frame->depth_x + way.y * frame->depth_y + way.z * frame->depth_z) >> 14;
}

/* --- The frame's constants -------------------------------------------------------------------- */

/* A part of a length, as a sine: Q14. Of no length, something else. */
APART int32_t share_of(int32_t part, int32_t length, int32_t otherwise)
{
    return length > 0 ? fix_scale(part, (int32_t)1 << 14, length) : otherwise;
}

/* Rows of R (paper, DIGEST 3), from the sines and cosines of the camera's elevation and of its
 * azimuth β (paper: eye seen from look), Q14.
 */
static void find_rows(yb_frame_t *frame)
{
    const yb_view_t *view = &frame->view;
    /* Differences are within 2^21; 7 more bits keep short vectors exact: squares below 2^58. */
    int32_t way_q15[3];
    int32_t length_q15[3];
    int64_t square = 0;
    for (int i = 0; i < 3; i++) {
        way_q15[i] = (view->eye_q8[i] - view->look_q8[i]) * 128;
        square = fix_add(square, way_q15[i], way_q15[i]);
        length_q15[i] = (int32_t)fix_sqrt((uint64_t)square);
    }
    const int32_t flat = length_q15[1];
    const int32_t whole = length_q15[2];
    /* Straight down (or up) any β would do: the picture's top is where the view's azimuth says. */
    const int32_t sin_b = share_of(way_q15[1], flat, -yb_cos_q14(view->azimuth_bam));
    const int32_t cos_b = share_of(way_q15[0], flat, -yb_sin_q14(view->azimuth_bam));
    const int32_t sin_a = share_of(way_q15[2], whole, 0);
    const int32_t cos_a = share_of(flat, whole, 1 << 14);
    frame->right_x = -sin_b;
    frame->right_y = cos_b;
    frame->up_x = -((sin_a * cos_b) >> 14);
    frame->up_y = -((sin_a * sin_b) >> 14);
    frame->up_z = cos_a;
    frame->depth_x = -((cos_a * cos_b) >> 14);
    frame->depth_y = -((cos_a * sin_b) >> 14);
    frame->depth_z = -sin_a;
}

/* How far places are shifted so that each coordinate has 16 bits: the eye's distance from the
 * farthest corner of the map's bounding box, heights with what refinement, walls and water add. A
 * row's product is then within sqrt(3) 2^16 2^14 < 2^31.
 */
static void find_shift(yb_frame_t *frame, int32_t stray)
{
    const yb_map_t *map = frame->map;
    /* Heights are below 2^19, times an exaggeration of 2^11. */
    const int32_t corner[2][3] = {
        {0, 0, ((map->low_q8 - stray) * frame->view.exaggerate_q8) >> 8},
        {map->east_q8, map->north_q8, ((map->high_q8 + stray) * frame->view.exaggerate_q8) >> 8}};
    uint32_t all = 0;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++)
            all |= (uint32_t)fix_abs(corner[k][i] - frame->view.eye_q8[i]);
    }
    frame->eye_shift = 0;
    for (; all >> 16 != 0; all >>= 1)
        frame->eye_shift++;
}

/* The frame's 16-bit depths are spread from the nearest thing on. A unit of height changes a depth
 * by `bend`, Q14.
 */
static void find_near(yb_frame_t *frame, int32_t stray, int32_t bend)
{
    int32_t nearest = INT32_MAX;
    for (int i = 0; i < frame->map->vertex_count; i++) {
        const yb_vertex_t *v = &frame->map->vertex[i];
        nearest = fix_min(nearest, camera_depth(frame, relief_place(v), v->z_q8));
    }
    nearest -= fix_product(stray, bend, 14 + frame->eye_shift) + 2;
    frame->near = fix_max(nearest, fix_max(NEAREST_Q8 >> frame->eye_shift, LEAST_NEAR));
    const int shift = shift_of(frame->near);
    frame->near_shift = shift;
    frame->near_scaled = shifted(frame->near, shift);
}

/* A way on the screen, over a 1/depth: with 20 fractional bits, rounded down. 34 bits and 20 more,
 * less the 31 of `least`.
 */
APART uint32_t over(uint64_t way, uint32_t least)
{
    return (uint32_t)((way << 20) / least);
}

/* The same over a 1/depth that is up to an eighth nearer than it was, 8/7, and rounded up. */
APART uint32_t sway_of(uint64_t way, uint32_t least)
{
    return over(way * 8 / 7, least) + 1;
}

/* What a change of height does on the screen. `whole` is 1/depth times depth, in q8, and `bend`
 * what a unit of height changes a depth, Q14. A point at depth d has 65535 near / d in its spot, so
 * r units of height times that are r / d times the constant 65535 near: a rise of r moves it up by
 * focal * lift * r / d, and changes its depth by bend * r.
 */
static void find_lift(yb_frame_t *frame, uint64_t whole, uint32_t bend)
{
    frame->most_bend = bend > 0 ? (int32_t)fix_share(whole << 8, bend, MOST_BEND) : MOST_BEND;
    /* As 32 bits, the highest of them set: near is LEAST_NEAR or more, this has 36 or more. */
    int shift = 20;
    for (whole <<= 14; whole >> 32 != 0; whole >>= 1)
        shift++;
    const uint32_t least = (uint32_t)whole;
    int32_t lift = (frame->up_z * frame->view.exaggerate_q8) >> 8; /* 17 bits, as bend */
    const uint64_t up = (uint64_t)fix_wide(lift, frame->focal_q4);
    uint32_t rise = over(up, least);
    /* Up to a screen size off the screen. */
    const int32_t aside = (int32_t)frame->screen.width * 24;
    const int32_t along = (int32_t)frame->screen.height * 24;
    uint32_t sway_x = sway_of((uint64_t)fix_wide((int32_t)bend, aside), least);
    uint32_t sway_y = sway_of((uint64_t)fix_wide((int32_t)bend, along) + up, least);
    for (; shift > 41 || sway_x >= 2047 || sway_y >= 2047; shift--) { /* rise is less */
        rise >>= 1;
        sway_x = (sway_x + 1) >> 1;
        sway_y = (sway_y + 1) >> 1;
    }
    frame->lift = (int16_t)rise;
    frame->sway_x_q4 = (int32_t)sway_x;
    frame->sway_y_q4 = (int32_t)sway_y;
    frame->lift_shift = (uint8_t)fix_max(shift - 10, 0);
}

/* What foreshortening leaves of lengths along the view: from 30 degrees above the ground on all,
 * and never less than a quarter, for hills rise above their ground. Q14.
 */
static int32_t foreshortening(const yb_frame_t *frame)
{
    return fix_clamp(2 * fix_abs(frame->depth_z), 1 << 12, 1 << 14);
}

/* About a sixteenth of the screen's width. A smaller screen wants a little less: more of its
 * triangles meet no pixel's centre. Made for as many on 128 and on 320 pixels, in a view of the
 * whole map, which covers half of the screen. The nearer the eye, the more of it is covered, and
 * the longer edges may be, so that a frame takes about as long: above all on rough ground, for what
 * noise may bring into view must be split to be told apart from what is out of sight.
 */
static uint32_t usual_edge(const yb_frame_t *frame)
{
    const int32_t width = frame->screen.width;
    const int32_t far = 3 * fix_max(frame->map->east_q8, frame->map->north_q8) >> 3;
    const int32_t near = fix_min(frame->near << frame->eye_shift, far);
    const int32_t noise = frame->map->detail ? frame->map->noise[STEP_CLASS] : 0;
    const int32_t rough = fix_min(noise * frame->view.exaggerate_q8 >> 8, ROUGH_Q8);
    const int32_t more = (NEARER_Q8 + rough) * width / ROUGH_Q8;
    return (uint32_t)(fix_max(86 * width / 96 - 16, (width + 1) >> 1) + more * (far - near) / far);
}

/* An edge is split by its plan length, foreshortened in the direction of view. Where it is,
 * triangles are wider too, so that they cover about as many pixels in every view. `whole` as in
 * find_lift.
 */
static void find_lengths(yb_frame_t *frame, uint64_t whole)
{
    int32_t steep = foreshortening(frame);
    /* Where lengths are foreshortened already, triangles are open from less on. */
    frame->open_turn = (uint8_t)(OPEN_TURN * ((int32_t)1 << 14) / steep);
    int32_t wide = (steep + (1 << 14)) >> 1;
    int32_t high = (steep * wide) >> 14;
    frame->along_x = (frame->right_y * high) >> 15;
    frame->along_y = (-frame->right_x * high) >> 15;
    frame->across_x = (frame->right_x * wide) >> 15;
    frame->across_y = (frame->right_y * wide) >> 15;
    /* focal * 2 length_q7 / depth > edge, with depth as 65535 near / (1/depth). */
    uint32_t edge_q4 = frame->view.edge_q4;
    if (edge_q4 == 0)
        edge_q4 = usual_edge(frame);
    frame->thin_q4 = (int32_t)edge_q4;
    frame->longest = fix_share(whole * edge_q4, (uint32_t)(2 * frame->focal_q4), UINT32_MAX);
}

void camera_begin(yb_frame_t *frame, int32_t stray)
{
    const yb_view_t *view = &frame->view;
    frame->focal_q4 =
        fix_min((int32_t)(((uint32_t)frame->screen.width * view->zoom_q12) >> 8), MOST_FOCAL_Q4);
    find_rows(frame);
    find_shift(frame, stray);
    int32_t bend = (fix_abs(frame->depth_z) * view->exaggerate_q8) >> 8; /* 17 bits */
    find_near(frame, stray, bend);
    /* 40 bits: near has 17, and eye_shift is 7 at most. */
    uint64_t whole = (uint64_t)65535 * (uint32_t)frame->near << frame->eye_shift;
    frame->spare_q4 = 3 * frame->focal_q4 / frame->near; /* below 2^12 */
    find_lift(frame, whole, (uint32_t)bend);
    find_lengths(frame, whole);
    for (int i = 0; i < frame->map->vertex_count; i++) {
        const yb_vertex_t *v = &frame->map->vertex[i];
        yb_point_t *point = &frame->root[0]; /* no triangle needs it yet */
        point->place = relief_place(v);
        point->top_q8 = fix_max(v->z_q8, view->water_q8);
        camera_see(frame, point);
        frame->seen[i].x_q4 = point->spot.x_q4;
        frame->seen[i].y_q4 = point->spot.y_q4;
        frame->seen[i].near = point->spot.near;
    }
}

/* --- The screen ------------------------------------------------------------------------------- */

void camera_view_finely(const yb_frame_t *frame, uint32_t place, int32_t top_q8, camera_point_t *to)
{
    const way_t way = way_to(frame, place, top_q8);
    const int shift = 14 - CAMERA_FINER;
    to->right = (way.x * frame->right_x + way.y * frame->right_y) >> shift;
    to->up = (way.x * frame->up_x + way.y * frame->up_y + way.z * frame->up_z) >> shift;
    to->depth = (way.x * frame->depth_x + way.y * frame->depth_y + way.z * frame->depth_z) >> shift;
}

void camera_view(const yb_frame_t *frame, uint32_t place, int32_t top_q8, camera_point_t *to)
{
    camera_view_finely(frame, place, top_q8, to);
    to->right >>= CAMERA_FINER;
    to->up >>= CAMERA_FINER;
    to->depth >>= CAMERA_FINER;
}

int32_t camera_depth(const yb_frame_t *frame, uint32_t place, int32_t top_q8)
{
    return depth_of(frame, way_to(frame, place, top_q8));
}

/* 2^29 over a depth that is shifted so: 2^14 to 2^15. */
static inline int32_t inverse_of(int32_t depth, int shift)
{
    return fix_reciprocal(shifted(depth, shift));
}

/* near / depth * 2^16: both factors have 15 bits, and depth is hardly nearer than near. */
static inline int32_t near_ratio(const yb_frame_t *frame, int32_t inverse, int shift)
{
    int32_t ratio = (frame->near_scaled * inverse) >> (13 + shift - frame->near_shift);
    return fix_clamp(ratio, 1, 65535);
}

int32_t camera_near(const yb_frame_t *frame, int32_t depth)
{
    int shift = shift_of(depth);
    return near_ratio(frame, inverse_of(depth, shift), shift);
}

/* Where a place is seen from the upper left corner, 1/16 pixel, and its 1/depth. right and up are
 * at most 2 depth and some units, which are a 32nd of the least depth: x is within 1.05 * 2^15, and
 * times MOST_FOCAL_Q4 below 2^31.
 */
static inline int32_t project(const yb_frame_t *frame, const camera_point_t *from, int32_t *x_q4,
                              int32_t *y_q4)
{
    int shift = shift_of(from->depth);
    int32_t inverse = inverse_of(from->depth, shift);
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
    int32_t x_q4 = 0;
    int32_t y_q4 = 0;
    int32_t near = 0;
    if (at.depth >= frame->near && fix_abs(at.right) < 2 * at.depth &&
        fix_abs(at.up) < 2 * at.depth) {
        near = project(frame, &at, &x_q4, &y_q4);
        const uint32_t wide = frame->screen.width * (uint32_t)16;
        const uint32_t high = frame->screen.height * (uint32_t)16;
        if ((uint32_t)x_q4 + wide > 3 * wide || (uint32_t)y_q4 + high > 3 * high)
            x_q4 = y_q4 = near = 0;
    }
    point->spot.x_q4 = (yb_side_t)x_q4;
    point->spot.y_q4 = (yb_side_t)y_q4;
    point->spot.near = (uint16_t)near;
    point->spot.out = 0;
}

void camera_drop(const yb_frame_t *frame, const yb_point_t *point, int32_t z_q8, yb_point_t *to)
{
    *to = *point;
    to->z_q8 = to->top_q8 = z_q8;
    camera_see(frame, to);
}
