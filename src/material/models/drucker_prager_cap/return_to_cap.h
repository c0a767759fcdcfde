// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Return of the Drucker-Prager cap law to the cap (theory: laws, eq. 7): closest-point projection,
/// because flow is associated there.
///
/// The point of the cap is p = pa + R Q cos(phi), t = A Q sin(phi). Unknown are the volumetric
/// plastic strain of the step, De, and u = tan(phi). The sizes pa and Q of the cap follow from the
/// strain eps_n + De. Associated flow gives the factor m of the deviatoric return, where G is the
/// shear modulus of the return of t:
///   m = 3 G Lambda = 3 G R De/(A^2 Q) sqrt(1 + u^2).
/// Two equations remain. The first states that the pressure is elastic, the second that t returns
/// from its trial value:
///   f = p_el(dv - De) - pa - R Q cos(phi) = 0.
///   g = A Q sin(phi) (1 + m) - t_tr = 0.
/// Newton's method solves both together if elasticity is linear. Points that have not converged
/// after a few iterations, and those of porous elasticity, are solved with one equation inside the
/// other, each within a bracket, which always converges.

#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap_trial.h"

namespace furrow {
inline namespace FURROW_ISA {

/// tan(phi) is not below this: sin(phi) <= min(tan(phi), 1) in A Q sin(phi) (1 + m) = t_tr with
/// m = k sqrt(1 + u^2). @param top  A Q
FURROW_INLINE Lanes min_tangent(const Lanes& t, const Lanes& top, const Lanes& k) {
  return min(max(t / (top * (k + Lanes(1.0))), (t - top) / (top * max(k, 1e-140))), 1e140);
}

FURROW_INLINE void finish_cap(const DruckerPragerCapParameters& parameters, const Mask& active,
                              const CapTrial& trial, const CapSurfaces& now, const Lanes& cosine,
                              const Lanes& sine, const Lanes& de, CapReturn& end) {
  where(active, end.compaction) = de;
  where(active, end.p) = now.pa + Lanes(parameters.R) * now.Q * cosine;
  where(active, end.t) = min(Lanes(parameters.A) * now.Q * sine, trial.t);
  where(active, end.pa) = now.pa;
  where(active, end.branch) = double(Branch::cap);
}

/// Solves both equations together, by Newton's method in (De, u), for linear elasticity: there
/// g = A Q sin(phi) + 3 G (R/A) De u - t_tr. @return the points that it has not solved
FURROW_INLINE Mask solve_cap_together(const DruckerPragerCapParameters& parameters,
                                      const Mask& active, const CapTrial& trial, const Lanes& guess,
                                      CapReturn& end) {
  const Lanes A = parameters.A, R = parameters.R, tan_beta = parameters.tan_beta,
              bulk = parameters.elasticity.bulk;
  const Lanes b = Lanes(3.0 * parameters.R / parameters.A) * trial.shear;
  Lanes de = guess;
  Lanes u = min_tangent(trial.t, A * trial.start.Q, b * guess / (A * trial.start.Q));
  CapSurfaces now = trial.start;
  Lanes cosine = 1.0;
  Lanes sine = 0.0;
  Mask solved(false);
  const Lanes tolerance = Lanes(2e-14) * trial.p + bulk * trial.noise();
  constexpr int max_iterations = 9;
  for (int i = 0;; ++i) {
    now = surfaces_at(parameters, trial.hardening, trial.eps + de);
    cosine = Lanes(1.0) / sqrt(Lanes(1.0) + u * u);
    sine = u * cosine;
    const Lanes f = trial.p - bulk * de - now.pa - R * now.Q * cosine;
    const Lanes g = A * now.Q * sine + b * de * u - trial.t;
    where(active && !solved, end.iterations) += 1.0;
    const Mask converged = abs(f) <= tolerance && abs(g) <= Lanes(1e-13) * trial.t;
    solved = solved || (converged && de >= Lanes(0.0) && u >= Lanes(0.0));
    if (i == max_iterations || all(solved || !active)) break;
    // - f = f_de dde + f_u du,  - g = g_de dde + g_u du
    const Lanes f_de = -bulk - now.pa_slope * (Lanes(1.0) + R * tan_beta * cosine);
    const Lanes f_u = R * now.Q * sine * cosine * cosine;
    const Lanes g_de = A * tan_beta * now.pa_slope * sine + b * u;
    const Lanes g_u = A * now.Q * cosine * cosine * cosine + b * de;
    const Lanes f_over = Lanes(1.0) / (f_de * g_u - f_u * g_de);
    const Lanes dde = (f_u * g - f * g_u) * f_over;
    const Lanes du = (f * g_de - f_de * g) * f_over;
    de = select(solved, de, max(de + dde, Lanes(0.1) * de));
    u = select(solved, u, max(u + du, Lanes(0.1) * u));
  }
  finish_cap(parameters, active && solved, trial, now, cosine, sine, de, end);
  return active && !solved;
}

/// Solves one equation inside the other, each within a bracket: g increases with u, and f with the
/// u that solves g decreases with De.
inline void solve_cap_nested(const DruckerPragerCapParameters& parameters, const Mask& active,
                             const CapTrial& trial, const Lanes& guess, CapReturn& end) {
  const ElasticStep& elastic = trial.elastic;
  const Lanes A = parameters.A, R = parameters.R;
  const Lanes k_factor = Lanes(3.0 * parameters.R / (parameters.A * parameters.A)) * trial.shear;
  Lanes u = 0.0;
  CapSurfaces now = trial.start;
  struct Angle {
    Lanes cosine, sine, length, m, slope;
  };
  Angle angle{};
  // g = 0 for tan(phi) at a given De. Concave in u for K = 1, so Newton's method from the left is
  // monotone.
  const auto solve_angle = [&](const Lanes& de) {
    const Lanes top = A * now.Q;
    const Lanes k = k_factor * de / now.Q;  // m = k sqrt(1 + u^2)
    const Lanes left = min_tangent(trial.t, top, k);
    Lanes low = 0.0, high = 1e150;
    u = max(u, left);
    Mask open = active;
    for (int i = 0; i < max_root_iterations; ++i) {
      const Lanes length = sqrt(Lanes(1.0) + u * u), cosine = Lanes(1.0) / length,
                  sine = u * cosine;
      const Lanes multiplier = k * length;
      const Lanes value = top * sine * (Lanes(1.0) + multiplier) - trial.t;
      const Lanes slope =
          top * (cosine * cosine * cosine * (Lanes(1.0) + multiplier) + sine * k * sine);
      angle = {cosine, sine, length, multiplier, slope};
      if (!any(open)) break;
      where(open, end.iterations) += 1.0;
      where(open && value > Lanes(0.0), high) = u;
      where(open && !(value > Lanes(0.0)), low) = u;
      const Lanes newton = u - value / slope;
      const Mask inside = newton >= low && newton <= high;
      const Lanes halfway =
          select(high < Lanes(1e149), Lanes(0.5) * (low + high), Lanes(2.0) * u + Lanes(1.0));
      const Lanes next = min(
          select(inside, newton, select(newton < low, max(left, Lanes(0.5) * (low + u)), halfway)),
          1e140);
      const Mask done = abs(next - u) <= Lanes(1e-14) * next || high - low <= Lanes(1e-15) * high ||
                        abs(value) <= Lanes(2e-15) * trial.t;  // the rounding of t_tr
      u = select(open, next, u);
      open = open && !done;
    }
  };
  const auto residual = [&](const Lanes& de) -> ValueAndSlope {
    now = surfaces_at(parameters, trial.hardening, trial.eps + de);
    solve_angle(de);
    const Lanes x = trial.dv - de, pressure = elastic.pressure(x);
    const Lanes cap_pressure = now.pa + R * now.Q * angle.cosine;
    // d(cos phi)/d(De) by the implicit derivative of g = 0
    const Lanes dQ = Lanes(parameters.tan_beta) * now.pa_slope;
    const Lanes m_slope = (k_factor * angle.length - angle.m * dQ) / now.Q;
    const Lanes inner = A * angle.sine * (dQ * (Lanes(1.0) + angle.m) + now.Q * m_slope);
    const Lanes dcos = angle.sine * square(angle.cosine) * inner / angle.slope;
    const Lanes slope =
        -elastic.bulk(x, pressure) - now.pa_slope - R * (dQ * angle.cosine + now.Q * dcos);
    return {pressure - cap_pressure, slope};
  };
  const Lanes floor = Lanes(-parameters.elasticity.limit) +
                      Lanes(1e-12) * (elastic.p_n + parameters.elasticity.limit);
  const Lanes high =
      trial.dv - elastic.strain(parameters.elasticity.porous ? floor : trial.start.pa);
  const Lanes de =
      decreasing_root(residual, min(guess, high), 0.0, high, Lanes(1e-13) * high + trial.noise(),
                      active && high > Lanes(0.0), end.iterations);
  const Lanes solution = select(active, max(de, 0.0), 0.0);
  residual(solution);
  finish_cap(parameters, active, trial, now, angle.cosine, angle.sine, solution, end);
}

FURROW_INLINE void return_to_cap(const DruckerPragerCapParameters& parameters, const Mask& active,
                                 const CapTrial& trial, CapReturn& end) {
  const CapSurfaces& old = trial.start;
  // First guess: De at constant t and size of the cap.
  const Lanes share = trial.t / (Lanes(parameters.A) * old.Q);
  const Lanes cosine = sqrt(max(Lanes(1.0) - share * share, 0.0));
  const Lanes excess = trial.p - old.pa - Lanes(parameters.R) * old.Q * cosine;
  const Lanes stiffness =
      trial.elastic.bulk(trial.dv, trial.p) +
      old.pa_slope * (Lanes(1.0) + Lanes(parameters.R * parameters.tan_beta) * cosine);
  const Lanes guess = max(excess / stiffness, 0.0);
  Mask open = active;
  if (!parameters.elasticity.porous)
    open = solve_cap_together(parameters, active, trial, guess, end);
  if (any(open)) solve_cap_nested(parameters, open, trial, guess, end);
}

}  // namespace FURROW_ISA
}  // namespace furrow
