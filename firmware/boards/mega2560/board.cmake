yb_board(boards/mega2560/board.c boards/mega2560/mega2560.ld)
# Of those codes that ask for no more vertices than the toolchain file allows.
yb_golden(4
    tests/golden/coast.hex tests/golden/cone.hex tests/golden/spec-1-5.hex maps/big_butte.yb
    maps/mauna_kea.yb)
