// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Cohesion, friction and dilation, all constant: the classical perfectly plastic soil
/// [Drucker1952].
///
/// The shear line and the flow potential are
///   q = d + p tan(beta),  g = q - p tan(psi).
/// Flow is associated with psi = beta and keeps the volume with psi = 0. With beta = 0 the law is
/// that of von Mises. Tension ends at the apex p = -d/tan(beta). Theory: laws, eqs. 12, 21, 22.

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/drucker_prager/drucker_prager_parameters.h"

namespace furrow {

class DruckerPrager : public ElasticKernelLaw<DruckerPragerParameters, DruckerPragerKernels> {
 public:
  static MaterialModel model();
  /// @param density  rho0 [kg/m^3]
  DruckerPrager(double density, const DruckerPragerParameters& parameters);

  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;
};

}  // namespace furrow
