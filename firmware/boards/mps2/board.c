/* Arm's MPS2 with one of the images AN385 (Cortex-M3), AN386 (Cortex-M4) or AN500 (Cortex-M7):
 * megabytes of RAM, for measuring what small boards have no room for. Console on the CMSDK's UART
 * 0.
 */
#include "board.h"

#define UART_REGISTER(offset) (*(volatile uint32_t *)(uintptr_t)(0x40004000u + (offset)))
#define UART_DATA UART_REGISTER(0x00)
#define UART_STATE UART_REGISTER(0x04)
#define UART_STATE_TRANSMIT_FULL (1u << 0)
#define UART_STATE_RECEIVED (1u << 1)
#define UART_CTRL UART_REGISTER(0x08)
#define UART_CTRL_TRANSMIT (1u << 0)
#define UART_CTRL_RECEIVE (1u << 1)
#define UART_BAUDDIV UART_REGISTER(0x10)

#define CORE_HZ 25000000u
#define BAUD 115200u

const char yb_board_name[] = YB_BOARD_NAME;

void yb_board_init(void)
{
    UART_BAUDDIV = (CORE_HZ + BAUD / 2u) / BAUD;
    UART_CTRL = UART_CTRL_TRANSMIT | UART_CTRL_RECEIVE;
}

int yb_board_read(void *context)
{
    (void)context;
    if (!(UART_STATE & UART_STATE_RECEIVED))
        return -1;
    return (int)(UART_DATA & 0xffu);
}

void yb_board_write(void *context, char character)
{
    (void)context;
    while (UART_STATE & UART_STATE_TRANSMIT_FULL) {
    }
    UART_DATA = (uint8_t)character;
}
