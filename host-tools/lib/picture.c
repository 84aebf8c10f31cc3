#include "picture.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>

bool yb_picture_init(yb_picture_t *picture, uint32_t width, uint32_t height, uint32_t channels)
{
    *picture = (yb_picture_t){width, height, channels, NULL};
    picture->samples = calloc((size_t)width * height, channels);
    return picture->samples != NULL;
}

void yb_picture_free(yb_picture_t *picture)
{
    free(picture->samples);
    *picture = (yb_picture_t){0};
}

static void spread_rgb565(uint8_t *sample, unsigned pixel)
{
    const unsigned red = pixel >> 11, green = pixel >> 5 & 63, blue = pixel & 31;
    sample[0] = (uint8_t)(red << 3 | red >> 2);
    sample[1] = (uint8_t)(green << 2 | green >> 4);
    sample[2] = (uint8_t)(blue << 3 | blue >> 2);
}

/* A pixel of a screen without colours, 0 to 255. */
static uint8_t grey_at(const yb_screen_t *screen, const uint8_t *row, size_t x)
{
    if (screen->format == YB_MONO)
        return (row[x / 8] >> (7 - x % 8) & 1) != 0 ? 255 : 0;
    return (uint8_t)((x % 2 == 0 ? row[x / 2] >> 4 : row[x / 2] & 15) * 17);
}

bool yb_picture_from_frame(yb_picture_t *picture, const yb_screen_t *screen, const uint8_t *pixels)
{
    const bool grey = screen->format != YB_RGB565;
    if (!yb_picture_init(picture, screen->width, screen->height, grey ? 1 : 3))
        return false;
    const size_t pitch = yb_screen_pitch(screen);
    uint8_t *sample = picture->samples;
    for (size_t y = 0; y < screen->height; y++) {
        const uint8_t *row = pixels + y * pitch;
        for (size_t x = 0; x < screen->width; x++, sample += picture->channels) {
            if (grey)
                *sample = grey_at(screen, row, x);
            else
                spread_rgb565(sample, (unsigned)row[2 * x] << 8 | row[2 * x + 1]);
        }
    }
    return true;
}

bool yb_picture_turn(yb_picture_t *turned, const yb_picture_t *picture, unsigned quarters)
{
    const uint32_t width = picture->width, height = picture->height;
    const bool across = quarters % 2 != 0;
    if (!yb_picture_init(turned, across ? height : width, across ? width : height,
                         picture->channels))
        return false;
    const uint8_t *sample = picture->samples;
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++, sample += picture->channels) {
            const uint32_t to_x[4] = {x, height - 1 - y, width - 1 - x, y};
            const uint32_t to_y[4] = {y, x, height - 1 - y, width - 1 - x};
            memcpy(turned->samples +
                       ((size_t)to_y[quarters % 4] * turned->width + to_x[quarters % 4]) *
                           picture->channels,
                   sample, picture->channels);
        }
    }
    return true;
}

uint8_t *yb_picture_png(const yb_picture_t *picture, size_t *size)
{
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = picture->width,
                       .height = picture->height,
                       .format = picture->channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB};
    png_alloc_size_t room = PNG_IMAGE_PNG_SIZE_MAX(image);
    uint8_t *file = malloc(room);
    if (file != NULL &&
        png_image_write_to_memory(&image, file, &room, 0, picture->samples, 0, NULL) != 0) {
        *size = room;
        return file;
    }
    png_image_free(&image);
    free(file);
    return NULL;
}
