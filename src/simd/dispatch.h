// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Selects the instruction set of the kernels of a run, once, at the first use of a kernel.

#include <vector>

#include "furrow/simd/instruction_set.h"

namespace furrow {

/// Name of a set: "baseline", "avx2", "avx512".
const char* to_string(InstructionSet set);

/// The instruction sets that this build has and this processor runs, slowest first.
std::vector<InstructionSet> available_instruction_sets();

/// The fastest of them, or the one that the environment variable FURROW_ISA = baseline | avx2 |
/// avx512 names; the same for the whole run.
/// @throws InputError when FURROW_ISA names one that is not available
InstructionSet chosen_instruction_set();

/// The kernels of a component for one of available_instruction_sets().
template <class Kernels>
const Kernels& kernels_for(InstructionSet set) {
#ifdef FURROW_X86_KERNELS  // avx2() and avx512() exist only in builds that define so
  if (set == InstructionSet::avx512) return Kernels::avx512();
  if (set == InstructionSet::avx2) return Kernels::avx2();
#else
  static_cast<void>(set);
#endif
  return Kernels::baseline();
}

/// The kernels of a component for this run. @throws InputError as chosen_instruction_set()
template <class Kernels>
const Kernels& kernels() {
  return kernels_for<Kernels>(chosen_instruction_set());
}

}  // namespace furrow
