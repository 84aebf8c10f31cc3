# What `cmake --install` puts where; included at the end of the top CMakeLists.txt.
#   find_package(yamabiko)  gives yamabiko::engine, and yamabiko::panels where they are built
#                         (it speaks only the engine's types: link both);
#   pkg-config              knows them as yamabiko and yamabiko-panels.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/yamabiko)
set(generated ${PROJECT_BINARY_DIR}/install)

install(TARGETS yb_api yb_engine EXPORT yamabikoTargets)
install(DIRECTORY engine/include/yamabiko DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET yb_panels)
    install(TARGETS yb_panels EXPORT yamabikoTargets)
    install(FILES platform/panels/panel.h platform/panels/update.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/yamabiko)
endif()

install(EXPORT yamabikoTargets NAMESPACE yamabiko:: DESTINATION ${package_dir})
configure_package_config_file(engine/yamabikoConfig.cmake.in ${generated}/yamabikoConfig.cmake
    INSTALL_DESTINATION ${package_dir})
# Until 1.0 a minor version may change the API and the code's bytes.
write_basic_package_version_file(${generated}/yamabikoConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${generated}/yamabikoConfig.cmake ${generated}/yamabikoConfigVersion.cmake
    DESTINATION ${package_dir})

# Relative to the .pc file, so that the installed tree can be moved.
if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR})
    set(pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
    file(RELATIVE_PATH pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
    string(REGEX REPLACE "/$" "" pc_prefix "\${pcfiledir}/${pc_prefix}")
endif()
function(yb_install_pc name)
    configure_file(engine/${name}.pc.in ${generated}/${name}.pc @ONLY)
    install(FILES ${generated}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
yb_install_pc(yamabiko)
if(TARGET yb_panels)
    yb_install_pc(yamabiko-panels)
endif()

if(TARGET yamabiko)
    install(TARGETS yamabiko)
    install(DIRECTORY docs/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN *.1)
    install(FILES host-tools/completion/yamabiko.bash RENAME yamabiko
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endif()
