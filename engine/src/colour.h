/* From a shade and a hue to a pixel value; the sky; haze. */
#ifndef YB_COLOUR_H
#define YB_COLOUR_H

#include <yamabiko/yamabiko.h>

#include "fix.h"

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

/* What there may be besides the sun's light, all in one number: most often nothing is. */
enum {
    LOOK_COLOURS = 1,
    LOOK_HAZE = 2,
    LOOK_SHADOWS = 4,
    LOOK_ODD = 8 /* a lamp, water, another vertical scale, or a map that is not smooth */
};

/* Fills in frame's looks, and its constants of hues, sky and haze. */
void colour_begin(yb_frame_t *frame);

/* A hue at a shade, as seen from a distance: `near` is 1/depth, 0 for right here. On a screen
 * without colours the shade alone is the picture.
 */
uint16_t colour_pixel(const yb_frame_t *frame, int hue, int32_t shade, int32_t near);

/* How much of what is seen is not haze, of 256: d/D at distance D, where haze begins at d. For
 * near < haze_near the product is below 2^24.
 */
static inline int32_t colour_clear(const yb_frame_t *frame, int32_t near)
{
    return near == 0 || near >= frame->haze_near ? 256 : near * frame->haze_q16 >> 16;
}

/* A pixel value where there are no colours: the sky is black. */
static inline uint16_t colour_grey(const yb_frame_t *frame, int32_t shade, int32_t near)
{
    return (uint16_t)fix_max(shade * colour_clear(frame, near) >> 8, 1);
}

/* The sky behind a row of the screen. */
uint16_t colour_sky(const yb_frame_t *frame, int32_t row);

#endif
