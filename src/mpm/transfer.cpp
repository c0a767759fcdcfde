// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/transfer.h"

#include <string>

#include "material/kernels.h"

namespace furrow {

const TransferKernels& transfer_kernels(const char* instruction_set) {
#ifdef FURROW_X86_KERNELS
  const std::string set = instruction_set;
  if (set == "avx512") return transfer_kernels_avx512();
  if (set == "avx2") return transfer_kernels_avx2();
#else
  static_cast<void>(instruction_set);
#endif
  return transfer_kernels_baseline();
}

const TransferKernels& transfer_kernels() { return transfer_kernels(kernels().instruction_set); }

}  // namespace furrow
