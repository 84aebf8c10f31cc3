# cmake -D SOURCE=… -D PRESET=… -P build_firmware.cmake: builds a board's firmware as the README
# says, so that the tests run what a user would.
foreach(step "--preset;${PRESET}" "--build;--preset;${PRESET}")
    execute_process(COMMAND ${CMAKE_COMMAND} ${step} WORKING_DIRECTORY ${SOURCE}
                    COMMAND_ERROR_IS_FATAL ANY)
endforeach()
