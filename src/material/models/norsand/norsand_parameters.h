// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Constants and kernels of NorSand, as plain data (norsand.h has the equations).

#include "furrow/material/point_block.h"
#include "furrow/material/section/section_parameters.h"
#include "furrow/simd/instruction_set.h"

namespace furrow {

struct NorSandParameters {
  double M = 1.2;             ///< critical stress ratio in triaxial compression
  double N = 0.5;             ///< volumetric coupling
  double chi_i = 4.0;         ///< dilatancy over the state parameter of the image
  double H = 100.0;           ///< plastic hardening modulus at the reference pressure
  double H_exponent = 0.0;    ///< exponent of the decrease of H with the image pressure
  double H_psi = 0.0;         ///< its decrease with the state parameter of the image
  double gamma = 1.0;         ///< critical void ratio at p = 1 Pa, or at p = 0 with an exponent
  double lambda = 0.0;        ///< slope of the critical state line
  double csl_exponent = 0.0;  ///< 0: over ln p
  double shear = 0.0;         ///< G at the reference pressure [Pa]
  double exponent = 0.5;
  double bulk_ratio = 1.0;  ///< K/G
  double pt = 10.0;         ///< hydrostatic tensile strength [Pa]
  double floor = 0.1;       ///< least P and P_i that moduli and logarithms take [Pa]
  double tip = 2.0;         ///< P/P_i at the tip of the surface
  double shear_band = 0.0;  ///< width of a shear band of the sand [m]; 0: of the point
  SectionParameters section;

  /// D at the tip
  double largest_D() const { return M / (1.0 - N); }

  static constexpr double reference_pressure = 1e5;  ///< of G and H [Pa]
  static constexpr double minimum_hardening = 0.1;   ///< share of H that remains in loose sand
  static constexpr double loosest = 3.0;             ///< bound of D_l over largest_D()
};

/// Kernels of norsand_kernel.h.
struct NorSandKernels : KernelTable {
  BlockUpdate<NorSandParameters> update = nullptr;

  static const NorSandKernels& baseline();
  static const NorSandKernels& avx2();
  static const NorSandKernels& avx512();
};

}  // namespace furrow
