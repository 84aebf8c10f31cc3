/* What spi-panel.dts says the guest has, used as the tests of panels use it: bytes sent by spidev,
 * and D/C between them, are all in one trace in their order; a button pressed from /sys gives edge
 * events. And what else such tests ask of the kernel. Runs in the guest, as root. */
#define _POSIX_C_SOURCE 200809L
#define _DEFAULT_SOURCE

#include "gpio_trace.h"

#include <fcntl.h>
#include <glob.h>
#include <linux/gpio.h>
#include <linux/spi/spidev.h>
#include <poll.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cmocka.h>

#define TRACING "/sys/kernel/tracing/"
#define BUTTON "/sys/devices/platform/gpio-sim/gpiochip0/sim_gpio5/pull"

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");

    if (file == NULL || fputs(text, file) < 0 || fclose(file) != 0)
        fail_msg("%s cannot be written", path);
}

static void read_line(const char *path, char *line, int bytes)
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, bytes, file));
    line[strcspn(line, "\n")] = '\0';
    fclose(file);
}

/* The number that the trace gives to line 0 of the chip. */
static unsigned chip_base(void)
{
    char path[300];
    char text[40];
    unsigned base = 0;
    bool is_it = false;
    glob_t found;
    assert_int_equal(glob("/sys/class/gpio/gpiochip*", 0, NULL, &found), 0);

    for (size_t i = 0; i < found.gl_pathc && !is_it; i++) {
        snprintf(path, sizeof path, "%s/label", found.gl_pathv[i]);
        read_line(path, text, sizeof text);
        is_it = strcmp(text, "spi-panel") == 0;
        snprintf(path, sizeof path, "%s/base", found.gl_pathv[i]);
        read_line(path, text, sizeof text);
        base = (unsigned)strtoul(text, NULL, 10);
    }
    globfree(&found);
    assert_true(is_it);
    return base;
}

/* Requests the line of this name, from whichever chip has it; the caller closes it. */
static int request_line(const char *name, uint64_t flags)
{
    int line = -1;
    glob_t found;
    assert_int_equal(glob("/dev/gpiochip*", 0, NULL, &found), 0);

    for (size_t i = 0; i < found.gl_pathc && line < 0; i++) {
        const int chip = open(found.gl_pathv[i], O_RDWR);
        struct gpio_v2_line_info info = {.offset = 0};
        for (; line < 0 && ioctl(chip, GPIO_V2_GET_LINEINFO_IOCTL, &info) == 0;
             info = (struct gpio_v2_line_info){.offset = info.offset + 1}) {
            struct gpio_v2_line_request request = {
                .offsets = {info.offset}, .num_lines = 1, .config = {.flags = flags}};
            if (strcmp(info.name, name) == 0) {
                assert_int_equal(ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &request), 0);
                line = request.fd;
            }
        }
        close(chip);
    }
    globfree(&found);
    assert_true(line >= 0);
    return line;
}

static void set_line(int line, bool value)
{
    struct gpio_v2_line_values values = {.bits = value, .mask = 1};
    assert_int_equal(ioctl(line, GPIO_V2_LINE_SET_VALUES_IOCTL, &values), 0);
}

enum {
    LINES = 32,
    MOST = 16
};

/* What the lines of one bus carried: bytes, with 0x100 added where D/C was high. */
typedef struct {
    unsigned base;
    unsigned sck;
    unsigned mosi;
    unsigned cs;
    unsigned dc;
    int selected; /* the level of cs that means so */
    int level[LINES];
    unsigned bits;
    unsigned byte;
    unsigned count;
    unsigned bytes[MOST];
    bool is_unselected;
} carried_t;

static bool line_set(void *context, unsigned number, int value)
{
    carried_t *carried = context;
    const unsigned line = number - carried->base;

    if (line >= LINES)
        return true;
    const bool rises = value != 0 && carried->level[line] == 0;
    carried->level[line] = value;
    if (line != carried->sck || !rises)
        return true;
    carried->is_unselected |= carried->level[carried->cs] != carried->selected;
    carried->byte = carried->byte << 1 | (carried->level[carried->mosi] != 0);
    if (++carried->bits < 8)
        return true;
    if (carried->count < MOST)
        carried->bytes[carried->count++] =
            carried->byte | (carried->level[carried->dc] != 0 ? 0x100 : 0);
    carried->bits = carried->byte = 0;
    return true;
}

static void send(int device, const uint8_t *bytes, size_t count)
{
    struct spi_ioc_transfer transfer = {
        .tx_buf = (uintptr_t)bytes, .len = (uint32_t)count, .speed_hz = 40000000};
    assert_int_equal(ioctl(device, SPI_IOC_MESSAGE(1), &transfer), count);
}

