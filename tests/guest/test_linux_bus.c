/* linux_bus on simulated chips: what it says when lines cannot be had, that it gives them back, and
 * the levels in which it leaves them. Runs in the guest, as root. */
#define _DEFAULT_SOURCE /* setgroups, usleep */

#include "linux_bus.h"

#include "sim_chip.h"

#include <grp.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

enum {
    DC_LINE = 0,
    MOSI_LINE = 1,
    RESET_LINE = 2,
    SCK_LINE = 3,
    LIGHT_LINE = 4,
    CS_LINE = 7,
};

static yb_sim_chip_t chip;
static const char *name; /* of the chip: "gpiochip0" */

static const char *const line_names[] = {"DATA/COMMAND", "MOSI", "RESET", "SCK",
                                         "LIGHT",        "",     "",      "SELECT"};

static const yb_linux_wiring_t good = {
    .chip = "bus", .sck = "SCK", .mosi = "1", .cs = "7", .dc = "DATA/COMMAND"};

static int make_chip(void **state)
{
    static const char *names[9];

    (void)state;
    memcpy(names, line_names, sizeof line_names);
    yb_sim_chip_make(&chip, "bus", names);
    name = strrchr(chip.path, '/') + 1;
    return 0;
}

static void assert_refused(const yb_linux_wiring_t *wiring, const char *format, ...)
{
    char error[YB_LINUX_ERROR_BYTES] = "";
    char sentence[YB_LINUX_ERROR_BYTES];
    va_list list;

    va_start(list, format);
    vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    assert_null(yb_linux_bus_open(wiring, &yb_panel_ssd0323, error));
    assert_string_equal(error, sentence);
}

/* What was taken before a failure must be free again. */
static int all_is_free(void **state)
{
    (void)state;
    for (unsigned line = 0; line < 16; line++)
        assert_string_equal(yb_sim_chip_holder(&chip, line), "");
    return 0;
}

static yb_linux_bus_t *open_bus(const yb_linux_wiring_t *wiring, const yb_panel_t *panel)
{
    char error[YB_LINUX_ERROR_BYTES] = "";
    yb_linux_bus_t *bus = yb_linux_bus_open(wiring, panel, error);

    assert_string_equal(error, "");
    assert_non_null(bus);
    return bus;
}

static void no_such_chip(void **state)
{
    static const char *const absent[] = {"gpiochip77", "77", "/dev/gpiochip77", "no such label"};
    yb_linux_wiring_t wiring = good;

    (void)state;
    for (size_t i = 0; i < sizeof absent / sizeof absent[0]; i++) {
        wiring.chip = absent[i];
        assert_refused(&wiring,
                       "there is no GPIO chip \"%s\"; gpiodetect lists the chips of this machine",
                       absent[i]);
    }
    wiring.chip = "/dev/null";
    assert_refused(&wiring, "\"/dev/null\" is not a GPIO chip; gpiodetect lists those there are");
}

static void chip_by_name_number_path_and_label(void **state)
{
    const char *const ways[] = {"bus", name, chip.path, name + strlen("gpiochip")};

    (void)state;
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        yb_linux_wiring_t wiring = good;
        wiring.chip = ways[i];
        yb_linux_bus_t *bus = open_bus(&wiring, &yb_panel_ssd0323);
        assert_string_equal(yb_sim_chip_holder(&chip, SCK_LINE), "yamabiko");
        yb_linux_bus_close(bus);
    }
}

static void no_such_line(void **state)
{
    yb_linux_wiring_t wiring = good;

    (void)state;
    wiring.mosi = "16";
    assert_refused(&wiring, "mosi: there is no line 16: %s has lines 0 to 15", name);
    wiring = good;
    wiring.cs = "GPIO7";
    assert_refused(&wiring, "cs: there is no line \"GPIO7\" on %s; gpioinfo lists its lines", name);
    wiring.cs = "-5";
    assert_refused(&wiring, "cs: there is no line \"-5\" on %s; gpioinfo lists its lines", name);
    wiring.cs = "";
    assert_refused(&wiring, "cs: there is no line \"\" on %s; gpioinfo lists its lines", name);
    wiring.cs = "99999999999999999999999";
    assert_refused(&wiring, "cs: there is no line 99999999999999999999999: %s has lines 0 to 15",
                   name);
}

static void missing_or_superfluous_line(void **state)
{
    yb_linux_wiring_t wiring = good;
    yb_panel_t sharp = yb_panel_ssd0323;
    char error[YB_LINUX_ERROR_BYTES] = "";

    (void)state;
    wiring.mosi = NULL;
    assert_refused(&wiring, "ssd0323, bit by bit, needs the line mosi; name it, or an SPI device");
    wiring = good;
    wiring.dc = NULL;
    assert_refused(&wiring, "ssd0323 needs the line dc, which tells data from commands; name it");
    wiring = good;
    wiring.spi = "/dev/spidev9.9";
    assert_refused(&wiring, "/dev/spidev9.9 has a line sck of its own; leave that out");
    sharp.flags |= YB_PANEL_NO_DC;
    assert_null(yb_linux_bus_open(&good, &sharp, error));
    assert_string_equal(error, "ssd0323 has no line dc; leave it out");
}

