# SPDX-License-Identifier: GPL-2.0-or-later
cmake_minimum_required(VERSION 3.25)
# mypy over the package, the drivers and the tests. Folders of drivers import their own modules; those
# that have modules of the same names are checked in different calls.
set(tests ${SOURCE}/tests/unit/postproc)
set(validation inputs/validation)

# A quarter of its time would go to the search for unused objects, of which there are few.
set(mypy "import gc; gc.disable(); from mypy.__main__ import console_entry; console_entry()")

# check(<folder where modules are found>... FILES <file>...)
function(check)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "" "FILES")
  list(JOIN ARG_UNPARSED_ARGUMENTS ":" path)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env MYPYPATH=${path} ${PYTHON} -c "${mypy}" --config-file postproc/pyproject.toml
                          --namespace-packages --explicit-package-bases --cache-dir ${CACHE} ${ARG_FILES}
                  WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    set(failed TRUE PARENT_SCOPE)
  endif()
endfunction()

file(GLOB_RECURSE alone RELATIVE ${SOURCE} ${SOURCE}/inputs/*.py)
list(FILTER alone EXCLUDE REGEX "^inputs/(laboratory|crosscheck|validation/grains|validation/second_opinion|validation/snow_wheel)/")
foreach(folder laboratory crosscheck validation/grains validation/second_opinion validation/snow_wheel)
  file(GLOB of_${folder} RELATIVE ${SOURCE} ${SOURCE}/inputs/${folder}/*.py)
endforeach()
file(GLOB_RECURSE of_tests RELATIVE ${SOURCE} ${tests}/*.py)
file(GLOB examples RELATIVE ${SOURCE} ${SOURCE}/inputs/guide/howto/*)
check(postproc inputs inputs/laboratory ${examples} FILES postproc/furrow_post ${alone} ${of_laboratory})
check(postproc inputs/crosscheck FILES ${of_crosscheck})
check(postproc ${validation}/grains FILES ${of_validation/grains})
check(postproc ${validation}/second_opinion FILES ${of_validation/second_opinion})
check(postproc ${validation}/snow_wheel FILES ${of_validation/snow_wheel})
check(postproc tests/support ${tests} inputs/laboratory inputs/crosscheck ${validation}/grains FILES tests/support/copied.py
      tests/support/mutants.py tests/support/short_suite.py ${of_tests})
if(failed)
  message(FATAL_ERROR "mypy: see above")
endif()
