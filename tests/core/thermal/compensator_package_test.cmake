# SPDX-License-Identifier: GPL-3.0-or-later
# What the package spindrift-dev holds is enough for a controller in C: installed into an empty folder, its example is
# compiled and linked with what pkg-config says, and run.
#   cmake -DBUILD=... -DWORK=... -DCC=... -DMAIN=... -P compensator_package_test.cmake
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component dev --prefix ${WORK} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE pc ${WORK}/*/spindrift-compensator.pc)
file(GLOB_RECURSE example ${WORK}/*/compensator_example.c)
if(NOT pc OR NOT example)
  message(FATAL_ERROR "the package has no pkg-config file or no example")
endif()
file(GLOB_RECURSE programs ${WORK}/bin/*)
if(programs)
  message(FATAL_ERROR "programs belong to the other package: ${programs}")
endif()
get_filename_component(folder ${pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${folder})
execute_process(COMMAND pkg-config --cflags --libs spindrift-compensator OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
execute_process(COMMAND ${CC} -std=c99 -Wall -Werror -o ${WORK}/example ${MAIN} ${example} ${flags} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/example missing.json RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE said)
if(NOT status EQUAL 0 OR NOT out MATCHES "state 0" OR NOT said MATCHES "missing.json: cannot be read")
  message(FATAL_ERROR "the example ended with ${status}: ${out} ${said}")
endif()
file(WRITE ${WORK}/model.json [[
{"format":"spindrift-thermal-model","version":1,"kind":"lags","train_s":[0,100],"inputs":[{"name":"T_a_degC","kind":"temperature",
"power":1,"scale":1,"reference":20,"train_range":[15,35]}],"outputs":[{"name":"ez_um","unit":"um","offset":0,
"terms":[{"input":0,"tau_s":0,"gain":2}]}]}
]])
execute_process(COMMAND ${WORK}/example ${WORK}/model.json OUTPUT_VARIABLE out COMMAND_ERROR_IS_FATAL ANY)
# 25 degC, 5 K above the reference, 2 um/K: minus 10 um, reached within a minute at 1 um/s.
if(NOT out MATCHES "state 1 compensation -10")
  message(FATAL_ERROR "the example compensates otherwise than the model says: ${out}")
endif()
