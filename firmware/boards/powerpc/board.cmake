yb_board(boards/powerpc/board.c)
target_link_options(yb_board PUBLIC -static)
yb_golden(16 LARGE ${few})
