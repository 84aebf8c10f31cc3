/* The registers of the LM3S6965 that the handheld uses; names as in its datasheet. */
#ifndef YB_LM3S6965_H
#define YB_LM3S6965_H

#include <stdint.h>

#define YB_REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

/* System control. */
#define SYSCTL_RIS YB_REGISTER(0x400FE050)
#define SYSCTL_RIS_PLL_LOCKED (1u << 6)
#define SYSCTL_RCC YB_REGISTER(0x400FE060)
#define SYSCTL_RCC_SYSDIV(n) (((n)-1u) << 23)
#define SYSCTL_RCC_SYSDIV_MASK (15u << 23)
#define SYSCTL_RCC_USE_SYSDIV (1u << 22)
#define SYSCTL_RCC_PLL_OFF (1u << 13)
#define SYSCTL_RCC_BYPASS (1u << 11)
#define SYSCTL_RCC_CRYSTAL_8MHZ (14u << 6)
#define SYSCTL_RCC_CRYSTAL_MASK (15u << 6)
#define SYSCTL_RCC_SOURCE_MASK (3u << 4) /* 0: the main oscillator */
#define SYSCTL_RCC_MAIN_OFF (1u << 0)
#define SYSCTL_RCGC1 YB_REGISTER(0x400FE104)
#define SYSCTL_RCGC1_UART0 (1u << 0)
#define SYSCTL_RCGC1_SSI0 (1u << 4)
#define SYSCTL_RCGC2 YB_REGISTER(0x400FE108)
#define SYSCTL_RCGC2_GPIO_A (1u << 0)
#define SYSCTL_RCGC2_GPIO_C (1u << 2)
#define SYSCTL_RCGC2_GPIO_D (1u << 3)

/* General-purpose pins: a port's registers from its base address. */
#define GPIO_A 0x40004000u
#define GPIO_C 0x40006000u
#define GPIO_D 0x40007000u
/* Reads and writes only the pins of the mask. */
#define GPIO_DATA(port, mask) YB_REGISTER((port) + ((mask) << 2))
#define GPIO_DIR(port) YB_REGISTER((port) + 0x400u)
#define GPIO_AFSEL(port) YB_REGISTER((port) + 0x420u)
#define GPIO_DEN(port) YB_REGISTER((port) + 0x51Cu)

/* UART 0, a PL011. */
#define UART0_DR YB_REGISTER(0x4000C000)
#define UART0_FR YB_REGISTER(0x4000C018)
#define UART_FR_BUSY (1u << 3)
#define UART_FR_RECEIVE_EMPTY (1u << 4)
#define UART_FR_TRANSMIT_FULL (1u << 5)
#define UART0_IBRD YB_REGISTER(0x4000C024)
#define UART0_FBRD YB_REGISTER(0x4000C028)
#define UART0_LCRH YB_REGISTER(0x4000C02C)
#define UART_LCRH_FIFOS (1u << 4)
#define UART_LCRH_8_BITS (3u << 5)
#define UART0_CTL YB_REGISTER(0x4000C030)
#define UART_CTL_ENABLE (1u << 0)
#define UART_CTL_TRANSMIT (1u << 8)
#define UART_CTL_RECEIVE (1u << 9)

/* SSI 0, a PL022. */
#define SSI0_CR0 YB_REGISTER(0x40008000)
#define SSI_CR0_8_BITS 7u /* Motorola's format, clock low when idle, data taken as it rises */
#define SSI0_CR1 YB_REGISTER(0x40008004)
#define SSI_CR1_ENABLE (1u << 1)
#define SSI0_DR YB_REGISTER(0x40008008)
#define SSI0_SR YB_REGISTER(0x4000800C)
#define SSI_SR_TRANSMIT_ROOM (1u << 1)
#define SSI_SR_RECEIVED (1u << 2)
#define SSI_SR_BUSY (1u << 4)
#define SSI0_CPSR YB_REGISTER(0x40008010)
#define SSI0_IM YB_REGISTER(0x40008014)
#define SSI_IM_TRANSMIT (1u << 3) /* the transmit FIFO is at most half full */

/* The core's interrupt controller. */
#define NVIC_ENABLE_0 YB_REGISTER(0xE000E100)
#define NVIC_SSI0 (1u << 7)

/* The core's timer. */
#define SYSTICK_CTRL YB_REGISTER(0xE000E010)
#define SYSTICK_CTRL_ENABLE (1u << 0)
#define SYSTICK_CTRL_CORE_CLOCK (1u << 2)
#define SYSTICK_CTRL_COUNTED (1u << 16)
#define SYSTICK_LOAD YB_REGISTER(0xE000E014)
#define SYSTICK_VALUE YB_REGISTER(0xE000E018)

#endif
