/* The list of maps that are shown: files as they are named, folders as they change. */
#include "map_list.h"

#include "scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static const char *name_of(const yb_map_list_t *list, size_t index)
{
    const char *path = yb_map_list_at(list, index);
    return path == NULL ? "" : strrchr(path, '/') + 1;
}

static void make(const char *folder, const char *name, const char *text)
{
    char path[512];
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    scratch_text(path, text);
}

static void files_stay_in_order(void **state)
{
    char one[256], two[256];
    char *paths[] = {two, one, (char[]){"-"}};
    yb_error_t error;
    (void)state;
    snprintf(one, sizeof(one), "%s", scratch_path("one.yb"));
    snprintf(two, sizeof(two), "%s", scratch_path("two.txt"));
    scratch_text(one, "1");
    scratch_text(two, "2");
    yb_map_list_t *list = yb_map_list_open(paths, 2, &error);
    assert_non_null(list);
    assert_int_equal(yb_map_list_count(list), 2);
    assert_string_equal(name_of(list, 0), "two.txt");
    assert_string_equal(name_of(list, 1), "one.yb");
    assert_null(yb_map_list_at(list, 2));
    assert_int_equal(yb_map_list_fd(list), -1);
    size_t index = 1;
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_SAME);
    assert_true(yb_map_list_tell(list, 0));
    assert_false(yb_map_list_tell(list, 0));
    yb_map_list_close(list);
    /* The standard input is read once, so it goes alone. */
    assert_null(yb_map_list_open(paths, 3, &error));
    list = yb_map_list_open(paths + 2, 1, &error);
    assert_string_equal(yb_map_list_at(list, 0), "-");
    yb_map_list_close(list);
}

static void a_missing_path_is_told(void **state)
{
    char *paths[] = {(char *)(uintptr_t)scratch_path("nowhere")};
    yb_error_t error;
    (void)state;
    assert_null(yb_map_list_open(paths, 1, &error));
    assert_non_null(strstr(error.text, "nowhere"));
}

static void folders_are_followed(void **state)
{
    char folder[256], path[512];
    char *paths[] = {folder};
    yb_error_t error;
    (void)state;
    snprintf(folder, sizeof(folder), "%s", scratch_path("maps"));
    assert_int_equal(mkdir(folder, 0700), 0);
    make(folder, "b.yb", "b");
    make(folder, "d.yb", "d");
    make(folder, ".hidden.yb", "");
    make(folder, "notes.txt", "");
    yb_map_list_t *list = yb_map_list_open(paths, 1, &error);
    assert_non_null(list);
    assert_int_equal(yb_map_list_count(list), 2);
    size_t index = 1;
    assert_string_equal(name_of(list, index), "d.yb");
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_SAME);

    /* Another comes before: the index follows, and what was told is not told again. */
    assert_true(yb_map_list_tell(list, 1));
    make(folder, "c.yb", "c");
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_OTHERS);
    assert_int_equal(index, 2);
    assert_string_equal(name_of(list, 1), "c.yb");
    assert_false(yb_map_list_tell(list, 2));

    /* The shown one is written, and then goes. */
    make(folder, "d.yb", "again");
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_THIS);
    assert_string_equal(name_of(list, index), "d.yb");
    assert_true(yb_map_list_tell(list, index));
    snprintf(path, sizeof(path), "%s/d.yb", folder);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_THIS);
    assert_int_equal(index, 0);

    /* All go; one comes. */
    snprintf(path, sizeof(path), "%s/b.yb", folder);
    assert_int_equal(unlink(path), 0);
    snprintf(path, sizeof(path), "%s/c.yb", folder);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_THIS);
    assert_int_equal(yb_map_list_count(list), 0);
    make(folder, "e.yb", "e");
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_THIS);
    assert_string_equal(name_of(list, index), "e.yb");

    /* A link comes; the folder itself goes and comes back. */
    snprintf(path, sizeof(path), "%s/f.yb", folder);
    assert_int_equal(symlink("e.yb", path), 0);
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_OTHERS);
    assert_int_equal(yb_map_list_count(list), 2);
    assert_false(yb_map_list_misses(list));
    snprintf(path, sizeof(path), "%s.old", folder);
    assert_int_equal(rename(folder, path), 0);
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_THIS);
    assert_int_equal(yb_map_list_count(list), 0);
    assert_true(yb_map_list_misses(list));
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_SAME);
    assert_int_equal(rename(path, folder), 0);
    assert_int_equal(yb_map_list_update(list, &index), YB_MAPS_THIS);
    assert_int_equal(yb_map_list_count(list), 2);
    assert_false(yb_map_list_misses(list));
    yb_map_list_close(list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_stay_in_order),
        cmocka_unit_test(a_missing_path_is_told),
        cmocka_unit_test(folders_are_followed),
    };
    return cmocka_run_group_tests(tests, scratch_begin, scratch_end);
}
