/* ping_usb: looks for a handheld and says what it found. Exit code 0 only when one answered. */
#include "usb_link.h"

#include <stdio.h>

int main(void)
{
    char message[YB_USB_MESSAGE_BYTES];
    const yb_usb_result_t result = yb_usb_ping(NULL, message, sizeof message);

    puts(message);
    return result == YB_USB_FOUND ? 0 : 1;
}
