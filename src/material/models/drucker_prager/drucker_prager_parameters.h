// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of the Drucker-Prager law, as plain data.

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/material/point_block.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct DruckerPragerParameters {
  ElasticityParameters elasticity;  ///< linear
  double d = 0.0;                   ///< intercept of the shear line [Pa]
  double tan_beta = 0.0;            ///< slope of the shear line
  double tan_psi = 0.0;             ///< slope of the flow potential
};

/// Kernels of drucker_prager_kernel.h.
struct DruckerPragerKernels : KernelTable {
  BlockUpdate<DruckerPragerParameters> update = nullptr;

  static const DruckerPragerKernels& baseline();
  static const DruckerPragerKernels& avx2();
  static const DruckerPragerKernels& avx512();
};

}  // namespace furrow
