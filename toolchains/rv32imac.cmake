set(CMAKE_SYSTEM_PROCESSOR riscv)
set(YB_TOOLS riscv64-unknown-elf)
# No small data: it wants a global pointer, and sections that other linker scripts have not.
set(YB_FLAGS "-march=rv32imac -mabi=ilp32 -msmall-data-limit=0 -isystem ${CMAKE_CURRENT_LIST_DIR}/freestanding")
include(${CMAKE_CURRENT_LIST_DIR}/bare.cmake)
