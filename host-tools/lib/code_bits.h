/* What the bits of a code are spent on. */
#ifndef YB_CODE_BITS_H
#define YB_CODE_BITS_H

#include <stdbool.h>

typedef enum {
    YB_BITS_HEADER,  /* scale, lattice, base, roughness */
    YB_BITS_FRAME,   /* heights of corners */
    YB_BITS_STARTS,  /* where lines begin, and how many there are */
    YB_BITS_HEIGHTS, /* of lines */
    YB_BITS_LENGTHS, /* of steps, and where lines end */
    YB_BITS_TURNS,   /* of steps */
    YB_BITS_SPOT_PLACES,
    YB_BITS_SPOT_HEIGHTS,
    YB_BITS_KINDS
} yb_bits_kind_t;

/* Fractions of bits: what the decisions were worth. Set to 0 before; by_kind if that is wanted. */
typedef struct {
    bool by_kind;
    double of[YB_BITS_KINDS];
    double all; /* with version, padding and check */
} yb_bits_t;

#endif
