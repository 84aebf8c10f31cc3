/* check_wire TRACING BASE SCK MOSI CS DC RESET EXPECTED PICTURE
 *
 * Turns the trace of a panel's GPIO lines (numbers from BASE) back into bytes with their D/C, hands
 * them to the model of the SSD0323, and compares its picture with the file EXPECTED: two pixels a
 * byte, high nibble left, or a PNG whose greys are 17 times the levels. PICTURE gets it as PGM, to
 * look at. Anything that a display could take amiss is an error: data that move while the clock is
 * high, a byte cut short, bytes while the display is not selected. */
#include "gpio_trace.h"
#include "ssd0323_model.h"

#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SCK,
    MOSI,
    CS,
    DC,
    RESET,
    LINES
};

typedef struct {
    unsigned number[LINES];
    int level[LINES];
    unsigned bits; /* of the byte that is on its way */
    uint8_t byte;
    unsigned long sets[LINES];
    unsigned long transfers;
    unsigned long bytes;
    yb_ssd0323_model_t model;
    const char *wrong;
} wire_t;

static bool refuse(wire_t *wire, const char *why)
{
    wire->wrong = why;
    return false;
}

static bool clock_rises(wire_t *wire)
{
    if (wire->level[CS] != 0)
        return refuse(wire, "the clock rose while the display was not selected");
    if (wire->level[RESET] == 0)
        return refuse(wire, "the clock rose while the display was held in reset");
    wire->byte = (uint8_t)(wire->byte << 1 | wire->level[MOSI]);
    if (++wire->bits < 8)
        return true;
    wire->bits = 0;
    wire->bytes++;
    if (!yb_ssd0323_model_byte(&wire->model, wire->level[DC] != 0, wire->byte))
        return refuse(wire, wire->model.error);
    return true;
}

static bool line_set(void *context, unsigned number, int value)
{
    wire_t *wire = context;
    int line = 0;

    while (line < LINES && wire->number[line] != number)
        line++;
    if (line == LINES)
        return true;
    wire->sets[line]++;
    if (wire->level[line] == value)
        return true;
    wire->level[line] = value;
    switch (line) {
    case SCK:
        return value == 0 || clock_rises(wire);
    case RESET:
        if (value == 0)
            yb_ssd0323_model_reset(&wire->model);
        return true;
    case CS:
        wire->transfers += value == 0;
        break;
    default:
        break;
    }
    if (wire->level[SCK] != 0)
        return refuse(wire, "a line other than the clock moved while the clock was high");
    if (line != MOSI && wire->bits != 0)
        return refuse(wire, "chip select or D/C moved in the middle of a byte");
    return true;
}

static void write_pgm(const char *path, const uint8_t *picture)
{
    FILE *file = fopen(path, "wb");

    if (file == NULL) {
        perror(path);
        return;
    }
    fprintf(file, "P5 %d %d 15\n", YB_SSD0323_WIDTH, YB_SSD0323_HEIGHT);
    for (int i = 0; i < YB_SSD0323_PICTURE_BYTES; i++) {
        putc(picture[i] >> 4, file);
        putc(picture[i] & 15, file);
    }
    fclose(file);
}

static bool read_raw(const char *path, uint8_t expected[YB_SSD0323_PICTURE_BYTES])
{
    uint8_t one_more;
    FILE *file = fopen(path, "rb");

    if (file == NULL) {
        perror(path);
        return false;
    }
    const size_t got = fread(expected, 1, YB_SSD0323_PICTURE_BYTES, file);
    const bool is_frame = got == YB_SSD0323_PICTURE_BYTES && fread(&one_more, 1, 1, file) == 0;
    fclose(file);
    if (!is_frame)
        fprintf(stderr, "%s: a frame has %d bytes, and this has not\n", path,
                YB_SSD0323_PICTURE_BYTES);
    return is_frame;
}

