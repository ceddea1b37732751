# SPDX-License-Identifier: GPL-3.0-or-later
# Run while installing one component: writes its Debian changelog and, beside the desktop program, the AppStream data
# with the date of the package, and installs them. Set before: PROJECT_VERSION, sources, made, gzip, metainfo (empty, or the
# package of the desktop program), data, documents.
include(${CMAKE_CURRENT_LIST_DIR}/SpindriftPackageDate.cmake)
string(TIMESTAMP package_date "%Y-%m-%d" UTC)
# Names of days and months in English, whatever the locale of whoever builds it.
string(TIMESTAMP package_date_rfc "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "Spindrift maintainers <spindrift@example.org>")
configure_file(${sources}/resources/packaging/changelog.in ${made}/changelog @ONLY)
configure_file(${sources}/CHANGELOG.md ${made}/NEWS COPYONLY)
execute_process(COMMAND ${gzip} -9nfk ${made}/changelog ${made}/NEWS COMMAND_ERROR_IS_FATAL ANY)
file(INSTALL ${made}/changelog.gz ${made}/NEWS.gz DESTINATION ${documents})
if(metainfo STREQUAL spindrift)
  configure_file(${sources}/resources/packaging/org.example.spindrift.metainfo.xml.in
                 ${made}/org.example.spindrift.metainfo.xml @ONLY)
  file(INSTALL ${made}/org.example.spindrift.metainfo.xml DESTINATION ${data}/metainfo)
endif()
