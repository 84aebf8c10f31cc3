/* Interrupts that a board's driver may handle: by number, as the chip counts them. */
#ifndef YB_VECTORS_H
#define YB_VECTORS_H

void yb_interrupt_7(void);

#endif
