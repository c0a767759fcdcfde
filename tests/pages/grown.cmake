# SPDX-License-Identifier: GPL-2.0-or-later
# Two tutorials of the guide write a law and a fix style: their files, in the places that the
# tutorials name, and the programs with them.
find_package(CLI11 REQUIRED)
set(grown ${CMAKE_CURRENT_BINARY_DIR}/grown)
file(MAKE_DIRECTORY ${grown}/bin)
set(tutorials ${PROJECT_SOURCE_DIR}/inputs/guide/tutorials)
foreach(file von_mises.h von_mises.cpp von_mises_test.cpp)
  configure_file(${tutorials}/write_a_law/${file} ${grown}/furrow/material/models/von_mises/${file} COPYONLY)
endforeach()
foreach(file fix_wheel_limit.h fix_wheel_limit.cpp)
  configure_file(${tutorials}/write_a_fix/${file} ${grown}/coupling/output/${file} COPYONLY)
endforeach()
file(READ ${PROJECT_BINARY_DIR}/src/material/models/material_models.cpp models)
string(REPLACE "namespace furrow {" "#include \"furrow/material/models/von_mises/von_mises.h\"\nnamespace furrow {" models "${models}")
string(REPLACE "  };\n  return models" "      VonMises::model(),\n  };\n  return models" models "${models}")
file(CONFIGURE OUTPUT ${grown}/material_models.cpp CONTENT "${models}" @ONLY)
set(grown_law ${grown}/material_models.cpp ${grown}/furrow/material/models/von_mises/von_mises.cpp)

# grown_program(<target> <name> <source>...): the program <name> with the law, for long tests alone
function(grown_program target name)
  add_executable(${target} EXCLUDE_FROM_ALL ${ARGN} ${grown_law})
  add_dependencies(long_tests ${target})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} RUNTIME_OUTPUT_DIRECTORY ${grown}/bin
                        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(${target} PRIVATE ${grown} ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PRIVATE furrow::furrow furrow_warnings fmt::fmt)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

set(programs ${PROJECT_SOURCE_DIR}/src/programs)
grown_program(grown_point furrow-point ${programs}/furrow_point.cpp ${programs}/figure.cpp
              ${programs}/parse_options.cpp ${programs}/number_option.cpp ${programs}/end_output.cpp)
target_compile_definitions(grown_point PRIVATE FURROW_PYTHON="${FURROW_PYTHON}")
target_link_libraries(grown_point PRIVATE CLI11::CLI11)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/postproc/furrow-post ${grown}/bin/furrow-post SYMBOLIC)
grown_program(guide_law_test guide_law_test ${grown}/furrow/material/models/von_mises/von_mises_test.cpp)
target_link_libraries(guide_law_test PRIVATE GTest::gtest_main GTest::gmock)
add_test(NAME pages.law COMMAND guide_law_test --gtest_brief=1)
furrow_long(pages.law)

if(FURROW_COUPLING)
  grown_program(grown_furrow furrow ${PROJECT_SOURCE_DIR}/coupling/main.cpp ${grown}/coupling/output/fix_wheel_limit.cpp)
  target_link_libraries(grown_furrow PRIVATE furrow_coupling)
  file(CREATE_LINK ${PROJECT_BINARY_DIR}/bin/furrow-resistance ${grown}/bin/furrow-resistance SYMBOLIC)
  guide_test(my_law ${grown} ${tutorial}/6_write_a_law.md)
  guide_test(my_fix ${grown} ${tutorial}/7_write_a_fix.md ${tutorial}/write_a_fix/fix_wheel_limit.md)
endif()
