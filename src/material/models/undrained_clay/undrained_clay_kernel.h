// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the undrained clay: backward Euler. Equations: undrained_clay.h.
///
/// The plastic strain y of the step follows from one equation.
///   q_tr - 3 G y - q_y R(y) S(eps + y) = 0
/// Without rate and sensitivity it is linear. A sudden step of clay with a rate is elastic.

#include "furrow/material/block_update.h"
#include "furrow/material/elasticity/elasticity_kernel.h"
#include "furrow/material/models/undrained_clay/undrained_clay_parameters.h"
#include "furrow/simd/exponential.h"
#include "furrow/simd/root_solver.h"

namespace furrow {
inline namespace FURROW_ISA {

struct UndrainedClayKernel {
  static constexpr int internal_variables = 2;  // eps_dev_pl, band_width
  const UndrainedClayParameters& parameters;

  FURROW_INLINE void step(const Symmetric& strain, Points<internal_variables>& points) const {
    const double G = parameters.elasticity.shear, q_y = parameters.q;
    const ElasticStep elastic(parameters.elasticity, points.stress.trace() * Lanes(-1.0 / 3.0));
    const Lanes dv = -strain.trace(), p = elastic.pressure(dv);
    const Symmetric s_old = points.stress.plus_identity(elastic.p_n);
    const Symmetric s_trial = s_old + strain.deviator() * Lanes(2.0 * G);
    const Lanes q_trial = sqrt(contract(s_trial, s_trial) * Lanes(1.5));

    const bool softens = parameters.remoulded<1.0, has_rate = parameters.rate_gain> 0.0;
    const Lanes decay = softens ? points.internal[1] * Lanes(parameters.decay) : Lanes(0.0);
    const Lanes loss = softens ? exponential(-decay * points.internal[0]) *
                                     Lanes(q_y * (1.0 - parameters.remoulded))
                               : Lanes(0.0);
    const Lanes remoulded = softens ? q_y * parameters.remoulded : q_y;
    const Lanes intact = remoulded + loss, excess = q_trial - intact;
    // The slack is rounding: a point at rest on the surface is elastic.
    Mask yielding = excess > Lanes(1e-13) * (abs(p) + intact);
    if (has_rate && !(points.time_step > 0.0)) yielding = Mask(false);
    Lanes y = excess * Lanes(1.0 / (3.0 * G));
    if ((softens || has_rate) && any(yielding)) {
      const Lanes slow = points.time_step * parameters.reference_rate * 0.57735026918962576451;
      const auto residual = [&](const Lanes& at) __attribute__((always_inline))->ValueAndSlope {
        const Lanes left = softens ? loss * exponential(-decay * at) : Lanes(0.0);
        Lanes strength = remoulded + left, slope = -decay * left;
        if (has_rate) {
          const Mask fast = at > slow;
          const Lanes gain = parameters.rate_gain;
          const Lanes rate = Lanes(1.0) + select(fast, gain * logarithm(max(at, slow) / slow), 0.0);
          slope = slope * rate + select(fast, strength * gain / max(at, slow), 0.0);
          strength *= rate;
        }
        return {q_trial - Lanes(3.0 * G) * at - strength, -Lanes(3.0 * G) - slope};
      };
      const Lanes high = q_trial * Lanes(1.0 / (3.0 * G));
      const Lanes start = has_rate ? min(y, slow) : y;
      y = decreasing_root(residual, start, Lanes(0.0), high, Lanes(1e-14) * high, yielding,
                          points.iterations);
    }
    const Lanes share =
        select(yielding, (q_trial - Lanes(3.0 * G) * y) / max(q_trial, 1e-290), 1.0);
    const Symmetric s = s_trial * share;
    const double half_compliance = 0.5 / G;
    points.stored = elastic.volumetric_work(dv, p) +
                    contract(s + s_old, s - s_old) * Lanes(0.5 * half_compliance);
    points.dissipated = select(yielding, contract(s, s_trial - s) * Lanes(half_compliance), 0.0);
    points.internal[0] += select(yielding, y, 0.0);
    points.stress = s.plus_identity(-p);
    points.branch = select(yielding, double(Branch::shear), double(Branch::elastic));
  }
};

inline BlockResult update_undrained_clay(const UndrainedClayParameters& parameters, double density,
                                         const PointBlock& block) {
  return update_points(UndrainedClayKernel{parameters}, density, block);
}

constexpr void fill(UndrainedClayKernels& kernels) { kernels.update = update_undrained_clay; }

}  // namespace FURROW_ISA
}  // namespace furrow
