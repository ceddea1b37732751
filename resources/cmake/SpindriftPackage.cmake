# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed, and the Debian package: cpack --config build/CPackConfig.cmake (or cmake --build build --target package).
# Components: `runtime` is the programs (package spindrift), `dev` the compensator for controllers (package spindrift-dev).
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)
install(TARGETS spindrift-cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS spindrift_image_files spindrift_cloud_alignment LIBRARY DESTINATION ${SPINDRIFT_MODULES})
if(TARGET spindrift-fe)
  install(TARGETS spindrift-fe RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET spindrift)
  install(TARGETS spindrift RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(FILES resources/packaging/spindrift.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES resources/packaging/spindrift.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
  install(FILES resources/icons/spindrift.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
endif()
install(DIRECTORY resources/scenarios resources/loop DESTINATION ${CMAKE_INSTALL_DATADIR}/spindrift)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift)
install(FILES resources/packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift)

# Each program writes its own man page and completion, the icon is drawn in every size: made when they are built, so that
# what is installed is what the programs say of themselves.
set(package_folder ${CMAKE_BINARY_DIR}/package)
file(MAKE_DIRECTORY ${package_folder}/runtime)
file(CHMOD ${package_folder}/runtime PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
find_program(SPINDRIFT_GZIP gzip REQUIRED)
find_program(SPINDRIFT_RSVG rsvg-convert REQUIRED)
mark_as_advanced(SPINDRIFT_GZIP SPINDRIFT_RSVG)
set(package_files)
foreach(program spindrift-cli spindrift-fe spindrift)
  if(NOT TARGET ${program})
    continue()
  endif()
  set(run ${CMAKE_COMMAND} -E env QT_QPA_PLATFORM=offscreen XDG_RUNTIME_DIR=${package_folder}/runtime
      LC_ALL=C.UTF-8 $<TARGET_FILE:${program}>)
  add_custom_command(
    OUTPUT ${package_folder}/${program}.1.gz ${package_folder}/${program}.bash
    COMMAND ${run} --reference man > ${package_folder}/${program}.1
    COMMAND ${SPINDRIFT_GZIP} -9nf ${package_folder}/${program}.1
    COMMAND ${run} --reference bash > ${package_folder}/${program}.bash
    DEPENDS ${program} VERBATIM)
  list(APPEND package_files ${package_folder}/${program}.1.gz ${package_folder}/${program}.bash)
  install(FILES ${package_folder}/${program}.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${package_folder}/${program}.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          RENAME ${program})
endforeach()
if(TARGET spindrift)
  foreach(size 16 22 24 32 48 64 128 256 512)
    set(icon ${package_folder}/spindrift-${size}.png)
    add_custom_command(
      OUTPUT ${icon} COMMAND ${SPINDRIFT_RSVG} --width ${size} --height ${size} --output ${icon}
                             ${CMAKE_SOURCE_DIR}/resources/icons/spindrift.svg
      DEPENDS ${CMAKE_SOURCE_DIR}/resources/icons/spindrift.svg VERBATIM)
    list(APPEND package_files ${icon})
    install(FILES ${icon} DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/${size}x${size}/apps RENAME spindrift.png)
  endforeach()
endif()
foreach(ending html pdf)
  set(manual ${package_folder}/manual.${ending})
  add_custom_command(OUTPUT ${manual} COMMAND $<TARGET_FILE:spindrift-cli> manual --out ${manual} DEPENDS spindrift-cli VERBATIM)
  list(APPEND package_files ${manual})
  install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift)
endforeach()
# In other languages the window's program writes it, whose catalogues it takes.
if(TARGET spindrift)
  foreach(ending html pdf)
    set(manual ${package_folder}/manual-de.${ending})
    add_custom_command(
      OUTPUT ${manual} COMMAND ${CMAKE_COMMAND} -E env QT_QPA_PLATFORM=offscreen HOME=${package_folder}/home
                               $<TARGET_FILE:spindrift> --language de --manual ${manual} DEPENDS spindrift VERBATIM)
    list(APPEND package_files ${manual})
    install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift)
  endforeach()
endif()
add_custom_target(spindrift_package_files ALL DEPENDS ${package_files})

# What carries a date is written when it is installed: of the last commit, not of the last configuring.
foreach(component runtime dev)
  set(folder spindrift)
  if(component STREQUAL dev)
    set(folder spindrift-dev)
  endif()
  install(
    CODE "set(PROJECT_VERSION ${PROJECT_VERSION})
          set(sources \"${CMAKE_SOURCE_DIR}\")
          set(made \"${package_folder}/${folder}\")
          set(gzip \"${SPINDRIFT_GZIP}\")
          set(metainfo \"$<$<TARGET_EXISTS:spindrift>:${folder}>\")
          set(data \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
          set(documents \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/doc/${folder}\")
          include(${CMAKE_SOURCE_DIR}/resources/cmake/SpindriftDatedFiles.cmake)"
    COMPONENT ${component})
endforeach()

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
install(FILES resources/packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift-dev COMPONENT dev)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME spindrift)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME spindrift-dev)
set(CPACK_COMPONENT_DEV_DESCRIPTION "The thermal compensator of Spindrift for machine controllers: C header, static library, example.")
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libfmt-dev, libblis-serial-dev")
set(CPACK_PACKAGE_NAME spindrift)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "Spindrift maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "Spindrift guides an operator through warm-up, capture, calibration and model fitting, shows where a machine goes wrong
 and by how much, predicts and compensates, and names the effect that a simulation lacks.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# The same bytes whoever builds it: one date, one umask, one thread's order.
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_SOURCE_DIR}/resources/cmake/SpindriftPackTime.cmake)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_THREADS 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "Spindrift maintainers <spindrift@example.org>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
# Loaded at run time, so no linked library tells of them.
# What BLIS says of itself names all of its kinds: the one of one thread.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "libblis4-serial, fonts-inter, libgl1-mesa-dri, libegl1, libqt6svg6, qt6-translations-l10n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "calculix-ccx")
include(CPack)
