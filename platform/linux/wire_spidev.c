#define _DEFAULT_SOURCE /* flock, major, minor */

#include "wire.h"

#include "linux_bus.h"
#include "linux_lines.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

enum {
    BUFSIZ_DEFAULT = 4096, /* spidev's, where the kernel does not tell */
};

typedef struct {
    yb_wire_t wire; /* first: a yb_wire_t is cast to this */
    char *path;
    int fd;
    uint32_t hz;
    size_t most; /* bytes that the kernel takes at once */
    bool whole;
} spidev_wire_t;

static size_t most_at_once(void)
{
    unsigned long most = 0;
    FILE *file = fopen("/sys/module/spidev/parameters/bufsiz", "r");

    if (file != NULL) {
        char text[32];
        if (fgets(text, sizeof text, file) != NULL)
            most = strtoul(text, NULL, 10);
        fclose(file);
    }
    return most != 0 ? most : BUFSIZ_DEFAULT;
}

/* ---- Sending --------------------------------------------------------------------------------- */

static bool send_some(spidev_wire_t *spidev, const uint8_t *bytes, size_t count, char *error)
{
    const struct spi_ioc_transfer transfer = {
        .tx_buf = (uintptr_t)bytes,
        .len = (uint32_t)count,
        .speed_hz = spidev->hz,
        .bits_per_word = 8,
    };
    int sent;

    /* Interrupted means that nothing was sent: once begun, the kernel ends a transfer. */
    do
        sent = ioctl(spidev->fd, SPI_IOC_MESSAGE(1), &transfer);
    while (sent < 0 && errno == EINTR);
    if (sent < 0)
        return yb_wire_failed(spidev->path, "a transfer", errno, error);
    if ((size_t)sent != count) {
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "the display could not be reached: %s sent %d of %zu bytes", spidev->path, sent,
                 count);
        return false;
    }
    return true;
}

static bool send_bytes(yb_wire_t *wire, const uint8_t *bytes, size_t count, char *error)
{
    spidev_wire_t *spidev = (spidev_wire_t *)wire;

    if (spidev->whole && count > spidev->most) {
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "the display wants %zu bytes at a stretch, and spidev sends %zu: raise its "
                 "parameter bufsiz",
                 count, spidev->most);
        return false;
    }
    while (count > 0) {
        const size_t some = count < spidev->most ? count : spidev->most;
        if (!send_some(spidev, bytes, some, error))
            return false;
        bytes += some;
        count -= some;
    }
    return true;
}

static void close_wire(yb_wire_t *wire)
{
    spidev_wire_t *spidev = (spidev_wire_t *)wire;

    close(spidev->fd);
    free(spidev->path);
    free(spidev);
}

/* ---- Opening --------------------------------------------------------------------------------- */

static bool explain_open(const char *path, int why, char *error)
{
    switch (why) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
        snprintf(error, YB_LINUX_ERROR_BYTES,
                 "there is no SPI device %s; the machine's device tree must have its SPI switched "
                 "on (Raspberry Pi: dtparam=spi=on)",
                 path);
        break;
    case EACCES:
    case EPERM:
        yb_lines_no_permission(path, error);
        break;
    case EWOULDBLOCK:
        snprintf(error, YB_LINUX_ERROR_BYTES, "%s is busy: another program draws through it", path);
        break;
    case ENOTTY:
        snprintf(error, YB_LINUX_ERROR_BYTES, "%s is not an SPI device", path);
        break;
    default:
        snprintf(error, YB_LINUX_ERROR_BYTES, "%s cannot be opened: %s", path, strerror(why));
        break;
    }
    return false;
}

/* Whether the device tree says that a high level selects. */
static bool tree_says_high(int fd)
{
    char path[80];
    struct stat device;

    if (fstat(fd, &device) != 0)
        return false;
    snprintf(path, sizeof path, "/sys/dev/char/%u:%u/device/of_node/spi-cs-high",
             major(device.st_rdev), minor(device.st_rdev));
    return access(path, F_OK) == 0;
}

/* Where chip select is a GPIO line to the kernel, its level is the device tree's affair: spidev
 * then takes the wish for a high one, does not follow it, and reads back without. */
static bool level_is_fixed(int fd)
{
    uint8_t mode = SPI_MODE_0 | SPI_CS_HIGH;

    return ioctl(fd, SPI_IOC_WR_MODE, &mode) == 0 && ioctl(fd, SPI_IOC_RD_MODE, &mode) == 0 &&
           (mode & SPI_CS_HIGH) == 0;
}

static bool set_up(const spidev_wire_t *spidev, bool select_high, char *error)
{
    const bool high = tree_says_high(spidev->fd);
    const uint8_t mode = SPI_MODE_0 | (select_high ? SPI_CS_HIGH : 0);
    const uint8_t bits = 8;

    if (high != select_high && level_is_fixed(spidev->fd)) {
        snprintf(
            error, YB_LINUX_ERROR_BYTES,
            "%s selects with a %s level and the display wants a %s one; its node in the device "
            "tree must be %s spi-cs-high",
            spidev->path, high ? "high" : "low", select_high ? "high" : "low",
            select_high ? "given" : "rid of");
        return false;
    }
    if (ioctl(spidev->fd, SPI_IOC_WR_MODE, &mode) != 0) {
        if (errno == ENOTTY)
            return explain_open(spidev->path, ENOTTY, error);
        snprintf(error, YB_LINUX_ERROR_BYTES, "%s refuses SPI mode 0%s: %s", spidev->path,
                 select_high ? " with a high chip select" : "", strerror(errno));
        return false;
    }
    if (ioctl(spidev->fd, SPI_IOC_WR_BITS_PER_WORD, &bits) != 0) {
        snprintf(error, YB_LINUX_ERROR_BYTES, "%s refuses bytes of 8 bits: %s", spidev->path,
                 strerror(errno));
        return false;
    }
    if (ioctl(spidev->fd, SPI_IOC_WR_MAX_SPEED_HZ, &spidev->hz) != 0) {
        snprintf(error, YB_LINUX_ERROR_BYTES, "%s refuses a clock of %lu Hz: %s", spidev->path,
                 (unsigned long)spidev->hz, strerror(errno));
        return false;
    }
    return true;
}

yb_wire_t *yb_wire_spidev_open(const char *path, uint32_t hz, bool select_high, bool whole,
                               char *error)
{
    spidev_wire_t *spidev = calloc(1, sizeof *spidev);

    if (spidev == NULL || (spidev->path = strdup(path)) == NULL) {
        snprintf(error, YB_LINUX_ERROR_BYTES, "out of memory");
        goto free_wire;
    }
    spidev->wire.send = send_bytes;
    spidev->wire.close = close_wire;
    spidev->hz = hz;
    spidev->most = most_at_once();
    spidev->whole = whole;
    spidev->fd = open(path, O_RDWR | O_CLOEXEC);
    /* spidev lets any number of programs in; a lock keeps those of this kind apart. */
    if (spidev->fd < 0) {
        explain_open(path, errno, error);
        goto free_wire;
    }
    if (flock(spidev->fd, LOCK_EX | LOCK_NB) != 0) {
        explain_open(path, errno, error);
        goto close_device;
    }
    if (!set_up(spidev, select_high, error))
        goto close_device;
    return &spidev->wire;

close_device:
    close(spidev->fd);
free_wire:
    if (spidev != NULL)
        free(spidev->path);
    free(spidev);
    return NULL;
}
