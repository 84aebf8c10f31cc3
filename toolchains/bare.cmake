# What all targets without an operating system share; the file that includes this one has set
# CMAKE_SYSTEM_PROCESSOR, YB_TOOLS (what the names of its tools begin with) and YB_FLAGS.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_C_COMPILER ${YB_TOOLS}-gcc)
set(CMAKE_OBJCOPY ${YB_TOOLS}-objcopy)
set(CMAKE_SIZE ${YB_TOOLS}-size)
# A bare-metal program needs the board's linker script, which CMake's compiler check has not.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_FLAGS_INIT "${YB_FLAGS} -ffreestanding -ffunction-sections -fdata-sections")
set(CMAKE_C_FLAGS_MINSIZEREL_INIT "-g")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
