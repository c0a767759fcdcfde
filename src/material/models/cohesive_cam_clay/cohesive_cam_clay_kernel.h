// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the cohesive Cam clay: backward Euler return mapping [Simo1998]. Equations:
/// cohesive_cam_clay.h.
///
/// If the trial has p >= c, flow compacts; otherwise it dilates. A step has one unknown: y, the
/// size of its volumetric plastic strain De = +-y. Elasticity gives p = p_el(dv - De), and the
/// hardening gives c and a at eps_n + De. The stress has the distance D = |p - c| from the centre
/// along p, and r = q/B along q. Associated flow shrinks r.
///   r(y) = r_tr D/(D + (3 G/B^2) y).
/// The step ends on the ellipse.
///   f(y) = sqrt(D^2 + r^2) - a = 0.
/// D and r fall as y grows. At the y that brings the pressure to the c of the start of the step,
/// both are 0 and f < 0, so the root is bracketed. Compaction has one root. Dilation may have
/// several where p0 softens more steeply than the point is stiff. The search then ends at one of
/// them.

#include "furrow/material/block_update.h"
#include "furrow/material/elasticity/elasticity_kernel.h"
#include "furrow/material/hardening/hardening_kernel.h"
#include "furrow/material/hardening_step.h"
#include "furrow/material/models/cohesive_cam_clay/cohesive_cam_clay_parameters.h"
#include "furrow/simd/root_solver.h"

namespace furrow {
inline namespace FURROW_ISA {

struct CohesiveCamClayKernel {
  static constexpr int internal_variables = 2;  // eps_vol_pl, eps_dev_pl
  const CohesiveCamClayParameters& parameters;

  FURROW_INLINE void step(const Symmetric& strain, Points<internal_variables>& points) const {
    const Lanes centre = parameters.centre, radius = parameters.radius;
    const ElasticStep elastic(parameters.elasticity, points.stress.trace() * Lanes(-1.0 / 3.0));
    const Lanes dv = -strain.trace();
    const Symmetric s_old = points.stress.plus_identity(elastic.p_n);
    const Symmetric s_trial = s_old + strain.deviator() * (Lanes(2.0) * elastic.shear);
    const Lanes p_trial = elastic.pressure(dv);
    const Lanes r_trial =
        sqrt(contract(s_trial, s_trial) * Lanes(1.5 / (parameters.aspect * parameters.aspect)));
    const Lanes eps_old = points.internal[0];
    Hardening hardening(parameters.hardening);
    const Lanes p0_old = hardening.at(eps_old).value;
    // The slack is rounding: a point at rest on its surface is elastic.
    const Lanes excess =
        sqrt(square(p_trial - centre * p0_old) + square(r_trial)) - radius * p0_old;
    const Mask yielding = excess > Lanes(1e-13) * p0_old + Lanes(1e-15) * abs(p_trial);

    Lanes p = p_trial, scale = 1.0, compaction = 0.0, p0 = p0_old;
    if (any(yielding)) {
      const Lanes sign = select(p_trial < centre * p0_old, -1.0, 1.0);
      const Lanes k = elastic.shear * Lanes(3.0 / (parameters.aspect * parameters.aspect));
      Lanes D = 0.0, r = 0.0, distance = 0.0, now = p0_old;
      const auto residual = [&](const Lanes& y) __attribute__((always_inline))->ValueAndSlope {
        const Hardening::Strength strength = hardening.at(eps_old + sign * y);
        now = strength.value;
        const Lanes x = dv - sign * y, pressure = elastic.pressure(x);
        D = max(sign * (pressure - centre * now), 0.0);
        const Lanes dD = -elastic.bulk(x, pressure) - centre * strength.slope;
        const Lanes share = Lanes(1.0) / max(D + k * y, 1e-290);
        r = r_trial * D * share;
        const Lanes dr = r_trial * k * (dD * y - D) * share * share;
        distance = sqrt(square(D) + square(r));
        return {distance - radius * now,
                (D * dD + r * dr) / max(distance, 1e-290) - sign * radius * strength.slope};
      };
      const Lanes high = abs(dv - elastic.strain(centre * p0_old));
      const Mask bracketed = yielding && high > Lanes(0.0) && finite(high);
      // First guess: back along the ray from the centre, at constant size.
      const Lanes guess = select(bracketed, high * excess / (excess + radius * p0_old), 0.0);
      const Lanes rounding = Lanes(4e-16) * (abs(eps_old) + abs(dv));
      const Lanes y = decreasing_root(residual, guess, 0.0, high, Lanes(1e-13) * high + rounding,
                                      bracketed, points.iterations);
      const Lanes solution = select(yielding, max(y, 0.0), 0.0);
      residual(solution);
      // Rounding is removed by placing the stress on the ellipse: along the ray from its centre, or
      // at constant p when the root could not be resolved (p_tr next to the centre).
      const Lanes a = radius * now;
      const Mask near = abs(distance - a) <= Lanes(1e-6) * a;
      const Lanes ray = a / max(distance, 1e-290);
      const Lanes on_ellipse = select(near, D * ray, min(D, a));
      const Lanes leg = sqrt(max(square(a) - square(on_ellipse), 0.0));
      where(yielding, p) = centre * now + sign * on_ellipse;
      where(yielding && r_trial > Lanes(0.0), scale) =
          min(select(near, r * ray, leg) / r_trial, 1.0);
      where(yielding, compaction) = sign * solution;
      where(yielding, p0) = now;
      const Lanes loosening =
          select(p < Lanes(0.0), double(Branch::tension), double(Branch::shear));
      where(yielding, points.branch) = select(sign > Lanes(0.0), double(Branch::cap), loosening);
    }
    end_hardening_step(strain, elastic, s_trial,
                       {s_trial * scale, p, compaction, centre * p0, yielding}, hardening, points);
  }
};

inline BlockResult update_cohesive_cam_clay(const CohesiveCamClayParameters& parameters,
                                            double density, const PointBlock& block) {
  return update_points(CohesiveCamClayKernel{parameters}, density, block);
}

constexpr void fill(CohesiveCamClayKernels& kernels) { kernels.update = update_cohesive_cam_clay; }

}  // namespace FURROW_ISA
}  // namespace furrow
