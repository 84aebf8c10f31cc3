/* ascii MAP.yb: a mountain in characters. All that a program needs to draw with Yamabiko. */
#include <stdio.h>

#include <yamabiko/yamabiko.h>

enum {
    WIDTH = 76,
    HEIGHT = 38,
    PITCH = WIDTH / 2
};

static yb_map_t map;
static union {
    yb_load_t load;
    yb_frame_t frame;
} work;
static uint8_t pixels[PITCH * HEIGHT];

int main(int argc, char **argv)
{
    static uint8_t code[YB_MAX_CODE_BYTES + 1];
    FILE *file = argc == 2 ? fopen(argv[1], "rb") : NULL;
    const size_t bytes = file != NULL ? fread(code, 1, sizeof(code), file) : 0;
    const yb_status_t status = yb_map_load(&map, &work.load, code, bytes);
    if (status != YB_OK) {
        fprintf(stderr, "usage: ascii MAP.yb (%s)\n", yb_status_text(status));
        return 1;
    }

    const yb_screen_t screen = {.width = WIDTH, .height = HEIGHT, .format = YB_GREY4};
    const yb_band_t all = {.rows = HEIGHT, .pixels = pixels, .pitch = PITCH};
    yb_view_t view;
    yb_view_init(&view, &map);
    yb_view_orbit(&view, &map, YB_DEGREES(45), YB_DEGREES(30), 307);
    yb_frame_begin(&work.frame, &map, &view, &screen);
    yb_frame_band(&work.frame, &all);

    /* A character is twice as high as it is wide: every other row will do. */
    for (int y = 0; y < HEIGHT; y += 2) {
        for (int x = 0; x < WIDTH; x++) {
            const uint8_t pair = pixels[y * PITCH + x / 2];
            putchar(" ..::--==++**##@"[x % 2 == 0 ? pair >> 4 : pair & 15]);
        }
        putchar('\n');
    }
    return 0;
}
