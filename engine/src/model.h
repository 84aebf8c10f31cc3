/* What decoder and encoder of the compact profile agree on (docs/SPEC.md 1.3): the models of binary
 * decisions, and steps as a length and a turn. The host's encoder includes this file, so that there
 * is one description of both.
 */
#ifndef YB_MODEL_H
#define YB_MODEL_H

#include <yamabiko/rom.h>
#include <yamabiko/yamabiko.h>

#include "fix.h"

/* The interval of the range coder: 24 bits, refilled by whole bytes when it has only 16 left. */
#define RANGE_BITS 24
#define RANGE_FULL ((uint32_t)1 << RANGE_BITS)
#define RANGE_LEAST ((uint32_t)1 << 16)

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

/* Probability of a 0 at the beginning, in 1/256: means over many encoded mountains. */
/* clang-format off */
static const uint8_t model_start[MODELS] YB_ROM = {
    [MODEL_SECTIONS] = 252,
    [MODEL_OBLONG] = 200,
    [MODEL_COARSE] = 220,
    [MODEL_STRAIGHT] = 250,
    [MODEL_CLOSED] = 53,
    [MODEL_END] = 246, 116,
    [MODEL_CORNER] = 58,
    [MODEL_GAP] = 120,
    [MODEL_LINE_DOWN] = 189,
    [MODEL_CORNER_DOWN] = 63,
    [MODEL_SPOT_DOWN] = 140,
    [MODEL_BASE] = 10, 10, 10, 91, 168, 206,
    [MODEL_LINES] = 10, 22, 81, 246, 200, 230,
    [MODEL_SPOTS] = 10, 10, 18, 129, 243, 246,
    [MODEL_START] = 13, 21, 46, 98, 192, 246,
    [MODEL_WAY] = 10, 12, 10, 30, 73, 166,
    [MODEL_LINE_HEIGHT] = 117, 52, 197, 235, 10, 246,
    [MODEL_CORNER_HEIGHT] = 12, 77, 191, 246, 246, 240,
    [MODEL_SPOT_HEIGHT] = 10, 73, 173, 211, 210, 246,
    [MODEL_LENGTH] = 10, 64, 118, 222, 246, 246,
    74, 120, 177, 246, 246, 240,
    21, 93, 191, 242, 246, 240,
    13, 82, 167, 246, 246, 240,
    10, 45, 139, 220, 246, 246,
    [MODEL_TURN] = 203, 239, 10, 158, 246, 60, 14,
    154, 142, 117, 169, 195, 222, 55,
    140, 184, 68, 158, 210, 42, 124,
    99, 181, 84, 65, 228, 38, 117,
    162, 115, 64, 97, 125, 115, 113,
};
/* clang-format on */

/* A model holds the probability of a 0 in 1/65536 and learns it with every decision. */
enum {
    LEARN_SHIFT = 5
};

static inline uint16_t model_first(int model)
{
    return (uint16_t)((unsigned)yb_rom_u8(&model_start[model]) << 8);
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
    int along = ring.place;
    int turns = 0; /* east, north, west, south */
    for (; along >= n; along -= 2 * n)
        turns++;
    *dx = n;
    *dy = along; /* -n … n along the side */
    for (; turns > 0; turns--) {
        int x = -*dy;
        *dy = *dx;
        *dx = x;
    }
}

static inline yb_ring_t ring_of(int dx, int dy)
{
    int n = (int)fix_max(fix_abs(dx), fix_abs(dy));
    int place = dx == n    ? (dy < 0 ? 8 * n + dy : dy)
                : dy == n  ? 2 * n - dx
                : dx == -n ? 4 * n - dy
                           : 6 * n + dx;
    return (yb_ring_t){n, place};
}

/* Where a ring of radius n is met by going on straight, less half a sector: from here on the
 * turn is counted.
 */
static inline int ring_ahead(yb_ring_t last, int n)
{
    return (int)(((int32_t)last.place * n + (last.length >> 1)) / last.length) + 8 * n - (n >> 1);
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
    int context = 1;
    while (context < LENGTH_CONTEXTS - 1 && length >> context != 0)
        context++;
    return context;
}

#endif
