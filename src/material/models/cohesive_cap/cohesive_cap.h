// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Cohesive cap law of compressible snow: lateral stress, shear strength and compaction curve are
/// independent. Equations: theory: snow, eqs. 1 to 6.
///
/// Three surfaces depend on the volumetric plastic strain. The cap is an ellipse for p > 0, and a
/// constant q = A pc in tension. The hardening gives pc.
///   p^2 + (q/A)^2 = pc^2.
/// The shear line has a cohesion d that grows as a power of the density.
///   q = d + p tan(beta), d = d_0 exp(m eps_vol_pl).
/// Tension ends at p = -tension_ratio d.
///
/// Flow on the cap follows the potential of metal foams [Deshpande2000].
///   g = sqrt(q^2 + b^2 p^2), b^2 = 9/2 (1 - 2 nu_p)/(1 + nu_p).
/// The plastic Poisson's ratio nu_p sets K0 = nu_p/(1 - nu_p) in confined compression. K0 is larger
/// where the shear line limits q (eq. 5). Flow on the shear line keeps the volume. Tension opens
/// the material without shear. [Haehnel2004] combines a shear line and a cap for snow. Here the cap
/// has its own flow potential, and cohesion grows with density. All plastic work is dissipated.
///
/// With a relaxation time the stress may be beyond the surfaces for a time (eq. 7).

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/cohesive_cap/cohesive_cap_parameters.h"

namespace furrow {

class CohesiveCap : public ElasticKernelLaw<CohesiveCapParameters, CohesiveCapKernels> {
 public:
  /// Indices of the internal variables in the state.
  enum : std::size_t { eps_vol_pl = field::internal, eps_dev_pl };

  static MaterialModel model();
  /// @param density       rho0 [kg/m^3]
  /// @param eps_vol_pl_0  initial volumetric plastic strain
  CohesiveCap(double density, const CohesiveCapParameters& parameters, double eps_vol_pl_0);

  bool rate_dependent() const override { return parameters_.relaxation > 0.0; }
  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

  double pc(double eps) const;  ///< yield strength in hydrostatic compression [Pa]
  double d(double eps) const;   ///< intercept of the shear line [Pa]

 private:
  /// Largest q at the pressure p between the tensile strength and pc [Pa]
  double strength(double p, double eps) const;
};

}  // namespace furrow
