# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed, and the Debian package: cpack --config build/CPackConfig.cmake (or cmake --build build --target package).
include(GNUInstallDirs)
install(TARGETS spindrift-cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET spindrift-fe)
  install(TARGETS spindrift-fe RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET spindrift)
  install(TARGETS spindrift RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(FILES resources/packaging/spindrift.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES resources/icons/spindrift.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
endif()
install(DIRECTORY resources/scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/spindrift)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spindrift RENAME copyright)

set(CPACK_GENERATOR DEB)
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
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded at run time, so no linked library tells of them.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-inter, libgl1-mesa-dri, libegl1, libqt6svg6")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "calculix-ccx")
include(CPack)
