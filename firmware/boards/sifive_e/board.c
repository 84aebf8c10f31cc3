/* SiFive's E31 in QEMU: RV32IMAC, 16 KB of RAM, flash at 0x20400000. Console on UART 0. */
#include "board.h"

#define UART_REGISTER(offset) (*(volatile uint32_t *)(uintptr_t)(0x10013000u + (offset)))
#define UART_TXDATA UART_REGISTER(0x00)
#define UART_TXDATA_FULL (1u << 31)
#define UART_RXDATA UART_REGISTER(0x04)
#define UART_RXDATA_EMPTY (1u << 31)
#define UART_TXCTRL UART_REGISTER(0x08)
#define UART_RXCTRL UART_REGISTER(0x0c)
#define UART_CTRL_ENABLE 1u
#define UART_DIV UART_REGISTER(0x18)

#define CORE_HZ 16000000u
#define BAUD 115200u

/* The UART's pins, 16 and 17, are given to it. */
#define GPIO_IOF_EN (*(volatile uint32_t *)(uintptr_t)0x10012038u)
#define PINS_UART0 (3u << 16)

const char yb_board_name[] = "sifive_e";

void yb_board_init(void)
{
    GPIO_IOF_EN |= PINS_UART0;
    UART_DIV = CORE_HZ / BAUD - 1u;
    UART_TXCTRL = UART_CTRL_ENABLE;
    UART_RXCTRL = UART_CTRL_ENABLE;
}

int yb_board_read(void *context)
{
    (void)context;
    uint32_t received = UART_RXDATA;
    return (received & UART_RXDATA_EMPTY) != 0 ? -1 : (int)(received & 0xffu);
}

void yb_board_write(void *context, char character)
{
    (void)context;
    while (UART_TXDATA & UART_TXDATA_FULL) {
    }
    UART_TXDATA = (uint8_t)character;
}
