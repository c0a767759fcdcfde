// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of the crushable foam law, as plain data.

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/material/hardening/hardening_parameters.h"
#include "furrow/material/point_block.h"
#include "furrow/material/section/section_parameters.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct CrushableFoamParameters {
  ElasticityParameters elasticity;
  HardeningParameters hardening;
  double pt = 0.0;  ///< yield strength in hydrostatic tension [Pa], constant
  /// aspect of the ellipse: its half-height in t over its half-width in p
  double M = 1.0;
  SectionParameters section;
};

/// Kernels of crushable_foam_kernel.h.
struct CrushableFoamKernels : KernelTable {
  BlockUpdate<CrushableFoamParameters> update = nullptr;

  static const CrushableFoamKernels& baseline();
  static const CrushableFoamKernels& avx2();
  static const CrushableFoamKernels& avx512();
};

}  // namespace furrow
