/* The first instructions of a RISC-V: it has no stack until they give it one. */
#include "common/start.h"

void yb_reset(void);

__attribute__((naked, section(".vectors"), used)) void yb_reset(void)
{
    __asm volatile("la sp, yb_stack_top\n"
                   "j yb_start");
}
