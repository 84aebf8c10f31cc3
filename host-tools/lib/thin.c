#include "thin.h"

#include <math.h>
#include <stdlib.h>

/* Of a pixel, while it is worked on. */
enum {
    INK = 1,
    LISTED = 2, /* to be looked at next */
    AGED = 4,   /* has been looked at once since something around it changed */
    TOUCHED = 8 /* a spur was taken off here */
};

enum {
    MOST_ROUNDS = 16 /* of taking off spurs: a fork has few arms */
};

typedef struct {
    uint8_t *pixel;
    int32_t step[8];
    int32_t *now, *next, *gone;
    int32_t count, coming;
} thinner_t;

/* A spur: from its end up to the fork. */
typedef struct {
    int32_t end, fork;
    int length;
} spur_t;

int yb_thin_neighbours(const yb_ink_t *ink, const int32_t step[8], int32_t at)
{
    int count = 0;
    for (int i = 0; i < 8; i++)
        count += ink->pixel[at + step[i]] & INK;
    return count;
}

/* The neighbours, clockwise from the north, and the first again. */
static void look_around(const uint8_t *pixel, const int32_t step[8], bool around[9])
{
    for (int i = 0; i < 9; i++)
        around[i] = (pixel[step[i % 8]] & INK) != 0;
}

/* Into how many parts the neighbours would fall without the pixel. */
static int parts_around(const bool around[9])
{
    int parts = 0;
    for (int i = 0; i < 8; i += 2)
        parts += !around[i] && (around[i + 1] || around[i + 2]);
    return parts;
}

/* Guo and Hall's conditions; their p2 is around[0]. */
static bool may_go(const uint8_t *pixel, const int32_t step[8], int phase)
{
    bool around[9];
    look_around(pixel, step, around);
    if (parts_around(around) != 1)
        return false;
    int odd = 0;
    int even = 0;
    for (int i = 0; i < 8; i += 2) {
        even += around[i] || around[i + 1];
        odd += around[i + 1] || around[i + 2];
    }
    int fewer = odd < even ? odd : even;
    if (fewer < 2 || fewer > 3)
        return false;
    if (phase == 0)
        return !((around[4] || around[5] || !around[7]) && around[6]);
    return !((around[0] || around[1] || !around[3]) && around[2]);
}

static void list(thinner_t *thinner, int32_t at)
{
    if ((thinner->pixel[at] & LISTED) == 0)
        thinner->next[thinner->coming++] = at;
    thinner->pixel[at] = INK | LISTED;
}

/* One sub-iteration. A pixel is looked at again as long as its surroundings change, and once more
 * in the other phase.
 */
static void thin_once(thinner_t *thinner, int phase)
{
    uint8_t *pixel = thinner->pixel;
    int32_t gone = 0;
    int32_t kept = 0;
    for (int32_t i = 0; i < thinner->count; i++) {
        int32_t at = thinner->now[i];
        if (may_go(pixel + at, thinner->step, phase))
            thinner->gone[gone++] = at;
        else
            thinner->now[kept++] = at;
    }
    for (int32_t i = 0; i < gone; i++)
        pixel[thinner->gone[i]] = 0;
    thinner->coming = 0;
    for (int32_t i = 0; i < kept; i++) {
        int32_t at = thinner->now[i];
        bool aged = (pixel[at] & AGED) != 0;
        pixel[at] = INK;
        if (!aged) {
            list(thinner, at);
            pixel[at] |= AGED;
        }
    }
    for (int32_t i = 0; i < gone; i++)
        for (int k = 0; k < 8; k++) {
            int32_t at = thinner->gone[i] + thinner->step[k];
            if (pixel[at] != 0)
                list(thinner, at);
        }
    int32_t *swapped = thinner->now;
    thinner->now = thinner->next;
    thinner->next = swapped;
    thinner->count = thinner->coming;
}

/* All ink, in the order of the picture. */
static int32_t gather(const yb_ink_t *ink, int32_t *index)
{
    int32_t all = yb_ink_index(ink, ink->width - 1, ink->height - 1) + 1;
    int32_t count = 0;
    for (int32_t i = 0; i < all; i++)
        if (ink->pixel[i] != 0) {
            if (index != NULL)
                index[count] = i;
            count++;
        }
    return count;
}

/* Takes pixels off the corners of staircases and what is left of spurs, one after the other, as
 * long as nothing falls apart and no end is eaten.
 */
