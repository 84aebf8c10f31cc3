#include "usb_link.h"

#include <libusb.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum {
    INTERFACE = 0,
    ANSWER_WITHIN_MS = 1000,
};

static yb_usb_result_t explain(libusb_device *device, int error, char *message,
                               size_t message_bytes)
{
    const unsigned bus = libusb_get_bus_number(device);
    const unsigned address = libusb_get_device_address(device);

    switch (error) {
    case LIBUSB_ERROR_ACCESS:
        snprintf(message, message_bytes,
                 "no permission to open the device at bus %u address %u; install 70-yamabiko.rules "
                 "for udev, or become root",
                 bus, address);
        break;
    case LIBUSB_ERROR_BUSY:
        snprintf(message, message_bytes,
                 "the device at bus %u address %u is busy: another program or a driver holds it",
                 bus, address);
        break;
    case LIBUSB_ERROR_PIPE:
        snprintf(message, message_bytes,
                 "the device at bus %u address %u has our numbers but is not a Yamabiko handheld: "
                 "it refused to say who it is",
                 bus, address);
        break;
    case LIBUSB_ERROR_TIMEOUT:
        snprintf(message, message_bytes,
                 "the device at bus %u address %u gave no answer within a second; plug it in again",
                 bus, address);
        break;
    case LIBUSB_ERROR_NO_DEVICE:
        snprintf(message, message_bytes,
                 "the device at bus %u address %u was unplugged while it was asked", bus, address);
        break;
    default:
        snprintf(message, message_bytes, "the device at bus %u address %u cannot be asked: %s", bus,
                 address, libusb_strerror(error));
        break;
    }
    return YB_USB_ERROR;
}

static yb_usb_result_t judge(libusb_device *device, const uint8_t *identity, int bytes,
                             yb_usb_device_t *found, char *message, size_t message_bytes)
{
    const uint8_t bus = libusb_get_bus_number(device);
    const uint8_t address = libusb_get_device_address(device);

    if (bytes != YB_USB_IDENTITY_BYTES || memcmp(identity, YB_USB_MAGIC, 3) != 0) {
        snprintf(message, message_bytes,
                 "the device at bus %u address %u has our numbers but is not a Yamabiko handheld: "
                 "it answered with something else",
                 bus, address);
        return YB_USB_ERROR;
    }
    if (identity[3] != YB_USB_PROTOCOL) {
        snprintf(message, message_bytes,
                 "the handheld at bus %u address %u speaks version %u of the link and this program "
                 "version %d; update the older one",
                 bus, address, identity[3], YB_USB_PROTOCOL);
        return YB_USB_ERROR;
    }
    snprintf(message, message_bytes, "a handheld answers at bus %u address %u", bus, address);
    if (found != NULL)
        *found = (yb_usb_device_t){.bus = bus, .address = address, .protocol = identity[3]};
    return YB_USB_FOUND;
}

static yb_usb_result_t ping_device(libusb_device *device, yb_usb_device_t *found, char *message,
                                   size_t message_bytes)
{
    yb_usb_result_t result;
    libusb_device_handle *handle = NULL;
    uint8_t identity[YB_USB_IDENTITY_BYTES];

    int status = libusb_open(device, &handle);
    if (status != 0)
        return explain(device, status, message, message_bytes);
    status = libusb_claim_interface(handle, INTERFACE);
    if (status != 0) {
        result = explain(device, status, message, message_bytes);
        goto close_device;
    }
    status = libusb_control_transfer(handle, YB_USB_REQUEST_TYPE, YB_USB_REQUEST_IDENTIFY, 0,
                                     INTERFACE, identity, sizeof identity, ANSWER_WITHIN_MS);
    result = status < 0 ? explain(device, status, message, message_bytes)
                        : judge(device, identity, status, found, message, message_bytes);
    libusb_release_interface(handle, INTERFACE);

close_device:
    libusb_close(handle);
    return result;
}

static bool has_our_numbers(libusb_device *device)
{
    struct libusb_device_descriptor descriptor;

    return libusb_get_device_descriptor(device, &descriptor) == 0 &&
           descriptor.idVendor == YB_USB_VENDOR && descriptor.idProduct == YB_USB_PRODUCT;
}

yb_usb_result_t yb_usb_ping(yb_usb_device_t *device, char *message, size_t message_bytes)
{
    yb_usb_result_t result = YB_USB_NONE;
    libusb_context *context = NULL;
    libusb_device **list = NULL;

    const int status = libusb_init(&context);
    if (status != 0) {
        snprintf(message, message_bytes, "USB is not to be had on this machine: %s",
                 libusb_strerror(status));
        return YB_USB_ERROR;
    }
    const ssize_t count = libusb_get_device_list(context, &list);
    if (count < 0) {
        snprintf(message, message_bytes, "the USB devices cannot be listed: %s",
                 libusb_strerror((int)count));
        result = YB_USB_ERROR;
        goto exit_usb;
    }
    snprintf(message, message_bytes, "no handheld is plugged in (no USB device %04x:%04x)",
             YB_USB_VENDOR, YB_USB_PRODUCT);
    for (ssize_t i = 0; i < count && result != YB_USB_FOUND; i++) {
        if (has_our_numbers(list[i]))
            result = ping_device(list[i], device, message, message_bytes);
    }
    libusb_free_device_list(list, 1);

exit_usb:
    libusb_exit(context);
    return result;
}
