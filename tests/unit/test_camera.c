/* The camera: where things are seen, against double; and any view at all without harm. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "camera.h"
#include "loaded_map.h"
#include "plain_frame.h"
#include "relief.h"

static yb_frame_t frame;

/* A bare frame: vertices 0 to 3 are SW, SE, NE, NW. */
static void load_frame(int east, int north, const int height[4])
{
    plan_t plan;
    plan_init(&plan, east, north);
    for (int k = 0; k < 4; k++)
        plan.corner_height[k] = height[k];
    load_plan(&plan);
}

static const yb_screen_t screen = {128, 64, YB_GREY4};

/* Vertex i in view space, q8. */
static camera_point_t seen(int i)
{
    camera_point_t at;
    camera_view(&frame, relief_place(&map.vertex[i]), map.vertex[i].z_q8, &at);
    at.right *= 1 << frame.eye_shift;
    at.up *= 1 << frame.eye_shift;
    at.depth *= 1 << frame.eye_shift;
    return at;
}

static void from_the_south_east_is_on_the_right(void **state)
{
    (void)state;
    const int height[4] = {0, 0, 50, 50};
    load_frame(255, 255, height);
    yb_view_t view;
    yb_view_init(&view, &map); /* azimuth 0: the eye stands in the south */
    yb_frame_begin(&frame, &map, &view, &screen);
    assert_true(view.eye_q8[1] < 0);
    assert_true(view.eye_q8[2] > 0);
    assert_true(seen(1).right > 0 && seen(2).right > 0);
    assert_true(seen(0).right < 0 && seen(3).right < 0);
    assert_true(seen(2).up > seen(1).up);
    assert_true(seen(2).depth > seen(1).depth);
    yb_point_t corner[4];
    for (int i = 0; i < 4; i++) {
        camera_root(&frame, (yb_index_t)i, &corner[i]);
        assert_true(corner[i].spot.near > 0);
    }
    assert_true(corner[1].spot.x_q4 > 64 * 16 && corner[0].spot.x_q4 < 64 * 16);
    assert_true(corner[2].spot.y_q4 < corner[1].spot.y_q4);
    assert_true(corner[2].spot.near < corner[1].spot.near);
}

static void higher_is_further_up(void **state)
{
    (void)state;
    for (int azimuth = 0; azimuth < 360; azimuth += 15) {
        int32_t before = INT32_MIN;
        for (int z = 0; z < 100; z += 10) {
            const int height[4] = {0, z, 0, 100};
            load_frame(200, 200, height);
            yb_view_t view;
            yb_view_init(&view, &map);
            yb_view_orbit(&view, &map, YB_DEGREES(azimuth), YB_DEGREES(20), 400);
            yb_frame_begin(&frame, &map, &view, &screen);
            assert_true(seen(1).up > before);
            before = seen(1).up;
        }
    }
}

static void straight_down_the_azimuth_is_up(void **state)
{
    (void)state;
    const int height[4] = {0, 0, 0, 0};
    load_frame(200, 200, height);
    for (int quarter = 0; quarter < 4; quarter++) {
        for (int how = 0; how < 2; how++) {
            yb_view_t view;
            yb_view_init(&view, &map);
            if (how == 0) {
                yb_view_orbit(&view, &map, (uint16_t)(quarter * 0x4000), YB_DEGREES(90), 400);
            } else { /* up from below: what lies towards the azimuth is at the bottom */
                view.azimuth_bam = (uint16_t)(quarter * 0x4000);
                view.eye_q8[0] = view.look_q8[0] = 100 * 256;
                view.eye_q8[1] = view.look_q8[1] = 100 * 256;
                view.eye_q8[2] = -30000;
                view.look_q8[2] = 0;
            }
            yb_frame_begin(&frame, &map, &view, &screen);
            /* Clockwise from the azimuth: north (NW, NE), east, south, west. */
            static const int top[4][2] = {{3, 2}, {2, 1}, {1, 0}, {0, 3}};
            int sign = how == 0 ? 1 : -1;
            assert_true(sign * seen(top[quarter][0]).up > 20000);
            assert_true(sign * seen(top[quarter][1]).up > 20000);
            assert_true(seen(top[quarter][0]).right < -20000);
            assert_true(seen(top[quarter][1]).right > 20000);
        }
    }
}

