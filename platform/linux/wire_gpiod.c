#include "wire.h"

#include "linux_bus.h"
#include "linux_lines.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

/* Clock and data are one group and chip select another: a bit moves two lines and not three. */
enum {
    SCK,
    MOSI,
    WIRE_LINES
};

typedef struct {
    yb_wire_t wire; /* first: a yb_wire_t is cast to this */
    const char *chip;
    yb_gpiod_group_t *data;
    yb_gpiod_group_t *select;
    int selected; /* the level */
} gpiod_wire_t;

static const int idle[WIRE_LINES] = {0, 0};

/* Mode 0: the display reads MOSI when the clock rises; the host changes it while it is low. */
static bool send_byte(yb_gpiod_group_t *data, uint8_t byte)
{
    for (unsigned bit = 0x80; bit != 0; bit >>= 1) {
        int values[WIRE_LINES] = {[SCK] = 0, [MOSI] = (byte & bit) != 0};
        if (!yb_gpiod_group_set(data, values))
            return false;
        values[SCK] = 1;
        if (!yb_gpiod_group_set(data, values))
            return false;
    }
    return true;
}

/* `error` NULL: it has its sentence already. */
static bool set_select(gpiod_wire_t *gpiod, bool selected, char *error)
{
    const int level = selected ? gpiod->selected : !gpiod->selected;

    return yb_gpiod_group_set(gpiod->select, &level) ||
           (error != NULL &&
            yb_wire_failed(gpiod->chip, "setting the chip select line", errno, error));
}

static bool send_bytes(yb_wire_t *wire, const uint8_t *bytes, size_t count, char *error)
{
    gpiod_wire_t *gpiod = (gpiod_wire_t *)wire;
    bool sent = true;

    if (!set_select(gpiod, true, error))
        return false;
    for (size_t i = 0; sent && i < count; i++)
        sent = send_byte(gpiod->data, bytes[i]);
    /* Mode 0 rests with the clock low, and it must rest before the display is deselected. */
    sent = sent && yb_gpiod_group_set(gpiod->data, idle);
    if (!sent)
        yb_wire_failed(gpiod->chip, "setting the clock and data lines", errno, error);
    /* After a failure as well, if it can be: the display then forgets the bits of half a byte. */
    return set_select(gpiod, false, sent ? error : NULL) && sent;
}

static void close_wire(yb_wire_t *wire)
{
    gpiod_wire_t *gpiod = (gpiod_wire_t *)wire;

    yb_gpiod_group_free(gpiod->data);
    yb_gpiod_group_free(gpiod->select);
    free(gpiod);
}

yb_wire_t *yb_wire_gpiod_open(yb_gpiod_chip_t *chip, unsigned sck, unsigned mosi, unsigned cs,
                              bool select_high, char *error)
{
    const unsigned data[WIRE_LINES] = {[SCK] = sck, [MOSI] = mosi};
    const int deselected = !select_high;
    gpiod_wire_t *gpiod = calloc(1, sizeof *gpiod);

    if (gpiod == NULL) {
        snprintf(error, YB_LINUX_ERROR_BYTES, "out of memory");
        return NULL;
    }
    gpiod->wire.send = send_bytes;
    gpiod->wire.close = close_wire;
    gpiod->chip = yb_gpiod_chip_name(chip);
    gpiod->selected = select_high;
    /* First of all the display must be deselected: then its clock line may move. */
    gpiod->select = yb_lines_take_outputs(chip, &cs, &deselected, 1, error);
    if (gpiod->select == NULL)
        goto free_wire;
    gpiod->data = yb_lines_take_outputs(chip, data, idle, WIRE_LINES, error);
    if (gpiod->data == NULL)
        goto free_select;
    return &gpiod->wire;

free_select:
    yb_gpiod_group_free(gpiod->select);
free_wire:
    free(gpiod);
    return NULL;
}
