/* Meshes and frames by their hashes: one line each, to be held against golden.txt.
 *
 *     golden [-p FOLDER] MAP.yb ...      -p: write each frame there as a picture (PPM), to look at
 *
 * Plain C and the engine alone, so that any compiler can build it: compilers.py tries several.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "fnv.h"
#include "standard_views.h"

static yb_map_t map;
static yb_load_t load;
static yb_frame_t frame;
static uint16_t depth[320 * 240];
static uint8_t pixels[320 * 240 * 2];

/* The name of a map: its file's, without folder and ending. */
static void name_of(const char *path, char name[64])
{
    const char *slash = strrchr(path, '/');
    snprintf(name, 64, "%s", slash != NULL ? slash + 1 : path);
    char *dot = strrchr(name, '.');
    if (dot != NULL)
        *dot = '\0';
}

/* Independent of the order of triangles, and of the corner that each begins with. */
static uint64_t mesh_hash(void)
{
    uint64_t hash = FNV_START;
    for (int i = 0; i < map.vertex_count; i++) {
        const yb_vertex_t *v = &map.vertex[i];
        const int64_t part[] = {v->x_q8, v->y_q8, v->z_q8, v->gx_q11, v->gy_q11};
        for (int k = 0; k < 5; k++)
            hash = fnv_number(hash, part[k]);
    }
    uint64_t sum = 0;
    for (int t = 0; t < map.triangle_count; t++) {
        const yb_index_t *c = map.triangle[t];
        int least = c[0] < c[1] ? (c[0] < c[2] ? 0 : 2) : (c[1] < c[2] ? 1 : 2);
        uint64_t one = FNV_START;
        for (int k = 0; k < 3; k++)
            one = fnv_number(one, c[(least + k) % 3]);
        sum += one;
    }
    hash = fnv_number(hash, (int64_t)(sum >> 1));
    for (int c = 0; c < YB_LENGTH_CLASSES; c++)
        hash = fnv_number(hash, map.noise[c]);
    return hash;
}

static uint64_t surface_hash(void)
{
    uint64_t hash = FNV_START;
    for (int y = 0; y <= map.north_q8; y += 2048) {
        for (int x = 0; x <= map.east_q8; x += 2048)
            hash = fnv_number(hash, yb_map_height(&map, (uint16_t)x, (uint16_t)y));
    }
    return hash;
}

static void write_picture(const char *folder, const char *name, const char *view,
                          const yb_screen_t *screen)
{
    char path[400];
    snprintf(path, sizeof path, "%s/%s-%s-%d.ppm", folder, name, view, screen->width);
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        return;
    fprintf(file, "P6 %d %d 255\n", screen->width, screen->height);
    for (int i = 0; i < screen->width * screen->height; i++) {
        if (screen->format == YB_RGB565) {
            int pixel = pixels[2 * i] << 8 | pixels[2 * i + 1];
            fputc((pixel >> 11) * 255 / 31, file);
            fputc((pixel >> 5 & 63) * 255 / 63, file);
            fputc((pixel & 31) * 255 / 31, file);
        } else {
            int grey = (i % 2 == 0 ? pixels[i / 2] >> 4 : pixels[i / 2] & 15) * 17;
            for (int k = 0; k < 3; k++)
                fputc(grey, file);
        }
    }
    fclose(file);
}

static void draw(const char *folder, const char *name, int which, const yb_screen_t *screen,
                 int band_rows)
{
    yb_view_t view;
    size_t pitch = yb_screen_pitch(screen);
    yb_view_init(&view, &map);
    if (which % 3 == 2)
        view.water_q8 = map.low_q8 + (map.high_q8 - map.low_q8) / 5;
    yb_standard_view_set(&view, &map, (yb_standard_view_t)which);
    yb_frame_begin(&frame, &map, &view, screen);
    for (int y = 0; y < screen->height; y += band_rows) {
        const yb_band_t band = {.y = (uint16_t)y,
                                .rows = (uint16_t)band_rows,
                                .depth = depth,
                                .pixels = pixels + (size_t)y * pitch,
                                .pitch = pitch};
        yb_frame_band(&frame, &band);
    }
    const char *view_name = yb_standard_view_name(which);
    uint64_t hash = fnv_bytes(FNV_START, pixels, pitch * screen->height);
    printf("frame %s %s %dx%d %016llx\n", name, view_name, screen->width, screen->height,
           (unsigned long long)hash);
    if (folder != NULL)
        write_picture(folder, name, view_name, screen);
}

static int do_map(const char *folder, const char *path)
{
    static uint8_t bytes[YB_MAX_CODE_BYTES + 1];
    char name[64];
    FILE *file = fopen(path, "rb");
    size_t size = file != NULL ? fread(bytes, 1, sizeof bytes, file) : 0;
    if (file != NULL)
        fclose(file);
    if (yb_map_load(&map, &load, bytes, size) != YB_OK) {
        fprintf(stderr, "golden: %s is no code\n", path);
        return 1;
    }
    name_of(path, name);
    printf("mesh %s %016llx\n", name, (unsigned long long)mesh_hash());
    printf("surface %s %016llx\n", name, (unsigned long long)surface_hash());
    const yb_screen_t small = {.width = 128, .height = 64, .format = YB_GREY4};
    const yb_screen_t large = {.width = 320, .height = 240, .format = YB_RGB565};
    for (int which = 0; yb_standard_view_name(which) != NULL; which++) {
        draw(folder, name, which, &small, 8);
        if (which % 4 == 0)
            draw(folder, name, which, &large, 240);
    }
    return 0;
}

int main(int argc, char **argv)
{
    const char *folder = argc > 2 && strcmp(argv[1], "-p") == 0 ? argv[2] : NULL;
    for (int i = folder != NULL ? 3 : 1; i < argc; i++) {
        if (do_map(folder, argv[i]) != 0)
            return 1;
    }
    return 0;
}
