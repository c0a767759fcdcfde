// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of the neo-Hookean law, as plain data.

#include "furrow/material/point_block.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct NeoHookeanParameters {
  double shear = 0.0;  ///< mu [Pa]
  double bulk = 0.0;   ///< K [Pa]
};

/// Kernels of neo_hookean_kernel.h.
struct NeoHookeanKernels : KernelTable {
  BlockUpdate<NeoHookeanParameters> update = nullptr;

  static const NeoHookeanKernels& baseline();
  static const NeoHookeanKernels& avx2();
  static const NeoHookeanKernels& avx512();
};

}  // namespace furrow
