set(YB_CPU cortex-m0)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
# There are eight registers: what is taken out of loops, and structs that are handed on in pieces,
# would not stay in them.
string(APPEND CMAKE_C_FLAGS_MINSIZEREL_INIT
       " -fno-tree-loop-im -fno-move-loop-invariants -fno-ipa-sra")
