// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Clay without drainage, in total stresses: a cohesion that grows with the rate of shear and falls
/// as shear remoulds the clay. Rate and remoulding multiply as in [Einav2005].
///
/// Yield does not depend on the pressure, and flow keeps the volume (von Mises).
///   q = sqrt(3) s,  s = s_u R S
///   R = 1 + m log10(max(1, gamma_rate/reference_rate))
///   S = 1/s_t + (1 - 1/s_t) exp(-3 gamma w/slip_95)
/// gamma = sqrt(3) eps_dev_pl is the plastic shear strain, m the rate_share, s_t the sensitivity.
/// The strength s is (sigma1 - sigma3)/2 in simple shear and plane strain. In triaxial compression
/// and extension that is sqrt(3)/2 s. Theory: laws, eqs. 23 and 24.
///
/// A shear band is as wide as the piece of ground that a point stands for. Its width w turns strain
/// into slip, so that the work to remould an area of the band does not depend on the cell. In a
/// continuum w is the cell (TerrainFill); alone a point has the key band_width. A band wider than
/// G slip_95/(3 s_u (1 - 1/s_t)) falls at once to a softer state.

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/undrained_clay/undrained_clay_parameters.h"

namespace furrow {

class UndrainedClay : public ElasticKernelLaw<UndrainedClayParameters, UndrainedClayKernels> {
 public:
  /// Indices of the internal variables in the state.
  enum : std::size_t { eps_dev_pl = field::internal, band_width };

  static MaterialModel model();
  /// @param density  rho0 [kg/m^3]; @param width  of a band in a point alone [m]
  UndrainedClay(double density, const UndrainedClayParameters& parameters, double width);

  bool rate_dependent() const override { return parameters_.rate_gain > 0.0; }
  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

 private:
  double strength(const VectorX& state) const;  ///< q at yield below the reference rate [Pa]
};

}  // namespace furrow
