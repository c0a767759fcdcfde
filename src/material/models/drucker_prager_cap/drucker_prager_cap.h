// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Modified Drucker-Prager cap law of soils and snow, after ABAQUS and [Shoop2001] (eq 12-16).
/// Equations: theory: laws, eqs. 6 to 10; K0: eq. 13; frozen energy: eq. 19.
///
/// Yield measure t: section/section.h. Pressure is positive in compression (core/types.h). Tension
/// ends at p = -cutoff with purely volumetric flow; the default is the apex p = -d/tan(beta). Shear
/// flow at p < pa dilates and lowers pa until p = pa, the critical state. The plastic work less the
/// frozen energy pa d(eps_vol_pl) is never negative, because both potentials grow away from (pa, 0)
/// [Collins2005].

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap_parameters.h"

namespace furrow {

class DruckerPragerCap
    : public ElasticKernelLaw<DruckerPragerCapParameters, DruckerPragerCapKernels> {
 public:
  /// Indices of the internal variables in the state.
  enum : std::size_t { eps_vol_pl = field::internal, eps_dev_pl };

  static MaterialModel model();
  /// @param density       rho0 [kg/m^3]
  /// @param eps_vol_pl_0  initial volumetric plastic strain: positions the cap
  DruckerPragerCap(double density, const DruckerPragerCapParameters& parameters,
                   double eps_vol_pl_0);

  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

  double pb(double eps) const;  ///< tip of the cap [Pa]
  double pa(double eps) const;  ///< pressure at the top of the cap, the critical state [Pa]

 private:
  /// t on the shear line or the transition, p <= pa
  double shear_strength(double p, double eps) const;
  /// t on the whole surface, 0 outside its range of p
  double strength(double p, double eps) const;
};

}  // namespace furrow
