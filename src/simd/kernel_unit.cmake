# SPDX-License-Identifier: GPL-2.0-or-later
# Kernels are compiled once for every instruction set of the build; the program chooses among them
# when it starts (src/simd/dispatch.h).
#
# Under sanitizers one instruction set with little optimisation is all that a build can afford: the
# checks make a kernel of inlined vector operations many times as large.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT FURROW_NATIVE AND NOT FURROW_SANITIZE)
  set(FURROW_INSTRUCTION_SETS baseline avx2 avx512)
else()
  set(FURROW_INSTRUCTION_SETS baseline)
endif()
set(furrow_kernel_optimisation -O3)
if(FURROW_SANITIZE)
  set(furrow_kernel_optimisation -O1)
endif()
set(furrow_kernel_unit_template ${CMAKE_CURRENT_LIST_DIR}/kernel_unit.cpp.in)

# furrow_kernel_unit(<target> <header> <table> [FUSED]): adds to a target one source for each
# instruction set, which defines <table>::baseline(), <table>::avx2() and <table>::avx512()
# (src/simd/instruction_set.h) from the kernels of <header>. Where the set has it, gcc multiplies and
# adds in one instruction, so that the last digit depends on how it groups operations; clang does so
# within an expression only, and across expressions in kernels that are FUSED.
function(furrow_kernel_unit target header table)
  cmake_parse_arguments(PARSE_ARGV 3 ARG "FUSED" "" "")
  set(baseline "")
  set(avx2 -march=x86-64-v3)
  set(avx512 -march=x86-64-v4 -mprefer-vector-width=512)
  if(ARG_FUSED)
    list(APPEND avx2 -ffp-contract=fast)
    list(APPEND avx512 -ffp-contract=fast)
  endif()
  get_filename_component(name ${header} NAME_WE)
  foreach(set ${FURROW_INSTRUCTION_SETS})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}_kernels/${name}_${set}.cpp)
    configure_file(${furrow_kernel_unit_template} ${source} @ONLY)
    target_sources(${target} PRIVATE ${source})
    # gcc 12 warns of uninitialised variables in its own avx512fintrin.h. It also warns that vectors wider
    # than the baseline's registers have another calling convention. No such vector crosses a call: the
    # functions that take or return one are always_inline.
    set_source_files_properties(${source} TARGET_DIRECTORY ${target}
      PROPERTIES COMPILE_OPTIONS "${furrow_kernel_optimisation};${${set}};-Wno-uninitialized;-Wno-psabi;$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>")
  endforeach()
endfunction()
