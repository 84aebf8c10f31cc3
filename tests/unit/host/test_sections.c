/* What follows the relief of a compact code: by the engine that skips it or takes the certificate,
 * and by the host that writes and reads it all. The relief is a fresh one from the encoder.
 */
#include "sections.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>

#include "certificate.h"
#include "encode.h"
#include "fidelity.h"
#include "scratch.h"

enum {
    ROOM = 2048
};

static uint8_t code[ROOM]; /* a relief after which sections follow … */
static size_t relief;      /* … and how long it is */
static yb_map_t plain, map;
static yb_load_t load;

static yb_code_file_t *encode(const yb_grid_t *grid, const yb_sections_t *sections, size_t bytes)
{
    yb_error_t error;
    yb_encode_result_t result;
    yb_encode_task_t task = {
        .most_bytes = bytes, .profile = YB_COMPACT, .seed = 1, .effort = 1, .sections = sections};
    if (!yb_encode_grid(grid, &task, &result, &error))
        fail_msg("%s", error.text);
    yb_code_file_t *file = result.code;
    result.code = NULL; /* it is the caller's now */
    yb_encode_result_free(&result);
    return file;
}

static int begin(void **state)
{
    yb_grid_t *grid = scratch_grid(48, 48, relief_range);
    const yb_sections_t named = {.name = "x"};
    yb_code_file_t *file = encode(grid, &named, 60);
    relief = file->load.relief_size;
    memcpy(code, file->bytes, relief);
    plain = file->map;
    yb_code_file_free(file);
    yb_grid_free(grid);
    return scratch_begin(state);
}

/* Puts sections behind the relief, and the check byte; answers the size of it all. */
static size_t with(const uint8_t *sections, size_t count)
{
    memcpy(code + relief, sections, count);
    code[relief + count] = yb_sections_check(code, relief + count);
    return relief + count + 1;
}

static yb_status_t feed_bytewise(const uint8_t *bytes, size_t count)
{
    yb_status_t status = YB_MORE;
    yb_map_begin(&map, &load);
    for (size_t i = 0; i < count; i++)
        status = yb_map_feed(&map, &load, bytes + i, 1);
    return status == YB_MORE ? yb_map_end(&map, &load) : status;
}

static bool same_relief(const yb_map_t *other)
{
    return other->vertex_count == plain.vertex_count &&
           memcmp(other->vertex, plain.vertex, plain.vertex_count * sizeof(plain.vertex[0])) == 0 &&
           other->seed == plain.seed && other->base_m == plain.base_m && other->cell == plain.cell;
}

typedef struct {
    const char *what;
    size_t count;
    uint8_t error, k;
    uint8_t bytes[512];
} tail_t;

/* SPEC 1.4: head bytes are [last:1][kind:3][length:4]. */
static tail_t tails[] = {
    {"a certificate", 3, 0x55, 0xaa, {0x92, 0x55, 0xaa}},
    {"a place", 7, 0, 0, {0xa6, 1, 2, 3, 4, 5, 6}},
    {"a name", 4, 0, 0, {0xb3, 'a', 'b', 'c'}},
    {"an unknown kind", 3, 0, 0, {0xf2, 0x92, 0x11}},
    {"kind 0", 2, 0, 0, {0x81, 0xff}},
    {"nothing, last", 1, 0, 0, {0x80}},
    {"nothing, twice", 2, 0, 0, {0x70, 0xf0}},
    {"an empty certificate", 1, 0, 0, {0x90}},
    {"half a certificate", 2, 9, 0, {0x91, 9}},
    {"a longer certificate", 5, 9, 8, {0x94, 9, 8, 7, 6}},
    {"all of them",
     17,
     7,
     6,
     {0x32, 'a', 'b', 0x12, 7, 6, 0x40, 0x26, 1, 2, 3, 4, 5, 6, 0xd2, 1, 2}},
    {"the long form of nothing", 3, 0, 0, {0xbf, 0, 0}},
    {"a long name", 3 + 20, 0, 0, {0xbf, 0, 20}},
    {"300 bytes, then a certificate", 306, 3, 4, {0x5f, 1, 44, [303] = 0x92, 3, 4}},
};
enum {
    TAILS = sizeof(tails) / sizeof(tails[0])
};