/* The paper's matrix (DIGEST 3) in double. */
typedef struct {
    double right, up, depth, offset;
} seen_t;

static void see(const yb_view_t *view, const yb_vertex_t *v, seen_t *seen)
{
    double d[3];
    double x[3] = {v->x_q8, v->y_q8, v->z_q8 * (view->exaggerate_q8 / 256.0)};
    for (int i = 0; i < 3; i++) {
        d[i] = (double)view->eye_q8[i] - view->look_q8[i];
        x[i] -= view->look_q8[i];
    }
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double a = asin(d[2] / length);
    double b = atan2(d[1], d[0]);
    double q1 = cos(a) * cos(b) * x[0] + cos(a) * sin(b) * x[1] + sin(a) * x[2];
    seen->right = -sin(b) * x[0] + cos(b) * x[1];
    seen->up = -sin(a) * cos(b) * x[0] - sin(a) * sin(b) * x[1] + cos(a) * x[2];
    seen->depth = length - q1;
    for (int i = 0; i < 3; i++)
        x[i] -= d[i];
    seen->offset = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

static void positions_are_the_papers(void **state)
{
    (void)state;
    rng_t rng = {51};
    double worst = 0;
    double worst_q4 = 0;
    int on_screen = 0;
    for (int round = 0; round < 3000; round++) {
        plan_t plan;
        if (round % 20 == 0) {
            random_fitting_plan(&plan, &rng);
            load_plan(&plan);
        }
        yb_view_t view;
        random_view(&view, &map, &rng);
        view.water_q8 = YB_NO_WATER;
        if (view.eye_q8[0] == view.look_q8[0] && view.eye_q8[1] == view.look_q8[1])
            continue;
        yb_frame_begin(&frame, &map, &view, &screen);
        for (int i = 0; i < map.vertex_count; i++) {
            seen_t truth;
            see(&view, &map.vertex[i], &truth);
            /* Fourteen bits of sine and cosine, twice rounded, three terms. */
            double most = 4 * (1 << frame.eye_shift) + truth.offset * 4 / 16384;
            double off = fmax(fabs(seen(i).right - truth.right),
                              fmax(fabs(seen(i).up - truth.up), fabs(seen(i).depth - truth.depth)));
            worst = fmax(worst, off / most);
            yb_point_t point;
            camera_root(&frame, (yb_index_t)i, &point);
            double x = 64 * 16 + truth.right / truth.depth * frame.focal_q4;
            double y = 32 * 16 - truth.up / truth.depth * frame.focal_q4;
            if (point.spot.near == 0 || x < 0 || x > 128 * 16 || y < 0 || y > 64 * 16)
                continue;
            on_screen++;
            double spread = 3 * most / truth.depth * frame.focal_q4 + 2;
            worst_q4 =
                fmax(worst_q4, fmax(fabs(point.spot.x_q4 - x), fabs(point.spot.y_q4 - y)) / spread);
            double near = 65536.0 * (frame.near << frame.eye_shift) / truth.depth;
            assert_true(fabs(fmin(near, 65535) - point.spot.near) <
                        10 + near * (2 * most / truth.depth + 0.001));
        }
    }
    print_message("%d points on the screen; view space within %.2f, screen within %.2f of bounds\n",
                  on_screen, worst, worst_q4);
    assert_true(on_screen > 10000);
    assert_true(worst <= 1);
    assert_true(worst_q4 <= 1);
}

static void known_projections(void **state)
{
    (void)state;
    /* Looking north along the ground from 100 steps south of a frame 100 wide: with 50 degrees,
     * focal length 4392/4096 of 128 pixels = 137.25, the near corners are 50/100 focal lengths
     * off the middle. */
    const int height[4] = {0, 0, 0, 0};
    load_frame(100, 100, height);
    yb_view_t view;
    yb_view_init(&view, &map);
    const int32_t eye[3] = {50 * 256, -100 * 256, 0};
    const int32_t look[3] = {50 * 256, 0, 0};
    memcpy(view.eye_q8, eye, sizeof eye);
    memcpy(view.look_q8, look, sizeof look);
    yb_frame_begin(&frame, &map, &view, &screen);
    static const double x[4] = {64 - 68.625, 64 + 68.625, 64 + 34.3125, 64 - 34.3125};
    for (int i = 0; i < 4; i++) {
        yb_point_t point;
        camera_root(&frame, (yb_index_t)i, &point);
        assert_true(fabs(point.spot.x_q4 / 16.0 - x[i]) <= 0.125);
        assert_int_equal(point.spot.y_q4, 32 * 16);
    }
}

static void orbits_keep_their_distance(void **state)
{
    (void)state;
    rng_t rng = {52};
    const int height[4] = {0, 60, 20, 100};
    load_frame(240, 100, height);
    for (int round = 0; round < 2000; round++) {
        yb_view_t view;
        yb_view_init(&view, &map);
        view.exaggerate_q8 = (uint16_t)rng_range(&rng, 64, 1024);
        uint16_t azimuth = (uint16_t)rng_range(&rng, 0, 65535);
        uint16_t elevation = (uint16_t)rng_range(&rng, 0, 0x4000);
        uint16_t distance = (uint16_t)rng_range(&rng, 50, 3000);
        yb_view_orbit(&view, &map, azimuth, elevation, distance);
        double d[3];
        for (int i = 0; i < 3; i++)
            d[i] = (double)view.eye_q8[i] - view.look_q8[i];
        double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        double truth = 240.0 * distance;
        assert_true(fabs(length - truth) < 3 + truth / 4000);
        assert_int_equal(view.look_q8[0], 120 * 256);
        assert_int_equal(view.look_q8[1], 50 * 256);
        assert_int_equal(view.look_q8[2], 50 * view.exaggerate_q8);
        double turned = atan2(-d[0], -d[1]) * 65536 / 6.283185307179586;
        if (elevation < 0x3f00)
            assert_true(fabs(remainder(turned - azimuth, 65536)) < 20 + 4e5 / length);
    }
}

static void any_view_at_all(void **state)
{
    (void)state;
    rng_t rng = {53};
    static uint8_t pixels[64 * 48 * 2];
    for (int round = 0; round < 20000; round++) {
        plan_t plan;
        if (round % 40 == 0) {
            random_fitting_plan(&plan, &rng);
            if (rng_one_in(&rng, 4)) {
                plan.gain = 255;
                int unit = plan.unit;
                plan.unit = 0xfff;
                plan.unit = map_fits(&plan) ? plan.unit : unit;
            }
            load_plan(&plan);
        }
        yb_view_t view;
        wild_view(&view, &rng);
        yb_screen_t page = {(uint16_t)(2 * rng_range(&rng, 1, 32)),
                            (uint16_t)rng_range(&rng, 1, 48),
                            rng_one_in(&rng, 2) ? YB_GREY4 : YB_RGB565};
        yb_frame_begin(&frame, &map, &view, &page);
        yb_band_t band = {0, page.height, pixels, yb_screen_pitch(&page), NULL};
        yb_frame_band(&frame, &band);
    }
}

static void an_eye_keeps_off_the_ground(void **state)
{
    (void)state;
    rng_t rng = {96};
    int raised = 0;
    for (int round = 0; round < 4000; round++) {
        if (round % 100 == 0) {
            plan_t plan;
            random_fitting_plan(&plan, &rng);
            load_plan(&plan);
        }
        yb_view_t view;
        yb_view_init(&view, &map);
        view.exaggerate_q8 = (uint16_t)rng_range(&rng, 100, 1000);
        if (rng_one_in(&rng, 2))
            view.water_q8 = rng_range(&rng, map.low_q8, map.high_q8);
        const int32_t eye[3] = {rng_range(&rng, -20000, 90000), rng_range(&rng, -20000, 90000),
                                rng_range(&rng, -90000, 90000)};
        const int32_t height = rng_range(&rng, 0, 2000);
        const uint16_t azimuth = (uint16_t)rng_range(&rng, 0, 65535);
        const int16_t tilt = (int16_t)rng_range(&rng, -16384, 16384);
        const bool above =
            eye[0] >= 0 && eye[1] >= 0 && eye[0] <= map.east_q8 && eye[1] <= map.north_q8;
        yb_view_fly(&view, &map, eye, height, azimuth, tilt);
        assert_int_equal(view.eye_q8[0], eye[0]);
        assert_int_equal(view.eye_q8[1], eye[1]);
        /* It looks where it was told to: within 1/8192 of a unit vector each way. */
        const double turn = azimuth * acos(-1.0) / 32768;
        const double up = tilt * acos(-1.0) / 32768;
        const double ahead[3] = {sin(turn) * cos(up), cos(turn) * cos(up), sin(up)};
        for (int i = 0; i < 3; i++)
            assert_true(fabs((view.look_q8[i] - view.eye_q8[i]) / 16384.0 - ahead[i]) < 5e-4);
        if (!above) {
            assert_int_equal(view.eye_q8[2], eye[2]);
            continue;
        }
        int32_t floor = yb_map_height(&map, (uint16_t)eye[0], (uint16_t)eye[1]);
        floor = floor > view.water_q8 ? floor : view.water_q8;
        const int32_t least = (int32_t)((int64_t)floor * view.exaggerate_q8 >> 8) + height;
        assert_int_equal(view.eye_q8[2], eye[2] > least ? eye[2] : least);
        raised += eye[2] < least;
        yb_view_walk(&view, &map, (uint16_t)eye[0], (uint16_t)eye[1], height, azimuth, tilt);
        assert_int_equal(view.eye_q8[2], least);
    }
    assert_in_range(raised, 100, 3000);
    /* A place beyond the frame is its nearest side. */
    yb_view_t view;
    yb_view_init(&view, &map);
    yb_view_walk(&view, &map, 65535, 65535, 100, 0, 0);
    assert_int_equal(view.eye_q8[0], map.east_q8);
    assert_int_equal(view.eye_q8[1], map.north_q8);
}

/* The longest edge of a map with so much noise, from on it. */
static int32_t usual_edge_near(int gain)
{
    plan_t plan;
    plan_init(&plan, 255, 255);
    for (int k = 0; k < 4; k++)
        plan.corner_height[k] = k < 2 ? 0 : 50;
    plan.gain = gain;
    load_plan(&plan);
    yb_view_t view;
    yb_view_init(&view, &map);
    yb_view_walk(&view, &map, 30000, 30000, 500, 0, 0);
    yb_frame_begin(&frame, &map, &view, &screen);
    return frame.thin_q4;
}

/* Where no length is asked for: from round the map a sixteenth of the width, near it more, and on
 * rough ground up to a sixteenth more again.
 */
static void edges_near_the_eye_are_longer(void **state)
{
    (void)state;
    const int height[4] = {0, 0, 50, 50};
    load_frame(255, 255, height);
    yb_view_t view;
    yb_view_init(&view, &map);
    yb_frame_begin(&frame, &map, &view, &screen);
    assert_int_equal(frame.thin_q4, 98);
    assert_in_range(usual_edge_near(0), 98 + 66, 98 + 70);
    assert_in_range(usual_edge_near(255), 98 + 66 + 122, 98 + 70 + 128);
    int32_t last = usual_edge_near(0);
    int longer = 0;
    for (int gain = 1; gain < 32; gain++) {
        const int32_t edge = usual_edge_near(gain);
        assert_true(edge >= last);
        longer += edge > last;
        last = edge;
    }
    assert_true(longer > 4);
    view.edge_q4 = 103;
    yb_frame_begin(&frame, &map, &view, &screen);
    assert_int_equal(frame.thin_q4, 103);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_the_south_east_is_on_the_right),
        cmocka_unit_test(higher_is_further_up),
        cmocka_unit_test(straight_down_the_azimuth_is_up),
        cmocka_unit_test(positions_are_the_papers),
        cmocka_unit_test(known_projections),
        cmocka_unit_test(orbits_keep_their_distance),
        cmocka_unit_test(any_view_at_all),
        cmocka_unit_test(an_eye_keeps_off_the_ground),
        cmocka_unit_test(edges_near_the_eye_are_longer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
