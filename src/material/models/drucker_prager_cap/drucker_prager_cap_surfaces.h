// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Yield surfaces of the Drucker-Prager cap law at a given volumetric plastic strain (theory: laws,
/// eqs. 6 to 9). The law: drucker_prager_cap.h.

#include "furrow/material/hardening/hardening_kernel.h"
#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap_parameters.h"
#include "furrow/simd/root_solver.h"

namespace furrow {
inline namespace FURROW_ISA {

/// The surfaces at one eps_vol_pl.
struct CapSurfaces {
  Lanes pa;        ///< pressure at the top of the cap [Pa]
  Lanes Q;         ///< d + pa tan(beta): the shear line there [Pa]
  Lanes pa_slope;  ///< d(pa)/d(eps) [Pa]
};

/// pa(eps) = (pb(eps) - R d)/(1 + R tan(beta))
FURROW_INLINE CapSurfaces surfaces_at(const DruckerPragerCapParameters& parameters,
                                      Hardening& hardening, const Lanes& eps) {
  const Hardening::Strength pb = hardening.at(eps);
  const Lanes f = 1.0 / (1.0 + parameters.R * parameters.tan_beta);
  const Lanes pa = (pb.value - Lanes(parameters.R * parameters.d)) * f;
  return {pa, Lanes(parameters.d) + pa * Lanes(parameters.tan_beta), pb.slope * f};
}

/// t on the shear line or the transition at p <= pa, and its derivative when p grows by dp, pa by
/// dpa. @param transition  set to the points on the transition, or null
FURROW_INLINE ValueAndSlope shear_strength(const DruckerPragerCapParameters& parameters,
                                           const CapSurfaces& at, const Lanes& p, const Lanes& dp,
                                           const Lanes& dpa, Mask* transition) {
  const Lanes tan_beta = parameters.tan_beta;
  ValueAndSlope t{Lanes(parameters.d) + p * tan_beta, tan_beta * dp};
  if (parameters.alpha == 0.0) return t;
  const Lanes radius = Lanes(parameters.alpha) * at.Q;
  const Lanes D = max(at.pa - p, 0.0);
  const Mask on_arc = D < radius * Lanes(parameters.sin_beta);
  const Lanes leg = sqrt(max(radius * radius - D * D, 0.0));
  t.value = select(on_arc, Lanes(parameters.B) * at.Q + leg, t.value);
  t.slope = select(on_arc,
                   Lanes(parameters.B) * tan_beta * dpa +
                       (Lanes(parameters.alpha) * radius * tan_beta * dpa - D * (dpa - dp)) / leg,
                   t.slope);
  if (transition) *transition = on_arc;
  return t;
}

}  // namespace FURROW_ISA
}  // namespace furrow
