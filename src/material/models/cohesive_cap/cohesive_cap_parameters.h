// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of the cohesive cap law, as plain data.

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/material/hardening/hardening_parameters.h"
#include "furrow/material/point_block.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct CohesiveCapParameters {
  ElasticityParameters elasticity;
  HardeningParameters hardening;
  double flow = 4.5;      ///< b^2 of the flow potential: 9/2 (1 - 2 nu_p)/(1 + nu_p)
  double aspect = 1.0;    ///< A, height q of the cap over its half-width p
  double tan_beta = 0.0;  ///< slope of the shear line
  double tension = 0.0;   ///< hydrostatic tensile strength over d
  double d = 0.0;         ///< intercept of the shear line at eps_vol_pl = 0 [Pa]
  double growth = 0.0;    ///< m of d exp(m eps_vol_pl)
  double relaxation = 0;  ///< relaxation time of the overstress [s]; 0: none
};

/// Kernels of cohesive_cap_kernel.h.
struct CohesiveCapKernels : KernelTable {
  BlockUpdate<CohesiveCapParameters> update = nullptr;

  static const CohesiveCapKernels& baseline();
  static const CohesiveCapKernels& avx2();
  static const CohesiveCapKernels& avx512();
};

}  // namespace furrow
