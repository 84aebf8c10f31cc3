/* Random numbers that are the same on every machine: splitmix64, whose state is one number. */
#ifndef YB_RANDOM_H
#define YB_RANDOM_H

#include <stdint.h>

/* From 0 to 1, 1 excluded. */
double yb_random_share(uint64_t *random);

/* 0 to count - 1 */
int yb_random_below(uint64_t *random, int count);

/* Symmetric round 0, more often small than large; within 1.5 sizes. */
double yb_random_bell(uint64_t *random, double size);

#endif
