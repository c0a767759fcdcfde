# SPDX-License-Identifier: GPL-2.0-or-later
# Installs the build FURROW_BUILD into PREFIX.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${FURROW_BUILD} --config ${CONFIGURATION} --prefix ${PREFIX}
                COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)

# Nothing of the source or build tree may be named in what was installed for other projects.
file(GLOB_RECURSE configs ${PREFIX}/*.cmake)
if(NOT configs)
  message(FATAL_ERROR "no CMake files were installed")
endif()
foreach(config ${configs})
  file(READ ${config} text)
  string(FIND "${text}" "${FURROW_BUILD}/src" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${config} names the build tree")
  endif()
endforeach()
