/* libFuzzer target for the decoder and what comes behind it.
 *
 * The last byte of an input is how large the pieces are in which the rest is fed; the check byte is
 * mended, or hardly an input would get past it. What loads is drawn and asked for heights. Built
 * without libFuzzer (YB_FUZZ_REPLAY) it runs the files it is given once: the corpus as a test.
 */
#include <stdio.h>
#include <string.h>

#include <yamabiko/yamabiko.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static yb_map_t map;
static yb_load_t load;
static yb_frame_t frame;

static uint8_t check_of(const uint8_t *bytes, size_t count)
{
    unsigned crc = 0;
    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (int k = 0; k < 8; k++)
            crc = (crc << 1 ^ ((crc & 0x80) != 0 ? 0x07 : 0)) & 0xff;
    }
    return (uint8_t)crc;
}

static void draw(const uint8_t *code, size_t size)
{
    static uint16_t depth[64 * 16];
    static uint8_t pixels[32 * 16];
    const yb_screen_t screen = {.width = 64, .height = 32, .format = YB_GREY4};
    yb_view_t view;
    yb_view_init(&view, &map);
    yb_view_orbit(&view, &map, (uint16_t)(code[size / 2] << 8), (uint16_t)(code[size / 3] << 6),
                  (uint16_t)(40 + code[size / 4] * 2));
    view.max_leaves = 1000;
    view.water_q8 = code[size / 5] < 128 ? YB_NO_WATER : code[size / 5] * 64;
    yb_frame_begin(&frame, &map, &view, &screen);
    yb_band_t band = {.rows = 16, .depth = depth, .pixels = pixels, .pitch = 32};
    for (band.y = 0; band.y < 32; band.y = (uint16_t)(band.y + 16))
        yb_frame_band(&frame, &band);
    (void)yb_map_height(&map, (uint16_t)(code[size / 6] << 8), (uint16_t)(code[size / 7] << 8));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t code[YB_MAX_CODE_BYTES + 8];
    if (size < 3 || size > sizeof code)
        return 0;
    size_t count = size - 1;
    size_t piece = (size_t)data[count] + 1;
    memcpy(code, data, count);
    code[count - 1] = check_of(code, count - 1);
    yb_map_begin(&map, &load);
    yb_status_t status = YB_MORE;
    for (size_t at = 0; at < count && status == YB_MORE; at += piece)
        status = yb_map_feed(&map, &load, code + at, count - at < piece ? count - at : piece);
    status = yb_map_end(&map, &load);
    if (status == YB_OK)
        draw(code, count);
    return 0;
}

#ifdef YB_FUZZ_REPLAY
int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        static uint8_t data[YB_MAX_CODE_BYTES + 8];
        FILE *file = fopen(argv[i], "rb");
        if (file == NULL) {
            perror(argv[i]);
            return 1;
        }
        size_t size = fread(data, 1, sizeof data, file);
        fclose(file);
        (void)LLVMFuzzerTestOneInput(data, size);
    }
    printf("%d inputs\n", argc - 1);
    return argc > 1 ? 0 : 1;
}
#endif
