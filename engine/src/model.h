/* What decoder and encoder of the compact profile agree on (docs/SPEC.md 1.3): the models of binary
 * decisions, and steps as a length and a turn. The host's encoder includes this file, so that there
 * is one description of both.
 */
#ifndef YB_MODEL_H
#define YB_MODEL_H

#include <yamabiko/yamabiko.h>

#include "fix.h"

/* The interval of the range coder: 24 bits, refilled by whole bytes when it has only 16 left. */
enum {
    RANGE_BITS = 24,
    RANGE_FULL = 1 << RANGE_BITS,
    RANGE_LEAST = 1 << 16
};

/* A number v ≥ 0 is coded by its class c, 2^c - 1 ≤ v < 2^(c+1) - 1, in unary, each decision with
 * its own model until the last, and by c bits within the class.
 */
enum {
    NUMBER_MODELS = 6,
    MOST_CLASS = 14
};

/* A step turns by one of eight sectors of 45 degrees: three decisions, a tree of seven models. */
enum {
    TURN_MODELS = 7
};

/* What is known when a step is coded. */
enum {
    TURN_INWARD, /* first step of an open line: into the map */
    TURN_FIRST,  /* first step of a closed line */
    TURN_STRAIGHT,
    TURN_LEFT,
    TURN_RIGHT, /* the step before turned so */
    TURN_CONTEXTS
};
enum {
    LENGTH_CONTEXTS = 5 /* first step; the step before was 1, 2 to 3, 4 to 7, 8 or more long */
};

/* Where the models of each decision begin. */
enum {
    MODEL_SECTIONS,
    MODEL_OBLONG,
    MODEL_COARSE,
    MODEL_STRAIGHT,
    MODEL_CLOSED,
    MODEL_END, /* of a closed line; the second model when it has come near its start */
    MODEL_CORNER = MODEL_END + 2,
    MODEL_GAP,
    MODEL_LINE_DOWN,
    MODEL_CORNER_DOWN,
    MODEL_SPOT_DOWN,
    MODEL_BASE,
    MODEL_LINES = MODEL_BASE + NUMBER_MODELS,
    MODEL_SPOTS = MODEL_LINES + NUMBER_MODELS,
    MODEL_START = MODEL_SPOTS + NUMBER_MODELS,
    MODEL_WAY = MODEL_START + NUMBER_MODELS,
    MODEL_LINE_HEIGHT = MODEL_WAY + NUMBER_MODELS,
    MODEL_CORNER_HEIGHT = MODEL_LINE_HEIGHT + NUMBER_MODELS,
    MODEL_SPOT_HEIGHT = MODEL_CORNER_HEIGHT + NUMBER_MODELS,
    MODEL_LENGTH = MODEL_SPOT_HEIGHT + NUMBER_MODELS,
    MODEL_TURN = MODEL_LENGTH + LENGTH_CONTEXTS * NUMBER_MODELS,
    MODELS = MODEL_TURN + TURN_CONTEXTS * TURN_MODELS
};

/* Probability of a 0 at the beginning, in 1/256. Means over many encoded mountains. */
static const uint8_t model_start[MODELS] = {
    [MODEL_SECTIONS] = 252,
    [MODEL_OBLONG] = 200,
    [MODEL_COARSE] = 220,
    [MODEL_STRAIGHT] = 250,
    [MODEL_CLOSED] = 49,
    [MODEL_END] = 249, 133,
    [MODEL_CORNER] = 47,
    [MODEL_GAP] = 129,
    [MODEL_LINE_DOWN] = 159,
    [MODEL_CORNER_DOWN] = 86,
    [MODEL_SPOT_DOWN] = 144,
    [MODEL_BASE] = 6, 29, 24, 75, 143, 202,
    [MODEL_LINES] = 6, 6, 77, 249, 200, 230,
    [MODEL_SPOTS] = 6, 6, 47, 175, 235, 249,
    [MODEL_START] = 18, 27, 46, 92, 160, 249,
    [MODEL_WAY] = 6, 10, 13, 40, 84, 151,
    [MODEL_LINE_HEIGHT] = 113, 66, 181, 227, 134, 249,
    [MODEL_CORNER_HEIGHT] = 16, 89, 197, 242, 249, 240,
    [MODEL_SPOT_HEIGHT] = 17, 83, 165, 198, 203, 178,
    [MODEL_LENGTH] = 6, 37, 105, 180, 224, 249,
    47, 68, 179, 191, 249, 240,
    15, 92, 163, 235, 249, 240,
    15, 58, 151, 236, 249, 240,
    6, 26, 97, 200, 240, 249,
    [MODEL_TURN] = 194, 238, 6, 129, 249, 60, 40,
    132, 151, 153, 175, 166, 151, 79,
    125, 197, 74, 157, 206, 58, 130,
    103, 189, 82, 90, 232, 54, 127,
    137, 141, 70, 102, 158, 109, 119,
};

/* A model holds the probability of a 0 in 1/65536 and learns it with every decision. */
enum {
    LEARN_SHIFT = 5
};

static inline uint16_t model_first(int model)
{
    return (uint16_t)(model_start[model] << 8);
}

/* The part of the interval that a 0 takes: 0 < bound < range, as range >= 2^16 and the model
 * stays within 31 … 65504.
 */
static inline uint32_t model_bound(uint16_t model, uint32_t range)
{
    return (range >> 12) * (model >> 4);
}

static inline uint16_t model_learn(uint16_t model, int bit)
{
    return (uint16_t)(bit != 0 ? model - (model >> LEARN_SHIFT)
                               : model + ((65535 - model) >> LEARN_SHIFT));
}

static inline void ring_step(yb_ring_t ring, int *dx, int *dy)
{
    int n = ring.length;
    int side = (ring.place + n) / (2 * n) & 3; /* east, north, west, south */
    int along = ring.place - 2 * n * side;     /* -n … n along it */
    if (side == 0 && along > n)
        along -= 8 * n;
    *dx = side == 0 ? n : side == 1 ? -along : side == 2 ? -n : along;
    *dy = side == 0 ? along : side == 1 ? n : side == 2 ? -along : -n;
}

static inline yb_ring_t ring_of(int dx, int dy)
{
    int n = fix_max(fix_abs(dx), fix_abs(dy));
    int place = dx == n    ? (dy < 0 ? 8 * n + dy : dy)
                : dy == n  ? 2 * n - dx
                : dx == -n ? 4 * n - dy
                           : 6 * n + dx;
    return (yb_ring_t){(int16_t)n, (int16_t)place};
}

/* Where a ring of radius n is met by going on straight, less half a sector: from here on the
 * turn is counted.
 */
static inline int ring_ahead(yb_ring_t last, int n)
{
    return (last.place * n + last.length / 2) / last.length + 8 * n - n / 2;
}

/* Lattice points that a run takes when so many are left for so many spot heights: about the median
 * gap.
 */
static inline uint32_t gap_run(uint32_t points, uint32_t spots)
{
    uint32_t run = points * 11 / (16 * (spots + 1));
    return run < 1 ? 1 : run > 4096 ? 4096 : run;
}

static inline int turn_context(int sector)
{
    return (sector & 3) == 0 ? TURN_STRAIGHT : sector < 4 ? TURN_LEFT : TURN_RIGHT;
}

static inline int length_context(int length)
{
    return length >= 8 ? 4 : 1 + fix_log2_floor((uint32_t)length);
}

#endif
