// SPDX-License-Identifier: GPL-2.0-or-later
// The shell's kernel for x86-64-v3: AVX2 and FMA. Compiled with that -march (src/CMakeLists.txt)
// and called on such processors only.
#ifdef FURROW_X86_KERNELS
#define FURROW_ISA isa_avx2
#include "shell/shell4_kernel.h"

namespace furrow {
Shell4Result shell4_forces_avx2(const Shell4Kind* kinds, std::size_t count,
                                const Shell4Places& places, const double* x, const double* rotation,
                                double pressure, double* force, double* moment) {
  return shell4_forces(kinds, count, places, x, rotation, pressure, force, moment);
}
}  // namespace furrow
#endif
