/* Output files: whole or not at all. */
#include "output.h"
#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void text_of(const char *path, char *text, size_t room)
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    size_t size = fread(text, 1, room - 1, file);
    text[size] = '\0';
    fclose(file);
}

static void test_written_whole(void **state)
{
    (void)state;
    yb_error_t error;
    char text[16];
    const char *path = scratch_path("a.txt");
    assert_true(yb_output_write(path, false, "one", 3, &error));
    text_of(path, text, sizeof(text));
    assert_string_equal(text, "one");
    assert_int_equal(scratch_files(), 1);
    remove(path);
}

static void test_not_overwritten(void **state)
{
    (void)state;
    yb_error_t error;
    char text[16];
    const char *path = scratch_path("a.txt");
    scratch_text(path, "old");
    assert_false(yb_output_write(path, false, "new", 3, &error));
    assert_non_null(strstr(error.text, "exists already"));
    assert_non_null(strstr(error.text, path));
    text_of(path, text, sizeof(text));
    assert_string_equal(text, "old");
    assert_true(yb_output_write(path, true, "new", 3, &error));
    text_of(path, text, sizeof(text));
    assert_string_equal(text, "new");
    assert_int_equal(scratch_files(), 1);
    remove(path);
}

static void test_nothing_left_without_commit(void **state)
{
    (void)state;
    yb_error_t error;
    const char *path = scratch_path("b.tif");
    yb_output_t *output = yb_output_open(path, false, &error);
    assert_non_null(output);
    assert_string_equal(strrchr(yb_output_path(output), '.'), ".tif");
    scratch_text(yb_output_path(output), "half");
    assert_false(scratch_exists(path));
    yb_output_close(output);
    assert_false(scratch_exists(path));
    assert_int_equal(scratch_files(), 0);
}

static void test_bad_places(void **state)
{
    (void)state;
    yb_error_t error;
    assert_null(yb_output_open(scratch_path("no/such/file"), false, &error));
    assert_non_null(strstr(error.text, "no such directory"));
    assert_null(yb_output_open(scratch_path(""), true, &error));
    assert_non_null(strstr(error.text, "is a directory"));
    assert_null(yb_output_open("", true, &error));
    yb_output_close(NULL);
}

static void test_devices_get_the_bytes(void **state)
{
    (void)state;
    yb_error_t error;
    assert_true(yb_output_write("/dev/null", false, "x", 1, &error));
    assert_true(scratch_exists("/dev/null"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_written_whole),
        cmocka_unit_test(test_not_overwritten),
        cmocka_unit_test(test_nothing_left_without_commit),
        cmocka_unit_test(test_bad_places),
        cmocka_unit_test(test_devices_get_the_bytes),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
