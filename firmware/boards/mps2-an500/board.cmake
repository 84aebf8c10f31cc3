yb_board(boards/mps2/board.c boards/mps2/mps2.ld)
yb_golden(240 LARGE ${few})
