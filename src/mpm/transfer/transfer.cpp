// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/transfer/transfer.h"

#include "furrow/simd/dispatch.h"

namespace furrow {

const TransferKernels& transfer_kernels() { return kernels<TransferKernels>(); }

}  // namespace furrow
