/* From a shade and a hue to a pixel value; the sky; haze. */
#ifndef YB_COLOUR_H
#define YB_COLOUR_H

#include <yamabiko/yamabiko.h>

enum {
    SHADES = 16, /* of which the ground uses DARKEST .. 15: 14 shades */
    DARKEST = 2, /* what the sun does not reach: light of the sky */
    HUES = 16    /* of the ground, from the lowest to the highest; the others follow */
};

enum {
    HUE_WATER = HUES,
    HUE_WALL,
    HUE_LINE,  /* contour lines */
    HUE_SHORE, /* where ground and water meet */
    HUE_HAZE,  /* the sky at the horizon and below */
    HUE_SKY,   /* high up */
    ALL_HUES
};

/* Fills in frame's constants of hues, sky and haze. */
void colour_begin(yb_frame_t *frame);

/* A hue at a shade, as seen from a distance: `near` is 1/depth, 0 for right here. On a screen
 * without colours the shade alone is the picture.
 */
uint16_t colour_pixel(const yb_frame_t *frame, int hue, int32_t shade, int32_t near);

/* Is a shade itself the pixel value, but for water? Where there are no colours, and no haze. */
static inline bool colour_is_shade(const yb_frame_t *frame)
{
    return frame->screen.format != YB_RGB565 && frame->haze_near == 0;
}

/* The sky behind a row of the screen. */
uint16_t colour_sky(const yb_frame_t *frame, int32_t row);

#endif