static void test_sections_are_taken_or_skipped(void **state)
{
    (void)state;
    for (int i = 0; i < TAILS; i++) {
        size_t size = with(tails[i].bytes, tails[i].count);
        if (yb_map_load(&map, &load, code, size) != YB_OK)
            fail_msg("%s is refused", tails[i].what);
        assert_true(same_relief(&map));
        assert_int_equal(map.certified_error, tails[i].error);
        assert_int_equal(map.certified_k, tails[i].k);
        assert_int_equal(load.relief_size, relief);
        assert_int_equal(feed_bytewise(code, size), YB_OK);
        assert_true(same_relief(&map));
        assert_int_equal(map.certified_error, tails[i].error);
        assert_int_equal(map.certified_k, tails[i].k);
        assert_int_equal(yb_map_load(&map, &load, code, size + 1), YB_ERR_CORRUPT);
    }
}

static void test_every_truncation_is_said_so(void **state)
{
    (void)state;
    for (int i = 0; i < TAILS; i++) {
        size_t size = with(tails[i].bytes, tails[i].count);
        for (size_t cut = 0; cut < size; cut++) {
            assert_int_equal(yb_map_load(&map, &load, code, cut), YB_ERR_TRUNCATED);
            assert_int_equal(feed_bytewise(code, cut), YB_ERR_TRUNCATED);
        }
    }
}

static void test_every_flipped_bit_is_refused(void **state)
{
    (void)state;
    for (int i = 0; i < TAILS; i++) {
        size_t size = with(tails[i].bytes, tails[i].count);
        for (size_t bit = 0; bit < size * 8; bit++) {
            code[bit / 8] ^= (uint8_t)(0x80 >> bit % 8);
            assert_true(yb_map_load(&map, &load, code, size) < 0);
            assert_true(feed_bytewise(code, size) < 0);
            code[bit / 8] ^= (uint8_t)(0x80 >> bit % 8);
        }
        code[size - 1] ^= 1; /* the check itself, and a byte that is kept */
        assert_int_equal(yb_map_load(&map, &load, code, size), YB_ERR_CORRUPT);
    }
    size_t size = with((const uint8_t[]){0x92, 5, 6}, 3);
    code[size - 2] ^= 0x10;
    assert_int_equal(yb_map_load(&map, &load, code, size), YB_ERR_CORRUPT);
}

static void test_errors_are_logarithmic(void **state)
{
    (void)state;
    assert_int_equal(yb_certified_error_m(0), 0);
    assert_int_equal(yb_certified_error_m(1), 1);
    assert_int_equal(yb_certified_error_m(33), 1);
    assert_int_equal(yb_certified_error_m(34), 2);
    assert_int_equal(yb_certified_error_m(255), 15025);
    for (int v = 1; v < 256; v++) {
        double metres = yb_sections_error_m((uint8_t)v);
        assert_true(fabs(metres / (0.25 * exp2((v - 1) / 16.0)) - 1) < (v < 17 ? 0.01 : 0.004));
        assert_true(yb_certified_error_m((uint8_t)v) == (uint16_t)ceil(metres));
        assert_true(v == 1 || metres > yb_sections_error_m((uint8_t)(v - 1)));
        assert_int_equal(yb_sections_error(metres), v);
        assert_int_equal(yb_sections_error(metres * 1.0001), v < 255 ? v + 1 : 0);
    }
    assert_int_equal(yb_sections_error(0), 1);
}

