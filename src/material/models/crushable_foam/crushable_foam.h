// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Crushable foam of snow and foams, after ABAQUS 5.8 and [Shoop2001] (eq 17, 18). Equations:
/// theory: laws, eqs. 14 and 15. Yield measure t: section/section.h; pressure is positive in
/// compression.
///
/// The tensile strength pt is constant. The compressive strength pc(eps_vol_pl) hardens by
/// compaction, exponentially (hardening.h, offset pt) or by a table; pc0 = pc(0). sigma0 is the
/// initial strength in uniaxial compression and must stay below 3 pc0, where M becomes infinite.
///
/// Table 1 of [Shoop2001] can be read as pc0 or as pc0 + pt: the key pc0_reading chooses. All
/// plastic work is dissipated.

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/crushable_foam/crushable_foam_parameters.h"

namespace furrow {

class CrushableFoam : public ElasticKernelLaw<CrushableFoamParameters, CrushableFoamKernels> {
 public:
  /// Indices of the internal variables in the state.
  enum : std::size_t { eps_vol_pl = field::internal, eps_dev_pl };

  static MaterialModel model();
  /// @param density  rho0 [kg/m^3]
  CrushableFoam(double density, const CrushableFoamParameters& parameters);

  bool stress_has_jumps() const override { return true; }
  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

  double pc(double eps) const;  ///< yield strength in hydrostatic compression [Pa]
};

}  // namespace furrow
