/* Buttons on lines that are played here, edge by edge with its time: what is a press and what is
 * not. On lines of a kernel they are tested in tests/guest. */
#include "linux_buttons.h"

#include "gpiod_lines.h"
#include "linux_bus.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* ---- The lines ---------------------------------------------------------------------------- */

struct yb_gpiod_chip {
    int dummy;
};
struct yb_gpiod_group {
    int dummy;
};

static struct yb_gpiod_chip the_chip;
static struct yb_gpiod_group the_group;
static unsigned taken[YB_GPIOD_GROUP_MAX];
static size_t taken_count;
static const yb_gpiod_edge_t *edges;
static size_t edges_left;
static bool gone;

yb_gpiod_chip_t *yb_gpiod_chip_open(const char *path)
{
    assert_string_equal(path, "/dev/gpiochip0");
    return &the_chip;
}

void yb_gpiod_chip_close(yb_gpiod_chip_t *chip)
{
    assert_ptr_equal(chip, &the_chip);
}

const char *yb_gpiod_chip_name(const yb_gpiod_chip_t *chip)
{
    (void)chip;
    return "gpiochip0";
}

const char *yb_gpiod_chip_label(const yb_gpiod_chip_t *chip)
{
    (void)chip;
    return "played";
}

unsigned yb_gpiod_chip_lines(const yb_gpiod_chip_t *chip)
{
    (void)chip;
    return 32;
}

int yb_gpiod_chip_find(yb_gpiod_chip_t *chip, const char *line_name)
{
    (void)chip;
    return strcmp(line_name, "SELECT") == 0 ? 17 : -1;
}

bool yb_gpiod_chip_holder(yb_gpiod_chip_t *chip, unsigned line, char holder[YB_GPIOD_NAME_BYTES])
{
    (void)chip;
    (void)line;
    (void)holder;
    return false;
}

yb_gpiod_group_t *yb_gpiod_take_outputs(yb_gpiod_chip_t *chip, const unsigned *lines,
                                        const int *values, size_t count)
{
    (void)chip;
    (void)lines;
    (void)values;
    (void)count;
    fail_msg("a button is no output");
    return NULL;
}

yb_gpiod_group_t *yb_gpiod_take_inputs(yb_gpiod_chip_t *chip, const unsigned *lines, size_t count)
{
    assert_ptr_equal(chip, &the_chip);
    memcpy(taken, lines, count * sizeof *lines);
    taken_count = count;
    return &the_group;
}

void yb_gpiod_group_free(yb_gpiod_group_t *group)
{
    assert_ptr_equal(group, &the_group);
}

int yb_gpiod_group_fd(const yb_gpiod_group_t *group)
{
    (void)group;
    return 77;
}

int yb_gpiod_group_read(yb_gpiod_group_t *group, yb_gpiod_edge_t *edge)
{
    assert_ptr_equal(group, &the_group);
    if (edges_left == 0)
        return gone ? -1 : 0;
    *edge = *edges++;
    edges_left--;
    return 1;
}

/* ---- The tests ---------------------------------------------------------------------------- */

static yb_linux_buttons_t *buttons;

static int open_buttons(void **state)
{
    static const char *const lines[] = {"5", "SELECT"};
    char error[YB_LINUX_ERROR_BYTES] = "";

    (void)state;
    gone = false;
    buttons = yb_linux_buttons_open(NULL, lines, 2, error);
    assert_string_equal(error, "");
    assert_non_null(buttons);
    return 0;
}

static int close_buttons(void **state)
{
    (void)state;
    yb_linux_buttons_close(buttons);
    return 0;
}

static void lines_by_number_and_name(void **state)
{
    (void)state;
    assert_int_equal(taken_count, 2);
    assert_int_equal(taken[0], 5);
    assert_int_equal(taken[1], 17);
    assert_int_equal(yb_linux_buttons_fd(buttons), 77);
}

#define DOWN(button, us)                                                                           \
    {                                                                                              \
        (button), true, (us)*UINT64_C(1000) + UINT64_C(1690000000000000000)                        \
    }
#define UP(button, us)                                                                             \
    {                                                                                              \
        (button), false, (us)*UINT64_C(1000) + UINT64_C(1690000000000000000)                       \
    }

static void play(const yb_gpiod_edge_t *played, size_t count)
{
    edges = played;
    edges_left = count;
}

#define PLAY(played) play((played), sizeof(played) / sizeof *(played))

static void press_with_bounces_is_one(void **state)
{
    static const yb_gpiod_edge_t played[] = {
        DOWN(0, 0),      UP(0, 300),    DOWN(0, 400),    UP(0, 29000),
        DOWN(0, 58000),  UP(0, 200000), DOWN(0, 200900), UP(0, 201000),
        DOWN(0, 230999), UP(0, 231500), DOWN(0, 261500),
    };

    (void)state;
    PLAY(played);
    assert_int_equal(yb_linux_buttons_read(buttons), 0);
    assert_int_equal(edges_left, 10);
    assert_int_equal(yb_linux_buttons_read(buttons), 0);
    assert_int_equal(edges_left, 0);
    assert_int_equal(yb_linux_buttons_read(buttons), -1);
}

/* 30 ms of rest make a press, and a microsecond less does not. */
static void rest_makes_a_press(void **state)
{
    static const yb_gpiod_edge_t played[] = {DOWN(1, 0), UP(1, 50000), DOWN(1, 79999), UP(1, 90000),
                                             DOWN(1, 120000)};

    (void)state;
    PLAY(played);
    assert_int_equal(yb_linux_buttons_read(buttons), 1);
    assert_int_equal(edges_left, 4);
    assert_int_equal(yb_linux_buttons_read(buttons), 1);
    assert_int_equal(edges_left, 0);
}

static void buttons_do_not_disturb_each_other(void **state)
{
    static const yb_gpiod_edge_t played[] = {DOWN(0, 0), DOWN(1, 10), UP(1, 20), UP(0, 40000),
                                             DOWN(1, 40010)};

    (void)state;
    PLAY(played);
    assert_int_equal(yb_linux_buttons_read(buttons), 0);
    assert_int_equal(yb_linux_buttons_read(buttons), 1);
    assert_int_equal(yb_linux_buttons_read(buttons), 1);
    assert_int_equal(yb_linux_buttons_read(buttons), -1);
}

/* Held at the start and let go with bounces. */
static void release_alone_is_no_press(void **state)
{
    static const yb_gpiod_edge_t played[] = {UP(0, 0), DOWN(0, 500), UP(0, 900)};

    (void)state;
    PLAY(played);
    assert_int_equal(yb_linux_buttons_read(buttons), -1);
    assert_int_equal(edges_left, 0);
}

static void vanished_chip_is_told_after_the_last_press(void **state)
{
    static const yb_gpiod_edge_t played[] = {DOWN(1, 0)};

    (void)state;
    PLAY(played);
    gone = true;
    assert_int_equal(yb_linux_buttons_read(buttons), 1);
    assert_int_equal(yb_linux_buttons_read(buttons), -2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(lines_by_number_and_name, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(press_with_bounces_is_one, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(rest_makes_a_press, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(buttons_do_not_disturb_each_other, open_buttons,
                                        close_buttons),
        cmocka_unit_test_setup_teardown(release_alone_is_no_press, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(vanished_chip_is_told_after_the_last_press, open_buttons,
                                        close_buttons),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
