#include "blots.h"

#include <math.h>
#include <stdlib.h>

/* A mark is no longer than so many times its breadth: a dot, a cross, a triangle, not a dash. */
static const double most_slender = 1.6;

enum {
    INK = 1,
    SEEN = 2,
    DIRECTIONS = 4 /* across, down and the two diagonals */
};

/* Pixels that hang together. */
typedef struct {
    int32_t *index;
    int32_t count;
    int low[DIRECTIONS], high[DIRECTIONS];
    double x, y; /* sums */
} spot_t;

double yb_blots_largest(const yb_ink_t *ink)
{
    return 8 * ink->thickness + 2;
}

bool yb_blots_add(yb_blots_t *marks, yb_place_t at)
{
    if (marks->count == marks->room) {
        int room = marks->room == 0 ? 16 : 2 * marks->room;
        yb_place_t *place = realloc(marks->place, (size_t)room * sizeof(*place));
        if (place == NULL)
            return false;
        marks->place = place;
        marks->room = room;
    }
    marks->place[marks->count++] = at;
    return true;
}

static void spot_extend(spot_t *spot, int x, int y)
{
    const int along[DIRECTIONS] = {x, y, x + y, x - y};
    for (int i = 0; i < DIRECTIONS; i++) {
        if (spot->count == 1 || along[i] < spot->low[i])
            spot->low[i] = along[i];
        if (spot->count == 1 || along[i] > spot->high[i])
            spot->high[i] = along[i];
    }
    spot->x += x + 0.5;
    spot->y += y + 0.5;
}

static void spot_flood(yb_ink_t *ink, spot_t *spot, int32_t from)
{
    int32_t step[8];
    yb_ink_around(ink, step);
    spot->count = 0;
    spot->x = 0;
    spot->y = 0;
    spot->index[spot->count++] = from;
    ink->pixel[from] |= SEEN;
    spot_extend(spot, yb_ink_x(ink, from), yb_ink_y(ink, from));
    for (int32_t i = 0; i < spot->count; i++)
        for (int k = 0; k < 8; k++) {
            int32_t next = spot->index[i] + step[k];
            if (ink->pixel[next] != INK)
                continue;
            ink->pixel[next] |= SEEN;
            spot->index[spot->count++] = next;
            spot_extend(spot, yb_ink_x(ink, next), yb_ink_y(ink, next));
        }
}

/* Length and breadth: the largest and the smallest extent of the four directions. */
static void spot_extents(const spot_t *spot, double *length, double *breadth)
{
    *length = 0;
    *breadth = HUGE_VAL;
    for (int i = 0; i < DIRECTIONS; i++) {
        double extent = (1 + spot->high[i] - spot->low[i]) * (i < 2 ? 1 : sqrt(0.5));
        *length = fmax(*length, extent);
        *breadth = fmin(*breadth, extent);
    }
}

/* The hole in a spot that hangs together, by Euler's number from its 2 x 2 squares: a square with
 * one pixel of the spot is a convex corner, one with three a hollow one; without a hole there
 * are four more of the one than of the other. Pixels that meet at a corner hang together, hence the
 * two of a diagonal.
 */
static bool spot_has_hole(const yb_ink_t *ink, const spot_t *spot)
{
    const int pitch = yb_ink_pitch(ink);
    int twelfths = 0;
    for (int32_t i = 0; i < spot->count; i++)
        for (int corner = 0; corner < 4; corner++) {
            /* The square with this pixel at one of its corners. */
            int32_t at = spot->index[i] - (corner & 1) - (corner >> 1) * pitch;
            int pixels = (ink->pixel[at] & 1) + (ink->pixel[at + 1] & 1) +
                         (ink->pixel[at + pitch] & 1) + (ink->pixel[at + pitch + 1] & 1);
            bool diagonal = pixels == 2 && (ink->pixel[at] & 1) == (ink->pixel[at + pitch + 1] & 1);
            /* Each square is met once for each of its pixels: twelfths make that even. */
            twelfths += pixels == 1 ? 12 : pixels == 3 ? -4 : diagonal ? -12 : 0;
        }
    return twelfths < 12 * 4;
}

/* Whether the spot is no line; marks are noted. */
static bool spot_take(const yb_ink_t *ink, const spot_t *spot, yb_blots_t *marks, bool *good)
{
    double length = 0;
    double breadth = 0;
    spot_extents(spot, &length, &breadth);
    if (length < fmax(1.5 * ink->thickness, 3))
        return true;
    if (length > yb_blots_largest(ink) || length > most_slender * breadth ||
        spot_has_hole(ink, spot))
        return false;
    yb_place_t centre = {spot->x / spot->count, spot->y / spot->count};
    *good = *good && yb_blots_add(marks, centre);
    return true;
}

bool yb_blots_take(yb_ink_t *ink, yb_blots_t *marks)
{
    int32_t pixels = 0;
    int32_t all = yb_ink_index(ink, ink->width - 1, ink->height - 1) + 1;
    for (int32_t i = 0; i < all; i++)
        pixels += ink->pixel[i];
    spot_t spot = {.index = malloc((size_t)pixels * sizeof(int32_t) + 1)};
    bool good = spot.index != NULL;
    for (int32_t i = 0; i < all && good; i++) {
        if (ink->pixel[i] != INK)
            continue;
        spot_flood(ink, &spot, i);
        if (spot_take(ink, &spot, marks, &good))
            for (int32_t k = 0; k < spot.count; k++)
                ink->pixel[spot.index[k]] = 0;
    }
    for (int32_t i = 0; i < all; i++)
        ink->pixel[i] &= INK;
    free(spot.index);
    return good;
}
