# SPDX-License-Identifier: GPL-2.0-or-later
# Builds PROJECT against PREFIX in WORK, with the packages WITHOUT disabled, and runs its PROGRAM.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(disabled "")
foreach(package ${WITHOUT})
  list(APPEND disabled -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK} -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${PREFIX} -D CMAKE_CXX_COMPILER=${CXX}
    -D CMAKE_BUILD_TYPE=${CONFIGURATION} -D CMAKE_FIND_PACKAGE_NO_PACKAGE_REGISTRY=ON ${disabled})
run(${CMAKE_COMMAND} --build ${WORK} --config ${CONFIGURATION})
run(${WORK}/${PROGRAM})