static void no_such_spi_device(void **state)
{
    yb_linux_wiring_t wiring = {.spi = "/dev/spidev9.9", .chip = "bus", .dc = "0"};

    (void)state;
    assert_refused(&wiring, "there is no SPI device /dev/spidev9.9; the machine's device tree must "
                            "have its SPI switched on (Raspberry Pi: dtparam=spi=on)");
    wiring.spi = "/dev/null";
    assert_refused(&wiring, "/dev/null is not an SPI device");
}

static void one_line_twice(void **state)
{
    yb_linux_wiring_t wiring = good;

    (void)state;
    wiring.dc = "3";
    assert_refused(&wiring, "line 3 cannot be both sck and dc");
    wiring = good;
    wiring.reset = "SELECT";
    assert_refused(&wiring, "line 7 cannot be both cs and reset");
}

static void busy_line_names_its_holder(void **state)
{
    (void)state;
    int fd = yb_sim_chip_hold(&chip, MOSI_LINE, "lamp of the porch");
    assert_refused(&good, "line 1 of %s is busy: \"lamp of the porch\" holds it", name);
    close(fd);
    fd = yb_sim_chip_hold(&chip, DC_LINE, "door bell");
    assert_refused(&good, "line 0 of %s is busy: \"door bell\" holds it", name);
    close(fd);
    yb_linux_bus_close(open_bus(&good, &yb_panel_ssd0323));
}

/* As somebody whom the chip's file does not let in. 0: it said so. */
static int open_as_nobody(const char *sentence)
{
    char error[YB_LINUX_ERROR_BYTES] = "";
    yb_linux_wiring_t wiring = good;

    wiring.chip = chip.path;
    if (setgroups(0, NULL) != 0 || setgid(65534) != 0 || setuid(65534) != 0)
        return 2;
    if (yb_linux_bus_open(&wiring, &yb_panel_ssd0323, error) != NULL)
        return 3;
    if (strcmp(error, sentence) == 0)
        return 0;
    fprintf(stderr, "it said: %s\nand not: %s\n", error, sentence);
    return 4;
}

static void assert_no_permission(const char *format, const char *path, const char *group)
{
    char sentence[YB_LINUX_ERROR_BYTES];
    int status = 0;

    snprintf(sentence, sizeof sentence, format, path, group);
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0)
        _exit(open_as_nobody(sentence));
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

static void no_permission_names_the_group(void **state)
{
    const struct group *group = getgrnam("dialout");

    (void)state;
    assert_non_null(group);
    assert_int_equal(chmod(chip.path, 0600), 0);
    assert_no_permission("no permission to open %s: it is root's alone; a udev rule can give it to "
                         "a group",
                         chip.path, "");
    assert_int_equal(chown(chip.path, 0, group->gr_gid), 0);
    assert_int_equal(chmod(chip.path, 0660), 0);
    assert_no_permission(
        "no permission to open %s: become a member of the group \"%s\", and log in "
        "again",
        chip.path, "dialout");
    assert_int_equal(chown(chip.path, 0, 54321), 0);
    assert_no_permission("no permission to open %s: become a member of the group of number 54321",
                         chip.path, "");
    assert_int_equal(chown(chip.path, 0, 0), 0);
}

static void lines_are_held_until_closed(void **state)
{
    static const unsigned lines[] = {SCK_LINE, MOSI_LINE, CS_LINE, DC_LINE};

    (void)state;
    for (int round = 0; round < 3; round++) {
        yb_linux_bus_t *bus = open_bus(&good, &yb_panel_ssd0323);
        assert_null(yb_linux_bus_panel(bus)->reset);
        for (size_t i = 0; i < 4; i++)
            assert_string_equal(yb_sim_chip_holder(&chip, lines[i]), "yamabiko");
        assert_refused(&good, "line 7 of %s is busy: \"yamabiko\" holds it", name);
        yb_linux_bus_close(bus);
        for (size_t i = 0; i < 4; i++)
            assert_string_equal(yb_sim_chip_holder(&chip, lines[i]), "");
    }
    yb_linux_bus_close(NULL);
}

static void levels_between_transfers(void **state)
{
    static const uint8_t bytes[] = {0xA5, 0xFF};
    yb_linux_wiring_t wiring = good;
    yb_panel_t panel = yb_panel_ssd0323;

    (void)state;
    wiring.reset = "RESET";
    wiring.backlight = "LIGHT";
    for (int high = 0; high <= 1; high++) {
        panel.flags = high ? YB_PANEL_SELECT_HIGH : 0;
        yb_linux_bus_t *bus = open_bus(&wiring, &panel);
        const yb_panel_bus_t *calls = yb_linux_bus_panel(bus);
        for (int step = 0; step < 3; step++) {
            assert_int_equal(yb_sim_chip_level(&chip, CS_LINE), !high);
            assert_int_equal(yb_sim_chip_level(&chip, SCK_LINE), 0);
            assert_int_equal(yb_sim_chip_level(&chip, RESET_LINE), 1);
            assert_int_equal(yb_sim_chip_level(&chip, LIGHT_LINE), step == 2);
            assert_true(calls->data(calls->context, bytes, sizeof bytes));
            assert_int_equal(yb_sim_chip_level(&chip, DC_LINE), 1);
            assert_true(calls->command(calls->context, bytes, 1));
            assert_int_equal(yb_sim_chip_level(&chip, DC_LINE), 0);
            assert_true(step == 0 ? calls->reset(calls->context)
                                  : yb_linux_bus_backlight(bus, true));
        }
        assert_int_equal(yb_linux_bus_bytes(bus), 9);
        assert_true(yb_linux_bus_backlight(bus, false));
        assert_int_equal(yb_sim_chip_level(&chip, LIGHT_LINE), 0);
        yb_linux_bus_close(bus);
    }
}

