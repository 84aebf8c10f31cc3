/* linux_buttons on a simulated chip, whose lines are pulled from outside. Runs in the guest. */
#define _POSIX_C_SOURCE 200809L /* nanosleep */

#include "linux_buttons.h"

#include "linux_bus.h"
#include "sim_chip.h"

#include <poll.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

enum {
    UP = 9,
    DOWN = 5,
    REST_MS = 50, /* more than a contact bounces */
};

static yb_sim_chip_t chip;
static const char *const lines[] = {"9", "FIFTH"};
static yb_linux_buttons_t *buttons;

static void rest(void)
{
    const struct timespec time = {0, REST_MS * 1000000L};
    nanosleep(&time, NULL);
}

/* The simulation tells of an edge at the next tick of the guest's timer, 10 ms at the latest; of
 * two edges that come before it, none. */
static void pull(unsigned line, int level)
{
    const struct timespec time = {0, 12 * 1000000L};

    yb_sim_chip_pull(&chip, line, level);
    nanosleep(&time, NULL);
}

static int make_chip(void **state)
{
    static const char *const names[] = {"", "", "", "", "", "FIFTH", NULL};

    (void)state;
    yb_sim_chip_make(&chip, "keys", names);
    return 0;
}

static int open_buttons(void **state)
{
    char error[YB_LINUX_ERROR_BYTES] = "";

    (void)state;
    buttons = yb_linux_buttons_open("keys", lines, 2, error);
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

static bool waits(void)
{
    struct pollfd fd = {.fd = yb_linux_buttons_fd(buttons), .events = POLLIN};
    return poll(&fd, 1, 0) == 1;
}

static void presses_in_order(void **state)
{
    (void)state;
    assert_false(waits());
    assert_int_equal(yb_linux_buttons_read(buttons), -1);
    pull(DOWN, 0);
    assert_true(waits());
    assert_int_equal(yb_linux_buttons_read(buttons), 1);
    assert_int_equal(yb_linux_buttons_read(buttons), -1);
    assert_false(waits());
    rest();
    pull(DOWN, 1);
    assert_int_equal(yb_linux_buttons_read(buttons), -1);
    rest();
    pull(UP, 0);
    assert_int_equal(yb_linux_buttons_read(buttons), 0);
    rest();
    pull(UP, 1);
    rest();
    pull(UP, 0);
    assert_int_equal(yb_linux_buttons_read(buttons), 0);
    assert_int_equal(yb_linux_buttons_read(buttons), -1);
    pull(UP, 1);
}

static void presses_wait_until_read(void **state)
{
    int seen[2] = {0, 0};
    int pressed;

    (void)state;
    for (int i = 0; i < 3; i++) {
        pull(UP, 0);
        if (i == 0)
            pull(DOWN, 0);
        rest();
        pull(UP, 1);
        rest();
    }
    pull(DOWN, 1);
    while ((pressed = yb_linux_buttons_read(buttons)) >= 0)
        seen[pressed]++;
    assert_int_equal(pressed, -1);
    assert_int_equal(seen[0], 3);
    assert_int_equal(seen[1], 1);
}

static uint64_t now_ms(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000 + (uint64_t)now.tv_nsec / 1000000;
}

/* Pulls the line to `level` with a bounce; false: the machine was too busy to do that within the
 * time in which a contact bounces. */
static bool bounce(unsigned line, int level)
{
    const uint64_t first = now_ms();
    pull(line, level);
    const uint64_t second = now_ms();
    pull(line, !level);
    const uint64_t third = now_ms();
    pull(line, level);
    return second - first < 20 && third - second < 20;
}

/* Down, and up some time later, each with bounces: one press. When exactly a press is one is tested
 * in tests/unit, with times that do not depend on the machine. */
static void bounces_are_no_presses(void **state)
{
    (void)state;
    for (int tries = 0; tries < 40; tries++) {
        int presses = 0;
        bool in_time = bounce(UP, 0);
        rest();
        in_time = bounce(UP, 1) && in_time;
        rest();
        assert_true(waits());
        while (yb_linux_buttons_read(buttons) == 0)
            presses++;
        if (!in_time)
            continue;
        assert_int_equal(presses, 1);
        return;
    }
    print_message("the machine was too busy to bounce\n");
    skip();
}

/* A button that is down at the start is let go with bounces: no press. */
static void down_at_the_start_is_no_press(void **state)
{
    (void)state;
    pull(UP, 0);
    assert_int_equal(yb_linux_buttons_read(buttons), 0);
    close_buttons(NULL);
    /* The kernel pulls the line up when it is asked for: the simulation lets it go. */
    open_buttons(NULL);
    assert_int_equal(yb_sim_chip_level(&chip, UP), 1);
    assert_int_equal(yb_linux_buttons_read(buttons), -1);
}

static void refused_lines(void **state)
{
    static const char *const twice[] = {"FIFTH", "5"};
    static const char *const absent[] = {"3", "GPIO77"};
    char error[YB_LINUX_ERROR_BYTES] = "";
    const char *name = strrchr(chip.path, '/') + 1;
    char sentence[YB_LINUX_ERROR_BYTES];

    (void)state;
    assert_null(yb_linux_buttons_open("keys", lines, 2, error));
    snprintf(sentence, sizeof sentence, "line 9 of %s is busy: \"yamabiko\" holds it", name);
    assert_string_equal(error, sentence);
    assert_null(yb_linux_buttons_open("keys", twice, 2, error));
    assert_string_equal(error, "line 5 cannot be both button 1 and button 2");
    assert_null(yb_linux_buttons_open("keys", absent, 2, error));
    snprintf(sentence, sizeof sentence,
             "button 2: there is no line \"GPIO77\" on %s; gpioinfo lists its lines", name);
    assert_string_equal(error, sentence);
    assert_null(yb_linux_buttons_open("gpiochip77", lines, 2, error));
    assert_string_equal(
        error, "there is no GPIO chip \"gpiochip77\"; gpiodetect lists the chips of this machine");
    assert_null(yb_linux_buttons_open("keys", lines, 0, error));
    assert_string_equal(error, "there can be 1 to 16 buttons, not 0");
}

static void all_sixteen(void **state)
{
    static const char *const all[] = {"0", "1", "2",  "3",  "4",  "5",  "6",  "7",
                                      "8", "9", "10", "11", "12", "13", "14", "15"};
    char error[YB_LINUX_ERROR_BYTES] = "";

    (void)state;
    yb_linux_buttons_close(buttons);
    buttons = yb_linux_buttons_open("keys", all, 16, error);
    assert_string_equal(error, "");
    for (unsigned i = 0; i < 16; i++) {
        pull(i, 0);
        assert_int_equal(yb_linux_buttons_read(buttons), i);
        pull(i, 1);
        assert_int_equal(yb_linux_buttons_read(buttons), -1);
    }
}

/* The last test: the chip is gone. */
static void vanished_chip_is_told(void **state)
{
    (void)state;
    pull(UP, 0);
    yb_sim_chip_unplug(&chip);
    assert_int_equal(yb_linux_buttons_read(buttons), -2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(presses_in_order, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(presses_wait_until_read, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(bounces_are_no_presses, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(down_at_the_start_is_no_press, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(refused_lines, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(all_sixteen, open_buttons, close_buttons),
        cmocka_unit_test_setup_teardown(vanished_chip_is_told, open_buttons, close_buttons),
    };
    return cmocka_run_group_tests(tests, make_chip, NULL);
}
