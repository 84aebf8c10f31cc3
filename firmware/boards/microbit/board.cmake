yb_firmware(yamabiko-microbit boards/microbit/main.c)

# 16 KB hold the viewer's band and no more.
yb_bench(2560)
