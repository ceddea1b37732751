# SPDX-License-Identifier: GPL-3.0-or-later
# Read by cpack and by what is installed: a package carries the date of the last commit, whoever builds it whenever and
# wherever (https://reproducible-builds.org/specs/source-date-epoch). A date that is set already is kept.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${CMAKE_CURRENT_LIST_DIR} log -1 --format=%ct OUTPUT_VARIABLE epoch
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  # Unpacked without its history: the day of the newest text on changes.
  if(NOT epoch MATCHES "^[0-9]+$")
    file(TIMESTAMP ${CMAKE_CURRENT_LIST_DIR}/../../CHANGELOG.md epoch "%s" UTC)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} ${epoch})
endif()
