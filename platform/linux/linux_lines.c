#define _POSIX_C_SOURCE 200809L

#include "linux_lines.h"

#include "linux_bus.h"

#include <dirent.h>
#include <errno.h>
#include <grp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum {
    PATH_BYTES = 280, /* "/dev/" and a file's name */
};

void yb_lines_no_permission(const char *path, char *error)
{
    struct stat device;
    const mode_t both = S_IRGRP | S_IWGRP;

    if (stat(path, &device) != 0 || (device.st_mode & both) != both || device.st_gid == 0) {
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "no permission to open %s: it is root's alone; a udev rule can give it to a group",
                 path);
        return;
    }
    const struct group *group = getgrgid(device.st_gid);
    if (group != NULL)
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "no permission to open %s: become a member of the group \"%s\", and log in again",
                 path, group->gr_name);
    else
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "no permission to open %s: become a member of the group of number %lu", path,
                 (unsigned long)device.st_gid);
}

/* ---- Chips ----------------------------------------------------------------------------------- */

static yb_gpiod_chip_t *no_chip(const char *name, const char *path, int why, char *error)
{
    switch (why) {
    case EACCES:
    case EPERM:
        yb_lines_no_permission(path, error);
        break;
    case ENOENT:
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "there is no GPIO chip \"%s\"; gpiodetect lists the chips of this machine", name);
        break;
    case ENODEV:
    case ENOTTY:
    case EINVAL:
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "\"%s\" is not a GPIO chip; gpiodetect lists those there are", name);
        break;
    default:
        snprintf(error, YB_LINUX_ERROR_BYTES, "GPIO chip \"%s\" cannot be opened: %s", name,
                 strerror(why));
        break;
    }
    return NULL;
}

static bool is_number(const char *text)
{
    return *text != '\0' && text[strspn(text, "0123456789")] == '\0';
}

/* Whether the name says which device file it is: "/dev/gpiochip0", "gpiochip0", "0". */
static bool names_file(const char *name, char path[PATH_BYTES])
{
    const char *number = strncmp(name, "gpiochip", 8) == 0 ? name + 8 : name;

    if (strchr(name, '/') != NULL)
        snprintf(path, PATH_BYTES, "%s", name);
    else
        snprintf(path, PATH_BYTES, "/dev/gpiochip%s", number);
    return strchr(name, '/') != NULL || is_number(number);
}

static yb_gpiod_chip_t *chip_of_label(const char *label, char *error)
{
    char path[PATH_BYTES];
    char closed[PATH_BYTES] = ""; /* one that must not be opened: it may be the one */
    const struct dirent *entry;
    yb_gpiod_chip_t *chip = NULL;
    DIR *dev = opendir("/dev");

    while (dev != NULL && chip == NULL && (entry = readdir(dev)) != NULL) {
        if (strncmp(entry->d_name, "gpiochip", 8) != 0)
            continue;
        snprintf(path, sizeof path, "/dev/%s", entry->d_name);
        chip = yb_gpiod_chip_open(path);
        if (chip == NULL && errno == EACCES)
            memcpy(closed, path, sizeof closed);
        if (chip != NULL && strcmp(yb_gpiod_chip_label(chip), label) != 0) {
            yb_gpiod_chip_close(chip);
            chip = NULL;
        }
    }
    if (dev != NULL)
        closedir(dev);
    if (chip != NULL)
        return chip;
    return no_chip(label, closed, closed[0] != '\0' ? EACCES : ENOENT, error);
}

yb_gpiod_chip_t *yb_lines_chip(const char *name, char *error)
{
    char path[PATH_BYTES];

    if (name == NULL)
        name = "gpiochip0";
    if (!names_file(name, path))
        return chip_of_label(name, error);
    yb_gpiod_chip_t *chip = yb_gpiod_chip_open(path);
    return chip != NULL ? chip : no_chip(name, path, errno, error);
}

/* ---- Lines ----------------------------------------------------------------------------------- */

static bool find_line(yb_gpiod_chip_t *chip, yb_line_t *line, char *error)
{
    const char *name = yb_gpiod_chip_name(chip);
    const unsigned lines = yb_gpiod_chip_lines(chip);

    if (is_number(line->name)) {
        const unsigned long number = strtoul(line->name, NULL, 10);
        if (number < lines) {
            line->number = (unsigned)number;
            return true;
        }
        snprintf(error, YB_LINUX_ERROR_BYTES, "%s: there is no line %s: %s has lines 0 to %u",
                 line->role, line->name, name, lines - 1);
        return false;
    }
    /* Lines without a name have the empty one. */
    const int number = line->name[0] != '\0' ? yb_gpiod_chip_find(chip, line->name) : -1;
    if (number < 0) {
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "%s: there is no line \"%s\" on %s; gpioinfo lists its lines", line->role,
                 line->name, name);
        return false;
    }
    line->number = (unsigned)number;
    return true;
}

bool yb_lines_find(yb_gpiod_chip_t *chip, yb_line_t *lines, size_t count, char *error)
{
    for (size_t i = 0; i < count; i++) {
        if (lines[i].name == NULL)
            continue;
        if (!find_line(chip, &lines[i], error))
            return false;
        /* The kernel would call the second use busy, and the user would look for another program.
         */
        for (size_t j = 0; j < i; j++) {
            if (lines[j].name != NULL && lines[i].number == lines[j].number) {
                snprintf(error, YB_LINUX_ERROR_BYTES, "line %u cannot be both %s and %s",
                         lines[i].number, lines[j].role, lines[i].role);
                return false;
            }
        }
    }
    return true;
}

/* The kernel refuses a group as a whole: look for the line that is the reason. */
static void explain_group(yb_gpiod_chip_t *chip, const unsigned *numbers, size_t count, int why,
                          char *error)
{
    const char *name = yb_gpiod_chip_name(chip);
    char holder[YB_GPIOD_NAME_BYTES];

    for (size_t i = 0; i < count; i++) {
        if (!yb_gpiod_chip_holder(chip, numbers[i], holder))
            continue;
        if (holder[0] != '\0')
            snprintf(error, YB_LINUX_ERROR_BYTES, "line %u of %s is busy: \"%s\" holds it",
                     numbers[i], name, holder);
        else
            snprintf(error, YB_LINUX_ERROR_BYTES,
                     "line %u of %s is busy: something that gave no name holds it", numbers[i],
                     name);
        return;
    }
    snprintf(error, YB_LINUX_ERROR_BYTES, "line %u of %s%s cannot be had: %s", numbers[0], name,
             count > 1 ? ", or one taken with it," : "", strerror(why));
}

yb_gpiod_group_t *yb_lines_take_outputs(yb_gpiod_chip_t *chip, const unsigned *numbers,
                                        const int *values, size_t count, char *error)
{
    yb_gpiod_group_t *group = yb_gpiod_take_outputs(chip, numbers, values, count);

    if (group == NULL)
        explain_group(chip, numbers, count, errno, error);
    return group;
}

yb_gpiod_group_t *yb_lines_take_inputs(yb_gpiod_chip_t *chip, const unsigned *numbers, size_t count,
                                       char *error)
{
    yb_gpiod_group_t *group = yb_gpiod_take_inputs(chip, numbers, count);

    if (group == NULL)
        explain_group(chip, numbers, count, errno, error);
    return group;
}