static int32_t tidy(yb_ink_t *ink, const int32_t step[8], int32_t *index, int32_t count)
{
    for (bool changed = true; changed;) {
        changed = false;
        int32_t kept = 0;
        for (int32_t i = 0; i < count; i++) {
            bool around[9];
            look_around(ink->pixel + index[i], step, around);
            if (yb_thin_neighbours(ink, step, index[i]) >= 2 && parts_around(around) == 1) {
                ink->pixel[index[i]] = 0;
                changed = true;
            } else {
                index[kept++] = index[i];
            }
        }
        count = kept;
    }
    return count;
}

/* The neighbour of a pixel on a line that is not the one before; -1: there is none. */
static int32_t onwards(const yb_ink_t *ink, const int32_t step[8], int32_t at, int32_t before)
{
    for (int i = 0; i < 8; i++)
        if (at + step[i] != before && (ink->pixel[at + step[i]] & INK) != 0)
            return at + step[i];
    return -1;
}

/* Whether a line from an end meets a fork within `most` pixels. */
static bool find_spur(const yb_ink_t *ink, const int32_t step[8], int32_t end, int most,
                      spur_t *spur)
{
    int32_t before = -1;
    int32_t at = end;
    for (int length = 1; length <= most; length++) {
        int32_t next = onwards(ink, step, at, before);
        if (next < 0)
            return false;
        before = at;
        at = next;
        int neighbours = yb_thin_neighbours(ink, step, at);
        if (neighbours >= 3) {
            *spur = (spur_t){end, at, length};
            return true;
        }
    }
    return false;
}

static int by_length(const void *a, const void *b)
{
    const spur_t *first = a;
    const spur_t *second = b;
    if (first->length != second->length)
        return first->length - second->length;
    return (first->end > second->end) - (first->end < second->end);
}

/* Takes the shortest spur off each fork; answers how many. */
static int32_t cut_spurs(yb_ink_t *ink, const int32_t step[8], spur_t *spur, int32_t count)
{
    int32_t cut = 0;
    if (count > 1)
        qsort(spur, (size_t)count, sizeof(*spur), by_length);
    for (int32_t i = 0; i < count; i++) {
        if ((ink->pixel[spur[i].fork] & TOUCHED) != 0)
            continue;
        int32_t before = -1;
        int32_t at = spur[i].end;
        for (int k = 0; k < spur[i].length; k++) {
            int32_t next = onwards(ink, step, at, before);
            before = at;
            ink->pixel[at] = 0;
            at = next;
        }
        ink->pixel[spur[i].fork] |= TOUCHED;
        for (int k = 0; k < 8; k++)
            if (ink->pixel[spur[i].fork + step[k]] != 0)
                ink->pixel[spur[i].fork + step[k]] |= TOUCHED;
        cut++;
    }
    return cut;
}

static bool trim(yb_ink_t *ink, const int32_t step[8], int32_t *index)
{
    int32_t count = tidy(ink, step, index, gather(ink, index));
    int most = (int)ceil(2 * ink->thickness);
    spur_t *spur = malloc((size_t)count * sizeof(*spur) + 1);
    if (spur == NULL)
        return false;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        int32_t spurs = 0;
        for (int32_t i = 0; i < count; i++)
            if (yb_thin_neighbours(ink, step, index[i]) == 1 &&
                find_spur(ink, step, index[i], most, &spur[spurs]))
                spurs++;
        if (cut_spurs(ink, step, spur, spurs) == 0)
            break;
        for (int32_t i = 0; i < count; i++)
            ink->pixel[index[i]] &= INK;
        count = tidy(ink, step, index, gather(ink, index));
    }
    free(spur);
    return true;
}

bool yb_thin(yb_ink_t *ink)
{
    size_t room = (size_t)gather(ink, NULL) * sizeof(int32_t) + 1;
    thinner_t thinner = {
        .pixel = ink->pixel, .now = malloc(room), .next = malloc(room), .gone = malloc(room)};
    yb_ink_around(ink, thinner.step);
    bool good = thinner.now != NULL && thinner.next != NULL && thinner.gone != NULL;
    if (good) {
        thinner.count = gather(ink, thinner.now);
        for (int phase = 0; thinner.count > 0; phase ^= 1)
            thin_once(&thinner, phase);
        good = trim(ink, thinner.step, thinner.now);
    }
    free(thinner.now);
    free(thinner.next);
    free(thinner.gone);
    return good;
}
