/* Frames per second on this machine, one core: turns each map round once.
 *
 *     host_frames WIDTHxHEIGHT EDGE_Q4 MAP.yb ...
 *
 * prints the mean time of a frame over the maps, in microseconds, and the mean number of triangles
 * drawn.
 */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <yamabiko/yamabiko.h>

enum {
    FRAMES = 24 /* round a map */
};

static yb_map_t map;
static yb_load_t load;
static yb_frame_t frame;

static bool load_map(const char *path)
{
    uint8_t code[YB_MAX_CODE_BYTES];
    FILE *file = fopen(path, "rb");
    size_t count = file != NULL ? fread(code, 1, sizeof code, file) : 0;
    if (file != NULL)
        (void)fclose(file);
    if (count > 0 && yb_map_load(&map, &load, code, count) == YB_OK)
        return true;
    (void)fprintf(stderr, "host_frames: %s is no map\n", path);
    return false;
}

static double now_us(void)
{
    struct timespec time;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec * 1e6 + (double)time.tv_nsec / 1e3;
}

int main(int argc, char **argv)
{
    unsigned width = 0;
    unsigned height = 0;
    if (argc < 4 || sscanf(argv[1], "%ux%u", &width, &height) != 2 || width > YB_MAX_SIDE ||
        height > YB_MAX_SIDE) {
        (void)fputs("usage: host_frames WIDTHxHEIGHT EDGE_Q4 MAP.yb ...\n", stderr);
        return 2;
    }
    const yb_screen_t screen = {(uint16_t)width, (uint16_t)height, YB_RGB565};
    const size_t pitch = yb_screen_pitch(&screen);
    uint8_t *pixels = malloc(pitch * height);
    double drawn = 0;
    double spent_us = 0;
    bool good = pixels != NULL;
    for (int i = 3; good && i < argc; i++) {
        good = load_map(argv[i]);
        for (unsigned k = 0; good && k < FRAMES; k++) {
            yb_view_t view;
            yb_view_init(&view, &map);
            view.edge_q4 = (uint16_t)strtoul(argv[2], NULL, 10);
            yb_view_orbit(&view, &map, (uint16_t)(65536 / FRAMES * k), YB_DEGREES(30), 307);
            const yb_band_t band = {0, screen.height, pixels, pitch, NULL};
            const double before = now_us();
            yb_frame_begin(&frame, &map, &view, &screen);
            yb_frame_band(&frame, &band);
            spent_us += now_us() - before;
            drawn += frame.stats.drawn;
        }
    }
    if (good)
        printf("%.0f %.0f\n", spent_us / (FRAMES * (argc - 3)), drawn / (FRAMES * (argc - 3)));
    free(pixels);
    return good ? 0 : 1;
}
