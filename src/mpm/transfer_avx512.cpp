// SPDX-License-Identifier: GPL-2.0-or-later
// The transfers for x86-64-v4: AVX-512. Compiled with that -march (src/CMakeLists.txt) and called
// on such processors only.
#ifdef FURROW_X86_KERNELS
#define FURROW_ISA isa_avx512
#include "mpm/transfer_kernel.h"

namespace furrow {
const TransferKernels& transfer_kernels_avx512() {
  static constexpr TransferKernels table = all_transfers("avx512");
  return table;
}
}  // namespace furrow
#endif
