# SPDX-License-Identifier: GPL-3.0-or-later
# Helpers that give every target the same flags and names.

# Flags shared by everything that is compiled here.
add_library(spindrift_options INTERFACE)
target_include_directories(spindrift_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(
  spindrift_options INTERFACE -Wall -Wextra -Wpedantic $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
                              $<$<COMPILE_LANGUAGE:CXX>:-Woverloaded-virtual>
                              $<$<BOOL:${SPINDRIFT_WARNINGS_AS_ERRORS}>:-Werror>)
# g++ 12 reports false positives of these kinds from inside Eigen and the standard library when it inlines.
target_compile_options(spindrift_options INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow
                                                   -Wno-restrict
                                                   # designated initialisers leave the rest at its stated default on purpose
                                                   -Wno-missing-field-initializers)
if(SPINDRIFT_UNITY)
  # A constant of one file is no shadow on a local name of another that is compiled with it, and what one file defines is no header.
  target_compile_options(spindrift_options INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wshadow=local>
                                                     $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
else()
  target_compile_options(spindrift_options INTERFACE -Wshadow)
endif()
if(SPINDRIFT_SANITIZE)
  # Without vptr: it wants the typeinfo of classes of libraries that only modules load (cv::VideoCapture).
  target_compile_options(spindrift_options INTERFACE -fsanitize=${SPINDRIFT_SANITIZE} -fno-sanitize=vptr -fno-omit-frame-pointer
                                                     -fno-sanitize-recover=undefined)
  target_link_options(spindrift_options INTERFACE -fsanitize=${SPINDRIFT_SANITIZE})
  # Under the address sanitizer Eigen would allocate in another way than in the libraries that bring its templates along,
  # compiled without it, and each free what the other allocated. Memory of the sanitizer is aligned to 16 bytes as well.
  target_compile_definitions(spindrift_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
# What every test runs with. Sanitized programs are slower, report leaks of our own, and end at the first report.
set(SPINDRIFT_TEST_ENVIRONMENT QT_QPA_PLATFORM=offscreen LC_ALL=C.UTF-8)
# A test that takes longer hangs, on the slowest machine.
set(SPINDRIFT_TEST_TIMEOUT_S 1200)
if(SPINDRIFT_SANITIZE)
  list(APPEND SPINDRIFT_TEST_ENVIRONMENT
       ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1
       UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1)
  set(SPINDRIFT_TEST_TIMEOUT_S 5000)
endif()
target_compile_definitions(spindrift_options INTERFACE SPINDRIFT_VERSION="${PROJECT_VERSION}")

# spindrift_core_library(<folder> [QUICK] SOURCES a.cpp ... [LINK lib ...] [PRIVATE_LINK lib ...] [SYSTEM dir ...])
# One static library per core folder, named spindrift_<folder>, alias Spindrift::<folder>. QUICK: it computes nothing that takes
# time, see spindrift_quick_to_compile.
function(spindrift_core_library name)
  cmake_parse_arguments(ARG "QUICK" "" "SOURCES;LINK;PRIVATE_LINK;SYSTEM" ${ARGN})
  add_library(spindrift_${name} STATIC ${ARG_SOURCES})
  add_library(Spindrift::${name} ALIAS spindrift_${name})
  target_link_libraries(spindrift_${name} PUBLIC spindrift_options ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  if(ARG_QUICK)
    spindrift_quick_to_compile(spindrift_${name})
    target_precompile_headers(spindrift_${name} REUSE_FROM spindrift_quick_headers)
  else()
    target_precompile_headers(spindrift_${name} REUSE_FROM spindrift_core_headers)
  endif()
  spindrift_unity(spindrift_${name})
  if(ARG_SYSTEM)
    target_include_directories(spindrift_${name} SYSTEM PRIVATE ${ARG_SYSTEM})
  endif()
endfunction()

# spindrift_module(<name> FOR <folder> SOURCES a.cpp ... LINK lib ... [SYSTEM dir ...])
# A shared object that core/<folder> loads when it is first used (core/base/module.h): libraries of others behind one table of
# functions. It takes nothing else of core, and no sanitizer, whose run-time is that of the program.
function(spindrift_module name)
  cmake_parse_arguments(ARG "" "FOR" "SOURCES;LINK;SYSTEM" ${ARGN})
  add_library(spindrift_${name} MODULE ${ARG_SOURCES})
  string(REPLACE _ - file ${name})
  set_target_properties(
    spindrift_${name} PROPERTIES PREFIX "" OUTPUT_NAME spindrift-${file} LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/${SPINDRIFT_MODULES}
                                 CXX_VISIBILITY_PRESET hidden)
  target_include_directories(spindrift_${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_include_directories(spindrift_${name} SYSTEM PRIVATE ${ARG_SYSTEM})
  target_compile_options(spindrift_${name} PRIVATE -Wall -Wextra $<$<BOOL:${SPINDRIFT_WARNINGS_AS_ERRORS}>:-Werror>
                                                   -Wno-maybe-uninitialized -Wno-array-bounds)
  target_link_libraries(spindrift_${name} PRIVATE ${ARG_LINK})
  # What it takes is there, whoever loads it; libc is named also where all that it calls is of other libraries.
  target_link_options(spindrift_${name} PRIVATE -Wl,-z,defs -Wl,--no-as-needed)
  add_dependencies(spindrift_${ARG_FOR} spindrift_${name})
endfunction()

# spindrift_register_test(<name> [TIMED] [LABELS l ...] [PARTS <suffix>=<filter> ...])
# Registers a GoogleTest program with ctest as <name>; one that takes minutes in parts, <name>_<suffix>, so that several run
# at once and none takes too long on a slow machine. What no part names runs as <name>. The longest begin first
# (tests/seconds.txt). TIMED: something in it has to be in time, so that it takes two of the places of ctest -j.
function(spindrift_register_test name)
  cmake_parse_arguments(ARG "TIMED" "" "LABELS;PARTS" ${ARGN})
  set(tests ${name})
  set(named "")
  foreach(part ${ARG_PARTS})
    string(REGEX MATCH "^([^=]+)=(.+)$" parsed "${part}")
    add_test(NAME ${name}_${CMAKE_MATCH_1} COMMAND ${name} --gtest_filter=${CMAKE_MATCH_2})
    list(APPEND tests ${name}_${CMAKE_MATCH_1})
    string(APPEND named ":${CMAKE_MATCH_2}")
  endforeach()
  if(named)
    string(REGEX REPLACE "^:" "-" named "${named}")
    add_test(NAME ${name} COMMAND ${name} --gtest_filter=${named})
  else()
    add_test(NAME ${name} COMMAND ${name})
  endif()
  set_tests_properties(${tests} PROPERTIES TIMEOUT ${SPINDRIFT_TEST_TIMEOUT_S} LABELS "${ARG_LABELS}" ENVIRONMENT "${SPINDRIFT_TEST_ENVIRONMENT}")
  if(ARG_TIMED)
    set_tests_properties(${tests} PROPERTIES PROCESSORS 2)
  endif()
  spindrift_begin_long_tests_first(${tests})
endfunction()

# spindrift_begin_long_tests_first(<test> ...): by the seconds that tests/seconds.txt knows.
function(spindrift_begin_long_tests_first)
  file(STRINGS ${CMAKE_SOURCE_DIR}/tests/seconds.txt known REGEX "^[0-9]")
  foreach(test ${ARGN})
    foreach(line ${known})
      if(line MATCHES "^([0-9]+) ${test}$")
        set_tests_properties(${test} PROPERTIES COST ${CMAKE_MATCH_1})
      endif()
    endforeach()
  endforeach()
endfunction()

# spindrift_test(<name> SOURCES a_test.cpp ... LINK lib ... [TIMED] [LABELS l ...] [PARTS <suffix>=<filter> ...])
# One GoogleTest program, registered with ctest as spindrift_register_test says.
function(spindrift_test name)
  cmake_parse_arguments(ARG "TIMED" "" "SOURCES;LINK;LABELS;PARTS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} spindrift_test_support)
  target_precompile_headers(${name} REUSE_FROM spindrift_test_headers)
  spindrift_unity(${name})
  spindrift_quick_to_compile(${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(ARG_TIMED)
    set(timed TIMED)
  endif()
  spindrift_register_test(${name} ${timed} LABELS ${ARG_LABELS} PARTS ${ARG_PARTS})
endfunction()

# spindrift_benchmark(<name> SOURCES a.cpp ... LINK lib ...): a program of its own in build/benchmarks, not run by ctest.
function(spindrift_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} spindrift_options)
  # Qt's flags differ.
  if(NOT Spindrift::widgets IN_LIST ARG_LINK)
    target_precompile_headers(${name} REUSE_FROM spindrift_core_headers)
    spindrift_unity(${name})
  endif()
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/benchmarks)
endfunction()
