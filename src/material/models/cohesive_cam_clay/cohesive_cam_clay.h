// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Cohesive Cam clay, the law of crushing snow of J. Gaume, T. Gast, J. Teran, A. van Herwijnen and
/// C. Jiang, Nature Communications 9 (2018) 3047, after K. H. Roscoe and J. B. Burland (modified
/// Cam clay, 1968). Compression positive, core/types.h.
///
///   yield:  y = q^2 (1 + 2 beta) + M^2 (p + beta p0)(p - p0) = 0,   0 <= beta <= 1
/// an ellipse from -beta p0 to p0, with centre c, half-width a and half-height B a:
///   c = (1 - beta) p0/2,   a = (1 + beta) p0/2,   B = M/sqrt(1 + 2 beta)
///   f = sqrt( (p - c)^2 + (q/B)^2 ) - a
///   flow:   associated, d(eps_pl) = Lambda dy/d(sigma), so that
///   d(eps_q)/d(eps_v) = q/(B^2 (p - c))
///   p0(eps_vol_pl): hardening.h; cohesion and tensile strength grow with it
/// Flow at p > c compacts and hardens, at p < c it loosens and softens; p = c is the critical
/// state. Where the material is torn, p0 decays with eps_vol_pl below the hardening data, never to
/// zero.
///
/// Confined compression, elastic strain neglected: d(eps_q)/d(eps_v) = 2/3, and with
/// S = sqrt(9 + 4 B^2) and sigma_1 = p + 2 q/3
///   p = c + 3 a/S,   q = 2 B^2 a/S
///   K0 = ( (1 - beta) S + (1 + beta)(3 - 2 B^2/3) )/( (1 - beta) S + (1 + beta)(3 + 4 B^2/3) )
/// and the M of a wanted K0, with eta = q/p = 3 (1 - K0)/(1 + 2 K0) and k = (1 - beta)/(1 + beta),
///   S = eta k + sqrt( (eta k)^2 + 6 eta + 9 ),   M = sqrt( (1 + 2 beta)(S^2 - 9) )/2
///
/// Thermodynamics: compaction stores the frozen energy psi = integral of c d(eps_vol_pl) (Collins,
/// Geotechnique 55 (2005) 373); the rest of the plastic work is
///   sigma : d(eps_pl) - c d(eps_vol_pl) = Lambda' (f + a) >= 0.
/// beta <= 1, or compaction would move the centre into tension. src/material/snow.md shows what the
/// law does with snow, and why flow is associated.

#include "material/material_model.h"
#include "material/models/cohesive_cam_clay/cohesive_cam_clay_parameters.h"

namespace furrow {

class CohesiveCamClay : public Material {
 public:
  /// Indices of the law's own variables in the state.
  enum : std::size_t { eps_vol_pl = field::internal, eps_dev_pl };

  static MaterialModel model();
  /// @param density       rho0 [kg/m^3]
  /// @param eps_vol_pl_0  initial volumetric plastic strain: size of the ellipse
  CohesiveCamClay(double density, const CohesiveCamClayParameters& parameters, double eps_vol_pl_0);

  UpdateReport update_block(const PointBlock& block) const override;
  ElasticModuli moduli(const VectorX& state) const override;
  double largest_wave_speed(const PointBlock& block) const override;
  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

  const CohesiveCamClayParameters& parameters() const { return parameters_; }
  double p0(double eps) const;  ///< yield strength in hydrostatic compression [Pa]

 private:
  CohesiveCamClayParameters parameters_;
};

}  // namespace furrow
