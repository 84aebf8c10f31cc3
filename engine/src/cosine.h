/* From the square of a cosine to a shade, without a root. It comes as a square over 2^12 times
 * another number: that of a dot product, of 15 bits, and that of a length, which has 9 to 18 bits,
 * so that it is less than 2^13.
 *
 * There are two ways to the same shades, for processors that divide in an instruction and for those
 * that do not. tests/unit/test_shade.c compares them wherever a shade begins.
 */
#ifndef YB_COSINE_H
#define YB_COSINE_H

#include <yamabiko/rom.h>

#include "colour.h"
#include "fix.h"

/* The square of the least cosine that has this shade, 12 fractional bits: shades grow by a 14th of
 * the cosine and are rounded down, but for a quarter that is added, so that level ground and water
 * below a sun 30 degrees high, a half on the dot, have one shade whatever triangles they are made
 * of.
 */
#define COSINE_LEAST(shade)                                                                        \
    (uint16_t)((((int32_t)1 << 12) * (4 * (shade)-9) * (4 * (shade)-9) + 28 * 56) / (56 * 56))

/* --- By a quotient ---------------------------------------------------------------------------- */

/* What is to be added to a square so that its upper 4 of 16 bits are this shade from where that
 * begins, and one less below.
 */
#define COSINE_STEP(shade) (uint16_t)(((uint32_t)(shade) << 12) - COSINE_LEAST(shade))

#define COSINE_BRIGHTEST (uint16_t)((uint32_t)(SHADES - 1) << 12)

enum {
    COSINE_CELL = 6 /* bits: no two shades begin in so wide a cell */
};

/* Of each cell, for the shade that begins in it or, if none does, beyond it. */
static const uint16_t cosine_steps[64] YB_ROM = {
    COSINE_STEP(3),   COSINE_STEP(5),   COSINE_STEP(5),   COSINE_STEP(6),   COSINE_STEP(6),
    COSINE_STEP(7),   COSINE_STEP(7),   COSINE_STEP(7),   COSINE_STEP(8),   COSINE_STEP(8),
    COSINE_STEP(8),   COSINE_STEP(9),   COSINE_STEP(9),   COSINE_STEP(9),   COSINE_STEP(9),
    COSINE_STEP(10),  COSINE_STEP(10),  COSINE_STEP(10),  COSINE_STEP(10),  COSINE_STEP(10),
    COSINE_STEP(11),  COSINE_STEP(11),  COSINE_STEP(11),  COSINE_STEP(11),  COSINE_STEP(11),
    COSINE_STEP(12),  COSINE_STEP(12),  COSINE_STEP(12),  COSINE_STEP(12),  COSINE_STEP(12),
    COSINE_STEP(12),  COSINE_STEP(12),  COSINE_STEP(13),  COSINE_STEP(13),  COSINE_STEP(13),
    COSINE_STEP(13),  COSINE_STEP(13),  COSINE_STEP(13),  COSINE_STEP(14),  COSINE_STEP(14),
    COSINE_STEP(14),  COSINE_STEP(14),  COSINE_STEP(14),  COSINE_STEP(14),  COSINE_STEP(14),
    COSINE_STEP(14),  COSINE_STEP(15),  COSINE_STEP(15),  COSINE_STEP(15),  COSINE_STEP(15),
    COSINE_STEP(15),  COSINE_STEP(15),  COSINE_STEP(15),  COSINE_STEP(15),  COSINE_BRIGHTEST,
    COSINE_BRIGHTEST, COSINE_BRIGHTEST, COSINE_BRIGHTEST, COSINE_BRIGHTEST, COSINE_BRIGHTEST,
    COSINE_BRIGHTEST, COSINE_BRIGHTEST, COSINE_BRIGHTEST, COSINE_BRIGHTEST};

/* A quotient that is rounded down is below no whole number that it was not below before. */
static inline int32_t cosine_divided(uint32_t number, uint32_t whole_q12)
{
    const int32_t square =
        fix_clamp((int32_t)(number * number / whole_q12), 0, ((int32_t)1 << 12) - 1);
    return (square + yb_rom_u16(&cosine_steps[square >> COSINE_CELL])) >> 12;
}

/* --- By a search ------------------------------------------------------------------------------ */

/* The least squares as a tree: below entry i lie the ones at 2i and, for what is less, 2i + 1.
 * Nothing is less than the darkest. They are below 2^12: products are below 2^30.
 */
static const uint16_t cosine_squares[SHADES] YB_ROM = {0,
                                                       COSINE_LEAST(8),
                                                       COSINE_LEAST(12),
                                                       COSINE_LEAST(4),
                                                       COSINE_LEAST(14),
                                                       COSINE_LEAST(10),
                                                       COSINE_LEAST(6),
                                                       0,
                                                       COSINE_LEAST(15),
                                                       COSINE_LEAST(13),
                                                       COSINE_LEAST(11),
                                                       COSINE_LEAST(9),
                                                       COSINE_LEAST(7),
                                                       COSINE_LEAST(5),
                                                       COSINE_LEAST(3),
                                                       0};

static inline uint32_t cosine_below(uint32_t i, uint32_t square, uint32_t whole_q12)
{
    /* The sign of a difference between numbers below 2^31 asks without a branch. */
    return 2 * i + ((square - whole_q12 * yb_rom_u16(&cosine_squares[i])) >> 31);
}

static inline int32_t cosine_searched(uint32_t number, uint32_t whole_q12)
{
    const uint32_t square = number * number;
    uint32_t i = cosine_below(1, square, whole_q12);
    i = cosine_below(i, square, whole_q12);
    i = cosine_below(i, square, whole_q12);
    i = cosine_below(i, square, whole_q12);
    return (int32_t)(~i & (SHADES - 1));
}

static inline int32_t cosine_shade(uint32_t number, uint32_t whole_q12)
{
#if defined(__ARM_FEATURE_IDIV) || defined(__riscv_div)
    return cosine_divided(number, whole_q12);
#else
    return cosine_searched(number, whole_q12);
#endif
}

#endif
