/* play_usb PORT PRODUCT IDENTITY
 *
 * Plays a USB device with our vendor number: the kernel's virtual host controller (vhci_hcd) gets
 * one end of a socket pair, and this program answers at the other end, in the USB/IP protocol, as a
 * device would on the wire (Documentation/usb/usbip_protocol.rst of the kernel). It is plugged into
 * port PORT until the program ends.
 *
 * PRODUCT is its product number, in hex. IDENTITY is what it answers to "who are you": bytes in
 * hex, or "refuse" to stall the request, or "silent" never to answer, or "vanish" to be unplugged
 * at that moment. */
#define _POSIX_C_SOURCE 200809L

#include "usb_link.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum {
    CMD_SUBMIT = 1,
    CMD_UNLINK = 2,
    RET_SUBMIT = 3,
    RET_UNLINK = 4,

    GET_DESCRIPTOR = 6,
    DEVICE_DESCRIPTOR = 1,
    CONFIGURATION_DESCRIPTOR = 2,
    REQUEST_IN = 0x80,

    SPEED_HIGH = 3,
    TRANSFER_MAX = 4096,
};

/* Both directions' header: 48 bytes, all words big-endian but `setup`. */
typedef struct {
    uint32_t command;
    uint32_t number;
    uint32_t device;
    uint32_t is_in;
    uint32_t endpoint;
    uint32_t words[5]; /* submit: flags, length, ...; its reply: status, length, ... */
    uint8_t setup[8];
} header_t;

typedef struct {
    int socket;
    uint8_t descriptor[18];
    uint8_t identity[32];
    size_t identity_bytes;
    bool refuses;
    bool is_silent;
    bool vanishes;
} player_t;

static const uint8_t configuration[] = {
    9,  CONFIGURATION_DESCRIPTOR,
    18, 0,
    1,  1,
    0,  0x80,
    50, /* one interface, 100 mA */
    9,  4,
    0,  0,
    0,  0xFF,
    0,  0,
    0, /* vendor class, endpoint 0 alone */
};

static bool receive(const player_t *player, void *bytes, size_t count)
{
    return count == 0 || recv(player->socket, bytes, count, MSG_WAITALL) == (ssize_t)count;
}

static bool answer(const player_t *player, const header_t *request, uint32_t command, int status,
                   const void *bytes, size_t count)
{
    header_t reply = {.command = htonl(command), .number = request->number};
    const bool is_in = request->is_in != 0;

    reply.words[0] = htonl((uint32_t)status);
    if (command == RET_SUBMIT)
        reply.words[1] = htonl((uint32_t)count);
    return send(player->socket, &reply, sizeof reply, 0) == (ssize_t)sizeof reply &&
           (!is_in || count == 0 || send(player->socket, bytes, count, 0) == (ssize_t)count);
}

/* A request to endpoint 0; `length` is the most that the host wants. */
static bool control(const player_t *player, const header_t *request, size_t length)
{
    const uint8_t *setup = request->setup;
    const uint8_t *bytes = NULL;
    size_t count = 0;

    if (setup[0] == YB_USB_REQUEST_TYPE && setup[1] == YB_USB_REQUEST_IDENTIFY) {
        if (player->vanishes)
            return false;
        if (player->is_silent)
            return true;
        if (player->refuses)
            return answer(player, request, RET_SUBMIT, -EPIPE, NULL, 0);
        bytes = player->identity;
        count = player->identity_bytes;
    } else if (setup[0] == REQUEST_IN && setup[1] == GET_DESCRIPTOR &&
               setup[3] == DEVICE_DESCRIPTOR) {
        bytes = player->descriptor;
        count = sizeof player->descriptor;
    } else if (setup[0] == REQUEST_IN && setup[1] == GET_DESCRIPTOR &&
               setup[3] == CONFIGURATION_DESCRIPTOR) {
        bytes = configuration;
        count = sizeof configuration;
    } else if ((setup[0] & REQUEST_IN) != 0) {
        return answer(player, request, RET_SUBMIT, -EPIPE, NULL, 0);
    }
    return answer(player, request, RET_SUBMIT, 0, bytes, count < length ? count : length);
}

static bool serve(const player_t *player)
{
    uint8_t out[TRANSFER_MAX];
    header_t request;

    while (receive(player, &request, sizeof request)) {
        if (ntohl(request.command) == CMD_UNLINK) {
            if (!answer(player, &request, RET_UNLINK, -ECONNRESET, NULL, 0))
                return false;
            continue;
        }
        const size_t length = ntohl(request.words[1]);
        if (ntohl(request.command) != CMD_SUBMIT || length > sizeof out ||
            (request.is_in == 0 && !receive(player, out, length)))
            return false;
        if (ntohl(request.endpoint) != 0) {
            if (!answer(player, &request, RET_SUBMIT, -EPIPE, NULL, 0))
                return false;
        } else if (!control(player, &request, length)) {
            return false;
        }
    }
    return true;
}

static bool read_identity(player_t *player, const char *text)
{
    player->refuses = strcmp(text, "refuse") == 0;
    player->is_silent = strcmp(text, "silent") == 0;
    player->vanishes = strcmp(text, "vanish") == 0;
    if (player->refuses || player->is_silent || player->vanishes)
        return true;
    for (; text[0] != '\0' && player->identity_bytes < sizeof player->identity; text += 2) {
        const char digits[] = {text[0], text[1], '\0'};
        char *end;
        player->identity[player->identity_bytes++] = (uint8_t)strtoul(digits, &end, 16);
        if (end != digits + 2)
            return false;
    }
    return player->identity_bytes > 0;
}

static bool plug_in(const char *port, int socket_of_host)
{
    static const char path[] = "/sys/devices/platform/vhci_hcd.0/attach";
    const unsigned long number = strtoul(port, NULL, 10);
    FILE *file = fopen(path, "w");

    if (file == NULL) {
        perror(path);
        return false;
    }
    fprintf(file, "%lu %d %lu %d", number, socket_of_host, (1UL << 16) + number + 1, SPEED_HIGH);
    if (fclose(file) != 0) {
        perror(path);
        return false;
    }
    return true;
}

int main(int argc, char **argv)
{
    player_t player = {.descriptor = {18, DEVICE_DESCRIPTOR, 0, 2, 0, 0, 0, 64}};
    int ends[2];

    if (argc != 4 || !read_identity(&player, argv[3])) {
        fputs("play_usb PORT PRODUCT IDENTITY\n", stderr);
        return 2;
    }
    const unsigned long product = strtoul(argv[2], NULL, 16);
    player.descriptor[8] = YB_USB_VENDOR & 0xFF;
    player.descriptor[9] = YB_USB_VENDOR >> 8;
    player.descriptor[10] = (uint8_t)product;
    player.descriptor[11] = (uint8_t)(product >> 8);
    player.descriptor[13] = 1; /* device 1.0; it has no strings */
    player.descriptor[17] = 1; /* one configuration */
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) {
        perror("socketpair");
        return 1;
    }
    player.socket = ends[1];
    if (!plug_in(argv[1], ends[0]))
        return 1;
    close(ends[0]);
    return serve(&player) ? 0 : 1;
}
