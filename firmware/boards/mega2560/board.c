/* Arduino Mega: ATmega2560, 8 KB of RAM, 16 MHz crystal. Console on USART 0. */
#include "board.h"

#include <avr/io.h>

/* 16 MHz / (8 * 115200) - 1, with the clock divided by 8 instead of 16. */
#define BAUD_DIVISOR 16u

const char yb_board_name[] = "mega2560";

void yb_board_init(void)
{
    UBRR0 = BAUD_DIVISOR;
    UCSR0A = 1u << U2X0;
    UCSR0B = 1u << TXEN0 | 1u << RXEN0;
    UCSR0C = 1u << UCSZ01 | 1u << UCSZ00;
}

int yb_board_read(void *context)
{
    (void)context;
    return (UCSR0A & 1u << RXC0) == 0 ? -1 : (int)UDR0;
}

void yb_board_write(void *context, char character)
{
    (void)context;
    while ((UCSR0A & 1u << UDRE0) == 0) {
    }
    UDR0 = (uint8_t)character;
}

/* The product r25:r22 of two signed numbers, r27:r26 and r19:r18, instead of libgcc's own function:
 * that ends with a return which is skipped or not, and there QEMU 7.2 goes round for ever.
 */
void __mulhisi3(void);

__attribute__((naked)) void __mulhisi3(void)
{
    __asm volatile("call __umulhisi3\n"
                   "tst r19\n"
                   "brpl 1f\n"
                   "sub r24, r26\n"
                   "sbc r25, r27\n"
                   "1: tst r27\n"
                   "brpl 2f\n"
                   "sub r24, r18\n"
                   "sbc r25, r19\n"
                   "2: ret");
}
