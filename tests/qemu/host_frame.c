/* host_frame MAP.yb|built-in AZIMUTH [LOOKS]: the frame that the firmware must show, drawn on the
 * PC by the firmware's own viewer; its rows of pixel bytes go to standard output. AZIMUTH in binary
 * angle.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "turntable.h"

static yb_viewer_t viewer;

static void write_band(void *context, uint16_t y, uint16_t rows, const uint8_t *pixels)
{
    (void)y;
    FILE *out = context;
    (void)fwrite(pixels, YB_VIEWER_PITCH, rows, out);
}

static yb_status_t load(const char *path)
{
    if (strcmp(path, "built-in") == 0)
        return yb_viewer_load(&viewer, yb_built_in_map, yb_built_in_map_bytes);
    FILE *file = fopen(path, "rb");
    if (!file)
        return YB_ERR_TRUNCATED;
    static uint8_t code[YB_MAX_CODE_BYTES + 1];
    size_t count = fread(code, 1, sizeof code, file);
    (void)fclose(file);
    return yb_viewer_load(&viewer, code, count);
}

int main(int argc, char **argv)
{
    if (argc != 3 && argc != 4) {
        (void)fprintf(stderr, "usage: host_frame MAP.yb|built-in AZIMUTH [LOOKS]\n");
        return 2;
    }
    yb_status_t status = load(argv[1]);
    if (status != YB_OK) {
        (void)fprintf(stderr, "host_frame: %s: %s\n", argv[1], yb_status_text(status));
        return 1;
    }
    viewer.looks = argc == 4 ? (uint8_t)strtoul(argv[3], NULL, 10) : 0;
    (void)yb_viewer_draw(&viewer, (uint16_t)strtoul(argv[2], NULL, 10), write_band, stdout);
    return fflush(stdout) == 0 && !ferror(stdout) ? 0 : 1;
}
