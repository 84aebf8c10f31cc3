yb_board(boards/lm3s6965evb/board.c boards/lm3s6965evb/lm3s6965evb.ld)
yb_viewer(boards/lm3s6965evb/main.c boards/lm3s6965evb/oled.c)
target_link_libraries(yamabiko-lm3s6965evb PRIVATE yamabiko::panels)
# All of the screen at a time, whatever the map.
target_compile_definitions(yb_app PUBLIC YB_VIEWER_BAND_BYTES=4160)

# 64 KB of RAM hold 16 rows of 320 x 240 and more beside the engine's structs, and all of 128 x 64.
yb_bench(40960)
yb_golden(12 LARGE ${few})
