// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of the cohesive Cam clay, as plain data.

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/material/hardening/hardening_parameters.h"
#include "furrow/material/point_block.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct CohesiveCamClayParameters {
  ElasticityParameters elasticity;
  HardeningParameters hardening;
  double beta = 0.0;    ///< tensile over compressive strength, both hydrostatic
  double centre = 0.5;  ///< c/p0 = (1 - beta)/2
  double radius = 0.5;  ///< a/p0 = (1 + beta)/2
  double aspect = 1.0;  ///< B = M/sqrt(1 + 2 beta)
};

/// Kernels of cohesive_cam_clay_kernel.h.
struct CohesiveCamClayKernels : KernelTable {
  BlockUpdate<CohesiveCamClayParameters> update = nullptr;

  static const CohesiveCamClayKernels& baseline();
  static const CohesiveCamClayKernels& avx2();
  static const CohesiveCamClayKernels& avx512();
};

}  // namespace furrow
