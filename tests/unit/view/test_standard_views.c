/* The standard views stand where they say. */
#include "codes.h"
#include "standard_views.h"

#include <string.h>

static yb_view_t standard(const yb_map_t *map, yb_standard_view_t which)
{
    yb_view_t view;
    yb_view_init(&view, map);
    yb_standard_view_set(&view, map, which);
    return view;
}

static void names_are_complete(void **state)
{
    (void)state;
    for (int i = 0; i < YB_STANDARD_VIEWS; i++)
        assert_non_null(yb_standard_view_name(i));
    assert_null(yb_standard_view_name(YB_STANDARD_VIEWS));
    assert_null(yb_standard_view_name(-1));
    assert_string_equal(yb_standard_view_name(YB_ORBIT_225), "orbit-225");
    assert_string_equal(yb_standard_view_name(YB_WALK_2), "walk-2");
}

static void orbits_look_where_they_are_called(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    /* Looking north-east, the eye is in the south-west, and so on round. */
    const int signs[4][2] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}};
    for (int i = 0; i < 4; i++) {
        const yb_view_t view = standard(&file->map, (yb_standard_view_t)i);
        assert_true((view.eye_q8[0] - view.look_q8[0]) * signs[i][0] > 0);
        assert_true((view.eye_q8[1] - view.look_q8[1]) * signs[i][1] > 0);
        assert_true(view.eye_q8[2] > view.look_q8[2]);
    }
    yb_code_file_free(file);
}

static void summits_are_looked_from(void **state)
{
    (void)state;
    yb_code_file_t *file = code_hill();
    const yb_view_t out = standard(&file->map, YB_SUMMIT_1);
    const yb_view_t back = standard(&file->map, YB_SUMMIT_2);
    const int32_t width = file->map.east_q8;
    /* 1000 m in steps of 30 m. */
    const int32_t summit = 1000 * 256 / 30;
    assert_int_equal(out.eye_q8[0], 128 * 256);
    assert_int_equal(out.eye_q8[1], 128 * 256);
    assert_in_range(out.eye_q8[2], summit + width / 100 - 1, summit + width / 100 + 1);
    assert_memory_equal(out.eye_q8, back.eye_q8, sizeof(out.eye_q8));
    assert_int_equal(out.look_q8[0], out.eye_q8[0] + width);
    assert_int_equal(back.look_q8[0], out.eye_q8[0] - width);
    assert_int_equal(out.look_q8[1], out.eye_q8[1]);
    assert_int_equal(out.look_q8[2], out.eye_q8[2] - width / 6);
    yb_code_file_free(file);

    /* The summit is nearer to the eastern side: now north and south have more ground. */
    file = code_eastern_hill();
    const yb_view_t north = standard(&file->map, YB_SUMMIT_1);
    assert_int_equal(north.look_q8[0], north.eye_q8[0]);
    assert_int_equal(north.look_q8[1], north.eye_q8[1] + width);
    yb_code_file_free(file);
}

static void walkers_stand_on_the_ground(void **state)
{
    (void)state;
    yb_code_file_t *file = code_rough_hill();
    for (int i = 1; i <= 2; i++) {
        const yb_view_t view = standard(&file->map, i == 1 ? YB_WALK_1 : YB_WALK_2);
        const int32_t place = file->map.east_q8 * i / 3;
        assert_int_equal(view.eye_q8[0], place);
        assert_int_equal(view.eye_q8[1], place);
        assert_int_equal(view.eye_q8[2],
                         yb_map_height(&file->map, (uint16_t)place, (uint16_t)place) +
                             file->map.east_q8 / 100);
        assert_true(view.look_q8[2] > view.eye_q8[2]);
    }
    /* On a lake they stand on the water. */
    yb_view_t view;
    yb_view_init(&view, &file->map);
    view.water_q8 = file->map.high_q8;
    yb_standard_view_set(&view, &file->map, YB_WALK_1);
    assert_int_equal(view.eye_q8[2], file->map.high_q8 + file->map.east_q8 / 100);
    yb_code_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_complete),
        cmocka_unit_test(orbits_look_where_they_are_called),
        cmocka_unit_test(summits_are_looked_from),
        cmocka_unit_test(walkers_stand_on_the_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
