// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the Drucker-Prager law: return mapping in closed form. Equations: drucker_prager.h.
///
/// The elastic trial state (p_tr, q_tr) lies beyond the shear line by f. It returns along the flow
/// by the plastic shear strain y:
///   y = f/(3 G + K tan(beta) tan(psi)).
///   q = q_tr - 3 G y,  p = p_tr + K tan(psi) y.
/// A state that would pass the apex of the cone returns to the apex.

#include "furrow/material/block_update.h"
#include "furrow/material/elasticity/elasticity_kernel.h"
#include "furrow/material/models/drucker_prager/drucker_prager_parameters.h"

namespace furrow {
inline namespace FURROW_ISA {

struct DruckerPragerKernel {
  static constexpr int internal_variables = 2;  // eps_vol_pl, eps_dev_pl
  const DruckerPragerParameters& parameters;

  FURROW_INLINE void step(const Symmetric& strain, Points<internal_variables>& points) const {
    const double K = parameters.elasticity.bulk, G = parameters.elasticity.shear,
                 tan_beta = parameters.tan_beta, tan_psi = parameters.tan_psi;
    const ElasticStep elastic(parameters.elasticity, points.stress.trace() * Lanes(-1.0 / 3.0));
    const Lanes dv = -strain.trace();
    const Symmetric s_old = points.stress.plus_identity(elastic.p_n);
    const Symmetric s_trial = s_old + strain.deviator() * Lanes(2.0 * G);
    const Lanes p_trial = elastic.pressure(dv);
    const Lanes q_trial = sqrt(contract(s_trial, s_trial) * Lanes(1.5));
    const Lanes excess = q_trial - Lanes(parameters.d) - p_trial * Lanes(tan_beta);
    // The slack is rounding: a point at rest on the line is elastic.
    const Mask yielding = excess > Lanes(1e-13) * (abs(p_trial) + Lanes(parameters.d));
    const Lanes y = select(yielding, excess * Lanes(1.0 / (3.0 * G + K * tan_beta * tan_psi)), 0.0);
    const Lanes q_line = q_trial - Lanes(3.0 * G) * y;
    const Mask apex = yielding && q_line < Lanes(0.0);
    const double p_apex = tan_beta > 0.0 ? -parameters.d / tan_beta : 0.0;
    const Lanes p = select(apex, p_apex, p_trial + Lanes(K * tan_psi) * y),
                share = select(yielding, select(apex, 0.0, q_line / max(q_trial, 1e-290)), 1.0);
    const Lanes compaction = select(yielding, (p_trial - p) * Lanes(1.0 / K), 0.0);
    const Symmetric s = s_trial * share;
    const double half_compliance = 0.5 / G;
    points.stored = elastic.volumetric_work(dv - compaction, p) +
                    contract(s + s_old, s - s_old) * Lanes(0.5 * half_compliance);
    points.dissipated =
        p * compaction + select(yielding, contract(s, s_trial - s) * Lanes(half_compliance), 0.0);
    points.internal[0] += compaction;
    points.internal[1] += select(yielding, elastic.equivalent_strain(s_trial - s), 0.0);
    points.stress = s.plus_identity(-p);
    points.branch = select(yielding, select(apex, double(Branch::tension), double(Branch::shear)),
                           double(Branch::elastic));
  }
};

inline BlockResult update_drucker_prager(const DruckerPragerParameters& parameters, double density,
                                         const PointBlock& block) {
  return update_points(DruckerPragerKernel{parameters}, density, block);
}

constexpr void fill(DruckerPragerKernels& kernels) { kernels.update = update_drucker_prager; }

}  // namespace FURROW_ISA
}  // namespace furrow
