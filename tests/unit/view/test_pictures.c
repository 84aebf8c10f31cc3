/* Frames, their hash, and the pictures made of them. */
#include "codes.h"
#include "numbered.h"
#include "picture.h"
#include "relief_picture.h"
#include "still.h"
#include "surface.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

/* Reads a PNG file back; asserts its size and answers its samples. */
static uint8_t *read_back(const uint8_t *file, size_t size, const yb_picture_t *expected)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_memory(&image, file, size));
    assert_int_equal(image.width, expected->width);
    assert_int_equal(image.height, expected->height);
    assert_int_equal(image.format, expected->channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB);
    uint8_t *samples = malloc(PNG_IMAGE_SIZE(image));
    assert_non_null(samples);
    assert_true(png_image_finish_read(&image, NULL, samples, 0, NULL));
    return samples;
}

static bool contains(const uint8_t *bytes, size_t size, const char *chunk)
{
    for (size_t i = 0; i + 4 <= size; i++) {
        if (memcmp(bytes + i, chunk, 4) == 0)
            return true;
    }
    return false;
}

static void check_round_trip(const yb_screen_t *screen, const uint8_t *pixels,
                             const uint8_t *expected)
{
    yb_picture_t picture;
    size_t size = 0, again_size = 0;
    assert_true(yb_picture_from_frame(&picture, screen, pixels));
    uint8_t *file = yb_picture_png(&picture, &size);
    uint8_t *again = yb_picture_png(&picture, &again_size);
    assert_non_null(file);
    assert_non_null(again);
    assert_int_equal(size, again_size);
    assert_memory_equal(file, again, size);
    assert_false(contains(file, size, "tEXt"));
    assert_false(contains(file, size, "tIME"));
    uint8_t *samples = read_back(file, size, &picture);
    assert_memory_equal(samples, expected,
                        (size_t)screen->width * screen->height * picture.channels);
    free(samples);
    free(file);
    free(again);
    yb_picture_free(&picture);
}

static void png_keeps_every_pixel(void **state)
{
    (void)state;
    const yb_screen_t grey = {.width = 4, .height = 2, .format = YB_GREY4};
    const uint8_t grey_pixels[] = {0x0f, 0x12, 0xe8, 0x70};
    const uint8_t grey_samples[] = {0, 255, 17, 34, 238, 136, 119, 0};
    check_round_trip(&grey, grey_pixels, grey_samples);

    const yb_screen_t colour = {.width = 3, .height = 2, .format = YB_RGB565};
    const uint8_t colour_pixels[] = {0xf8, 0x00, 0x07, 0xe0, 0x00, 0x1f,
                                     0xff, 0xff, 0x00, 0x00, 0x84, 0x10};
    const uint8_t colour_samples[] = {255, 0,   0,   0, 255, 0, 0,   0,   255,
                                      255, 255, 255, 0, 0,   0, 132, 130, 132};
    check_round_trip(&colour, colour_pixels, colour_samples);
}

static void the_hash_is_fnv_1a(void **state)
{
    (void)state;
    uint8_t pixels[6] = {'f', 'o', 'o', 'b', 'a', 'r'};
    yb_still_t still = {.screen = {.width = 2, .height = 1, .format = YB_GREY4}, .pixels = pixels};
    assert_int_equal(yb_still_hash(&still), 0xe30c2799); /* "f" */
    still.screen = (yb_screen_t){.width = 3, .height = 1, .format = YB_RGB565};
    assert_int_equal(yb_still_hash(&still), 0xbf9cf968); /* "foobar" */
}

static void bands_make_the_same_picture(void **state)
{
    (void)state;
    yb_code_file_t *file = code_rough_hill();
    const yb_screen_t screen = {.width = 96, .height = 50, .format = YB_RGB565};
    const uint16_t rows[] = {0, 1, 7, 16, 49, 50, 200};
    uint32_t hash = 0;
    yb_view_t view;
    yb_view_init(&view, &file->map);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        yb_still_t still;
        assert_true(yb_still_draw(&still, &file->map, &view, &screen, rows[i], 0));
        if (i == 0)
            hash = yb_still_hash(&still);
        assert_int_equal(yb_still_hash(&still), hash);
        assert_true(still.stats.drawn > 0);
        yb_still_free(&still);
    }
    yb_code_file_free(file);
}

