# SPDX-License-Identifier: GPL-3.0-or-later
# What keeps a build short: headers of other projects are read once, files of one library are compiled several at a time, and
# what was compiled before is taken from ccache.
# Every file still includes what it uses: cmake --preset plain builds without any of this.

# ccache, where it is installed and no other launcher was asked for. A normal variable, so that it also holds in build
# folders that an older preset configured with "ccache".
find_program(SPINDRIFT_CCACHE ccache)
mark_as_advanced(SPINDRIFT_CCACHE)
foreach(language C CXX)
  if(SPINDRIFT_CCACHE AND "${CMAKE_${language}_COMPILER_LAUNCHER}" MATCHES "^(ccache)?$")
    # Without the first two kinds of sloppiness, ccache passes every file with a precompiled header on to the compiler; the
    # third: what is compiled is the same in every language. Places below the top are taken relative to it, so that a second
    # clone finds what the first has compiled.
    set(CMAKE_${language}_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,locale
                                            CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${SPINDRIFT_CCACHE})
  endif()
endforeach()
# Places in messages of assertions begin at the top: no folder of the machine that built it in a program, and the same text to
# compile in every clone.
add_compile_options(-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=)
# mold, where it is installed: a program with a window is linked in half a second instead of five, and there are a hundred.
find_program(SPINDRIFT_MOLD mold)
mark_as_advanced(SPINDRIFT_MOLD)
if(SPINDRIFT_MOLD AND (CMAKE_CXX_COMPILER_ID MATCHES Clang OR CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12.1))
  add_link_options(-fuse-ld=mold)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # ccache asks for it: the preprocessed text then names the precompiled header.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  # The compiler collects garbage when its heap passes 128 MB, which a precompiled header fills at once: a tenth of the time.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=500000>)
endif()

# The headers to be read once: of other projects only, for ours change, and each change would build everything again. They are
# listed in files, for CMake does not notice a change of a list.
set(SPINDRIFT_CORE_HEADERS ${CMAKE_SOURCE_DIR}/resources/precompiled/core.h)
set(SPINDRIFT_TEST_HEADERS ${CMAKE_SOURCE_DIR}/resources/precompiled/tests.h)
set(SPINDRIFT_QT_HEADERS ${CMAKE_SOURCE_DIR}/resources/precompiled/qt.h)

# spindrift_precompiled(<name> HEADERS h ... LINK lib ...)
# A target that holds nothing but a precompiled header, for targets of the same flags to reuse. g++ takes a precompiled header
# only if every macro that was defined for it is defined alike, so LINK is what all of those targets have in common.
function(spindrift_precompiled name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINK" ${ARGN})
  file(CONFIGURE OUTPUT ${name}.cpp CONTENT "// Made by CMake: a target needs a source.\n" @ONLY)
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE spindrift_options ${ARG_LINK})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
  set_target_properties(${name} PROPERTIES AUTOMOC OFF AUTORCC OFF)
endfunction()

# spindrift_quick_to_compile(<target>)
# For code that waits for files, people and the libraries (window, command line, tests): optimised as far as it costs nothing to
# compile, a quarter of the time less. The header precompiled for it has to be made with the same.
function(spindrift_quick_to_compile target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  # So little inlined, g++ 12 reports one more kind of false positive from inside the standard library.
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-stringop-overread>)
endfunction()

# spindrift_unity(<target> [<files at once>])
# Compiles the files of a target several at a time (CMake's unity build): templates of Eigen, json and fmt that each of them uses
# are made once a batch. A file that cannot share (macros of its own, headers with options of their own) says so with
# SKIP_UNITY_BUILD_INCLUSION. Names in anonymous namespaces are to differ within a library.
option(SPINDRIFT_UNITY "Compile several files of a library at once" ON)
function(spindrift_unity target)
  set(batch 8)
  if(ARGC GREATER 1)
    set(batch ${ARGV1})
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SPINDRIFT_UNITY} UNITY_BUILD_BATCH_SIZE ${batch})
endfunction()
