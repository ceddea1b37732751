# SPDX-License-Identifier: GPL-3.0-or-later
find_package(Qt6 6.4 REQUIRED COMPONENTS Widgets Test)
# Without Qt6::Test, which gives every folder a macro of its own.
spindrift_precompiled(spindrift_widget_test_headers HEADERS ${SPINDRIFT_CORE_HEADERS} ${SPINDRIFT_TEST_HEADERS} ${SPINDRIFT_QT_HEADERS}
                      LINK Spindrift::theme Spindrift::base Qt6::Widgets GTest::gtest GTest::gmock)
spindrift_quick_to_compile(spindrift_widget_test_headers)
# A main() that makes a QApplication on the offscreen platform; stands in for that of spindrift_test_support.
add_library(spindrift_widget_test_support STATIC ${CMAKE_SOURCE_DIR}/tests/widgets/support/widget_test_main.cpp
                                                  ${CMAKE_SOURCE_DIR}/tests/widgets/support/event_loop_watch.cpp
                                                  ${CMAKE_SOURCE_DIR}/tests/support/source_folder.cpp
                                                  ${CMAKE_SOURCE_DIR}/tests/support/temp_folder.cpp)
target_compile_definitions(spindrift_widget_test_support PRIVATE SPINDRIFT_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
set_target_properties(spindrift_widget_test_support PROPERTIES AUTOMOC ON)
target_link_libraries(spindrift_widget_test_support PUBLIC spindrift_options Spindrift::theme Qt6::Widgets Qt6::Test
                                                           Spindrift::base GTest::gtest GTest::gmock)

# spindrift_widget_test(<name> SOURCES ... LINK ...)
function(spindrift_widget_test name)
  cmake_parse_arguments(ARG "TIMED" "" "SOURCES;LINK;PARTS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} spindrift_widget_test_support)
  target_precompile_headers(${name} REUSE_FROM spindrift_widget_test_headers)
  spindrift_unity(${name})
  spindrift_quick_to_compile(${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(ARG_TIMED)
    set(timed TIMED)
  endif()
  spindrift_register_test(${name} ${timed} LABELS widgets PARTS ${ARG_PARTS})
endfunction()
