// SPDX-License-Identifier: GPL-2.0-or-later
// The transfers for every processor of the target; no special instructions.
#define FURROW_ISA isa_baseline
#include "mpm/transfer_kernel.h"

namespace furrow {
const TransferKernels& transfer_kernels_baseline() {
  static constexpr TransferKernels table = all_transfers("baseline");
  return table;
}
}  // namespace furrow
