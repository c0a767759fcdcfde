# SPDX-License-Identifier: GPL-2.0-or-later
# Runs the programs installed in PREFIX, and a scene as installed, in its quick version.
foreach(program furrow-point furrow-post furrow-resistance furrow-sidewall furrow-soil furrow-tyre)
  execute_process(COMMAND ${PREFIX}/bin/${program} --help OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
set(results ${PREFIX}/results)
execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=FURROW_BUILD
                        ${PREFIX}/bin/furrow-post run wheel_on_snow --quick -o ${results}
                WORKING_DIRECTORY ${PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(READ ${results}/command.json command)
if(NOT command MATCHES "share/furrow/inputs/scenes/wheel_on_snow.lig")
  message(FATAL_ERROR "not the installed scene was run: ${command}")
endif()
file(READ ${results}/summary.txt summary)
if(NOT summary MATCHES "sinkage|hub drop")
  message(FATAL_ERROR "${results}/summary.txt has no sinkage: ${summary}")
endif()
