// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The end of a step of a law that hardens by compaction.

#include "furrow/material/block_update.h"
#include "furrow/material/elasticity/elasticity_kernel.h"
#include "furrow/material/hardening/hardening_kernel.h"

namespace furrow {
inline namespace FURROW_ISA {

/// Result of the return mapping of a step.
struct ReturnedPoint {
  Symmetric deviator;  ///< s at the end [Pa]
  Lanes p;             ///< pressure at the end [Pa]
  Lanes compaction;    ///< volumetric plastic strain of the step; 0 where elastic
  Lanes back_stress;   ///< back stress, whose work on the compaction is frozen, not dissipated [Pa]
  Mask yielding;
};

/// Viscous overstress (theory: snow, eq. 7): the share of the return that fits into the step. The
/// state at its end stays beyond the yield surface. A sudden step is elastic.
FURROW_INLINE void delay_return(double relaxation_time, double time_step, const Lanes& dv,
                                const ElasticStep& elastic, const Symmetric& s_trial,
                                ReturnedPoint& end) {
  const Lanes share = time_step / (relaxation_time + time_step);
  end.deviator = s_trial + (end.deviator - s_trial) * share;
  end.compaction = end.compaction * share;
  end.p = select(end.yielding, elastic.pressure(dv - end.compaction), end.p);
}

/// Energies, stress and internal variables: the volumetric plastic strain, which the hardening
/// reads, and the equivalent one of the deviator.
FURROW_INLINE void end_hardening_step(const Symmetric& strain, const ElasticStep& elastic,
                                      const Symmetric& s_trial, const ReturnedPoint& end,
                                      const Hardening& hardening, Points<2>& points) {
  const Symmetric s_old = points.stress.plus_identity(elastic.p_n), &s = end.deviator;
  const Lanes half_compliance = Lanes(0.5) / elastic.shear;
  points.stored = elastic.volumetric_work(-strain.trace() - end.compaction, end.p) +
                  contract(s + s_old, s - s_old) * half_compliance * Lanes(0.5);
  points.frozen = end.back_stress * end.compaction;
  points.dissipated = (end.p - end.back_stress) * end.compaction +
                      select(end.yielding, contract(s, s_trial - s) * half_compliance, 0.0);
  points.internal[0] = points.internal[0] + end.compaction;
  points.internal[1] =
      points.internal[1] + select(end.yielding, elastic.equivalent_strain(s_trial - s), 0.0);
  points.stress = s.plus_identity(-end.p);
  points.below_data = hardening.below(points.internal[0]);
  points.beyond_data = hardening.beyond(points.internal[0]);
  points.stopped = hardening.stopped(points.internal[0]);
}

}  // namespace FURROW_ISA
}  // namespace furrow
