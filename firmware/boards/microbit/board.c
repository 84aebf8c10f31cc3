/* BBC micro:bit: nRF51822, 16 KB of RAM, console on the USB chip's serial line. */
#include "board.h"

#include "nrf51.h"

#define PIN_TXD 24u
#define PIN_RXD 25u

const char yb_board_name[] = "microbit";

void yb_board_init(void)
{
    /* The serial line's timing needs the crystal; after reset the RC oscillator runs. */
    CLOCK_EVENTS_HFCLKSTARTED = 0;
    CLOCK_TASKS_HFCLKSTART = 1;
    while (!CLOCK_EVENTS_HFCLKSTARTED) {
    }
    /* Idle is high, also before the UART takes the pin over. */
    GPIO_OUTSET = 1u << PIN_TXD;
    GPIO_DIRSET = 1u << PIN_TXD;
    UART_PSELTXD = PIN_TXD;
    UART_PSELRXD = PIN_RXD;
    UART_BAUDRATE = UART_BAUDRATE_115200;
    UART_ENABLE = UART_ENABLE_ENABLED;
    UART_TASKS_STARTTX = 1;
    UART_TASKS_STARTRX = 1;
}

int yb_board_read(void *context)
{
    (void)context;
    if (!UART_EVENTS_RXDRDY)
        return -1;
    /* In this order: reading moves the FIFO on, which may raise the event anew. */
    UART_EVENTS_RXDRDY = 0;
    return (int)(UART_RXD & 0xffu);
}

void yb_board_write(void *context, char character)
{
    (void)context;
    UART_EVENTS_TXDRDY = 0;
    UART_TXD = (uint8_t)character;
    while (!UART_EVENTS_TXDRDY) {
    }
}
