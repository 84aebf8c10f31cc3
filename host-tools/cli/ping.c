#include "cli.h"

#include <getopt.h>
#include <jansson.h>
#include <stdio.h>

#include <usb_link.h>

enum {
    OPTION_USB = 256,
    OPTION_JSON,
    OPTION_HELP
};

static const struct option options[] = {{"usb", no_argument, NULL, OPTION_USB},
                                        {"json", no_argument, NULL, OPTION_JSON},
                                        {"help", no_argument, NULL, OPTION_HELP},
                                        {0}};

static void help(void)
{
    puts("Usage: yamabiko ping --usb [--json]\n"
         "\n"
         "Looks for a handheld on USB and asks who it is. Exit code 0: one answered; 1: there is\n"
         "none, or it did not answer (one sentence says which).\n"
         "\n"
         "  --usb    look on the USB\n"
         "  --json   print where it is and which version of the protocol it speaks\n"
         "  --help   this text");
}

static int run(bool json)
{
    char message[YB_USB_MESSAGE_BYTES];
    yb_usb_device_t device = {0};
    if (yb_usb_ping(&device, message, sizeof message) != YB_USB_FOUND)
        return cli_fail("%s", message);
    if (!json) {
        puts(message);
        return CLI_OK;
    }
    json_t *object = json_pack("{s:i, s:i, s:i}", "bus", device.bus, "address", device.address,
                               "protocol", device.protocol);
    json_dumpf(object, stdout, JSON_INDENT(2));
    putchar('\n');
    json_decref(object);
    return CLI_OK;
}

int cli_ping(int argc, char **argv)
{
    bool usb = false;
    bool json = false;
    int answer = 0;
    while ((answer = getopt_long(argc, argv, ":", options, NULL)) != -1) {
        switch (answer) {
        case OPTION_USB:
            usb = true;
            break;
        case OPTION_JSON:
            json = true;
            break;
        case OPTION_HELP:
            help();
            return CLI_OK;
        default:
            return cli_bad_option(answer, argc, argv);
        }
    }
    if (optind != argc)
        return cli_usage("'%s' is one word too many", argv[optind]);
    return usb ? run(json) : cli_usage("say where to look: --usb");
}
