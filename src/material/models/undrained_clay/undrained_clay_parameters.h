// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of the undrained clay, as plain data.

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/material/point_block.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct UndrainedClayParameters {
  ElasticityParameters elasticity;  ///< linear
  double q = 0.0;                   ///< sqrt(3) s_u: Mises stress at yield, intact [Pa]
  double remoulded = 1.0;           ///< 1/sensitivity
  double decay = 0.0;               ///< 3 sqrt(3)/slip_95 [1/m]
  double rate_gain = 0.0;           ///< rate_share/ln(10)
  double reference_rate = 1.0;      ///< of the plastic shear strain gamma [1/s]
};

/// Kernels of undrained_clay_kernel.h.
struct UndrainedClayKernels : KernelTable {
  BlockUpdate<UndrainedClayParameters> update = nullptr;

  static const UndrainedClayKernels& baseline();
  static const UndrainedClayKernels& avx2();
  static const UndrainedClayKernels& avx512();
};

}  // namespace furrow
