// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/transfer.h"

#include "simd/dispatch.h"

namespace furrow {

const TransferKernels& transfer_kernels() { return kernels<TransferKernels>(); }

}  // namespace furrow
