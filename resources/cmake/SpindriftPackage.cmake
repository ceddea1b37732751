# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed, and the Debian package: cpack --config build/CPackConfig.cmake (or cmake --build build --target package).
# Components: `runtime` is the programs (package spindrift), `dev` the compensator for controllers (package spindrift-dev).
include(GNUInstallDirs)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)
install(TARGETS spindrift-cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET spindrift-fe)
  install(TARGETS spindrift-fe RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET spindrift)
  install(TARGETS spindrift RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(FILES resources/packaging/spindrift.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES resources/icons/spindrift.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
endif()
install(DIRECTORY resources/scenarios resources/loop DESTINATION ${CMAKE_INSTALL_DATADIR}/spindrift)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift RENAME copyright)

# The compensator: its C header, one static library with all that it needs of the core, an example, pkg-config.
set(compensator_library ${CMAKE_BINARY_DIR}/lib/libspindrift-compensator.a)
file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/compensator.mri
     CONTENT "create ${compensator_library}
addlib $<TARGET_FILE:spindrift_thermal>
addlib $<TARGET_FILE:spindrift_machine>
addlib $<TARGET_FILE:spindrift_geometry>
addlib $<TARGET_FILE:spindrift_math>
addlib $<TARGET_FILE:spindrift_base>
save
end
")
add_custom_command(
  OUTPUT ${compensator_library} COMMAND ${CMAKE_COMMAND} -E rm -f ${compensator_library}
  COMMAND ${CMAKE_AR} -M < ${CMAKE_BINARY_DIR}/compensator.mri
  DEPENDS spindrift_thermal spindrift_machine spindrift_geometry spindrift_math spindrift_base ${CMAKE_BINARY_DIR}/compensator.mri
  VERBATIM)
add_custom_target(spindrift_compensator ALL DEPENDS ${compensator_library})
# Found from where the file stands, so that a copy of the tree works at any place.
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(resources/packaging/spindrift-compensator.pc.in spindrift-compensator.pc @ONLY)
file(READ tests/core/thermal/compensator_example.c compensator_example)
string(REPLACE "core/thermal/compensator_c.h" "spindrift/compensator.h" compensator_example "${compensator_example}")
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/compensator_example.c CONTENT "${compensator_example}" @ONLY)
install(FILES core/thermal/compensator_c.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spindrift RENAME compensator.h COMPONENT dev)
install(FILES ${compensator_library} DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
install(FILES ${CMAKE_BINARY_DIR}/spindrift-compensator.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
install(FILES ${CMAKE_BINARY_DIR}/compensator_example.c DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift-dev/examples COMPONENT dev)
install(FILES core/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift-dev RENAME copyright COMPONENT dev)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME spindrift)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME spindrift-dev)
set(CPACK_COMPONENT_DEV_DESCRIPTION "The thermal compensator of Spindrift for machine controllers: C header, static library, example.")
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libfmt-dev")
set(CPACK_PACKAGE_NAME spindrift)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "Spindrift maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_DESCRIPTION
    "Spindrift guides an operator through warm-up, capture, calibration and model fitting, shows where a machine goes wrong
 and by how much, predicts and compensates, and names the effect that a simulation lacks.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "Spindrift maintainers <spindrift@example.org>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Loaded at run time, so no linked library tells of them.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "fonts-inter, libgl1-mesa-dri, libegl1, libqt6svg6")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "calculix-ccx")
include(CPack)
