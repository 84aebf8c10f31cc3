/* Two GPIO lines set by libgpiod and nothing around it: what the bus's speed is measured against.
 * One file per version. */
#ifndef YB_BARE_LINES_H
#define YB_BARE_LINES_H

#include <stdbool.h>

/* Takes both lines of the chip as outputs; they are held until the program ends. */
bool bare_lines_take(const char *path, unsigned clock, unsigned data);

/* Sends `bits` bits, alternately 0 and 1: for each, data with the clock low, then the clock. */
bool bare_lines_send(unsigned bits);

#endif
