# What all Cortex-M targets share; YB_CPU is set by the file that includes this one.
set(CMAKE_SYSTEM_PROCESSOR arm)
set(YB_TOOLS arm-none-eabi)
set(YB_FLAGS "-mcpu=${YB_CPU} -mthumb")
include(${CMAKE_CURRENT_LIST_DIR}/bare.cmake)
