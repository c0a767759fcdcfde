# SPDX-License-Identifier: GPL-2.0-or-later
# The pages of the guide, and the first page
# guide_test(<name> <build folder> <page>...)
function(guide_test name build)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/)
  add_test(NAME pages.${name} COMMAND ${FURROW_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/guide.py ${PROJECT_SOURCE_DIR} ${build}
           ${CMAKE_CURRENT_BINARY_DIR}/${name} ${ARGN})
  set_tests_properties(pages.${name} PROPERTIES TIMEOUT 1800 COST 50 ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1;${MPI_TEST_ENVIRONMENT}")
  furrow_long(pages.${name})
endfunction()

file(GLOB howto RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/inputs/guide/howto/*.md
     ${PROJECT_SOURCE_DIR}/inputs/guide/*.md)
list(REMOVE_ITEM howto inputs/guide/howto/python.md)  # starts two ranks
guide_test(howto_python ${PROJECT_BINARY_DIR} inputs/guide/howto/python.md)
furrow_ranks(pages.howto_python 2)
guide_test(howto ${PROJECT_BINARY_DIR} ${howto})
set_tests_properties(pages.howto PROPERTIES COST 200)  # the longest start first
set(tutorial inputs/guide/tutorials)
guide_test(first_run ${PROJECT_BINARY_DIR} README.md ${tutorial}/1_first_run.md)
guide_test(my_tyre ${PROJECT_BINARY_DIR} ${tutorial}/2_my_tyre_my_sand.md)
guide_test(my_script ${PROJECT_BINARY_DIR} ${tutorial}/3_wheel_in_my_script.md)
set_tests_properties(pages.my_script PROPERTIES FIXTURES_SETUP own_script)  # for pages.commands
guide_test(my_soil ${PROJECT_BINARY_DIR} ${tutorial}/4_soil_from_tests.md)
guide_test(which_ground ${PROJECT_BINARY_DIR} ${tutorial}/5_which_ground.md)
guide_test(soil_card ${PROJECT_BINARY_DIR} ${tutorial}/8_soil_card.md)
