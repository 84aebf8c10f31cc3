/* Writes plans as codes of the compact profile, and codes of any decisions whatever. */
#ifndef TEST_COMPACT_PLAN_H
#define TEST_COMPACT_PLAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "plan.h"

enum {
    COMPACT_MODELS = 128,
    COMPACT_MOST_BYTES = 4096
};

/* The numbers that lead to the decisions written so far: low … low + range - 1, low in bytes. */
typedef struct {
    uint8_t low[COMPACT_MOST_BYTES];
    size_t count;
    uint32_t range;
    uint16_t model[COMPACT_MODELS];
} compact_pen_t;

void compact_begin_code(compact_pen_t *pen);
void compact_one_of(compact_pen_t *pen, uint32_t count, uint32_t value);
void compact_bit(compact_pen_t *pen, int model, bool bit);
void compact_number(compact_pen_t *pen, int model, int value);
void compact_signed(compact_pen_t *pen, int model, int value);
void compact_difference(compact_pen_t *pen, int model, int down, int value);

/* Sections, each with its head, may be given. Returns the length, check included. */
size_t compact_end_code(compact_pen_t *pen, int seed, const uint8_t *sections, size_t size,
                        uint8_t *code);

/* The header's elements, as coded. */
typedef struct {
    int cell_exponent, cell_mantissa;
    int spacing; /* in steps; the plan's longer side has ⌊255 / spacing⌋ of them */
    int unit_exponent, unit_mantissa;
    int interval; /* 1, 2, 4 or 8 units */
    int base;     /* in units */
    int dimension, gain;
    int vertices; /* class of V */
} compact_head_t;

void compact_put_head(compact_pen_t *pen, const compact_head_t *head, const plan_t *plan);

/* What the paper profile says of the same head, set in the plan: the two codes are of one map, but
 * for V.
 */
void compact_head_of_plan(const compact_head_t *head, plan_t *plan);

/* The plan's contours in steps of the head's spacing, spot heights last and row by row (sort them
 * so for the same map). Heights are in units and may be negative. Returns the code's length.
 */
size_t compact_write(const plan_t *plan, const compact_head_t *head, uint8_t *code);

/* Lines first, then spot heights row by row: the order of a compact code. */
void compact_sort(plan_t *plan);

#endif
