/* The published codes, damaged in every small way there is, and bytes that only look like a code.
 *
 *     test_gallery MAP.yb ...
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "check.h"
#include "maps.h"
#include "rng.h"

enum {
    MOST_MAPS = 64,
    RANDOM_CODES = 60000
};

typedef struct {
    const char *path;
    size_t size;
    uint8_t bytes[YB_MAX_CODE_BYTES];
} code_t;

static code_t codes[MOST_MAPS];
static int code_count;
static yb_map_t map;
static yb_map_t whole;
static yb_load_t load;
static yb_frame_t frame;

static void read_code(const char *path)
{
    code_t *code = &codes[code_count++];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    code->path = path;
    code->size = fread(code->bytes, 1, sizeof code->bytes, file);
    assert_true(feof(file) != 0 || fgetc(file) == EOF);
    assert_int_equal(fclose(file), 0);
}

static void every_code_loads(void **state)
{
    (void)state;
    assert_true(code_count >= 6);
    for (int i = 0; i < code_count; i++)
        assert_int_equal(yb_map_load(&map, &load, codes[i].bytes, codes[i].size), YB_OK);
}

static void every_truncation_is_refused(void **state)
{
    (void)state;
    for (int i = 0; i < code_count; i++) {
        for (size_t n = 0; n < codes[i].size; n++)
            assert_int_equal(yb_map_load(&map, &load, codes[i].bytes, n), YB_ERR_TRUNCATED);
    }
}

static void every_flipped_bit_is_refused(void **state)
{
    (void)state;
    for (int i = 0; i < code_count; i++) {
        for (size_t bit = 0; bit < codes[i].size * 8; bit++) {
            codes[i].bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
            assert_true(yb_map_load(&map, &load, codes[i].bytes, codes[i].size) < 0);
            codes[i].bytes[bit / 8] ^= (uint8_t)(1u << bit % 8);
        }
    }
}

/* Cut anywhere in two, or into single bytes: the same map to the last byte of the struct. */
static void every_cut_gives_the_same_map(void **state)
{
    (void)state;
    for (int i = 0; i < code_count; i++) {
        const code_t *code = &codes[i];
        assert_int_equal(yb_map_load(&whole, &load, code->bytes, code->size), YB_OK);
        for (size_t cut = 0; cut <= code->size; cut++) {
            yb_map_begin(&map, &load);
            yb_status_t first = yb_map_feed(&map, &load, code->bytes, cut);
            assert_int_equal(first, cut < code->size ? YB_MORE : YB_OK);
            assert_int_equal(yb_map_feed(&map, &load, code->bytes + cut, code->size - cut), YB_OK);
            assert_true(map_same(&map, &whole));
        }
        yb_map_begin(&map, &load);
        for (size_t k = 0; k < code->size; k++) {
            yb_status_t status = yb_map_feed(&map, &load, &code->bytes[k], 1);
            assert_int_equal(status, k + 1 < code->size ? YB_MORE : YB_OK);
        }
        assert_true(map_same(&map, &whole));
        assert_int_equal(yb_map_feed(&map, &load, code->bytes, 1), YB_ERR_CORRUPT);
    }
}

static uint8_t crc_of(const uint8_t *bytes, size_t count)
{
    unsigned crc = 0;
    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (int k = 0; k < 8; k++)
            crc = (crc << 1 ^ ((crc & 0x80) != 0 ? 0x07 : 0)) & 0xff;
    }
    return (uint8_t)crc;
}

static void draw(uint16_t azimuth_bam)
{
    static uint8_t pixels[64 * 32 / 2];
    yb_view_t view;
    const yb_screen_t screen = {.width = 64, .height = 32, .format = YB_GREY4};
    const yb_band_t band = {.rows = 32, .pixels = pixels, .pitch = 32};
    yb_view_init(&view, &map);
    yb_view_orbit(&view, &map, azimuth_bam, YB_DEGREES(20), 260);
    view.max_leaves = 2000;
    yb_frame_begin(&frame, &map, &view, &screen);
    yb_frame_band(&frame, &band);
}

/* A published code with some bytes made up and its check mended: a map that can be drawn, or an
 * error; nothing else, and soon.
 */
static void mended_damage_is_a_map_or_refused(void **state)
{
    (void)state;
    rng_t rng = {2024};
    int maps = 0;
    for (int i = 0; i < RANDOM_CODES; i++) {
        const code_t *code = &codes[rng_range(&rng, 0, code_count - 1)];
        uint8_t bytes[YB_MAX_CODE_BYTES];
        memcpy(bytes, code->bytes, code->size);
        int changes = rng_range(&rng, 1, 4);
        for (int k = 0; k < changes; k++)
            bytes[rng_range(&rng, 1, (int)code->size - 2)] = (uint8_t)rng_range(&rng, 0, 255);
        bytes[code->size - 1] = crc_of(bytes, code->size - 1);
        yb_status_t status = yb_map_load(&map, &load, bytes, code->size);
        assert_true(status <= YB_OK && status >= YB_ERR_LIMIT);
        if (status == YB_OK) {
            maps++;
            if (maps % 16 == 0)
                draw((uint16_t)(i * 4099));
        }
    }
    print_message("%d of %d mended codes are maps\n", maps, RANDOM_CODES);
    assert_true(maps > RANDOM_CODES / 100);
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc && i <= MOST_MAPS; i++)
        read_code(argv[i]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_code_loads),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(every_flipped_bit_is_refused),
        cmocka_unit_test(every_cut_gives_the_same_map),
        cmocka_unit_test(mended_damage_is_a_map_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
