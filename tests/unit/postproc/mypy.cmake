# SPDX-License-Identifier: GPL-2.0-or-later
cmake_minimum_required(VERSION 3.25)
# mypy over the package, then over each folder of drivers by itself (they have modules of the same
# names), then over the tests.
set(failed "")

# check(<folder>... FILES <file>...): files that find their modules in the folders
function(check)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "" "FILES")
  list(JOIN ARG_UNPARSED_ARGUMENTS ":" path)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env MYPYPATH=${path} ${MYPY} --config-file ${SOURCE}/postproc/pyproject.toml
                          --cache-dir ${CACHE} ${ARG_FILES}
                  RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    set(failed ${failed} ${ARG_FILES} PARENT_SCOPE)
  endif()
endfunction()

check(${SOURCE}/postproc FILES ${SOURCE}/postproc/furrow_post)

file(GLOB_RECURSE drivers ${SOURCE}/inputs/*.py)
set(folders "")
foreach(driver ${drivers})
  get_filename_component(folder ${driver} DIRECTORY)
  list(APPEND folders ${folder})
endforeach()
list(REMOVE_DUPLICATES folders)
foreach(folder ${folders})
  file(GLOB files ${folder}/*.py)
  check(${SOURCE}/postproc ${folder} FILES ${files})
endforeach()

set(tests ${SOURCE}/tests/unit/postproc)
file(GLOB support ${tests}/support/*.py ${tests}/rooms_test.py)
check(${SOURCE}/postproc ${tests} FILES ${support})
foreach(room read analyse laboratory figures cli scene study surrogate sweep faults)
  file(GLOB files ${tests}/${room}/*.py)
  check(${SOURCE}/postproc ${tests} FILES ${files})
endforeach()
# A test of a driver imports the modules of its folder
foreach(pair costs=costs crosscheck=crosscheck grains=validation/grains laboratory_cone=laboratory
             laboratory_identify=laboratory laboratory_snow=laboratory
             report_wheel=validation/report_wheel snow_wheel=validation/snow_wheel
             study_pages=validation tyre_on_snow=validation/tyre_on_snow tyre_table6=validation/tyre_table6 tyre_files= start=)
  string(REPLACE "=" ";" pair ${pair})
  list(GET pair 0 name)
  list(LENGTH pair length)
  set(folder ${SOURCE}/inputs)
  if(length GREATER 1)
    list(GET pair 1 place)
    set(folder ${SOURCE}/inputs/${place})
  endif()
  check(${SOURCE}/postproc ${tests} ${folder} FILES ${tests}/drivers/${name}_test.py)
endforeach()

if(failed)
  message(FATAL_ERROR "mypy: see above")
endif()
