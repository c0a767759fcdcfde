// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The table of block updates that kernels_*.cpp fill, one for each instruction set. Plain data
/// only: this header is compiled with every instruction set (simd/lanes.h says why that matters).

#include "material/models/crushable_foam/crushable_foam_parameters.h"
#include "material/models/drucker_prager_cap/drucker_prager_cap_parameters.h"
#include "material/elasticity/elasticity_parameters.h"
#include "material/models/neo_hookean/neo_hookean_parameters.h"
#include "material/point_block.h"

namespace furrow {

enum class Failure { none, folded, table_ends, not_finite };

/// Result of a block update as plain data: only material.cpp turns a failure into an exception.
struct BlockResult {
  UpdateReport report;
  Failure failure = Failure::none;
  std::size_t failed_point = 0;
};

/// One function a law.
struct Kernels {
  const char* instruction_set;
  int lanes;  ///< points updated at once
  BlockResult (*crushable_foam)(const CrushableFoamParameters&, double density, const PointBlock&);
  BlockResult (*drucker_prager_cap)(const DruckerPragerCapParameters&, double density,
                                    const PointBlock&);
  BlockResult (*elastic)(const ElasticityParameters&, double density, const PointBlock&);
  BlockResult (*neo_hookean)(const NeoHookeanParameters&, double density, const PointBlock&);
};

const Kernels& kernels_baseline();
const Kernels& kernels_avx2();  // x86 builds only
const Kernels& kernels_avx512();

/// ln U and U^-1 of C = U^2 = I + X by eigenvalues, for the kernels' rare large steps. Components
/// xx, yy, zz, xy, yz, xz. False, with nothing written, when C is not finite or not positive
/// definite.
bool large_stretch(const double* x, double* log_u, double* inverse_u);

}  // namespace furrow
