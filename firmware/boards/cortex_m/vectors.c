/* The vector table of every Cortex-M: the core's exceptions, and the first interrupts of the chip,
 * up to the last that a board of ours uses. A board's driver overrides the weak handler.
 */
#include <stddef.h>

#include "board.h"
#include "common/start.h"
#include "vectors.h"

typedef void (*vector_t)(void);

typedef struct {
    uint32_t *stack;
    vector_t handler[15];
    vector_t interrupt[8];
} vectors_t;

static void unexpected(void)
{
    yb_stop();
}

void yb_interrupt_7(void) __attribute__((weak, alias("unexpected")));

__attribute__((section(".vectors"), used)) static const vectors_t vectors = {
    .stack = yb_stack_top,
    .handler = {yb_start, yb_stop, yb_stop, yb_stop, yb_stop, yb_stop, NULL, NULL, NULL, NULL,
                yb_stop, yb_stop, NULL, yb_stop, yb_stop},
    .interrupt = {unexpected, unexpected, unexpected, unexpected, unexpected, unexpected,
                  unexpected, yb_interrupt_7},
};
