// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The elastic trial of a step of the Drucker-Prager cap law, and which surface it violates.

#include "furrow/material/elasticity/elasticity_kernel.h"
#include "furrow/material/models/drucker_prager_cap/drucker_prager_cap_surfaces.h"
#include "furrow/material/point_block.h"

namespace furrow {
inline namespace FURROW_ISA {

/// The elastic trial of a step, and what it takes to correct it.
struct CapTrial {
  const ElasticStep& elastic;
  Lanes shear;  ///< shear modulus of the return of t (deviatoric_return.h) [Pa]
  Hardening& hardening;
  Lanes dv;           ///< volumetric strain of the step, compression positive
  Lanes eps;          ///< eps_vol_pl at the start of the step
  CapSurfaces start;  ///< at the start of the step
  Lanes p;            ///< of the elastic trial [Pa]
  Lanes t;

  /// Strain that rounding of p and eps amounts to.
  FURROW_INLINE Lanes noise() const {
    const Lanes stress = abs(elastic.p_n) + abs(start.pa);
    return Lanes(4e-16) * (abs(eps) + abs(dv)) + Lanes(8e-16) * stress / elastic.bulk_at_start();
  }
};

/// @param deviator  a DeviatoricReturn
template <class Deviator>
FURROW_INLINE CapTrial make_trial(const DruckerPragerCapParameters& parameters,
                                  const ElasticStep& elastic, const Deviator& deviator,
                                  Hardening& hardening, const Lanes& dv, const Lanes& eps) {
  return {elastic,
          deviator.stiffness(elastic.shear),
          hardening,
          dv,
          eps,
          surfaces_at(parameters, hardening, eps),
          elastic.pressure(dv),
          deviator.t()};
}

/// State at the end of a step.
struct CapReturn {
  Lanes p;  ///< [Pa]
  Lanes t;
  Lanes compaction = 0.0;  ///< De, the volumetric plastic strain of the step
  Lanes pa = 0.0;
  Lanes branch = double(Branch::elastic);
  Lanes iterations = 0.0;
};

/// The surface that each point's trial violates, one at most.
struct ViolatedSurface {
  Mask cap;
  Mask shear;  ///< shear line or transition
  Mask tension;
};

/// The trial pressure decides on which surface the return ends. Flow on the cap compacts and ends
/// at p >= pa; flow on the shear line and the transition dilates and ends at p <= pa.
FURROW_INLINE ViolatedSurface violated_surface(const DruckerPragerCapParameters& parameters,
                                               const CapTrial& trial) {
  // The slack is rounding: a point at rest on its surface is elastic.
  const CapSurfaces& old = trial.start;
  const Lanes slack = Lanes(1e-13) * old.Q;
  const Lanes rounding = Lanes(1e-15) * abs(trial.p);
  const Mask compacts = trial.p >= old.pa;
  const Lanes cap_limit = Lanes(parameters.R) * (old.Q + slack) + rounding;
  const Mask outside_cap =
      square(trial.p - old.pa) + square(trial.t * Lanes(parameters.R / parameters.A)) >
      square(cap_limit);
  const Lanes shear_excess =
      trial.t - shear_strength(parameters, old, trial.p, 0.0, 0.0, nullptr).value - slack;
  const Mask cap = compacts && outside_cap;
  const Mask shear = !compacts && shear_excess > rounding;
  return {cap, shear, !cap && !shear && trial.p < Lanes(-parameters.cutoff) - rounding};
}

}  // namespace FURROW_ISA
}  // namespace furrow
