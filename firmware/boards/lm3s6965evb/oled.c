/* Pins: PA2 clock, PA5 data, PA3 chip select (low: the OLED), PC7 command or data, PC6 the glass's
 * 15 V supply, PD0 chip select of the microSD card that shares the bus (high: not the card).
 */
#include "oled.h"

#include "cortex_m/vectors.h"
#include "lm3s6965.h"

#define PIN_A_SSI 0x24u
#define PIN_A_OLED_SELECT 0x08u
#define PIN_C_DATA 0x80u
#define PIN_C_SUPPLY 0x40u
#define PIN_D_CARD_SELECT 0x01u

#define CORE_HZ 50000000u
/* 50 MHz / 14 = 3.57 MHz: the SSD0323 takes at most 4. An even number, 2 to 254. */
#define SSI_DIVIDER 14u

void yb_oled_start(void)
{
    SYSCTL_RCGC1 |= SYSCTL_RCGC1_SSI0;
    SYSCTL_RCGC2 |= SYSCTL_RCGC2_GPIO_A | SYSCTL_RCGC2_GPIO_C | SYSCTL_RCGC2_GPIO_D;
    (void)SYSCTL_RCGC2; /* a module answers three clocks after it gets its own */

    GPIO_DATA(GPIO_D, PIN_D_CARD_SELECT) = PIN_D_CARD_SELECT;
    GPIO_DIR(GPIO_D) |= PIN_D_CARD_SELECT;
    GPIO_DEN(GPIO_D) |= PIN_D_CARD_SELECT;
    /* Once more: a pin that was an input while written has not told its level. */
    GPIO_DATA(GPIO_D, PIN_D_CARD_SELECT) = PIN_D_CARD_SELECT;

    GPIO_AFSEL(GPIO_A) |= PIN_A_SSI;
    GPIO_DIR(GPIO_A) |= PIN_A_OLED_SELECT;
    GPIO_DEN(GPIO_A) |= PIN_A_SSI | PIN_A_OLED_SELECT;
    GPIO_DATA(GPIO_A, PIN_A_OLED_SELECT) = 0;

    GPIO_DIR(GPIO_C) |= PIN_C_DATA | PIN_C_SUPPLY;
    GPIO_DEN(GPIO_C) |= PIN_C_DATA | PIN_C_SUPPLY;
    GPIO_DATA(GPIO_C, PIN_C_DATA | PIN_C_SUPPLY) = PIN_C_SUPPLY;

    SSI0_CR1 = 0;
    SSI0_CR0 = SSI_CR0_8_BITS;
    SSI0_CPSR = SSI_DIVIDER;
    SSI0_CR1 = SSI_CR1_ENABLE;
    NVIC_ENABLE_0 = NVIC_SSI0;
}

/* What is under way: bytes that the interrupt hands to the transmitter. */
static const uint8_t *volatile to_send;
static volatile size_t left;

/* Refills the transmit FIFO. What comes back means nothing, but an unread receive FIFO would
 * overrun, and QEMU's stops the transmitter. */
void yb_interrupt_7(void)
{
    while (left > 0 && (SSI0_SR & SSI_SR_TRANSMIT_ROOM)) {
        while (SSI0_SR & SSI_SR_RECEIVED)
            (void)SSI0_DR;
        SSI0_DR = *to_send;
        to_send = to_send + 1;
        left = left - 1;
    }
    if (left == 0)
        SSI0_IM = 0;
}

static bool finish(void *context)
{
    (void)context;
    while (left > 0) {
    }
    /* The last byte left the FIFO, but its last clock may still be running: D/C must not move yet.
     */
    while (SSI0_SR & SSI_SR_BUSY) {
    }
    while (SSI0_SR & SSI_SR_RECEIVED)
        (void)SSI0_DR;
    return true;
}

static void begin(uint32_t data_pin, const uint8_t *bytes, size_t count)
{
    (void)finish(NULL);
    GPIO_DATA(GPIO_C, PIN_C_DATA) = data_pin;
    to_send = bytes;
    left = count;
    SSI0_IM = SSI_IM_TRANSMIT;
}

static bool send_command(void *context, const uint8_t *bytes, size_t count)
{
    begin(0, bytes, count);
    return finish(context);
}

static bool send_data(void *context, const uint8_t *bytes, size_t count)
{
    begin(PIN_C_DATA, bytes, count);
    return finish(context);
}

/* The program goes on while the interrupt sends. */
static bool send_pixels(void *context, const uint8_t *bytes, size_t count)
{
    (void)context;
    begin(PIN_C_DATA, bytes, count);
    return true;
}

static void wait_ms(void *context, uint32_t ms)
{
    (void)context;
    SYSTICK_LOAD = CORE_HZ / 1000u - 1u;
    SYSTICK_VALUE = 0;
    SYSTICK_CTRL = SYSTICK_CTRL_ENABLE | SYSTICK_CTRL_CORE_CLOCK;
    for (; ms > 0; ms--) {
        while (!(SYSTICK_CTRL & SYSTICK_CTRL_COUNTED)) {
        }
    }
    SYSTICK_CTRL = 0;
}

/* The display's reset is the board's. */
const yb_panel_bus_t yb_oled_bus = {.command = send_command,
                                    .data = send_data,
                                    .pixels = send_pixels,
                                    .finish = finish,
                                    .wait_ms = wait_ms};
