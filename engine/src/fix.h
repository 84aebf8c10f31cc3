/* Fixed-point arithmetic shared by the stages. Every function is exact integer arithmetic: the same
 * on every CPU. Ranges are stated; tests/unit/test_fix.c drives their bounds.
 */
#ifndef YB_FIX_H
#define YB_FIX_H

#include <stdbool.h>
#include <stdint.h>

#include <yamabiko/rom.h>

#include "compiler.h"

/* `>>` of a negative number rounds down on every compiler we know; C11 leaves it to them. */
_Static_assert((-3 >> 1) == -2, "arithmetic right shift");

static inline int32_t fix_abs(int32_t a)
{
    return a < 0 ? -a : a;
}

/* The size of a number, but that a negative one counts as one less: one instruction. */
static inline uint32_t fix_size(int32_t a)
{
    return (uint32_t)(a ^ -(int32_t)(a < 0));
}

/* a - b, of two plan coordinates: they are unsigned, and on a small processor an int has 16 bits.
 */
static inline int32_t fix_minus(uint16_t a, uint16_t b)
{
    return (int32_t)a - (int32_t)b;
}

/* Half way between two plan coordinates, rounded down. */
static inline uint16_t fix_middle(uint16_t a, uint16_t b)
{
    return (uint16_t)(((uint32_t)a + b) >> 1);
}

static inline int32_t fix_min(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static inline int32_t fix_max(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* Is one of two numbers above 0, and the other one not? Both are above INT32_MIN. */
static inline bool fix_parted(int32_t a, int32_t b)
{
    return ((a - 1) ^ (b - 1)) < 0;
}

static inline int32_t fix_clamp(int32_t a, int32_t low, int32_t high)
{
    return a < low ? low : a > high ? high : a;
}

/* Length of a plan vector, from 2.8 % below the truth to 6.8 % above it: max + 3/8 min, rounded
 * down. |dx|, |dy| < 2^28.
 */
static inline int32_t fix_length(int32_t dx, int32_t dy)
{
    dx = fix_abs(dx);
    dy = fix_abs(dy);
    return dx > dy ? dx + (3 * dy >> 3) : dy + (3 * dx >> 3);
}

/* a * b, all 64 bits. */
int64_t fix_wide(int32_t a, int32_t b);

/* sum + a * b: what is added up one by one stays in the registers that it is handed on in. */
int64_t fix_add(int64_t sum, int32_t a, int32_t b);

/* The low 32 bits of a * b >> shift, 0 <= shift < 63, rounded down. */
int32_t fix_product(int32_t a, int32_t b, int shift);

/* a * b / c, rounded towards zero; |a|, |b|, |c| < 2^31, c is not 0 and the result fits. */
int32_t fix_scale(int32_t a, int32_t b, int32_t c);

/* a / b, rounded down, but at most so much. Where the engine divides 64 bits they are unsigned: on
 * a small processor signed division is a helper of its own.
 */
uint32_t fix_share(uint64_t a, uint32_t b, uint32_t most);

/* Position of the highest set bit; a > 0. */
static inline int fix_log2_floor(uint32_t a)
{
#if defined(__GNUC__) && __SIZEOF_INT__ >= 4
    return 31 - __builtin_clz(a);
#else
    int n = 0;
    for (int step = 16; step > 0; step >>= 1) {
        if (a >> step != 0) {
            a >>= step;
            n += step;
        }
    }
    return n;
#endif
}

/* Base-2 logarithm with 11 fractional bits, a > 0; error below 1.2 / 2^11. */
int32_t fix_log2_q11(uint64_t a);

/* 2^(e/2048), rounded, at most UINT32_MAX; relative error below 2^-11 where the result is large. */
uint32_t fix_exp2_q11(int32_t e_q11);

/* 2^20 / a, rounded down, for 0 < a < 256. From 17 on it fits 16 bits. */
extern const uint32_t fix_large_inverses[17] YB_ROM;
extern const uint16_t fix_small_inverses[256 - 17] YB_ROM;
static inline int32_t fix_inverse(int32_t a)
{
    return a < 17 ? (int32_t)yb_rom_u32(&fix_large_inverses[a])
                  : (int32_t)yb_rom_u16(&fix_small_inverses[a - 17]);
}

/* 2^29 / a for 2^14 <= a < 2^15, within 4: at least 2^14, at most 2^15. The top 6 bits after the
 * leading one look up, the other 8 interpolate: the chord lies up to h^2/8 f'' = 2^13 2^-12 = 2
 * above the curve, and the table up to 2 below.
 */
static inline int32_t fix_reciprocal_here(int32_t a)
{
    const uint16_t *beyond = &fix_small_inverses[a >> 8];
    int32_t low = yb_rom_u16(beyond - 17);
    return 2 * low - (((low - yb_rom_u16(beyond - 16)) * (a & 255)) >> 7);
}

/* The same, where a call takes less room. */
int32_t fix_reciprocal(int32_t a);

/* Whole square root, rounded down. */
uint32_t fix_sqrt(uint64_t a);

#endif
