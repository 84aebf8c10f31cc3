/* What the start-up code of a processor (its interrupt vectors, or its first instructions) is built
 * on.
 */
#ifndef YB_START_H
#define YB_START_H

/* Sets memory up and runs main; the stack is there, nothing else. Never returns. */
void yb_start(void);

/* Faults end here, where a debugger finds them. */
void yb_stop(void);

#endif
