// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels for x86-64-v4: AVX-512. Compiled with that -march (src/CMakeLists.txt) and called on
// such processors only.
#ifdef FURROW_X86_KERNELS
#define FURROW_ISA isa_avx512
#include "material/kernels_all.h"

namespace furrow {
const Kernels& kernels_avx512() {
  static constexpr Kernels table = all_kernels("avx512");
  return table;
}
}  // namespace furrow
#endif