static bool read_png(const char *path, uint8_t expected[YB_SSD0323_PICTURE_BYTES])
{
    static uint8_t grey[YB_SSD0323_WIDTH * YB_SSD0323_HEIGHT];
    png_image image = {.version = PNG_IMAGE_VERSION};

    if (!png_image_begin_read_from_file(&image, path)) {
        fprintf(stderr, "%s: %s\n", path, image.message);
        return false;
    }
    image.format = PNG_FORMAT_GRAY;
    if (image.width != YB_SSD0323_WIDTH || image.height != YB_SSD0323_HEIGHT) {
        fprintf(stderr, "%s: %u x %u is not the panel's size\n", path, image.width, image.height);
        png_image_free(&image);
        return false;
    }
    if (!png_image_finish_read(&image, NULL, grey, 0, NULL)) {
        fprintf(stderr, "%s: %s\n", path, image.message);
        return false;
    }
    for (size_t i = 0; i < YB_SSD0323_PICTURE_BYTES; i++) {
        if (grey[2 * i] % 17 != 0 || grey[2 * i + 1] % 17 != 0) {
            fprintf(stderr, "%s: has greys that the panel has not\n", path);
            return false;
        }
        expected[i] = (uint8_t)(grey[2 * i] / 17 << 4 | grey[2 * i + 1] / 17);
    }
    return true;
}

static bool same_as_file(const char *path, const uint8_t *picture)
{
    uint8_t expected[YB_SSD0323_PICTURE_BYTES];
    const char *ending = strrchr(path, '.');
    const bool is_png = ending != NULL && strcmp(ending, ".png") == 0;
    int different = 0;

    if (!(is_png ? read_png(path, expected) : read_raw(path, expected)))
        return false;
    for (int i = 0; i < YB_SSD0323_PICTURE_BYTES; i++)
        different += picture[i] != expected[i];
    if (different != 0)
        fprintf(stderr, "the panel shows another picture: %d of %d bytes differ\n", different,
                YB_SSD0323_PICTURE_BYTES);
    return different == 0;
}

/* Two system calls a bit, and for each transfer one that lets the clock rest. */
static bool few_enough_calls(const wire_t *wire)
{
    const unsigned long most = 16 * wire->bytes + wire->transfers + LINES;

    if (wire->sets[SCK] > most) {
        fprintf(stderr, "the clock line was set %lu times; %lu would do\n", wire->sets[SCK], most);
        return false;
    }
    return true;
}

int main(int argc, char **argv)
{
    static wire_t wire = {.level = {0, 0, 1, 0, 1}};
    uint8_t picture[YB_SSD0323_PICTURE_BYTES];

    if (argc != 10) {
        fputs("check_wire TRACING BASE SCK MOSI CS DC RESET EXPECTED PICTURE\n", stderr);
        return 2;
    }
    for (int line = 0; line < LINES; line++)
        wire.number[line] =
            (unsigned)(strtoul(argv[2], NULL, 10) + strtoul(argv[3 + line], NULL, 10));
    yb_ssd0323_model_reset(&wire.model);
    if (!yb_gpio_trace_read(argv[1], line_set, &wire)) {
        fprintf(stderr, "after %lu bytes: %s\n", wire.bytes,
                wire.wrong != NULL ? wire.wrong : "the trace ended");
        return 1;
    }
    if (wire.bits != 0 || wire.level[CS] != 1) {
        fputs("the last transfer was cut short\n", stderr);
        return 1;
    }
    printf("%lu bytes in %lu transfers; the clock line was set %lu times\n", wire.bytes,
           wire.transfers, wire.sets[SCK]);
    if (!yb_ssd0323_model_picture(&wire.model, picture)) {
        fprintf(stderr, "the panel shows nothing: %s\n", wire.model.error);
        return 1;
    }
    write_pgm(argv[9], picture);
    if (!few_enough_calls(&wire) || !same_as_file(argv[8], picture))
        return 1;
    puts("the panel shows the frame, bit for bit");
    return 0;
}
