// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of the Drucker-Prager cap law, as plain data.

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/material/hardening/hardening_parameters.h"
#include "furrow/material/point_block.h"
#include "furrow/material/section/section_parameters.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct DruckerPragerCapParameters {
  ElasticityParameters elasticity;
  HardeningParameters hardening;
  double d = 0.0;         ///< cohesion in the p-t plane [Pa]
  double tan_beta = 0.0;  ///< slope of the shear line
  double sin_beta = 0.0;
  double R = 0.0;      ///< eccentricity of the cap
  double alpha = 0.0;  ///< size of the transition
  /// 1 + alpha - alpha/cos(beta): top of the cap is t = A (d + pa tan(beta))
  double A = 1.0;
  double B = 1.0;  ///< 1 - alpha/cos(beta): height of the transition's centre
  SectionParameters section;
  double cutoff = 1e300;  ///< tension cut-off: p >= -cutoff [Pa]
};

/// Kernels of drucker_prager_cap_kernel.h.
struct DruckerPragerCapKernels : KernelTable {
  BlockUpdate<DruckerPragerCapParameters> update = nullptr;

  static const DruckerPragerCapKernels& baseline();
  static const DruckerPragerCapKernels& avx2();
  static const DruckerPragerCapKernels& avx512();
};

}  // namespace furrow
