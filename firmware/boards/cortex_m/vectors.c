/* The vector table of every Cortex-M: the two core exceptions that matter. No board of ours uses
 * interrupts, so it ends with the core's.
 */
#include <stddef.h>

#include "board.h"
#include "common/start.h"

typedef void (*vector_t)(void);

typedef struct {
    uint32_t *stack;
    vector_t handler[15];
} vectors_t;

__attribute__((section(".vectors"), used)) static const vectors_t vectors = {
    .stack = yb_stack_top,
    .handler = {yb_start, yb_stop, yb_stop, yb_stop, yb_stop, yb_stop, NULL, NULL, NULL, NULL,
                yb_stop, yb_stop, NULL, yb_stop, yb_stop},
};
