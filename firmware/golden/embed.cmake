# yb_embed_codes(OUTPUT.c CODE…): writes a C file that defines golden_codes (codes.h): the bytes of
# these files, .yb (bytes) or .hex (digits). Run again by CMake when one of them changes.
function(yb_embed_codes output)
    set(arrays "")
    set(rows "")
    foreach(code ${ARGN})
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${code})
        get_filename_component(name ${code} NAME_WE)
        if(code MATCHES "\\.hex$")
            file(READ ${code} digits)
            string(REGEX REPLACE "[^0-9a-f]" "" digits "${digits}")
        else()
            file(READ ${code} digits HEX)
        endif()
        string(REGEX REPLACE "(..)" "0x\\1, " bytes "${digits}")
        string(MAKE_C_IDENTIFIER ${name} array)
        string(APPEND arrays "static const uint8_t ${array}[] YB_ROM = {${bytes}};\n")
        string(APPEND rows "    {\"${name}\", ${array}, sizeof ${array}},\n")
    endforeach()
    list(LENGTH ARGN count)
    file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
/* Embedded by the build. */
#include "codes.h"

#include <yamabiko/rom.h>

@arrays@
const golden_code_t golden_codes[] = {
@rows@};
const size_t golden_code_count = @count@;
]])
endfunction()
