/* Luminary's (now TI's) LM3S6965 evaluation board: 8 MHz crystal, console on UART 0. */
#include "board.h"

#include "lm3s6965.h"

/* 50 MHz / (16 * 115200) = 27 + 8/64. */
#define BAUD_WHOLE 27u
#define BAUD_64THS 8u
#define PIN_A_UART 0x03u

const char yb_board_name[] = "lm3s6965evb";

/* The PLL makes 200 MHz of the crystal; a quarter of that is the fastest this part may run. In the
 * datasheet's order: divide nothing while the PLL starts, use it once it has locked.
 */
static void start_clock(void)
{
    uint32_t rcc = SYSCTL_RCC;
    rcc |= SYSCTL_RCC_BYPASS;
    rcc &= ~SYSCTL_RCC_USE_SYSDIV;
    SYSCTL_RCC = rcc;
    rcc &= ~(SYSCTL_RCC_MAIN_OFF | SYSCTL_RCC_SOURCE_MASK | SYSCTL_RCC_CRYSTAL_MASK |
             SYSCTL_RCC_PLL_OFF | SYSCTL_RCC_SYSDIV_MASK);
    rcc |= SYSCTL_RCC_CRYSTAL_8MHZ;
    SYSCTL_RCC = rcc;
    rcc |= SYSCTL_RCC_USE_SYSDIV | SYSCTL_RCC_SYSDIV(4u);
    SYSCTL_RCC = rcc;
    while (!(SYSCTL_RIS & SYSCTL_RIS_PLL_LOCKED)) {
    }
    SYSCTL_RCC = rcc & ~SYSCTL_RCC_BYPASS;
}

static void start_console(void)
{
    SYSCTL_RCGC1 |= SYSCTL_RCGC1_UART0;
    SYSCTL_RCGC2 |= SYSCTL_RCGC2_GPIO_A;
    (void)SYSCTL_RCGC2; /* a module answers three clocks after it gets its own */
    GPIO_AFSEL(GPIO_A) |= PIN_A_UART;
    GPIO_DEN(GPIO_A) |= PIN_A_UART;
    UART0_CTL = 0;
    UART0_IBRD = BAUD_WHOLE;
    UART0_FBRD = BAUD_64THS;
    UART0_LCRH = UART_LCRH_8_BITS | UART_LCRH_FIFOS;
    UART0_CTL = UART_CTL_ENABLE | UART_CTL_TRANSMIT | UART_CTL_RECEIVE;
}

void yb_board_init(void)
{
    start_clock();
    start_console();
}

int yb_board_read(void *context)
{
    (void)context;
    if (UART0_FR & UART_FR_RECEIVE_EMPTY)
        return -1;
    return (int)(UART0_DR & 0xffu);
}

void yb_board_write(void *context, char character)
{
    (void)context;
    while (UART0_FR & UART_FR_TRANSMIT_FULL) {
    }
    UART0_DR = (uint8_t)character;
}
