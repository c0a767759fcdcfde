# SPDX-License-Identifier: GPL-2.0-or-later
# Installs the build into WORK/prefix, builds PROJECT against it alone, runs its program.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${FURROW_BUILD} --config ${CONFIGURATION} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${WORK}/prefix -D CMAKE_CXX_COMPILER=${CXX}
    -D CMAKE_BUILD_TYPE=${CONFIGURATION} -D CMAKE_FIND_PACKAGE_NO_PACKAGE_REGISTRY=ON)
run(${CMAKE_COMMAND} --build ${WORK}/build --config ${CONFIGURATION})
run(${WORK}/build/wheel)

# Nothing of the source or build tree may be named in what was installed for other projects.
file(GLOB_RECURSE configs ${WORK}/prefix/*.cmake)
if(NOT configs)
  message(FATAL_ERROR "no CMake files were installed")
endif()
foreach(config ${configs})
  file(READ ${config} text)
  string(FIND "${text}" "${FURROW_BUILD}/src" place)
  if(NOT place EQUAL -1)
    message(FATAL_ERROR "${config} names the build tree")
  endif()
endforeach()