static volatile sig_atomic_t ticks;

static void tick(int number)
{
    (void)number;
    ticks++;
}

/* A pause lasts as long as it was asked for, however many signals come. */
static void signals_shorten_no_pause(void **state)
{
    const struct sigaction action = {.sa_handler = tick}; /* without SA_RESTART */
    const struct itimerval fast = {{0, 2000}, {0, 2000}};
    const struct itimerval off = {{0, 0}, {0, 0}};
    struct timeval begin;
    struct timeval end;
    yb_linux_bus_t *bus = open_bus(&good, &yb_panel_ssd0323);
    const yb_panel_bus_t *calls = yb_linux_bus_panel(bus);

    (void)state;
    ticks = 0;
    assert_int_equal(sigaction(SIGALRM, &action, NULL), 0);
    gettimeofday(&begin, NULL);
    assert_int_equal(setitimer(ITIMER_REAL, &fast, NULL), 0);
    calls->wait_ms(calls->context, 60);
    gettimeofday(&end, NULL);
    assert_int_equal(setitimer(ITIMER_REAL, &off, NULL), 0);
    assert_true(ticks >= 3);
    assert_true((end.tv_sec - begin.tv_sec) * 1000000 + (end.tv_usec - begin.tv_usec) >= 59000);
    yb_linux_bus_close(bus);
}

/* Sends until that fails, and tells when something is sent; 0: it said that the chip is gone, and
 * goes on saying so.
 */
static int draw_until_it_fails(const char *sentence, int telling)
{
    static const uint8_t bytes[100];
    yb_linux_bus_t *bus = open_bus(&good, &yb_panel_ssd0323);
    const yb_panel_bus_t *calls = yb_linux_bus_panel(bus);

    if (calls->data(calls->context, bytes, sizeof bytes) && write(telling, bytes, 1) != 1)
        return 5;
    while (calls->data(calls->context, bytes, sizeof bytes))
        ;
    fprintf(stderr, "it says: %s\n", yb_linux_bus_error(bus));
    const bool said = strcmp(yb_linux_bus_error(bus), sentence) == 0 &&
                      !calls->command(calls->context, bytes, 1) &&
                      strcmp(yb_linux_bus_error(bus), sentence) == 0;
    const bool counted = yb_linux_bus_bytes(bus) != 0 && yb_linux_bus_bytes(bus) % 100 == 0;
    yb_linux_bus_close(bus);
    return said && counted ? 0 : 4;
}

/* A chip on a USB adapter goes away when it is pulled out. The last test: the chip is gone. */
static void vanishes_while_it_draws(void **state)
{
    char sentence[YB_LINUX_ERROR_BYTES];
    int status = 0;
    int told[2];
    char byte;

    (void)state;
    assert_int_equal(pipe(told), 0);
    snprintf(sentence, sizeof sentence,
             "the display could not be reached: %s is gone; was it unplugged?", name);
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0)
        _exit(draw_until_it_fails(sentence, told[1]));
    close(told[1]);
    assert_int_equal(read(told[0], &byte, 1), 1); /* however slow the machine is */
    close(told[0]);
    usleep(100000);
    assert_int_equal(waitpid(child, &status, WNOHANG), 0);
    yb_sim_chip_unplug(&chip);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(no_such_chip, all_is_free),
        cmocka_unit_test_teardown(chip_by_name_number_path_and_label, all_is_free),
        cmocka_unit_test_teardown(no_such_line, all_is_free),
        cmocka_unit_test_teardown(missing_or_superfluous_line, all_is_free),
        cmocka_unit_test_teardown(no_such_spi_device, all_is_free),
        cmocka_unit_test_teardown(one_line_twice, all_is_free),
        cmocka_unit_test_teardown(busy_line_names_its_holder, all_is_free),
        cmocka_unit_test_teardown(no_permission_names_the_group, all_is_free),
        cmocka_unit_test_teardown(lines_are_held_until_closed, all_is_free),
        cmocka_unit_test_teardown(levels_between_transfers, all_is_free),
        cmocka_unit_test_teardown(signals_shorten_no_pause, all_is_free),
        cmocka_unit_test(vanishes_while_it_draws),
    };
    return cmocka_run_group_tests(tests, make_chip, NULL);
}
