// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Modified Drucker-Prager cap, as [Shoop2001] (eq 12-16) takes it from ABAQUS. Stresses p, t:
/// compression positive, core/types.h.
///
///   t = (q/2) [1 + 1/K - (1 - 1/K)(r/q)^3], or the section of smooth cones (section/section.h)
///   shear (12):       t - p tan(beta) - d = 0
///   cap (13):         sqrt( (p - pa)^2 + (R t/(1 + alpha - alpha/cos(beta)))^2 )
///                       - R (d + pa tan(beta)) = 0
///   (14):             pa = (pb - R d)/(1 + R tan(beta)), with the tip of the cap pb(eps_vol_pl)
///                     from the hardening
///   transition (15):  sqrt( (p - pa)^2 + (t - (1 - alpha/cos(beta))(d + pa tan(beta)))^2 )
///                       - alpha (d + pa tan(beta)) = 0
///   flow:             associated on the cap; on shear and transition by the potential
///   (16):             G = sqrt( ((pa - p) tan(beta))^2 + (t/(1 + alpha - alpha/cos(beta)))^2 )
///   tension cut-off:  p >= -cutoff, purely volumetric flow; without it the apex p = -d/tan(beta)
///                     ends the shear line
///
/// Flow at p < pa loosens and so softens the cap (pa falls) until p = pa, the critical state.
/// Thermodynamics: (16) loosens faster than friction does where p < pa/2 (at d = 0), so the plastic
/// work there is negative: flow releases energy that compaction has frozen in (frozen elastic
/// energy: I. F. Collins, Geotechnique 55 (2005) 373). With the frozen energy
/// psi(eps_vol_pl) = integral of pa d(eps_vol_pl) the rest, sigma : d(eps_pl) - pa d(eps_vol_pl),
/// is never negative, because both potentials grow away from (pa, 0).

#include "material/material_model.h"
#include "material/models/drucker_prager_cap/drucker_prager_cap_parameters.h"

namespace furrow {

class DruckerPragerCap : public Material {
 public:
  /// Indices of the law's own variables in the state.
  enum : std::size_t { eps_vol_pl = field::internal, eps_dev_pl };

  static MaterialModel model();
  /// @param density       rho0 [kg/m^3]
  /// @param eps_vol_pl_0  initial volumetric plastic strain: positions the cap
  DruckerPragerCap(double density, const DruckerPragerCapParameters& parameters,
                   double eps_vol_pl_0);

  UpdateReport update_block(const PointBlock& block) const override;
  ElasticModuli moduli(const VectorX& state) const override;
  double largest_wave_speed(const PointBlock& block) const override;
  double yield_function(const VectorX& state) const override;
  double stress_scale(const VectorX& state) const override;
  std::vector<Vector2> yield_surface(const VectorX& state, std::size_t points = 200) const override;

  const DruckerPragerCapParameters& parameters() const { return parameters_; }
  double pb(double eps) const;  ///< tip of the cap [Pa]
  double pa(double eps) const;  ///< pressure at the top of the cap, the critical state [Pa]

 private:
  /// t on the shear line or the transition, p <= pa
  double shear_strength(double p, double eps) const;
  /// t on the whole surface, 0 outside its range of p
  double strength(double p, double eps) const;

  DruckerPragerCapParameters parameters_;
};

}  // namespace furrow
