/* check_wire [--follow PID] [--select-high] [--turn 90|180|270]
 *            PANEL TRACING BASE SCK MOSI CS DC RESET EXPECTED PICTURE
 *
 * Turns the trace of a panel's GPIO lines (numbers from BASE, "-" for one that is not wired) back
 * into bytes with their D/C, hands them to the model of PANEL, and compares its picture with the
 * file EXPECTED: a PNG, or for displays of 16 greys two pixels a byte, high nibble left. EXPECTED
 * may be turned clockwise on the glass. PICTURE gets what the glass shows as PPM, to look at.
 * Anything that a display could take amiss is an error: data that move while the clock is high, a
 * byte cut short, bytes while the display is not selected. --follow reads the trace while the
 * process PID makes it, until that has ended. */
#include "gpio_trace.h"
#include "panel_model.h"

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
    long number[LINES]; /* -1: not wired */
    int level[LINES];
    int selected;  /* the level of chip select while it is active */
    unsigned bits; /* of the byte that is on its way */
    uint8_t byte;
    unsigned long sets[LINES];
    unsigned long transfers;
    unsigned long bytes;
    yb_panel_model_t *model;
    const char *wrong;
} wire_t;

static bool refuse(wire_t *wire, const char *why)
{
    wire->wrong = why;
    return false;
}

static bool clock_rises(wire_t *wire)
{
    if (wire->level[CS] != wire->selected)
        return refuse(wire, "the clock rose while the display was not selected");
    if (wire->level[RESET] == 0)
        return refuse(wire, "the clock rose while the display was held in reset");
    wire->byte = (uint8_t)(wire->byte << 1 | wire->level[MOSI]);
    if (++wire->bits < 8)
        return true;
    wire->bits = 0;
    wire->bytes++;
    if (!yb_panel_model_byte(wire->model, wire->level[DC] != 0, wire->byte))
        return refuse(wire, yb_panel_model_error(wire->model));
    return true;
}

static bool line_set(void *context, unsigned number, int value)
{
    wire_t *wire = context;
    int line = 0;

    while (line < LINES && wire->number[line] != (long)number)
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
            yb_panel_model_reset(wire->model);
        return true;
    case CS:
        wire->transfers += value == wire->selected;
        break;
    default:
        break;
    }
    if (wire->level[SCK] != 0)
        return refuse(wire, "a line other than the clock moved while the clock was high");
    if (line != MOSI && wire->bits != 0)
        return refuse(wire, "chip select or D/C moved in the middle of a byte");
    if (line == CS && !yb_panel_model_select(wire->model, value == wire->selected))
        return refuse(wire, yb_panel_model_error(wire->model));
    return true;
}

static void write_ppm(const char *path, const yb_model_picture_t *picture)
{
    const size_t pixels = (size_t)picture->width * picture->height;
    FILE *file = fopen(path, "wb");

    if (file == NULL) {
        perror(path);
        return;
    }
    fprintf(file, "P6 %u %u 255\n", picture->width, picture->height);
    (void)fwrite(picture->rgb, 3, pixels, file);
    fclose(file);
}

/* RGB of a file with two pixels of 16 greys a byte; the caller's to free, NULL: it cannot be had.
 */
static uint8_t *read_raw(const char *path, unsigned width, unsigned height)
{
    const size_t bytes = (size_t)width * height / 2;
    uint8_t *rgb = malloc(bytes * 6);
    FILE *file = fopen(path, "rb");

    if (rgb == NULL || file == NULL) {
        perror(path);
    } else {
        int byte = 0;
        size_t got = 0;
        while ((byte = getc(file)) != EOF && got < bytes) {
            memset(rgb + 6 * got, 17 * (byte >> 4), 3);
            memset(rgb + 6 * got++ + 3, 17 * (byte & 15), 3);
        }
        if (got == bytes && byte == EOF) {
            fclose(file);
            return rgb;
        }
        fprintf(stderr, "%s: a frame has %zu bytes, and this has not\n", path, bytes);
    }
    if (file != NULL)
        fclose(file);
    free(rgb);
    return NULL;
}

static uint8_t *read_png(const char *path, unsigned width, unsigned height)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    uint8_t *rgb = NULL;

    if (!png_image_begin_read_from_file(&image, path)) {
        fprintf(stderr, "%s: %s\n", path, image.message);
        return NULL;
    }
    image.format = PNG_FORMAT_RGB;
    if (image.width != width || image.height != height) {
        fprintf(stderr, "%s: %u x %u is not the panel's size\n", path, image.width, image.height);
        png_image_free(&image);
        return NULL;
    }
    rgb = malloc(PNG_IMAGE_SIZE(image));
    if (rgb == NULL || !png_image_finish_read(&image, NULL, rgb, 0, NULL)) {
        fprintf(stderr, "%s: %s\n", path, image.message);
        png_image_free(&image);
        free(rgb);
        return NULL;
    }
    return rgb;
}

