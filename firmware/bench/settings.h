/* The memory that the benches give a screen size, for all of it: map, frame and band in one piece,
 * and what the stack takes at most.
 */
#ifndef YB_SETTINGS_H
#define YB_SETTINGS_H

enum {
    STACK_BYTES = 1000,
    BYTES_12K = 12 * 1024 - STACK_BYTES, /* 128 x 64 */
    BYTES_32K = 32 * 1024 - STACK_BYTES  /* 320 x 240 */
};

/* The board's, one piece. */
#ifndef BENCH_BYTES
#error "BENCH_BYTES: the board's CMake file gives it"
#endif

#endif
