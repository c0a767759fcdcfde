// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Return mapping of the Drucker-Prager cap law in p and t: backward Euler [Simo1998], for cap
/// models [Hofstetter1993]. Equations of the law: drucker_prager_cap.h.
///
/// Unknown is the volumetric plastic strain of the step, De, compression positive. At the end
///   p = p_el(dv - De)                elasticity
///   t (1 + m) = t_tr,  m = 3 G Lambda  deviatoric return, with its shear modulus
///   (deviatoric_return.h) f(p, t, eps_n + De) = 0          the surface that the trial violates,
///   known in advance Lambda(De)                       flow rule of that surface
/// all hold with the stress and the hardening of the end of the step. The stress is then placed on
/// the surface of the final eps, so that the yield function is zero to rounding.

#include "furrow/material/models/drucker_prager_cap/return_to_cap.h"

namespace furrow {
inline namespace FURROW_ISA {

/// Shear line and transition: x = -De >= 0, D = pa - p. Flow (theory: laws, eq. 10): m = 3 G x/(A^2
/// tan^2(beta) D), and with the strength t_y(p) of the surface the equation is
///   t_tr D - t_y(p) (D + m D) = 0    decreasing in x; a quadratic on a straight piece of the
///                                    hardening table
inline void return_to_shear(const DruckerPragerCapParameters& parameters, const Mask& active,
                            const CapTrial& trial, CapReturn& end) {
  const ElasticStep& elastic = trial.elastic;
  const CapSurfaces& old = trial.start;
  const Lanes c =
      Lanes(3.0 / (parameters.A * parameters.A * parameters.tan_beta * parameters.tan_beta)) *
      trial.shear;
  CapSurfaces now = old;
  Lanes pressure = trial.p, D = 0.0, strength = 0.0;
  Mask transition(false);
  const auto residual = [&](const Lanes& x) __attribute__((always_inline))->ValueAndSlope {
    now = surfaces_at(parameters, trial.hardening, trial.eps - x);
    pressure = elastic.pressure(trial.dv + x);
    const Lanes dp = elastic.bulk(trial.dv + x, pressure), dpa = -now.pa_slope;
    const Mask before = now.pa > pressure;
    D = max(now.pa - pressure, 0.0);
    const Lanes dD = select(before, dpa - dp, 0.0);
    const ValueAndSlope yield = shear_strength(parameters, now, pressure, dp, dpa, &transition);
    strength = yield.value;
    const Lanes product = D + c * x;
    return {trial.t * D - strength * product,
            trial.t * dD - yield.slope * product - strength * (dD + c)};
  };
  const Lanes high = elastic.strain(old.pa) - trial.dv;
  const Lanes positive = max(shear_strength(parameters, old, trial.p, 0.0, 0.0, nullptr).value,
                             Lanes(1e-3) * trial.t + Lanes(1e-290));
  const Lanes ratio = trial.t / positive - Lanes(1.0);
  const Lanes start = min(
      ratio * (old.pa - trial.p) / (c + ratio * (elastic.bulk(trial.dv, trial.p) + old.pa_slope)),
      high);
  // p and t are taken from the final x, on the surface: a last step of 1e-10 leaves the direction
  // of flow exact to that, at least.
  const Lanes x = decreasing_root(residual, start, 0.0, high, Lanes(1e-10) * high,
                                  active && high > Lanes(0.0), end.iterations);
  const Lanes solution = select(active, max(x, 0.0), 0.0);
  residual(solution);
  pressure = min(pressure, now.pa);  // the pressure is below, except for rounding
  strength = shear_strength(parameters, now, pressure, 0.0, 0.0, nullptr).value;
  const Mask apex = strength <= Lanes(1e-12) * now.Q;
  where(active, end.compaction) = -solution;
  where(active, end.p) = pressure;
  where(active, end.t) = min(max(strength, 0.0), trial.t);
  where(active, end.pa) = now.pa;
  where(active, end.branch) =
      select(apex, double(Branch::tension),
             select(transition, double(Branch::transition), double(Branch::shear)));
}

/// Tension cut-off, p = -cutoff: De follows from the elastic law, and t is the smaller of the
/// trial's and the yield surface's.
inline void return_to_cutoff(const DruckerPragerCapParameters& parameters, const Mask& active,
                             const CapTrial& trial, CapReturn& end) {
  const Lanes pressure = -parameters.cutoff;
  const Lanes de = select(active, trial.dv - trial.elastic.strain(pressure), 0.0);
  const CapSurfaces now = surfaces_at(parameters, trial.hardening, trial.eps + de);
  const Lanes D = pressure - now.pa;
  const Lanes on_cap = Lanes(parameters.A / parameters.R) *
                       sqrt(max(square(Lanes(parameters.R) * now.Q) - D * D, 0.0));
  const Lanes strength =
      max(select(D > Lanes(0.0), on_cap,
                 shear_strength(parameters, now, pressure, 0.0, 0.0, nullptr).value),
          0.0);
  const Lanes measure = min(trial.t, strength);
  where(active, end.iterations) += 1.0;
  where(active, end.compaction) = de;
  where(active, end.p) = pressure;
  where(active, end.t) = measure;
  where(active, end.pa) = now.pa;
  where(active, end.branch) = double(Branch::tension);
}

/// Returns the end of the step: the trial where it is elastic, else its return to the surface it
/// violates.
FURROW_INLINE CapReturn return_mapping(const DruckerPragerCapParameters& parameters,
                                       const ViolatedSurface& violated, const CapTrial& trial) {
  CapReturn end;
  end.p = trial.p;
  end.t = trial.t;
  if (any(violated.cap)) return_to_cap(parameters, violated.cap, trial, end);
  if (any(violated.shear)) return_to_shear(parameters, violated.shear, trial, end);
  const Mask cut = (violated.cap || violated.shear || violated.tension) &&
                   end.p < Lanes(-parameters.cutoff * (1.0 + 1e-15));
  if (any(cut)) return_to_cutoff(parameters, cut, trial, end);
  return end;
}

}  // namespace FURROW_ISA
}  // namespace furrow
