// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the crushable foam law: backward Euler return mapping. Equations: crushable_foam.h.
///
/// Flow is along (9/2 p, q): De = 4.5 Lambda p, deviatoric plastic strain = Lambda q. So the
/// deviator shrinks radially,
///   q = q_tr/(1 + 3 G Lambda) = q_tr |p|/(|p| + (2/3) G |De|),
/// and p keeps the sign of the trial. The unknown |De| runs from 0 to the value at which p and q
/// are 0. That point is inside the ellipse because pt > 0 and pc > 0, so the root is bracketed.

#include "furrow/material/block_update.h"
#include "furrow/material/deviatoric_return.h"
#include "furrow/material/elasticity/elasticity_kernel.h"
#include "furrow/material/hardening/hardening_kernel.h"
#include "furrow/material/hardening_step.h"
#include "furrow/material/models/crushable_foam/crushable_foam_parameters.h"
#include "furrow/simd/root_solver.h"

namespace furrow {
inline namespace FURROW_ISA {

template <SectionParameters::Kind section>
struct CrushableFoamKernel {
  static constexpr int internal_variables = 2;  // eps_vol_pl, eps_dev_pl
  const CrushableFoamParameters& parameters;

  FURROW_INLINE void step(const Symmetric& strain, Points<internal_variables>& points) const {
    const ElasticStep elastic(parameters.elasticity, points.stress.trace() * Lanes(-1.0 / 3.0));
    const Lanes dv = -strain.trace();
    const Lanes p_trial = elastic.pressure(dv);
    const Symmetric s_old = points.stress.plus_identity(elastic.p_n);
    const Symmetric s_trial = s_old + strain.deviator() * (Lanes(2.0) * elastic.shear);
    const Lanes t_trial = yield_measure<section>(parameters.section, s_trial);
    const Lanes eps_old = points.internal[0];
    Hardening hardening(parameters.hardening);
    const Lanes pc_old = hardening.at(eps_old).value;

    // Ellipse: centre (c, 0), half-width a.
    const auto excess = [&](const Lanes& pressure, const Lanes& measure, const Lanes& pc) {
      return sqrt(square(pressure - Lanes(0.5) * (pc - parameters.pt)) +
                  square(measure * (1.0 / parameters.M))) -
             Lanes(0.5) * (pc + parameters.pt);
    };
    const Mask yielding = excess(p_trial, t_trial, pc_old) >
                          Lanes(1e-13) * (pc_old + parameters.pt) + Lanes(1e-15) * abs(p_trial);

    Lanes p = p_trial, scale = 1.0, compaction = 0.0;
    if (any(yielding)) {
      const Lanes sign = select(p_trial < Lanes(0.0), -1.0, 1.0);
      Lanes pressure = p_trial, measure = t_trial, c = 0.0, a = 0.0;
      const auto residual = [&](const Lanes& y) __attribute__((always_inline))->ValueAndSlope {
        const Hardening::Strength pc = hardening.at(eps_old + sign * y);
        const auto [elastic_pressure, bulk] = elastic.response(dv - sign * y);
        pressure = sign * max(sign * elastic_pressure, 0.0);
        const Lanes k = Lanes(2.0 / 3.0) * elastic.shear, size = abs(pressure);
        const Lanes sum = max(size + k * y, 1e-290);
        measure = t_trial * size / sum;
        const Lanes measure_slope = -t_trial * k * (y * bulk + size) / (sum * sum);
        c = Lanes(0.5) * (pc.value - parameters.pt);
        a = Lanes(0.5) * (pc.value + parameters.pt);
        const Lanes dpc = Lanes(0.5) * sign * pc.slope;
        const Lanes distance = sqrt(square(pressure - c) + square(measure * (1.0 / parameters.M)));
        const Lanes along = (pressure - c) * (-sign * bulk - dpc) +
                            measure * measure_slope * (1.0 / (parameters.M * parameters.M));
        return {distance - a, along / max(distance, 1e-290) - dpc};
      };
      const Lanes high = sign * (dv - elastic.strain(0.0));
      const Lanes y = decreasing_root(residual, 0.0, 0.0, high, Lanes(1e-15) * high,
                                      yielding && high > Lanes(0.0), points.iterations);
      const Lanes solution = select(yielding, max(y, 0.0), 0.0);
      residual(solution);
      // Rounding is removed by placing the stress on the ellipse: along the ray from its centre, or
      // at constant p when the root could not be resolved (p_tr next to zero).
      const Lanes distance = sqrt(square(pressure - c) + square(measure * (1.0 / parameters.M)));
      const Mask near = abs(distance - a) <= Lanes(1e-6) * a;
      const Lanes ray = sign * max(sign * (c + (pressure - c) * a / distance), 0.0);
      const Lanes leg = Lanes(parameters.M) * sqrt(max(a * a - square(pressure - c), 0.0));
      const Lanes t = select(near, measure * a / distance, min(leg, t_trial));
      where(yielding, p) = select(near, ray, pressure);
      where(yielding && t_trial > Lanes(0.0), scale) = t / t_trial;
      where(yielding, compaction) = sign * solution;
      where(yielding, points.branch) =
          select(sign > Lanes(0.0), double(Branch::cap), double(Branch::tension));
    }
    end_hardening_step(strain, elastic, s_trial, {s_trial * scale, p, compaction, 0.0, yielding},
                       hardening, points);
  }
};

inline BlockResult update_crushable_foam(const CrushableFoamParameters& parameters, double density,
                                         const PointBlock& block) {
  return for_section(parameters.section, [&](auto kind) {
    return update_points(CrushableFoamKernel<kind.value>{parameters}, density, block);
  });
}

constexpr void fill(CrushableFoamKernels& kernels) { kernels.update = update_crushable_foam; }

}  // namespace FURROW_ISA
}  // namespace furrow