static void check_round_trip(const yb_sections_t *sections)
{
    yb_sections_t read;
    size_t size = yb_sections_end(sections, code, relief, ROOM);
    assert_int_equal(size, relief + yb_sections_size(sections) + 1);
    assert_int_equal(yb_map_load(&map, &load, code, size), YB_OK);
    yb_sections_read(&read, code + relief, size - relief - 1);
    assert_int_equal(read.certified, sections->certified);
    assert_int_equal(read.error, sections->error);
    assert_int_equal(read.k, sections->k);
    assert_int_equal(map.certified_error, sections->error);
    assert_int_equal(read.placed, sections->placed);
    assert_string_equal(read.name, sections->name);
    double turn = fabs(read.lon_deg - sections->lon_deg);
    assert_true(fmin(turn, 360 - turn) <= 180.0 / (1 << 24) + 1e-12);
    assert_true(fabs(read.lat_deg - sections->lat_deg) <= 180.0 / (1 << 24));
    assert_int_equal(yb_sections_end(sections, code, relief, size - 1), 0);
}

static void test_what_is_written_is_read(void **state)
{
    (void)state;
    yb_sections_t all = {.certified = true,
                         .error = 77,
                         .k = 200,
                         .placed = true,
                         .lon_deg = -121.4911,
                         .lat_deg = 46.2026,
                         .name = "Aoraki \xe5\xb1\xb1\xe5\xbd\xa6"};
    check_round_trip(&all);
    assert_int_equal(yb_sections_size(&all), 3 + 7 + 1 + 13);
    const double places[][2] = {{180, 90}, {-180, -90}, {0, 0}, {179.99999, -89.99999}, {-1e-5, 1}};
    for (size_t i = 0; i < sizeof(places) / sizeof(places[0]); i++) {
        yb_sections_t placed = {.placed = true, .lon_deg = places[i][0], .lat_deg = places[i][1]};
        check_round_trip(&placed);
    }
    for (int length = 1; length <= YB_NAME_BYTES; length++) {
        yb_sections_t named = {.certified = length % 2 == 0};
        memset(named.name, 'x', (size_t)length);
        check_round_trip(&named);
    }
    assert_int_equal(yb_sections_size(NULL), 0);
    assert_int_equal(yb_sections_size(&(yb_sections_t){0}), 0);
}

/* The example of SPEC 1.4. */
static void test_the_example_of_the_specification(void **state)
{
    (void)state;
    static const uint8_t bytes[] = {0x12, 0x68, 0xbd, 0x26, 0xa9, 0x9b, 0x38,
                                    0x41, 0xb5, 0xe4, 0xb2, 0x4b, 0x32};
    yb_sections_t sections;
    yb_sections_read(&sections, bytes, sizeof(bytes));
    assert_int_equal(yb_certified_error_m(sections.error), 22);
    assert_true(fabs(yb_sections_error_m(sections.error) - 21.67) < 0.005);
    assert_true(fabs(sections.k / 255.0 - 0.74) < 0.005);
    assert_true(fabs(sections.lon_deg + 121.4911) < 2e-5);
    assert_true(fabs(sections.lat_deg - 46.2027) < 1e-5);
    assert_string_equal(sections.name, "K2");
    size_t size = yb_sections_end(&sections, code, relief, ROOM);
    assert_int_equal(size, relief + sizeof(bytes) + 1);
    assert_memory_equal(code + relief, bytes, sizeof(bytes));
}

static void test_names(void **state)
{
    (void)state;
    const char *good[] = {"a",
                          "K2",
                          "Mont \xc3\x89mile",
                          "\xe5\xaf\x8c\xe5\xa3\xab",
                          "\xc2\xa0",
                          "\xf0\x9f\x8f\x94",
                          "\xf4\x8f\xbf\xbf",
                          "\xed\x9f\xbf",
                          "\xee\x80\x80"};
    const char *bad[] = {"",
                         "a\nb",
                         "\x1b[31m",
                         "\x7f",
                         "\xc2\x85",  /* next line */
                         "\xc2\x9b;", /* a terminal's command */
                         "\xc3",      /* cut off */
                         "\x80",      /* begins in the middle */
                         "\xc0\xaf",  /* longer than needed */
                         "\xe0\x80\xaf",
                         "\xf0\x80\x80\xaf",
                         "\xed\xa0\x80",     /* half of a pair */
                         "\xf4\x90\x80\x80", /* beyond the last one */
                         "\xf8\x88\x80\x80\x80",
                         "\xff",
                         "caf\xe9"};
    yb_sections_t sections = {0};
    yb_error_t error;
    for (size_t i = 0; i < sizeof(good) / sizeof(good[0]); i++) {
        assert_true(yb_sections_name(&sections, good[i], &error));
        check_round_trip(&sections);
    }
    for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); i++) {
        assert_false(yb_sections_name(&sections, bad[i], &error));
        uint8_t bytes[32] = {(uint8_t)(0xb0 | strlen(bad[i]))};
        memcpy(bytes + 1, bad[i], strlen(bad[i]));
        yb_sections_read(&sections, bytes, 1 + strlen(bad[i]));
        assert_string_equal(sections.name, "");
    }
    char longest[YB_NAME_BYTES + 2] = "";
    memset(longest, 'y', YB_NAME_BYTES);
    assert_true(yb_sections_name(&sections, longest, &error));
    longest[YB_NAME_BYTES] = 'y';
    assert_false(yb_sections_name(&sections, longest, &error));
    assert_non_null(strstr(error.text, "64 bytes: at most 63"));
}

