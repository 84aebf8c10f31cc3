/* linux_bus on the guest's two SPI devices (spi-panel.dts): what it says when they cannot be had or
 * do not fit the panel, and when one goes away. Runs in the guest, as root. */
#define _DEFAULT_SOURCE /* setgroups, usleep */

#include "linux_bus.h"

#include <fcntl.h>
#include <grp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <linux/spi/spidev.h>

#include <cmocka.h>

#define LOW "/dev/spidev0.0"
#define HIGH "/dev/spidev1.0"

static const yb_linux_wiring_t good = {.spi = LOW, .chip = "spi-panel", .dc = "GPIO25"};
static const yb_linux_wiring_t sharp = {.spi = HIGH};

static void assert_refused(const yb_linux_wiring_t *wiring, const yb_panel_t *panel,
                           const char *sentence)
{
    char error[YB_LINUX_ERROR_BYTES] = "";

    assert_null(yb_linux_bus_open(wiring, panel, error));
    assert_string_equal(error, sentence);
}

static yb_linux_bus_t *open_bus(const yb_linux_wiring_t *wiring, const yb_panel_t *panel)
{
    char error[YB_LINUX_ERROR_BYTES] = "";
    yb_linux_bus_t *bus = yb_linux_bus_open(wiring, panel, error);

    assert_string_equal(error, "");
    assert_non_null(bus);
    return bus;
}

static void level_of_chip_select(void **state)
{
    yb_linux_wiring_t wrong = good;

    (void)state;
    wrong.spi = HIGH;
    assert_refused(&wrong, &yb_panel_ssd1306,
                   "/dev/spidev1.0 selects with a high level and the display wants a low one; its "
                   "node in the device tree must be rid of spi-cs-high");
    wrong = sharp;
    wrong.spi = LOW;
    assert_refused(&wrong, &yb_panel_ls013b7dh03,
                   "/dev/spidev0.0 selects with a low level and the display wants a high one; its "
                   "node in the device tree must be given spi-cs-high");
}

static void sharp_needs_no_gpio_chip(void **state)
{
    yb_linux_wiring_t wiring = sharp;

    (void)state;
    wiring.chip = "gpiochip77";
    yb_linux_bus_close(open_bus(&wiring, &yb_panel_ls013b7dh03));
}

static void one_program_at_a_time(void **state)
{
    yb_linux_wiring_t other = good;
    yb_linux_bus_t *bus = open_bus(&good, &yb_panel_ssd1306);

    (void)state;
    other.dc = "GPIO24";
    assert_refused(&other, &yb_panel_ssd1306,
                   "/dev/spidev0.0 is busy: another program draws through it");
    yb_linux_bus_close(bus);
    yb_linux_bus_close(open_bus(&other, &yb_panel_ssd1306));
}

static uint32_t clock_of(const char *path)
{
    uint32_t hz = 0;
    const int fd = open(path, O_RDWR);

    assert_true(fd >= 0);
    assert_int_equal(ioctl(fd, SPI_IOC_RD_MAX_SPEED_HZ, &hz), 0);
    close(fd);
    return hz;
}

static uint8_t mode_of(int fd)
{
    uint8_t mode = 0xFF;

    assert_int_equal(ioctl(fd, SPI_IOC_RD_MODE, &mode), 0);
    return mode;
}

/* Whatever the program before has left there. */
static void mode_is_0(void **state)
{
    const uint8_t left = SPI_MODE_3;
    const int fd = open(LOW, O_RDWR);

    (void)state;
    assert_true(fd >= 0);
    assert_int_equal(ioctl(fd, SPI_IOC_WR_MODE, &left), 0);
    assert_int_equal(mode_of(fd), SPI_MODE_3);
    yb_linux_bus_t *bus = open_bus(&good, &yb_panel_ssd1306);
    assert_int_equal(mode_of(fd), SPI_MODE_0);
    assert_int_not_equal(clock_of(LOW), 0);
    yb_linux_bus_close(bus);
    close(fd);
}

