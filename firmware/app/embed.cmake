# yb_embed_map(FILE.yb OUTPUT.c): writes a C file that defines yb_built_in_map as the code's bytes.
# Run again by CMake when the code changes.
function(yb_embed_map code output)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${code})
    file(READ ${code} digits HEX)
    string(REGEX REPLACE "(..)" "0x\\1, " bytes "${digits}")
    string(REGEX REPLACE "(................................................................................................)" "\\1\n    "
           bytes "${bytes}")
    get_filename_component(name ${code} NAME)
    file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
/* @name@, embedded by the build. */
#include "turntable.h"

const uint8_t yb_built_in_map[] = {
    @bytes@
};
const size_t yb_built_in_map_bytes = sizeof yb_built_in_map;
]])
endfunction()