static void assert_carries(const char *path, carried_t *carried)
{
    static const uint8_t command[] = {0xDE};
    static const uint8_t data[] = {0xAD, 0xBE, 0xEF};
    static const unsigned expected[] = {0xDE, 0x1AD, 0x1BE, 0x1EF, 0xDE};
    const int device = open(path, O_RDWR);
    const int dc = request_line("GPIO25", GPIO_V2_LINE_FLAG_OUTPUT);
    assert_true(device >= 0);
    carried->base = chip_base();

    write_text(TRACING "events/gpio/gpio_value/enable", "1");
    write_text(TRACING "tracing_on", "1");
    send(device, command, sizeof command);
    set_line(dc, true);
    send(device, data, sizeof data);
    set_line(dc, false);
    assert_int_equal(write(device, command, sizeof command), sizeof command);
    write_text(TRACING "tracing_on", "0");
    close(dc);
    close(device);

    assert_true(yb_gpio_trace_read(TRACING, line_set, carried));
    assert_int_equal(carried->bits, 0);
    assert_int_equal(carried->count, sizeof expected / sizeof expected[0]);
    assert_memory_equal(carried->bytes, expected, sizeof expected);
    assert_false(carried->is_unselected);
    assert_int_equal(carried->level[carried->cs], !carried->selected);
}

static void spidev_with_chip_select_low(void **state)
{
    carried_t carried = {.sck = 11, .mosi = 10, .cs = 8, .dc = 25};

    (void)state;
    assert_carries("/dev/spidev0.0", &carried);
}

static void spidev_with_chip_select_high(void **state)
{
    carried_t carried = {.sck = 21, .mosi = 20, .cs = 18, .dc = 25, .selected = 1};

    (void)state;
    assert_carries("/dev/spidev1.0", &carried);
}

static void button_gives_edges(void **state)
{
    struct gpio_v2_line_event event;

    (void)state;
    write_text(BUTTON, "pull-up");
    const int line =
        request_line("GPIO5", GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_ACTIVE_LOW |
                                  GPIO_V2_LINE_FLAG_EDGE_RISING | GPIO_V2_LINE_FLAG_EDGE_FALLING);
    struct pollfd ready = {.fd = line, .events = POLLIN};
    assert_int_equal(poll(&ready, 1, 0), 0);
    write_text(BUTTON, "pull-down");
    assert_int_equal(poll(&ready, 1, 1000), 1);
    assert_int_equal(read(line, &event, sizeof event), sizeof event);
    assert_int_equal(event.id, GPIO_V2_LINE_EVENT_RISING_EDGE);
    write_text(BUTTON, "pull-up");
    assert_int_equal(poll(&ready, 1, 1000), 1);
    assert_int_equal(read(line, &event, sizeof event), sizeof event);
    assert_int_equal(event.id, GPIO_V2_LINE_EVENT_FALLING_EDGE);
    close(line);
}

/* The most memory this process ever had, from /proc as shell scripts read it. */
static unsigned long peak_kb(void)
{
    char text[128];
    unsigned long peak = 0;
    FILE *file = fopen("/proc/self/status", "r");
    assert_non_null(file);

    while (fgets(text, sizeof text, file) != NULL) {
        if (strncmp(text, "VmHWM:", 6) == 0)
            peak = strtoul(text + 6, NULL, 10);
    }
    fclose(file);
    return peak;
}

static void memory_is_told(void **state)
{
    enum {
        BYTES = 8 << 20
    };
    (void)state;
    const unsigned long before = peak_kb();
    assert_true(before > 0);
    char *much = malloc(BYTES);
    assert_non_null(much);
    memset(much, 1, BYTES);
    assert_true(peak_kb() >= before + BYTES / 2048);
    free(much);
    write_text("/proc/self/clear_refs", "5");
    assert_true(peak_kb() < before + BYTES / 2048);
    assert_int_equal(access("/proc/self/fd/0", F_OK), 0);
}

static void folder_is_watched(void **state)
{
    union {
        struct inotify_event event;
        char bytes[512];
    } got;

    (void)state;
    const int watch = inotify_init1(IN_NONBLOCK);
    assert_true(watch >= 0);
    assert_true(inotify_add_watch(watch, "/run/tmp", IN_CLOSE_WRITE) >= 0);
    const int file = open("/run/tmp/new", O_WRONLY | O_CREAT, 0600);
    assert_true(file >= 0);
    close(file);
    assert_true(read(watch, &got, sizeof got) > 0);
    assert_string_equal(got.event.name, "new");
    close(watch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spidev_with_chip_select_low),
        cmocka_unit_test(spidev_with_chip_select_high),
        cmocka_unit_test(button_gives_edges),
        cmocka_unit_test(memory_is_told),
        cmocka_unit_test(folder_is_watched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
