// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/simd/dispatch.h"

#ifdef FURROW_X86_KERNELS
#include <cpuid.h>
#endif

#include <cstdlib>
#include <string>

#include "furrow/core/error.h"

namespace furrow {

const char* to_string(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::avx2:
      return "avx2";
    default:
      return "baseline";
  }
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
#ifdef FURROW_X86_KERNELS
  __builtin_cpu_init();
  // clang 14 has no __builtin_cpu_supports of F16C, MOVBE and LZCNT
  unsigned eax = 0, ebx = 0, basic = 0, extended = 0, edx = 0;
  __get_cpuid(1, &eax, &ebx, &basic, &edx);
  __get_cpuid(0x80000001, &eax, &ebx, &extended, &edx);
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                  __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                  (basic & bit_F16C) && (basic & bit_MOVBE) && (extended & bit_LZCNT);
  if (v3) sets.push_back(InstructionSet::avx2);
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                  __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512cd");
  if (v4) sets.push_back(InstructionSet::avx512);
#endif
  return sets;
}

namespace {

InstructionSet choose() {
  const std::vector<InstructionSet> available = available_instruction_sets();
  const char* wish = std::getenv("FURROW_ISA");
  if (!wish) return available.back();
  std::string names;
  for (const InstructionSet set : available) {
    if (to_string(set) == std::string(wish)) return set;
    names += (names.empty() ? "" : ", ") + std::string(to_string(set));
  }
  throw InputError("environment variable FURROW_ISA",
                   "is '" + std::string(wish) + "', which this processor or build does not have",
                   names, "leave it unset to take the fastest");
}

}  // namespace

InstructionSet chosen_instruction_set() {
  static const InstructionSet chosen = choose();
  return chosen;
}

}  // namespace furrow
