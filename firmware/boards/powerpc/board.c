/* A big-endian PowerPC under Linux, without a C library: the console is standard output. */
#include "board.h"

enum {
    CALL_EXIT = 1,
    CALL_WRITE = 4,
    STANDARD_OUTPUT = 1,
    STACK_WORDS = 16384
};

const char yb_board_name[] = "powerpc";

int main(void);
void yb_linux_main(void);

/* A stack of its own, so that what is used of it can be measured as on a board. The two symbols
 * that a linker script makes elsewhere are its ends.
 */
__attribute__((used)) static uint32_t stack[STACK_WORDS + 4] __attribute__((aligned(16)));

__asm(".globl yb_stack_limit, yb_stack_top, _start\n"
      ".set yb_stack_limit, stack\n"
      ".set yb_stack_top, stack + 65536\n"
      ".text\n"
      "_start:\n"
      "    lis 1, yb_stack_top@ha\n"
      "    la 1, yb_stack_top@l(1)\n"
      "    li 0, 0\n"
      "    stw 0, 0(1)\n"
      "    bl yb_linux_main\n");

static long call(long number, long a, long b, long c)
{
    register long r0 __asm("r0") = number;
    register long r3 __asm("r3") = a;
    register long r4 __asm("r4") = b;
    register long r5 __asm("r5") = c;
    __asm volatile("sc"
                   : "+r"(r0), "+r"(r3), "+r"(r4), "+r"(r5)
                   :
                   : "r6", "r7", "r8", "r9", "r10", "r11", "r12", "cr0", "ctr", "memory");
    return r3;
}

__attribute__((used)) void yb_linux_main(void)
{
    (void)call(CALL_EXIT, main(), 0, 0);
}

void yb_board_init(void)
{
}

int yb_board_read(void *context)
{
    (void)context;
    return -1;
}

void yb_board_write(void *context, char character)
{
    (void)context;
    (void)call(CALL_WRITE, STANDARD_OUTPUT, (long)&character, 1);
}
