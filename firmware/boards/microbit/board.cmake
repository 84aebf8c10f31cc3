yb_firmware(yamabiko-microbit boards/microbit/main.c)
