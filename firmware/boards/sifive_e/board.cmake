yb_board(boards/sifive_e/board.c boards/sifive_e/sifive_e.ld)
yb_golden(8)
