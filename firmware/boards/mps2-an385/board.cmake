yb_board(boards/mps2/board.c boards/mps2/mps2.ld)
# Enough RAM for a full-height band of 320 x 240 in 16-bit colours.
yb_bench(204800)
