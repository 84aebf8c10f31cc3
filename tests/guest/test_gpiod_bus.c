/* gpiod_bus on simulated chips: what it says when lines cannot be had, and that it gives them back.
 * Runs in the guest, as root. */
#define _POSIX_C_SOURCE 200809L

#include "gpiod_bus.h"

#include <gpiod.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#define SIM "/sys/kernel/config/gpio-sim/"
/* The name of the chip "bus": spi-panel.dts has the first one. */
#define CHIP "gpiochip1"

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");

    if (file == NULL || fputs(text, file) < 0 || fclose(file) != 0)
        fail_msg("%s cannot be written", path);
}

static int make_chips(void **state)
{
    (void)state;
    assert_int_equal(mkdir(SIM "bus", 0755), 0);
    assert_int_equal(mkdir(SIM "bus/bank", 0755), 0);
    write_text(SIM "bus/bank/num_lines", "16");
    write_text(SIM "bus/bank/label", "bus");
    write_text(SIM "bus/live", "1");
    return 0;
}

static const yb_gpiod_pins_t good_pins = {
    .chip = "bus", .sck = 3, .mosi = 1, .cs = 7, .dc = 0, .reset = YB_GPIOD_NOT_WIRED};

static void assert_refused(const yb_gpiod_pins_t *pins, const char *sentence)
{
    char error[YB_GPIOD_ERROR_BYTES] = "";

    assert_null(yb_gpiod_bus_open(pins, error, sizeof error));
    assert_string_equal(error, sentence);
}

/* Who holds a line; "" when nobody does. The caller frees the answer. */
static char *holder_of(unsigned offset)
{
    struct gpiod_chip *chip = gpiod_chip_open_lookup("bus");
    assert_non_null(chip);
    struct gpiod_line *line = gpiod_chip_get_line(chip, offset);
    assert_non_null(line);
    const char *consumer = gpiod_line_is_used(line) ? gpiod_line_consumer(line) : "";
    char *holder = strdup(consumer != NULL ? consumer : "?");
    gpiod_chip_close(chip);
    return holder;
}

static void assert_holder(unsigned offset, const char *expected)
{
    char *holder = holder_of(offset);

    assert_string_equal(holder, expected);
    free(holder);
}

static void no_such_chip(void **state)
{
    yb_gpiod_pins_t pins = good_pins;

    (void)state;
    pins.chip = "gpiochip77";
    assert_refused(&pins,
                   "there is no GPIO chip \"gpiochip77\"; gpiodetect lists the chips of this "
                   "machine");
    pins.chip = "/dev/null";
    assert_refused(&pins, "\"/dev/null\" is not a GPIO chip; gpiodetect lists those there are");
}

static void no_such_line(void **state)
{
    yb_gpiod_pins_t pins = good_pins;

    (void)state;
    pins.mosi = 16;
    assert_refused(&pins, "there is no line 16: " CHIP " has lines 0 to 15");
    pins = good_pins;
    pins.cs = -5;
    assert_refused(&pins, "there is no line -5: " CHIP " has lines 0 to 15");
    assert_holder(7, "");
}

static void one_line_twice(void **state)
{
    yb_gpiod_pins_t pins = good_pins;

    (void)state;
    pins.dc = pins.sck;
    assert_refused(&pins, "line 3 cannot be both sck and dc");
    pins = good_pins;
    pins.reset = pins.cs;
    assert_refused(&pins, "line 7 cannot be both cs and reset");
}

static void busy_line_names_its_holder(void **state)
{
    struct gpiod_chip *chip = gpiod_chip_open_lookup("bus");

    (void)state;
    assert_non_null(chip);
    struct gpiod_line *line = gpiod_chip_get_line(chip, 1);
    assert_int_equal(gpiod_line_request_output(line, "lamp of the porch", 0), 0);
    assert_refused(&good_pins, "line 1 of " CHIP " is busy: \"lamp of the porch\" holds it");
    gpiod_line_release(line);

    line = gpiod_chip_get_line(chip, 0);
    assert_int_equal(gpiod_line_request_input(line, "door bell"), 0);
    assert_refused(&good_pins, "line 0 of " CHIP " is busy: \"door bell\" holds it");
    gpiod_line_release(line);
    gpiod_chip_close(chip);

    /* What was taken before the busy line was met is free again. */
    for (unsigned offset = 0; offset < 16; offset++)
        assert_holder(offset, "");
}

static void no_permission(void **state)
{
    int status = 0;

    (void)state;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        char error[YB_GPIOD_ERROR_BYTES] = "";
        const yb_gpiod_pins_t pins = {
            .chip = CHIP, .sck = 3, .mosi = 1, .cs = 7, .dc = 0, .reset = 2};
        if (setgid(65534) != 0 || setuid(65534) != 0)
            _exit(2);
        if (yb_gpiod_bus_open(&pins, error, sizeof error) != NULL)
            _exit(3);
        const bool said = strstr(error, "no permission to open GPIO chip \"" CHIP "\"") != NULL;
        if (!said)
            fprintf(stderr, "it said: %s\n", error);
        _exit(said ? 0 : 4);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

static void lines_are_held_until_closed(void **state)
{
    static const unsigned lines[] = {3, 1, 7, 0};
    char error[YB_GPIOD_ERROR_BYTES] = "";

    (void)state;
    for (int round = 0; round < 3; round++) {
        yb_gpiod_bus_t *bus = yb_gpiod_bus_open(&good_pins, error, sizeof error);
        assert_non_null(bus);
        assert_null(yb_gpiod_bus_panel(bus)->reset);
        for (size_t i = 0; i < 4; i++)
            assert_holder(lines[i], "yamabiko");
        yb_gpiod_bus_close(bus);
        for (size_t i = 0; i < 4; i++)
            assert_holder(lines[i], "");
    }
    yb_gpiod_bus_close(NULL);
}

/* A chip on a USB adapter goes away when it is pulled out. The last test: the chip is gone. */
static void vanished_chip_is_reported(void **state)
{
    static const uint8_t byte = 0xE3;
    char error[YB_GPIOD_ERROR_BYTES] = "";
    yb_gpiod_bus_t *bus = yb_gpiod_bus_open(&good_pins, error, sizeof error);

    (void)state;
    assert_non_null(bus);
    const yb_panel_bus_t *panel = yb_gpiod_bus_panel(bus);
    assert_true(panel->command(panel->context, &byte, 1));
    assert_string_equal(yb_gpiod_bus_error(bus), "");
    write_text(SIM "bus/live", "0");
    assert_false(panel->command(panel->context, &byte, 1));
    assert_string_equal(yb_gpiod_bus_error(bus),
                        "the display could not be reached: setting the chip-select and D/C lines: "
                        "No such device");
    yb_gpiod_bus_close(bus);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_such_chip),
        cmocka_unit_test(no_such_line),
        cmocka_unit_test(one_line_twice),
        cmocka_unit_test(busy_line_names_its_holder),
        cmocka_unit_test(no_permission),
        cmocka_unit_test(lines_are_held_until_closed),
        cmocka_unit_test(vanished_chip_is_reported),
    };
    return cmocka_run_group_tests(tests, make_chips, NULL);
}
