/* Golden vectors: the mesh and some frames of the vectors here and of the gallery, as hashes.
 *
 *     golden EXPECTED [--pictures FOLDER] [--update] CODE ...
 *
 * A CODE is a file, .hex (digits) or .yb (bytes). EXPECTED has lines "code what hash" in the order
 * of the files. Prints every line that differs, as it should be; --update writes them all to
 * EXPECTED;
 * --pictures leaves PPMs to look at. Exits 1 if any differed.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "fnv.h"
#include "mesh_check.h"
#include "views.h"

enum {
    WIDTH = 320,
    HEIGHT = 240,
    MOST_LINES = 800
};

static yb_map_t map;
static yb_load_t load;
static yb_frame_t frame;
static uint8_t greys[WIDTH * HEIGHT / 2];
static uint8_t pixels[WIDTH * HEIGHT * 2];
static const char *pictures;

static bool load_code(const char *path)
{
    bool digits = strstr(path, ".hex") != NULL;
    FILE *file = fopen(path, digits ? "r" : "rb");
    if (file == NULL) {
        perror(path);
        return false;
    }
    uint8_t code[YB_MAX_CODE_BYTES];
    size_t count = 0;
    unsigned byte;
    if (!digits)
        count = fread(code, 1, sizeof code, file);
    while (digits && count < sizeof code && fscanf(file, "%2x", &byte) == 1)
        code[count++] = (uint8_t)byte;
    (void)fclose(file);
    yb_status_t status = yb_map_load(&map, &load, code, count);
    if (status != YB_OK)
        (void)fprintf(stderr, "%s: %s\n", path, yb_status_text(status));
    return status == YB_OK;
}

/* A code's name: its file's, without folder and ending. */
static void name_of(const char *path, char name[64])
{
    const char *slash = strrchr(path, '/');
    (void)snprintf(name, 64, "%s", slash != NULL ? slash + 1 : path);
    name[strcspn(name, ".")] = '\0';
}

/* Heights of the reference surface on a grid, with and without detail. */
static uint64_t surface_hash(void)
{
    uint64_t hash = FNV_START;
    for (int detail = 0; detail < 2; detail++) {
        map.detail = detail == 1;
        for (int y = 0; y <= 32; y++) {
            for (int x = 0; x <= 32; x++)
                hash = fnv_number(hash, yb_map_height(&map, (uint16_t)(map.east_q8 * x / 32),
                                                      (uint16_t)(map.north_q8 * y / 32)));
        }
    }
    return hash;
}

static void write_picture(const char *name, const char *what)
{
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/%s-%s.ppm", pictures, name, what);
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        return;
    const yb_screen_t *screen = &frame.screen;
    (void)fprintf(file, "P6\n%d %d\n255\n", screen->width, screen->height);
    for (size_t i = 0; i < (size_t)screen->width * screen->height; i++) {
        int red, green, blue;
        if (screen->format == YB_MONO) {
            red = green = blue = (pixels[i / 8] >> (7 - i % 8) & 1) * 255; /* widths are 8 n */
        } else if (screen->format == YB_GREY4) {
            red = green = blue = (i % 2 == 0 ? pixels[i / 2] >> 4 : pixels[i / 2] & 15) * 17;
        } else {
            int pixel = pixels[2 * i] << 8 | pixels[2 * i + 1];
            red = (pixel >> 11) * 255 / 31;
            green = (pixel >> 5 & 63) * 255 / 63;
            blue = (pixel & 31) * 255 / 31;
        }
        const uint8_t rgb[3] = {(uint8_t)red, (uint8_t)green, (uint8_t)blue};
        (void)fwrite(rgb, 1, 3, file);
    }
    (void)fclose(file);
}

static uint64_t frame_hash(int which, const yb_screen_t *screen)
{
    static uint8_t work[YB_SHADOW_WORK(GOLDEN_SHADOW_SIDE)];
    yb_view_t view;
    golden_view_set(which, &view, &map, work);
    yb_frame_begin(&frame, &map, &view, screen);
    size_t pitch = yb_screen_pitch(screen);
    yb_band_t band = {0, screen->height, pixels, pitch, greys};
    yb_frame_band(&frame, &band);
    return fnv_bytes(FNV_START, pixels, pitch * screen->height);
}

/* --- Lines ------------------------------------------------------------------------------------ */

typedef struct {
    char text[160];
} line_t;

typedef struct {
    line_t line[MOST_LINES];
    int count;
} lines_t;

static void add_line(lines_t *lines, const char *code, const char *what, uint64_t hash)
{
    if (lines->count < MOST_LINES)
        (void)snprintf(lines->line[lines->count++].text, sizeof lines->line->text,
                       "%s %s %016" PRIx64, code, what, hash);
}

static bool find_lines(const char *path, lines_t *lines)
{
    static const yb_screen_t screens[2] = {{128, 64, YB_GREY4}, {WIDTH, HEIGHT, YB_RGB565}};
    char code[64];
    if (!load_code(path))
        return false;
    name_of(path, code);
    add_line(lines, code, "mesh", mesh_hash(&map));
    add_line(lines, code, "surface", surface_hash());
    for (int k = 0; k < 2 * GOLDEN_VIEWS; k++) {
        char what[40];
        yb_screen_t screen = screens[k % 2];
        screen.format = golden_view_format(k / 2, screen.format);
        (void)snprintf(what, sizeof what, "%s-%dx%d", golden_view_name(k / 2), screen.width,
                       screen.height);
        add_line(lines, code, what, frame_hash(k / 2, &screen));
        if (pictures != NULL)
            write_picture(code, what);
    }
    return true;
}

static int compare(const char *path, const lines_t *lines)
{
    FILE *file = fopen(path, "r");
    int wrong = 0;
    char text[160];
    for (int i = 0; i < lines->count; i++) {
        bool have = file != NULL && fgets(text, sizeof text, file) != NULL;
        text[have ? strcspn(text, "\n") : 0] = '\0';
        if (strcmp(text, lines->line[i].text) != 0) {
            printf("expected: %s\nfound:    %s\n", text, lines->line[i].text);
            wrong++;
        }
    }
    if (file != NULL)
        (void)fclose(file);
    printf("%d of %d golden lines differ\n", wrong, lines->count);
    return wrong == 0 ? 0 : 1;
}

static int update(const char *path, const lines_t *lines)
{
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        perror(path);
        return 1;
    }
    for (int i = 0; i < lines->count; i++)
        (void)fprintf(file, "%s\n", lines->line[i].text);
    return fclose(file) == 0 ? 0 : 1;
}

int main(int argc, char **argv)
{
    static lines_t lines;
    bool write = false;
    if (argc < 3) {
        (void)fprintf(stderr, "usage: golden EXPECTED [--pictures FOLDER] [--update] CODE ...\n");
        return 2;
    }
    for (int i = 2; i < argc; i++) {
        if (strcmp(argv[i], "--update") == 0)
            write = true;
        else if (strcmp(argv[i], "--pictures") == 0 && i + 1 < argc)
            pictures = argv[++i];
        else if (!find_lines(argv[i], &lines))
            return 1;
    }
    return write ? update(argv[1], &lines) : compare(argv[1], &lines);
}
