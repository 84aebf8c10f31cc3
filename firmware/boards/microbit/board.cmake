yb_board(boards/microbit/board.c boards/microbit/microbit.ld)
yb_viewer(boards/microbit/main.c)

# 12 KB, but for the stack.
yb_bench(11392)
yb_golden(8)
