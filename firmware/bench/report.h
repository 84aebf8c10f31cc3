/* How a program on a board tells whoever watches it from outside what it does and needs: lines on
 * the console, two functions whose calls can be counted between, the depth of the stack.
 */
#ifndef YB_REPORT_H
#define YB_REPORT_H

#include <stdint.h>

/* A counter of instructions (tests/budget/count.c) starts at the first and stops at the second. */
void yb_mark_begin(void);
void yb_mark_end(void);

void report_text(const char *text);

/* WORD NAME NUMBER; the name comes in two parts for those that are made of two. */
void report_line(const char *word, const char *name, const char *rest, uint32_t number);

/* Fills what the stack has not reached yet. */
void report_paint_stack(void);

/* Bytes that it has used since, counted from where report_paint_stack was called. */
uint32_t report_stack_used(void);

/* Ends the emulator by semihosting, on Arm. */
void report_leave(void);

#endif
