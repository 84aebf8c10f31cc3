yb_firmware(yamabiko-microbit boards/microbit/main.c)

yb_firmware(bench-microbit bench/bench.c)
target_compile_definitions(bench-microbit PRIVATE BENCH_BAND_BYTES=2560)
