yb_board(boards/lm3s6965evb/board.c boards/lm3s6965evb/lm3s6965evb.ld)
yb_viewer(boards/lm3s6965evb/main.c boards/lm3s6965evb/oled.c)
target_link_libraries(yamabiko-lm3s6965evb PRIVATE yamabiko::panels)

# 64 KB of RAM hold a full-height band of 128 x 64 beside the engine's structs.
yb_bench(23040)
yb_golden(12 LARGE ${few})