/* spidev sends no more than its bufsiz at once: a long transfer goes in pieces, unless the display
 * would take a piece for a whole. */
static void longer_than_the_kernel_takes(void **state)
{
    static uint8_t bytes[10000];
    yb_linux_bus_t *bus = open_bus(&good, &yb_panel_ssd1306);
    const yb_panel_bus_t *calls = yb_linux_bus_panel(bus);

    (void)state;
    assert_true(calls->data(calls->context, bytes, sizeof bytes));
    assert_int_equal(yb_linux_bus_bytes(bus), sizeof bytes);
    yb_linux_bus_close(bus);

    bus = open_bus(&sharp, &yb_panel_ls013b7dh03);
    calls = yb_linux_bus_panel(bus);
    assert_true(calls->data(calls->context, bytes, 4096));
    assert_false(calls->data(calls->context, bytes, 4097));
    assert_string_equal(yb_linux_bus_error(bus),
                        "the display wants 4097 bytes at a stretch, and spidev sends 4096: raise "
                        "its parameter bufsiz");
    assert_int_equal(yb_linux_bus_bytes(bus), 4096);
    yb_linux_bus_close(bus);
}

static void no_permission_names_the_group(void **state)
{
    const struct group *group = getgrnam("dialout");
    int status = 0;

    (void)state;
    assert_non_null(group);
    assert_int_equal(chown(HIGH, 0, group->gr_gid), 0);
    assert_int_equal(chmod(HIGH, 0660), 0);
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        char error[YB_LINUX_ERROR_BYTES] = "";
        if (setgroups(0, NULL) != 0 || setgid(65534) != 0 || setuid(65534) != 0)
            _exit(2);
        if (yb_linux_bus_open(&sharp, &yb_panel_ls013b7dh03, error) != NULL)
            _exit(3);
        fprintf(stderr, "it says: %s\n", error);
        _exit(strcmp(error, "no permission to open /dev/spidev1.0: become a member of the group "
                            "\"dialout\", and log in again") != 0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

/* Sends until that fails; 0: it said that the device is gone. */
static int draw_until_it_fails(void)
{
    static uint8_t bytes[500];
    yb_linux_bus_t *bus = open_bus(&good, &yb_panel_ssd1306);
    const yb_panel_bus_t *calls = yb_linux_bus_panel(bus);

    while (calls->data(calls->context, bytes, sizeof bytes))
        ;
    fprintf(stderr, "it says: %s\n", yb_linux_bus_error(bus));
    const bool said =
        strcmp(yb_linux_bus_error(bus),
               "the display could not be reached: /dev/spidev0.0 is gone; was it unplugged?") == 0;
    yb_linux_bus_close(bus);
    return said ? 0 : 4;
}

/* The last test: the device is gone. */
static void vanishes_while_it_draws(void **state)
{
    int status = 0;

    (void)state;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0)
        _exit(draw_until_it_fails());
    usleep(100000);
    assert_int_equal(waitpid(child, &status, WNOHANG), 0);
    FILE *unbind = fopen("/sys/bus/spi/drivers/spidev/unbind", "w");
    assert_non_null(unbind);
    assert_true(fputs("spi0.0", unbind) >= 0);
    assert_int_equal(fclose(unbind), 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    assert_refused(&good, &yb_panel_ssd1306,
                   "there is no SPI device /dev/spidev0.0; the machine's device tree must have its "
                   "SPI switched on (Raspberry Pi: dtparam=spi=on)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(level_of_chip_select),
        cmocka_unit_test(sharp_needs_no_gpio_chip),
        cmocka_unit_test(one_program_at_a_time),
        cmocka_unit_test(mode_is_0),
        cmocka_unit_test(longer_than_the_kernel_takes),
        cmocka_unit_test(no_permission_names_the_group),
        cmocka_unit_test(vanishes_while_it_draws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
