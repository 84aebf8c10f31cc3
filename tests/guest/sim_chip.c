#define _POSIX_C_SOURCE 200809L /* O_CLOEXEC */

#include "sim_chip.h"

#include <fcntl.h>
#include <linux/gpio.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#define SIM "/sys/kernel/config/gpio-sim/"

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");

    if (file == NULL || fputs(text, file) < 0 || fclose(file) != 0)
        fail_msg("%s cannot be written", path);
}

static void read_word(const char *path, char *word, int bytes)
{
    FILE *file = fopen(path, "r");

    if (file == NULL || fgets(word, bytes, file) == NULL)
        fail_msg("%s cannot be read", path);
    else
        word[strcspn(word, "\n")] = '\0';
    if (file != NULL)
        fclose(file);
}

void yb_sim_chip_make(yb_sim_chip_t *chip, const char *label, const char *const *names)
{
    char path[160];
    char device[32] = "";
    char name[32] = "";

    snprintf(chip->label, sizeof chip->label, "%s", label);
    snprintf(path, sizeof path, SIM "%s", label);
    assert_int_equal(mkdir(path, 0755), 0);
    snprintf(path, sizeof path, SIM "%s/bank", label);
    assert_int_equal(mkdir(path, 0755), 0);
    snprintf(path, sizeof path, SIM "%s/bank/num_lines", label);
    write_text(path, "16");
    snprintf(path, sizeof path, SIM "%s/bank/label", label);
    write_text(path, label);
    for (unsigned i = 0; names != NULL && names[i] != NULL; i++) {
        snprintf(path, sizeof path, SIM "%s/bank/line%u", label, i);
        assert_int_equal(mkdir(path, 0755), 0);
        snprintf(path, sizeof path, SIM "%s/bank/line%u/name", label, i);
        write_text(path, names[i]);
    }
    snprintf(path, sizeof path, SIM "%s/live", label);
    write_text(path, "1");
    snprintf(path, sizeof path, SIM "%s/dev_name", label);
    read_word(path, device, sizeof device);
    snprintf(path, sizeof path, SIM "%s/bank/chip_name", label);
    read_word(path, name, sizeof name);
    snprintf(chip->path, sizeof chip->path, "/dev/%s", name);
    snprintf(chip->lines, sizeof chip->lines, "/sys/devices/platform/%s/%s", device, name);
}

void yb_sim_chip_unplug(const yb_sim_chip_t *chip)
{
    char path[160];

    snprintf(path, sizeof path, SIM "%s/live", chip->label);
    write_text(path, "0");
}

void yb_sim_chip_pull(const yb_sim_chip_t *chip, unsigned line, int level)
{
    char path[240];

    snprintf(path, sizeof path, "%s/sim_gpio%u/pull", chip->lines, line);
    write_text(path, level != 0 ? "pull-up" : "pull-down");
}

int yb_sim_chip_level(const yb_sim_chip_t *chip, unsigned line)
{
    char path[240];
    char value[8] = "";

    snprintf(path, sizeof path, "%s/sim_gpio%u/value", chip->lines, line);
    read_word(path, value, sizeof value);
    return value[0] == '1';
}

int yb_sim_chip_hold(const yb_sim_chip_t *chip, unsigned line, const char *holder)
{
    struct gpio_v2_line_request request = {.num_lines = 1};
    const int fd = open(chip->path, O_RDWR | O_CLOEXEC);

    assert_true(fd >= 0);
    request.offsets[0] = line;
    request.config.flags = GPIO_V2_LINE_FLAG_INPUT;
    snprintf(request.consumer, sizeof request.consumer, "%s", holder);
    assert_int_equal(ioctl(fd, GPIO_V2_GET_LINE_IOCTL, &request), 0);
    close(fd);
    return request.fd;
}

const char *yb_sim_chip_holder(const yb_sim_chip_t *chip, unsigned line)
{
    static struct gpio_v2_line_info info;
    const int fd = open(chip->path, O_RDWR | O_CLOEXEC);

    assert_true(fd >= 0);
    memset(&info, 0, sizeof info);
    info.offset = line;
    assert_int_equal(ioctl(fd, GPIO_V2_GET_LINEINFO_IOCTL, &info), 0);
    close(fd);
    return (info.flags & GPIO_V2_LINE_FLAG_USED) != 0 ? info.consumer : "";
}
