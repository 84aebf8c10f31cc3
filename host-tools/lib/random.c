#include "random.h"

double yb_random_share(uint64_t *random)
{
    *random += 0x9e3779b97f4a7c15U;
    uint64_t z = *random;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9U;
    z = (z ^ z >> 27) * 0x94d049bb133111ebU;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

int yb_random_below(uint64_t *random, int count)
{
    return (int)(yb_random_share(random) * count);
}

double yb_random_bell(uint64_t *random, double size)
{
    /* One after the other: C leaves the order of calls within a sum open. */
    double sum = yb_random_share(random);
    sum += yb_random_share(random);
    sum += yb_random_share(random);
    return (sum - 1.5) * size;
}
