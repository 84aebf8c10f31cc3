/* Fuzzing of the decoder and of what is drawn from its maps.
 *
 * Input: one byte that says in which pieces the code is fed, one that chooses the view, the code.
 * Its last byte is replaced by the right check, or nothing would ever come past it. Built as a fuzz
 * target with libFuzzer, else with a main that runs the files it is given.
 */
#include <stdlib.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

#include "maps.h"
#include "mesh_check.h"
#include "plan.h"

enum {
    MOST = 1400,
    WIDTH = 48,
    HEIGHT = 32
};

static yb_map_t map;
static yb_load_t load;
static yb_frame_t frame;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static yb_status_t feed(const uint8_t *code, size_t count, unsigned piece)
{
    yb_status_t status = YB_MORE;
    yb_map_begin(&map, &load);
    for (size_t at = 0; at < count && status >= 0; at += piece) {
        size_t rest = count - at;
        status = yb_map_feed(&map, &load, code + at, rest < piece ? rest : piece);
    }
    yb_status_t end = yb_map_end(&map, &load);
    if (end == YB_MORE || (status != YB_MORE && end != status))
        abort();
    return end;
}

static void check_mesh(void)
{
    plan_t bare;
    plan_init(&bare, 255, 255);
    if (mesh_check_tiling(&map, &bare) != NULL)
        abort();
}

static void draw(uint8_t choice)
{
    static uint8_t greys[WIDTH * HEIGHT / 2];
    static uint8_t pixels[WIDTH * HEIGHT * 2];
    static uint8_t again[WIDTH * HEIGHT * 2];
    static const yb_format_t formats[4] = {YB_RGB565, YB_GREY4, YB_MONO, YB_GREY4};
    yb_screen_t screen = {WIDTH, HEIGHT, formats[(choice & 1) | (choice >> 2 & 2)]};
    yb_view_t view;
    yb_view_init(&view, &map);
    view.max_leaves = 2000;
    yb_view_orbit(&view, &map, (uint16_t)(choice << 10), YB_DEGREES(35),
                  (uint16_t)(80 + 4 * choice));
    if ((choice & 2) != 0)
        view.water_q8 = (map.low_q8 + map.high_q8) / 2;
    if ((choice & 4) != 0) {
        uint16_t x = (uint16_t)(map.east_q8 / 3);
        uint16_t y = (uint16_t)(map.north_q8 / 5);
        view.eye_q8[0] = x;
        view.eye_q8[1] = y;
        view.eye_q8[2] = yb_map_height(&map, x, y) + 300;
    }
    yb_frame_begin(&frame, &map, &view, &screen);
    size_t pitch = yb_screen_pitch(&screen);
    yb_band_t band = {0, HEIGHT, pixels, pitch, greys};
    yb_frame_band(&frame, &band);
    for (uint16_t y = 0; y < HEIGHT; y = (uint16_t)(y + 5)) {
        /* Dots may come to lie where the greys are. */
        const bool apart = screen.format != YB_MONO;
        band = (yb_band_t){y, 5, apart ? again + y * pitch : greys, pitch, greys};
        yb_frame_band(&frame, &band);
        if (!apart)
            memcpy(again + y * pitch, greys, pitch * (size_t)(HEIGHT - y < 5 ? HEIGHT - y : 5));
    }
    if (memcmp(pixels, again, pitch * HEIGHT) != 0)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t code[MOST];
    if (size < 3)
        return 0;
    size_t count = size - 2 < MOST ? size - 2 : MOST;
    memcpy(code, data + 2, count);
    plan_mend(code, count);
    static yb_map_t first;
    yb_status_t status = feed(code, count, data[0] % 40u + 1);
    if (status != YB_OK)
        return 0;
    check_mesh();
    first = map;
    if (feed(code, count, MOST) != YB_OK || !map_same(&first, &map))
        abort();
    draw(data[1]);
    return 0;
}
