# SPDX-License-Identifier: GPL-2.0-or-later
# Runs the programs installed in PREFIX, and a scene as installed, in its quick version.
foreach(program furrow-point furrow-post furrow-resistance furrow-sidewall furrow-tyre)
  execute_process(COMMAND ${PREFIX}/bin/${program} --help OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
set(scene ${PREFIX}/share/furrow/inputs/scenes/wheel_on_snow.lig)
set(results ${PREFIX}/results)
execute_process(COMMAND ${PREFIX}/bin/furrow -in ${scene} -log none -var cell 0.05 -var distance 0.7 -var results ${results}
                WORKING_DIRECTORY ${PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(READ ${results}/summary.txt summary)
if(NOT summary MATCHES "sinkage|hub drop")
  message(FATAL_ERROR "${results}/summary.txt has no sinkage: ${summary}")
endif()
