yb_board(boards/lm3s6965evb/board.c boards/lm3s6965evb/lm3s6965evb.ld)
yb_viewer(boards/lm3s6965evb/main.c boards/lm3s6965evb/oled.c)
target_link_libraries(yamabiko-lm3s6965evb PRIVATE yamabiko::panels)
# About half the screen at a time: one half is drawn while the other is on the wires.
target_compile_definitions(yb_app PUBLIC YB_VIEWER_BAND_BYTES=4608)

# 64 KB of RAM hold 18 rows of 320 x 240 beside the engine's structs, and all of 128 x 64.
yb_bench(40960)
yb_golden(12 LARGE ${few})
