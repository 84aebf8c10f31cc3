#include "update.h"

#include <string.h>

/* Pixel x of a row, leftmost in the highest bits of a byte. */
static unsigned pixel_at(unsigned bits, const uint8_t *row, unsigned x)
{
    if (bits == 16)
        return (unsigned)row[2 * x] << 8 | row[2 * x + 1];
    const unsigned a_byte = 8 / bits;
    return row[x / a_byte] >> (8 - bits - x % a_byte * bits) & ((1u << bits) - 1);
}

/* Into memory that holds zeros. */
static void put_pixel(unsigned bits, uint8_t *row, unsigned x, unsigned pixel)
{
    if (bits == 16) {
        row[2 * x] = (uint8_t)(pixel >> 8);
        row[2 * x + 1] = (uint8_t)pixel;
        return;
    }
    const unsigned a_byte = 8 / bits;
    row[x / a_byte] |= (uint8_t)(pixel << (8 - bits - x % a_byte * bits));
}

void yb_turn_picture(const yb_screen_t *screen, yb_turn_t turn, const uint8_t *from, uint8_t *to)
{
    const bool across = yb_turn_lies_across(turn);
    const yb_screen_t turned = {across ? screen->height : screen->width,
                                across ? screen->width : screen->height, screen->format};
    const unsigned bits = yb_pixel_bits(screen->format);
    const size_t from_pitch = yb_screen_pitch(screen);
    const size_t to_pitch = yb_screen_pitch(&turned);

    memset(to, 0, to_pitch * turned.height);
    for (unsigned y = 0; y < screen->height; y++) {
        for (unsigned x = 0; x < screen->width; x++) {
            const unsigned right = screen->width - 1u - x, below = screen->height - 1u - y;
            const unsigned to_x = turn == YB_TURN_0     ? x
                                  : turn == YB_TURN_90  ? below
                                  : turn == YB_TURN_180 ? right
                                                        : y;
            const unsigned to_y = turn == YB_TURN_0     ? y
                                  : turn == YB_TURN_90  ? x
                                  : turn == YB_TURN_180 ? below
                                                        : right;
            put_pixel(bits, to + to_y * to_pitch, to_x, pixel_at(bits, from + y * from_pitch, x));
        }
    }
}