/* Bytes that no engine would have let through are read without harm. */
static void test_broken_sections_are_no_danger(void **state)
{
    (void)state;
    yb_sections_t sections;
    for (int i = 0; i < TAILS; i++)
        for (size_t cut = 0; cut < tails[i].count; cut++) {
            uint8_t *exact = malloc(cut + 1);
            assert_non_null(exact);
            memcpy(exact, tails[i].bytes, cut);
            yb_sections_read(&sections, exact, cut);
            free(exact);
        }
}

static void test_they_count_into_the_bytes(void **state)
{
    (void)state;
    yb_error_t error;
    yb_grid_t *grid = scratch_grid(48, 48, relief_range);
    yb_sections_t sections = {
        .certified = true, .placed = true, .lon_deg = 9.5, .lat_deg = 46.5, .name = "Piz"};
    yb_code_file_t *file = encode(grid, &sections, 60);
    assert_in_range(file->size, 40, 60);
    assert_string_equal(file->sections.name, "Piz");
    assert_non_null(file->origin.projection);
    assert_true(fabs(file->origin.west_m * 2 + 47 * 30) < 60);
    /* The certificate says what a comparison finds, and no more. */
    yb_comparison_t comparison;
    yb_fidelity_t fidelity;
    assert_true(yb_comparison_make(&comparison, file, grid, NULL, &error));
    assert_true(yb_fidelity_measure(&fidelity, file, &comparison));
    double certified_m = yb_sections_error_m(file->map.certified_error);
    assert_true(certified_m >= fidelity.detail.p90_m);
    assert_true(file->map.certified_error == 1 || certified_m < fidelity.detail.p90_m * 1.06);
    assert_true(file->map.certified_k / 255.0 <= fidelity.k);
    assert_true((file->map.certified_k + 1) / 255.0 > fidelity.k);
    yb_fidelity_free(&fidelity);
    yb_comparison_free(&comparison);
    yb_code_file_free(file);
    yb_encode_result_t result;
    const size_t least = YB_ENCODE_LEAST_BYTES + 3 + 7 + 4;
    yb_encode_task_t task = {
        .most_bytes = least - 1, .profile = YB_COMPACT, .effort = 1, .sections = &sections};
    assert_false(yb_encode_grid(grid, &task, &result, &error));
    assert_non_null(strstr(error.text, "the least is 37"));
    task.most_bytes = least;
    if (yb_encode_grid(grid, &task, &result, &error)) {
        assert_true(result.code->size <= least);
        yb_encode_result_free(&result);
    } else {
        fail_msg("%s", error.text);
    }
    yb_grid_free(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sections_are_taken_or_skipped),
        cmocka_unit_test(test_every_truncation_is_said_so),
        cmocka_unit_test(test_every_flipped_bit_is_refused),
        cmocka_unit_test(test_errors_are_logarithmic),
        cmocka_unit_test(test_what_is_written_is_read),
        cmocka_unit_test(test_the_example_of_the_specification),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_broken_sections_are_no_danger),
        cmocka_unit_test(test_they_count_into_the_bytes),
    };
    return cmocka_run_group_tests(tests, begin, scratch_end);
}
