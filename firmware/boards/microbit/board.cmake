yb_board(boards/microbit/board.c boards/microbit/microbit.ld)
yb_viewer(boards/microbit/main.c)

# 16 KB hold the viewer's band and no more.
yb_bench(11520)
yb_golden(8)
