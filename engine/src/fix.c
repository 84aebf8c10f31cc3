#include "fix.h"

#include <yamabiko/rom.h>
#include <yamabiko/yamabiko.h>

/* round(2048 log2(1 + i/32)) */
static const uint16_t log_table[33] YB_ROM = {0,    91,   179,  265,  348,  429,  508,  585,  659,
                                              732,  803,  873,  941,  1007, 1072, 1136, 1198, 1259,
                                              1319, 1377, 1435, 1491, 1546, 1600, 1653, 1706, 1757,
                                              1808, 1857, 1906, 1954, 2001, 2048};

/* round(32768 (2^(i/32) - 1)) */
static const uint16_t exp_table[33] YB_ROM = {
    0,     718,   1451,  2200,  2966,  3748,  4548,  5365,  6200,  7053,  7925,
    8816,  9727,  10657, 11608, 12580, 13573, 14588, 15625, 16684, 17767, 18874,
    20005, 21160, 22341, 23548, 24781, 26041, 27329, 28645, 29989, 31364, 32768};

#define INVERSE(a) (((uint32_t)1 << 20) / (a))
#define INVERSES_4(a) INVERSE(a), INVERSE((a) + 1), INVERSE((a) + 2), INVERSE((a) + 3)
#define INVERSES_16(a) INVERSES_4(a), INVERSES_4((a) + 4), INVERSES_4((a) + 8), INVERSES_4((a) + 12)
#define INVERSES_64(a)                                                                             \
    INVERSES_16(a), INVERSES_16((a) + 16), INVERSES_16((a) + 32), INVERSES_16((a) + 48)

const uint32_t fix_large_inverses[17] YB_ROM = {
    0,          INVERSE(1), INVERSE(2), INVERSE(3), INVERSES_4(4), INVERSES_4(8), INVERSES_4(12),
    INVERSE(16)};
const uint16_t fix_small_inverses[256 - 17] YB_ROM = {
    INVERSE(17),     INVERSE(18),      INVERSE(19),     INVERSES_4(20),
    INVERSES_4(24),  INVERSES_4(28),   INVERSES_16(32), INVERSES_16(48),
    INVERSES_64(64), INVERSES_64(128), INVERSES_64(192)};

/* Between an entry of a table and the next, greater one: the part has so many bits. */
APART uint32_t between(const uint16_t *entry, uint32_t part, int bits)
{
    uint32_t first = yb_rom_u16(entry);
    uint32_t step = yb_rom_u16(entry + 1) - first;
    return first + ((step * part + ((uint32_t)1 << bits >> 1)) >> bits);
}

int32_t fix_log2_q11(uint64_t a)
{
    /* Bring a to 1.5 .. fraction of 16 bits: the top 5 of them look up, the other 11 interpolate.
     */
    int exponent = 0;
    while (a >> 32 != 0) {
        a >>= 1;
        exponent++;
    }
    uint32_t low = (uint32_t)a;
    int top = fix_log2_floor(low);
    uint32_t fraction = (low << (31 - top)) >> 15 & 0xffff;
    uint32_t log = between(&log_table[fraction >> 11], fraction & 0x7ff, 11);
    return (int32_t)(exponent + top) * 2048 + (int32_t)log;
}

uint32_t fix_exp2_q11(int32_t e_q11)
{
    int exponent = (int)(e_q11 >> 11);
    if (exponent >= 32)
        return UINT32_MAX;
    if (exponent < -1)
        return 0;
    uint32_t i = (uint32_t)e_q11 >> 6 & 31;
    uint32_t mantissa = 32768 + between(&exp_table[i], (uint32_t)e_q11 & 63, 6); /* Q15, below 2 */
    const int down = 15 - exponent;                                              /* -16 .. 16 */
    return down > 0 ? (mantissa + ((uint32_t)1 << down >> 1)) >> down : mantissa << -down;
}

int64_t fix_wide(int32_t a, int32_t b)
{
    return (int64_t)a * b;
}

int64_t fix_add(int64_t sum, int32_t a, int32_t b)
{
    return sum + fix_wide(a, b);
}

int32_t fix_product(int32_t a, int32_t b, int shift)
{
    return (int32_t)(fix_wide(a, b) >> shift);
}

int32_t fix_scale(int32_t a, int32_t b, int32_t c)
{
    const uint64_t product = (uint64_t)fix_wide(fix_abs(a), fix_abs(b));
    const int32_t size = (int32_t)fix_share(product, (uint32_t)fix_abs(c), UINT32_MAX);
    return (a ^ b ^ c) < 0 ? -size : size;
}

uint32_t fix_share(uint64_t a, uint32_t b, uint32_t most)
{
    a /= b;
    return a < most ? (uint32_t)a : most;
}

int32_t fix_reciprocal(int32_t a)
{
    return fix_reciprocal_here(a);
}

uint32_t fix_sqrt(uint64_t a)
{
    uint32_t root = 0;
    for (uint32_t bit = (uint32_t)1 << (a >> 32 != 0 ? 31 : 15); bit != 0; bit >>= 1) {
        uint64_t more = root | bit;
        if (more * more <= a)
            root |= bit;
    }
    return root;
}

/* round(16384 sin(i/64 of a right angle)): a polynomial whose coefficients have been found by
 * trial, so that all of them are right. Products are below 2^31.
 */
APART int32_t sine_of(int32_t i)
{
    int32_t square = i * i;
    int32_t sum = 333263 - (square * 142 >> 5);
    sum = 338638 - (square * sum >> 15);
    sum = 26353549 - (square * sum >> 7);
    return (i * sum + 32768) >> 16;
}

int16_t yb_sin_q14(uint16_t angle_bam)
{
    int32_t quarter = angle_bam & 0x3fff;
    if ((angle_bam & 0x4000) != 0)
        quarter = 0x4000 - quarter;
    int32_t first = sine_of(quarter >> 8);
    int32_t step = sine_of((quarter >> 8) + 1) - first;
    int32_t value = first + ((step * (quarter & 255) + 128) >> 8);
    return (int16_t)((angle_bam & 0x8000) != 0 ? -value : value);
}

int16_t yb_cos_q14(uint16_t angle_bam)
{
    return yb_sin_q14((uint16_t)(angle_bam + 0x4000));
}
