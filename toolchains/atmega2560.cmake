# 8 KB of RAM: maps of 96 vertices, screens of 128 pixels. An int has 16 bits, so counts of type
# uint16_t and loops of type int are of different signs here, and nowhere else.
set(CMAKE_SYSTEM_PROCESSOR avr)
set(YB_TOOLS avr)
set(YB_FLAGS "-mmcu=atmega2560 -DYB_MAX_VERTICES=96 -DYB_MAX_SIDE=128 -Wno-sign-compare -Wno-sign-conversion")
include(${CMAKE_CURRENT_LIST_DIR}/bare.cmake)
