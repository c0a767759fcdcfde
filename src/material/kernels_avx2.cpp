// SPDX-License-Identifier: GPL-2.0-or-later
// The kernels for x86-64-v3: AVX2 and FMA. Compiled with that -march (src/CMakeLists.txt) and
// called on such processors only.
#ifdef FURROW_X86_KERNELS
#define FURROW_ISA isa_avx2
#include "material/kernels_all.h"

namespace furrow {
const Kernels& kernels_avx2() {
  static constexpr Kernels table = all_kernels("avx2");
  return table;
}
}  // namespace furrow
#endif
