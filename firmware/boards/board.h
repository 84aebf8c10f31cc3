/* What every board gives to a program: its clocks and its console, and the memory that the linker
 * script laid out. One of boards/<board>/board.c is linked.
 */
#ifndef YB_BOARD_H
#define YB_BOARD_H

#include <stddef.h>
#include <stdint.h>

/* The board's name, as in its preset. */
extern const char yb_board_name[];

/* Starts the clocks and the console: 115200 baud, 8 bits, no parity. */
void yb_board_init(void);

/* The console's next character, or -1 if none has come. Never waits. */
int yb_board_read(void *context);

/* Sends a character, and waits for room if it has to. */
void yb_board_write(void *context, char character);

/* The map slot: the last 4 KB of flash, written apart from the program. */
extern const uint8_t yb_slot[];
#define YB_SLOT_BYTES 4096

/* What the linker script leaves to the stack: it grows down from yb_stack_top, and nothing else
 * lies above yb_stack_limit.
 */
extern uint32_t yb_stack_limit[];
extern uint32_t yb_stack_top[];

#endif