/* The pixel of the glass that shows x, y of a picture turned clockwise on it. */
static const uint8_t *shown_at(const yb_model_picture_t *picture, unsigned turn, unsigned x,
                               unsigned y)
{
    const unsigned right = picture->width - 1U;
    const unsigned bottom = picture->height - 1U;
    const unsigned at[4][2] = {{x, y}, {right - y, x}, {right - x, bottom - y}, {y, bottom - x}};
    const unsigned *place = at[turn / 90];

    return picture->rgb + 3 * ((size_t)place[1] * picture->width + place[0]);
}

static bool same_as_file(const char *path, const yb_model_picture_t *picture, unsigned turn)
{
    const bool aside = turn % 180 != 0;
    const unsigned width = aside ? picture->height : picture->width;
    const unsigned height = aside ? picture->width : picture->height;
    const char *ending = strrchr(path, '.');
    const bool is_png = ending != NULL && strcmp(ending, ".png") == 0;
    unsigned different = 0;

    uint8_t *expected = is_png ? read_png(path, width, height) : read_raw(path, width, height);
    if (expected == NULL)
        return false;
    for (unsigned y = 0; y < height; y++) {
        for (unsigned x = 0; x < width; x++)
            different += memcmp(expected + 3 * ((size_t)y * width + x),
                                shown_at(picture, turn, x, y), 3) != 0;
    }
    free(expected);
    if (different != 0)
        fprintf(stderr, "the panel shows another picture: %u of %u pixels differ\n", different,
                width * height);
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

static long line_number(const char *base, const char *line)
{
    return strcmp(line, "-") == 0 ? -1 : strtol(base, NULL, 10) + strtol(line, NULL, 10);
}

static int check(wire_t *wire, char **argv, long drawer, unsigned turn)
{
    yb_model_picture_t picture;

    for (int line = 0; line < LINES; line++)
        wire->number[line] = line_number(argv[2], argv[3 + line]);
    if (!yb_gpio_trace_follow(argv[1], drawer, line_set, wire)) {
        fprintf(stderr, "after %lu bytes: %s\n", wire->bytes,
                wire->wrong != NULL ? wire->wrong : "the trace ended");
        return 1;
    }
    if (wire->bits != 0 || wire->level[CS] == wire->selected) {
        fputs("the last transfer was cut short\n", stderr);
        return 1;
    }
    printf("%lu bytes in %lu transfers; the clock line was set %lu times\n", wire->bytes,
           wire->transfers, wire->sets[SCK]);
    if (!yb_panel_model_picture(wire->model, &picture)) {
        fprintf(stderr, "the panel shows nothing: %s\n", yb_panel_model_error(wire->model));
        return 1;
    }
    write_ppm(argv[9], &picture);
    if (!few_enough_calls(wire) || !same_as_file(argv[8], &picture, turn))
        return 1;
    puts("the panel shows the frame, bit for bit");
    return 0;
}

int main(int argc, char **argv)
{
    static wire_t wire = {.level = {0, 0, 1, 0, 1}};
    long drawer = 0;
    unsigned long turn = 0;
    int first = 1;

    if (first + 1 < argc && strcmp(argv[first], "--follow") == 0) {
        drawer = strtol(argv[first + 1], NULL, 10);
        first += 2;
    }
    if (first < argc && strcmp(argv[first], "--select-high") == 0) {
        wire.selected = 1;
        wire.level[CS] = 0;
        first++;
    }
    if (first + 1 < argc && strcmp(argv[first], "--turn") == 0) {
        turn = strtoul(argv[first + 1], NULL, 10);
        first += 2;
    }
    if (argc - first != 10 || turn % 90 != 0 || turn > 270) {
        fputs("check_wire [--follow PID] [--select-high] [--turn 90|180|270] PANEL TRACING BASE "
              "SCK MOSI CS DC RESET EXPECTED PICTURE\n",
              stderr);
        return 2;
    }
    wire.model = yb_panel_model_new(argv[first]);
    if (wire.model == NULL) {
        fprintf(stderr, "%s: there is no model of that panel\n", argv[first]);
        return 2;
    }
    const int result = check(&wire, argv + first, drawer, (unsigned)turn);
    yb_panel_model_free(wire.model);
    return result;
}
