#include "report.h"

#include "board.h"

/* A byte, for a stack may be aligned to no more. */
#define PAINT 0xA5u
/* What a call may push between asking for the frame address and painting. */
#define PAINT_MARGIN_BYTES 64

/* The two differ, so that the compiler cannot make one function of both. */
__attribute__((noinline)) void yb_mark_begin(void)
{
    __asm volatile("nop" ::: "memory");
}

__attribute__((noinline)) void yb_mark_end(void)
{
    __asm volatile("nop\n\tnop" ::: "memory");
}

void report_text(const char *text)
{
    while (*text != '\0')
        yb_board_write(NULL, *text++);
}

static void report_number(uint32_t number)
{
    char digits[11];
    size_t at = sizeof digits - 1;
    digits[at] = '\0';
    do {
        digits[--at] = (char)('0' + number % 10u);
        number /= 10u;
    } while (number > 0);
    report_text(&digits[at]);
}

void report_line(const char *word, const char *name, const char *rest, uint32_t number)
{
    report_text(word);
    report_text(" ");
    report_text(name);
    report_text(rest);
    report_text(" ");
    report_number(number);
    report_text("\r\n");
}

static uint8_t *painted_to;

__attribute__((noinline)) void report_paint_stack(void)
{
    painted_to = (uint8_t *)__builtin_frame_address(0) - PAINT_MARGIN_BYTES;
    for (volatile uint8_t *at = (uint8_t *)yb_stack_limit; at < painted_to; at++)
        *at = PAINT;
}

uint32_t report_stack_used(void)
{
    const volatile uint8_t *at = (const uint8_t *)yb_stack_limit;
    while (at < painted_to && *at == PAINT)
        at++;
    return (uint32_t)(painted_to - at) + PAINT_MARGIN_BYTES;
}

#ifdef __arm__
/* SYS_EXIT with ADP_Stopped_ApplicationExit: the emulator ends with status 0. */
void report_leave(void)
{
    register uint32_t operation __asm("r0") = 0x18;
    register uint32_t reason __asm("r1") = 0x20026;
    __asm volatile("bkpt 0xAB" : "+r"(operation) : "r"(reason) : "memory");
}
#endif
