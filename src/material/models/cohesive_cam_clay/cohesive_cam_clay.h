// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Cohesive Cam clay, the law of compressible snow of [Gaume2018], after modified Cam clay
/// [Roscoe1968]. Equations: theory: laws, eq. 16; K0 of confined compression: eq. 17.
///
/// The yield surface is an ellipse from -beta p0 to p0, where beta is the key tension_ratio.
///   f = sqrt( (p - c)^2 + (q/B)^2 ) - a.
/// Its centre is c = (1 - beta) p0/2, and its half-width a = (1 + beta) p0/2. Its half-height is
/// B a, with B = M/sqrt(1 + 2 beta).
///
/// Flow is associated: d(eps_q)/d(eps_v) = q/(B^2 (p - c)). Above c it compacts and hardens. Below
/// c it dilates and softens. At p = c is the critical state. The hardening gives p0(eps_vol_pl). In
/// torn material p0 decays below the hardening data without reaching zero.
///
/// A wanted K0 sets the stress ratio eta = 3 (1 - K0)/(1 + 2 K0) of confined compression. With
/// k = (1 - beta)/(1 + beta) it gives M.
///   S = eta k + sqrt( (eta k)^2 + 6 eta + 9 ).
///   M = sqrt( (1 + 2 beta)(S^2 - 9) )/2.
///
/// Frozen energy (theory: laws, eq. 19): back stress c; the dissipation is Lambda' (f + a) >= 0.
/// beta <= 1 keeps c >= 0. src/material/snow.md shows what the law does with snow.

#include "furrow/material/kernel_law.h"
#include "furrow/material/models/cohesive_cam_clay/cohesive_cam_clay_parameters.h"

namespace furrow {

class CohesiveCamClay : public ElasticKernelLaw<CohesiveCamClayParameters, CohesiveCamClayKernels> {
 public:
  /// Indices of the internal variables in the state.
  enum : std::size_t { eps_vol_pl = field::internal, eps_dev_pl };

  static MaterialModel model();
  /// @param density       rho0 [kg/m^3]
  /// @param eps_vol_pl_0  initial volumetric plastic strain: size of the ellipse
  CohesiveCamClay(double density, const CohesiveCamClayParameters& parameters, double eps_vol_pl_0);

  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

  double p0(double eps) const;  ///< yield strength in hydrostatic compression [Pa]
};

}  // namespace furrow
