/* Repeatable random numbers for the tests: splitmix64. */
#ifndef TEST_RNG_H
#define TEST_RNG_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    uint64_t state;
} rng_t;

static inline uint64_t rng_next(rng_t *rng)
{
    uint64_t z = rng->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* low <= result <= high */
static inline int rng_range(rng_t *rng, int low, int high)
{
    uint64_t span = (uint64_t)((int64_t)high - low + 1);
    return (int)((int64_t)(rng_next(rng) % span) + low);
}

/* True once in n times. */
static inline bool rng_one_in(rng_t *rng, int n)
{
    return rng_range(rng, 1, n) == 1;
}

/* 0 <= result < 1 */
static inline double rng_unit(rng_t *rng)
{
    return (double)(rng_next(rng) >> 11) / 9007199254740992.0;
}

#endif
