#include "border.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A side of the sheet, walked inwards: position `along` the side, `deep` from it. */
typedef struct {
    int32_t origin, along, inwards;
    int length, depth;
} side_t;

static side_t side_of(const yb_ink_t *ink, int number)
{
    const int pitch = yb_ink_pitch(ink);
    switch (number) {
    case 0: /* left */
        return (side_t){yb_ink_index(ink, 0, 0), pitch, 1, ink->height, ink->width};
    case 1: /* top */
        return (side_t){yb_ink_index(ink, 0, 0), 1, pitch, ink->width, ink->height};
    case 2: /* right */
        return (side_t){yb_ink_index(ink, ink->width - 1, 0), pitch, -1, ink->height, ink->width};
    default: /* bottom */
        return (side_t){yb_ink_index(ink, 0, ink->height - 1), 1, -pitch, ink->width, ink->height};
    }
}

/* Share of the middle of a side that has ink somewhere between two depths. */
static double covered(const yb_ink_t *ink, side_t side, int from, int to)
{
    int count = 0;
    int first = side.length / 8;
    int last = side.length - first;
    for (int i = first; i < last; i++) {
        const uint8_t *pixel = ink->pixel + side.origin + i * side.along;
        bool found = false;
        for (int deep = from; deep < to && !found; deep++)
            found = pixel[deep * side.inwards] != 0;
        count += found;
    }
    return (double)count / (last - first);
}

/* How deep a straight line along a side reaches into the sheet; 0: there is none. */
static int border_depth(const yb_ink_t *ink, side_t side)
{
    int band = 2 + (int)ceil(ink->thickness);
    for (int deep = 0; deep < side.depth / 4 - 3 * band; deep++) {
        if (covered(ink, side, deep, deep + 1) < 0.2 ||
            covered(ink, side, deep, deep + band) < 0.95)
            continue;
        int end = deep + 1;
        while (end < deep + 3 * band && covered(ink, side, end, end + 1) > 0.1)
            end++;
        return end + 1;
    }
    return 0;
}

bool yb_border_cut(yb_ink_t *ink)
{
    int deep[4];
    for (int i = 0; i < 4; i++) {
        deep[i] = border_depth(ink, side_of(ink, i));
        if (deep[i] == 0)
            return true;
    }
    yb_ink_t inside = *ink;
    inside.left = deep[0];
    inside.top = deep[1];
    inside.width = ink->width - deep[0] - deep[2];
    inside.height = ink->height - deep[1] - deep[3];
    if (inside.width < YB_INK_LEAST_SIDE || inside.height < YB_INK_LEAST_SIDE)
        return true;
    inside.pixel = calloc((size_t)yb_ink_pitch(&inside), (size_t)inside.height + 2);
    if (inside.pixel == NULL)
        return false;
    for (int y = 0; y < inside.height; y++)
        memcpy(inside.pixel + yb_ink_index(&inside, 0, y),
               ink->pixel + yb_ink_index(ink, inside.left, inside.top + y), (size_t)inside.width);
    free(ink->pixel);
    *ink = inside;
    return true;
}
