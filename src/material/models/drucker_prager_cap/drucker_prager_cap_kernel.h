// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the Drucker-Prager cap law: trial, return mapping (drucker_prager_cap_return.h),
/// energies and the new state.

#include "furrow/material/block_update.h"
#include "furrow/material/deviatoric_return.h"
#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap_return.h"

namespace furrow {
inline namespace FURROW_ISA {

template <SectionParameters::Kind section>
struct DruckerPragerCapKernel {
  static constexpr int internal_variables = 2;  // eps_vol_pl, eps_dev_pl
  const DruckerPragerCapParameters& parameters;
  /// neighbours lie on the same segments of the table, mostly
  mutable Hardening hardening{parameters.hardening};

  using Deviator = DeviatoricReturn<section>;
  using CapPoints = Points<internal_variables>;

  // ---- in three passes (update_gathered): the return mapping needs p and t only
  static constexpr int trial_numbers = 3;
  static constexpr int prediction_numbers = trial_numbers + Deviator::numbers;
  static constexpr int return_numbers = 6;
  static constexpr int surface_count = 3;
  struct Prediction {
    Lanes numbers[prediction_numbers];  ///< p_n, dv, eps_n, those of the deviator
    Mask violated[surface_count];       ///< cap, shear, tension; none once corrected
  };
  struct Numbers {
    Lanes numbers[return_numbers];  ///< of a CapReturn
  };

  FURROW_INLINE Prediction predict(const Symmetric& strain, const CapPoints& points,
                                   Numbers& end) const {
    const ElasticStep elastic(parameters.elasticity, pressure_of(points));
    const Deviator deviator(parameters.section, trial_deviator(elastic, strain, points));
    const CapTrial trial =
        make_trial(parameters, elastic, deviator, hardening, -strain.trace(), points.internal[0]);
    ViolatedSurface violated = violated_surface(parameters, trial);
    const Mask none(false);
    if (all(violated.cap) || all(violated.shear)) {
      end = numbers_of(return_mapping(parameters, violated, trial));
      violated = {none, none, none};
    } else {
      end = numbers_of(return_mapping(parameters, ViolatedSurface{none, none, none}, trial));
    }
    Prediction prediction{{elastic.p_n, trial.dv, trial.eps},
                          {violated.cap, violated.shear, violated.tension}};
    deviator.store(prediction.numbers + trial_numbers);
    return prediction;
  }
  Numbers correct(int surface, const Lanes* prediction) const {
    const ElasticStep elastic(parameters.elasticity, prediction[0]);
    const Deviator deviator(parameters.section, prediction + trial_numbers);
    Hardening own_hardening(parameters.hardening);  // gathered points are no neighbours
    const CapTrial trial =
        make_trial(parameters, elastic, deviator, own_hardening, prediction[1], prediction[2]);
    const CapReturn end = return_mapping(
        parameters, ViolatedSurface{Mask(surface == 0), Mask(surface == 1), Mask(surface == 2)},
        trial);
    return numbers_of(end);
  }
  FURROW_INLINE void finish(const Symmetric& strain, const Lanes* prediction, const Lanes* ends,
                            CapPoints& points) const {
    const ElasticStep elastic(parameters.elasticity, prediction[0]);
    const Symmetric s_trial = trial_deviator(elastic, strain, points);
    const Deviator deviator(parameters.section, prediction + trial_numbers);
    const CapReturn end{ends[0], ends[1], ends[2], ends[3], ends[4], ends[5]};
    const Mask yielding = end.branch > Lanes(double(Branch::elastic));
    conclude(strain, elastic, s_trial, deviator.stress(s_trial, end.t, yielding), end, points);
  }

 private:
  FURROW_INLINE static Symmetric trial_deviator(const ElasticStep& elastic, const Symmetric& strain,
                                                const CapPoints& points) {
    return points.stress.plus_identity(elastic.p_n) +
           strain.deviator() * (Lanes(2.0) * elastic.shear);
  }
  FURROW_INLINE static Lanes pressure_of(const CapPoints& points) {
    return points.stress.trace() * Lanes(-1.0 / 3.0);
  }
  FURROW_INLINE static Numbers numbers_of(const CapReturn& end) {
    return {{end.p, end.t, end.compaction, end.pa, end.branch, end.iterations}};
  }

  /// Energies and the new state, from the deviator s of the end of the step.
  FURROW_INLINE void conclude(const Symmetric& strain, const ElasticStep& elastic,
                              const Symmetric& s_trial, const Symmetric& s, const CapReturn& end,
                              CapPoints& points) const {
    const Mask yielding = end.branch > Lanes(double(Branch::elastic));
    const Symmetric s_old = points.stress.plus_identity(elastic.p_n);
    const Lanes elastic_strain = -strain.trace() - end.compaction;
    const Lanes half_compliance = parameters.elasticity.porous
                                      ? Lanes(0.5) / elastic.shear
                                      : Lanes(0.5 / parameters.elasticity.shear);
    points.stored = elastic.volumetric_work(elastic_strain, end.p) +
                    contract(s + s_old, s - s_old) * half_compliance * Lanes(0.5);
    if (any(yielding)) {
      // Plastic work p De + s:De_dev. Compaction stores pa De as frozen energy; flow always leads
      // away from (pa, 0), so the rest is >= 0.
      const Lanes back_stress =
          select(end.branch == Lanes(double(Branch::tension)), max(end.pa, end.p), end.pa);
      points.frozen = select(yielding, back_stress * end.compaction, 0.0);
      points.dissipated = select(
          yielding,
          (end.p - back_stress) * end.compaction + contract(s, s_trial - s) * half_compliance, 0.0);
      points.internal[1] =
          points.internal[1] + select(yielding, elastic.equivalent_strain(s_trial - s), 0.0);
    }
    points.internal[0] = points.internal[0] + end.compaction;
    points.stress = s.plus_identity(-end.p);
    points.branch = end.branch;
    points.iterations = end.iterations;
    points.below_data = hardening.below(points.internal[0]);
    points.beyond_data = hardening.beyond(points.internal[0]);
    points.stopped = hardening.stopped(points.internal[0]);
  }
};

inline BlockResult update_drucker_prager_cap(const DruckerPragerCapParameters& parameters,
                                             double density, const PointBlock& block) {
  return for_section(parameters.section, [&](auto kind) {
    return update_gathered(DruckerPragerCapKernel<kind.value>{parameters}, density, block);
  });
}

constexpr void fill(DruckerPragerCapKernels& kernels) {
  kernels.update = update_drucker_prager_cap;
}

}  // namespace FURROW_ISA
}  // namespace furrow
