yb_firmware(yamabiko-lm3s6965evb
    boards/lm3s6965evb/main.c boards/lm3s6965evb/oled.c)
target_link_libraries(yamabiko-lm3s6965evb PRIVATE yamabiko::panels)