static void json_has_every_field(void **state)
{
    (void)state;
    static const char *const view_fields[] = {
        "eye_q8",  "look_q8", "azimuth_bam", "zoom_q12",      "exaggerate_q8",
        "edge_q4", "sun_q14", "walls",       "water_q8",      "max_leaves",
        "palette", "haze_q8", "contour_q8",  "contour_at_q8", "lamp_q8"};
    yb_code_file_t *file = code_hill();
    const yb_screen_t screen = {.width = 64, .height = 32, .format = YB_GREY4};
    yb_view_t view;
    yb_still_t still;
    yb_view_init(&view, &file->map);
    assert_true(yb_still_draw(&still, &file->map, &view, &screen, 0, 0));
    json_t *json = yb_still_json(&still);
    assert_non_null(json);
    json_t *fields = json_object_get(json, "view");
    for (size_t i = 0; i < sizeof(view_fields) / sizeof(view_fields[0]); i++)
        assert_non_null(json_object_get(fields, view_fields[i]));
    assert_int_equal(json_object_size(fields), sizeof(view_fields) / sizeof(view_fields[0]));
    assert_true(json_is_null(json_object_get(fields, "water_q8")));
    assert_int_equal(json_integer_value(json_array_get(json_object_get(fields, "eye_q8"), 2)),
                     view.eye_q8[2]);
    assert_string_equal(
        json_string_value(json_object_get(json_object_get(json, "screen"), "format")), "grey4");
    assert_int_equal(strlen(json_string_value(json_object_get(json, "fnv1a"))), 8);
    json_decref(json);
    yb_still_free(&still);
    yb_code_file_free(file);
}

/* Column of the first pixel from the top that is not sky, as its row begins with. */
static uint32_t peak_column(const yb_picture_t *picture)
{
    for (uint32_t y = 0; y < picture->height; y++) {
        for (uint32_t x = 0; x < picture->width; x++) {
            const size_t at = ((size_t)y * picture->width + x) * picture->channels;
            if (memcmp(picture->samples + at, picture->samples + at - x * picture->channels,
                       picture->channels) != 0)
                return x;
        }
    }
    return UINT32_MAX;
}

static void draw_both(const yb_map_t *map, uint16_t azimuth_bam, uint32_t column[2])
{
    const yb_screen_t screen = {.width = 160, .height = 120, .format = YB_RGB565};
    yb_view_t view;
    yb_still_t still;
    yb_picture_t picture;
    yb_mesh_t mesh;
    yb_view_init(&view, map);
    yb_view_orbit(&view, map, azimuth_bam, YB_DEGREES(5), 384);
    assert_true(yb_still_draw(&still, map, &view, &screen, 0, 0));
    assert_true(yb_picture_from_frame(&picture, &screen, still.pixels));
    column[0] = peak_column(&picture);
    assert_true(yb_mesh_from_map(&mesh, map, 1024));
    assert_true(yb_relief_picture_draw(&picture, &mesh, map, &view));
    column[1] = peak_column(&picture);
    yb_mesh_free(&mesh);
    yb_picture_free(&picture);
    yb_still_free(&still);
}

static void from_the_south_east_is_on_the_right(void **state)
{
    (void)state;
    yb_code_file_t *file = code_eastern_hill();
    uint32_t column[2];
    draw_both(&file->map, YB_DEGREES(0), column);
    for (int i = 0; i < 2; i++)
        assert_in_range(column[i], 100, 150);
    draw_both(&file->map, YB_DEGREES(180), column);
    for (int i = 0; i < 2; i++)
        assert_in_range(column[i], 10, 60);
    draw_both(&file->map, YB_DEGREES(90), column);
    for (int i = 0; i < 2; i++)
        assert_in_range(column[i], 75, 85);
    yb_code_file_free(file);
}

static void patterns_have_one_number(void **state)
{
    static const char *const wrong[] = {"f.png",   "f-%s.png", "%d-%d.png", "f-%", "f-%5d",
                                        "f-%0d.p", "f-%010d",  "%n%d",      "%%d", "f-%ld.png"};
    (void)state;
    yb_error_t error;
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
        if (yb_numbered_check(wrong[i], &error))
            fail_msg("%s was taken", wrong[i]);
    }
    static const char *const good[][2] = {
        {"f-%03d.png", "f-007.png"}, {"%d", "7"}, {"100%%-%02d", "100%-07"}};
    for (size_t i = 0; i < sizeof(good) / sizeof(good[0]); i++) {
        assert_true(yb_numbered_check(good[i][0], &error));
        char *name = yb_numbered_name(good[i][0], 7);
        assert_string_equal(name, good[i][1]);
        free(name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_keeps_every_pixel),
        cmocka_unit_test(the_hash_is_fnv_1a),
        cmocka_unit_test(bands_make_the_same_picture),
        cmocka_unit_test(json_has_every_field),
        cmocka_unit_test(from_the_south_east_is_on_the_right),
        cmocka_unit_test(patterns_have_one_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
