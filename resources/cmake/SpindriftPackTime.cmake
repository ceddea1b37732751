# SPDX-License-Identifier: GPL-3.0-or-later
# Read by cpack before it packs.
include(${CMAKE_CURRENT_LIST_DIR}/SpindriftPackageDate.cmake)
# cpack makes folders and the archive itself as the umask says: /usr would be closed to others, the bytes would differ.
execute_process(COMMAND sh -c umask OUTPUT_VARIABLE umask OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT umask MATCHES "^0*22$")
  message(FATAL_ERROR "The umask is ${umask}, so folders of the package would not be readable for all; allowed: 022. "
                      "Run: umask 022 && cpack ...")
endif()
