# Big-endian, for programs without a C library that run under qemu-ppc.
set(CMAKE_SYSTEM_PROCESSOR powerpc)
set(YB_TOOLS powerpc-linux-gnu)
set(YB_FLAGS "-mcpu=powerpc -fno-pic -fno-pie -fno-stack-protector -isystem ${CMAKE_CURRENT_LIST_DIR}/freestanding")
include(${CMAKE_CURRENT_LIST_DIR}/bare.cmake)
