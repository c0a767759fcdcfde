// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the cohesive cap law: backward Euler return mapping. Equations: cohesive_cap.h.
///
/// A step has one unknown: y, the size of its volumetric plastic strain. Elasticity gives the
/// pressure.
///   p(y) = p_el(dv - y).
/// Flow on the cap is along (b^2 p, q), so the deviator shrinks radially to q_c.
///   q_c(y) = q_tr p/(p + (3 G/b^2) y).
/// The shear line cuts what exceeds it, q = min(q_c, d + p tan(beta)). Corner and cap are thus one
/// equation.
///   f(y) = sqrt(p^2 + (q/A)^2) - pc(eps_n + y) = 0.
/// Tension opens the material by y, and has its own equation.
///   f(y) = -p_el(dv + y) - tension_ratio d(eps_n - y) = 0.
/// Either f is negative at the y where p = 0, so the root is bracketed. Shear alone leaves p and
/// cuts q.

#include "furrow/material/block_update.h"
#include "furrow/material/elasticity/elasticity_kernel.h"
#include "furrow/material/hardening/hardening_kernel.h"
#include "furrow/material/hardening_step.h"
#include "furrow/material/models/cohesive_cap/cohesive_cap_parameters.h"
#include "furrow/simd/root_solver.h"

namespace furrow {
inline namespace FURROW_ISA {

struct CohesiveCapKernel {
  static constexpr int internal_variables = 2;  // eps_vol_pl, eps_dev_pl
  const CohesiveCapParameters& parameters;

  /// d(eps); the exponent is bounded where d is below rounding, or beyond any pressure on earth.
  FURROW_INLINE Lanes intercept(const Lanes& eps) const {
    return Lanes(parameters.d) * exponential(max(min(Lanes(parameters.growth) * eps, 80.0), -80.0));
  }

  FURROW_INLINE void step(const Symmetric& strain, Points<internal_variables>& points) const {
    const Lanes tan_beta = parameters.tan_beta, tension = parameters.tension,
                over_aspect = 1.0 / parameters.aspect;
    const ElasticStep elastic(parameters.elasticity, points.stress.trace() * Lanes(-1.0 / 3.0));
    const Lanes dv = -strain.trace();
    const Symmetric s_old = points.stress.plus_identity(elastic.p_n);
    const Symmetric s_trial = s_old + strain.deviator() * (Lanes(2.0) * elastic.shear);
    const Lanes p_trial = elastic.pressure(dv);
    const Lanes q_trial = sqrt(contract(s_trial, s_trial) * Lanes(1.5));
    const Lanes eps_old = points.internal[0];
    Hardening hardening(parameters.hardening);
    const Lanes pc_old = hardening.at(eps_old).value, d_old = intercept(eps_old);
    // The slack is rounding: a point at rest on its surface is elastic.
    const auto slack = [&](const Lanes& strength, const Lanes& trial)
        __attribute__((always_inline)) {
      return Lanes(1e-13) * strength + Lanes(1e-15) * abs(trial);
    };
    const Lanes line = max(d_old + p_trial * tan_beta, 0.0);
    const Lanes q_cut = min(q_trial, line);
    const Lanes distance_old = sqrt(square(p_trial) + square(q_cut * over_aspect));
    const Mask compacting = p_trial > Lanes(0.0) && distance_old - pc_old > slack(pc_old, p_trial);
    const Mask opening = -p_trial - tension * d_old > slack(tension * d_old, p_trial);
    const Lanes limit_old =
        select(p_trial > Lanes(0.0), line, min(line, Lanes(parameters.aspect) * pc_old));
    const Mask flowing = compacting || opening;
    const Mask yielding = flowing || q_trial - limit_old > slack(limit_old, q_trial);

    Lanes p = p_trial, q = q_trial, compaction = 0.0;
    if (any(yielding)) {
      q = select(yielding, min(q_trial, limit_old), q_trial);
      where(yielding, points.branch) = double(Branch::shear);
    }
    if (any(flowing)) {
      const Lanes sign = select(opening, -1.0, 1.0);
      const Lanes k = elastic.shear * Lanes(3.0 / parameters.flow);
      Lanes pressure = p_trial, radial = q_trial, pc = pc_old, d = d_old;
      const auto residual = [&](const Lanes& y) __attribute__((always_inline))->ValueAndSlope {
        const Lanes eps = eps_old + sign * y;
        const Hardening::Strength cap = hardening.at(eps);
        pc = cap.value;
        d = intercept(eps);
        const Lanes d_slope = d * Lanes(parameters.growth);
        const auto [elastic_pressure, bulk] = elastic.response(dv - sign * y);
        pressure = select(opening, elastic_pressure, max(elastic_pressure, 0.0));
        const Lanes share = Lanes(1.0) / max(pressure + k * y, 1e-290);
        const Lanes cone = d + pressure * tan_beta, shrunk = q_trial * pressure * share;
        const Mask cut = shrunk > cone;
        radial = select(cut, cone, shrunk);
        const Lanes radial_slope = select(cut, d_slope - tan_beta * bulk,
                                          -q_trial * k * (y * bulk + pressure) * share * share);
        const Lanes height = radial * over_aspect;
        const Lanes distance = sqrt(square(pressure) + square(height));
        const Lanes along =
            (height * radial_slope * over_aspect - pressure * bulk) / max(distance, 1e-290);
        return {select(opening, -pressure - tension * d, distance - pc),
                select(opening, tension * d_slope - bulk, along - cap.slope)};
      };
      const Lanes high = sign * (dv - elastic.strain(0.0));
      const Mask bracketed = flowing && high > Lanes(0.0) && finite(high);
      const Lanes rounding = Lanes(4e-16) * (abs(eps_old) + abs(dv));
      // First guess: back along the ray from the origin, at constant strength.
      const Lanes share_of_trial =
          select(opening, -tension * d_old / p_trial, pc_old / distance_old);
      const Lanes guess = select(bracketed, high * (Lanes(1.0) - share_of_trial), 0.0);
      const Lanes y = decreasing_root(residual, guess, 0.0, high, Lanes(1e-13) * high + rounding,
                                      bracketed, points.iterations);
      const Lanes solution = select(flowing, max(y, 0.0), 0.0);
      residual(solution);
      // Rounding is removed by placing the stress on its surface: along the ray from the origin, or
      // at constant p when the root could not be resolved (p_tr next to zero).
      const Lanes distance = sqrt(square(pressure) + square(radial * over_aspect));
      const Mask near = abs(distance - pc) <= Lanes(1e-6) * pc;
      const Lanes ray = select(near, pc / max(distance, 1e-290), 1.0);
      const Lanes on_cap = min(pressure * ray, pc);
      const Lanes leg = Lanes(parameters.aspect) * sqrt(max(square(pc) - square(on_cap), 0.0));
      where(flowing, p) = select(opening, -tension * d, on_cap);
      const Lanes cone = max(d + p * tan_beta, 0.0);
      const Lanes top = select(opening, Lanes(parameters.aspect) * pc,
                               select(near, radial * ray, min(radial, leg)));
      where(flowing, q) = min(min(top, cone), q_trial);
      where(flowing, compaction) = sign * solution;
      where(flowing, points.branch) = select(opening, double(Branch::tension), double(Branch::cap));
    }
    const Lanes scale = select(yielding, q / max(q_trial, 1e-290), 1.0);
    ReturnedPoint end{s_trial * scale, p, compaction, 0.0, yielding};
    if (parameters.relaxation > 0.0)
      delay_return(parameters.relaxation, points.time_step, dv, elastic, s_trial, end);
    end_hardening_step(strain, elastic, s_trial, end, hardening, points);
  }
};

inline BlockResult update_cohesive_cap(const CohesiveCapParameters& parameters, double density,
                                       const PointBlock& block) {
  return update_points(CohesiveCapKernel{parameters}, density, block);
}

constexpr void fill(CohesiveCapKernels& kernels) { kernels.update = update_cohesive_cap; }

}  // namespace FURROW_ISA
}  // namespace furrow
