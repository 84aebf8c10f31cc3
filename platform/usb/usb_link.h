/* The PC's end of the USB link to a handheld, over libusb.
 *
 * A handheld is a device with the vendor and product number below that answers the request "who
 * are you" with our four bytes. The numbers are pid.codes' shared test numbers, so other people's
 * prototypes carry them too: the answer decides, not the numbers.
 *
 *     bmRequestType  C1h   from the device, vendor, interface 0
 *     bRequest       01h   identify
 *     wLength        4     answer: 'Y' 'B' 'K' version
 */
#ifndef YB_USB_LINK_H
#define YB_USB_LINK_H

#include <stddef.h>
#include <stdint.h>

enum {
    YB_USB_VENDOR = 0x1209,
    YB_USB_PRODUCT = 0x0001,

    YB_USB_REQUEST_TYPE = 0xC1,
    YB_USB_REQUEST_IDENTIFY = 1,
    YB_USB_IDENTITY_BYTES = 4,
    YB_USB_PROTOCOL = 1, /* the only version there is so far */

    YB_USB_MESSAGE_BYTES = 240,
};

/* The first three bytes of the identity; the fourth is the version of the protocol. */
#define YB_USB_MAGIC "YBK"

typedef enum {
    YB_USB_FOUND = 0, /* a handheld answered */
    YB_USB_NONE = 1,  /* nothing with our numbers is plugged in */
    YB_USB_ERROR = -1 /* something is, and it could not be opened, or did not answer as ours */
} yb_usb_result_t;

typedef struct {
    uint8_t bus; /* as lsusb counts */
    uint8_t address;
    uint8_t protocol;
} yb_usb_device_t;

/* Asks every device with our numbers until one answers, at most a second each. `message` always
 * gets one sentence: what was found, that nothing was, or why not. `device` is filled in only for
 * YB_USB_FOUND, and may be NULL. */
yb_usb_result_t yb_usb_ping(yb_usb_device_t *device, char *message, size_t message_bytes);

#endif
