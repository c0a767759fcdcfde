// SPDX-License-Identifier: GPL-2.0-or-later
// The transfers for x86-64-v3: AVX2 and FMA. Compiled with that -march (src/CMakeLists.txt) and
// called on such processors only.
#ifdef FURROW_X86_KERNELS
#define FURROW_ISA isa_avx2
#include "mpm/transfer_kernel.h"

namespace furrow {
const TransferKernels& transfer_kernels_avx2() {
  static constexpr TransferKernels table = all_transfers("avx2");
  return table;
}
}  // namespace furrow
#endif
