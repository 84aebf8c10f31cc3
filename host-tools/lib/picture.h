/* Pictures: what a screen shows, as a PNG file.
 *
 * RGB565 becomes 8 bits a channel by repeating the high bits, a grey level becomes level * 17: the
 * darkest pixel is 0, the brightest 255. Nothing but the pixels decides the bytes of the file.
 */
#ifndef YB_PICTURE_H
#define YB_PICTURE_H

#include <yamabiko/yamabiko.h>

typedef struct {
    uint32_t width, height;
    uint32_t channels; /* 1 grey, 3 red, green, blue */
    uint8_t *samples;  /* 8 bits each, rows from the top, without gaps */
} yb_picture_t;

/* False: no memory. */
bool yb_picture_init(yb_picture_t *picture, uint32_t width, uint32_t height, uint32_t channels);
void yb_picture_free(yb_picture_t *picture);

/* A frame's pixels, yb_screen_pitch bytes a row. False: no memory. */
bool yb_picture_from_frame(yb_picture_t *picture, const yb_screen_t *screen, const uint8_t *pixels);

/* Turned clockwise by so many quarters; `turned` is new. False: no memory. */
bool yb_picture_turn(yb_picture_t *turned, const yb_picture_t *picture, unsigned quarters);

/* The whole PNG file in memory, to be freed. NULL: no memory. */
uint8_t *yb_picture_png(const yb_picture_t *picture, size_t *size);

#endif
