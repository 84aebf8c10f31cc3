/* From reset to main, for every Cortex-M: the two core exceptions that matter, and .data and .bss
 * as C expects them. No board of ours uses interrupts, so the vector table ends with the core's.
 */
#include <string.h>

#include "board.h"

extern uint32_t yb_data_source[];
extern uint32_t yb_data_start[];
extern uint32_t yb_data_end[];
extern uint32_t yb_bss_start[];
extern uint32_t yb_bss_end[];

int main(void);
void yb_reset(void);

typedef void (*vector_t)(void);

/* A fault stops here, where a debugger finds it. */
static void stop(void)
{
    for (;;) {
    }
}

void yb_reset(void)
{
    memcpy(yb_data_start, yb_data_source, (size_t)(yb_data_end - yb_data_start) * 4);
    memset(yb_bss_start, 0, (size_t)(yb_bss_end - yb_bss_start) * 4);
    (void)main();
    stop();
}

typedef struct {
    uint32_t *stack;
    vector_t handler[15];
} vectors_t;

__attribute__((section(".vectors"), used)) static const vectors_t vectors = {
    .stack = yb_stack_top,
    .handler = {yb_reset, stop, stop, stop, stop, stop, NULL, NULL, NULL, NULL, stop, stop, NULL,
                stop, stop},
};
