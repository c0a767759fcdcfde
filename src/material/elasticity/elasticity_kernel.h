// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Elastic response to a strain increment: linear or porous (elasticity.h has the equations).

#include "furrow/material/elasticity/elasticity_parameters.h"
#include "furrow/simd/exponential.h"
#include "furrow/simd/tensors.h"

namespace furrow {
inline namespace FURROW_ISA {

/// The elastic response of a step, from pressure p_n. x is the elastic volumetric strain of the
/// step, compression positive.
struct ElasticStep {
  const ElasticityParameters& parameters;
  Lanes p_n;
  Lanes above;  ///< p_n + limit > 0, whatever rounding has made of p_n (porous)
  Lanes shear;  ///< G at the start of the step
  Lanes ratio;  ///< J_el at the start of the step (porous)

  FURROW_INLINE ElasticStep(const ElasticityParameters& constants, const Lanes& pressure)
      : parameters(constants), p_n(pressure) {
    if (!parameters.porous) {
      shear = parameters.shear;
      return;
    }
    const Lanes c = parameters.stiffness;
    above = above_limit(p_n);
    ratio = Lanes(1.0) - logarithm(above / Lanes(parameters.p0 + parameters.limit)) / c;
    shear = parameters.shear_ratio > 0.0 ? Lanes(parameters.shear_ratio) * above * c * ratio
                                         : Lanes(parameters.shear);
  }

  /// p(x), increasing, and dp/dx. The largest exponent, exp(300), only bounds trial states of the
  /// return mapping. The change of J_el keeps its digits in the shortest steps.
  struct Response {
    Lanes pressure, bulk;
  };
  FURROW_INLINE Response response(const Lanes& x) const {
    if (!parameters.porous) return {p_n + Lanes(parameters.bulk) * x, parameters.bulk};
    const Lanes stiffness = Lanes(parameters.stiffness) * ratio;
    const Lanes change = exponential_minus_one(-x);
    const Lanes from_limit = above * exponential(min(-stiffness * change, 300.0));
    return {from_limit - parameters.limit, from_limit * (stiffness + stiffness * change)};
  }
  FURROW_INLINE Lanes pressure(const Lanes& x) const { return response(x).pressure; }
  /// dp/dx at p = pressure(x)
  FURROW_INLINE Lanes bulk(const Lanes& x, const Lanes& p) const {
    if (!parameters.porous) return parameters.bulk;
    return (p + parameters.limit) * Lanes(parameters.stiffness) * ratio * exponential(-x);
  }
  /// dp/dx at the start of the step
  FURROW_INLINE Lanes bulk_at_start() const {
    if (!parameters.porous) return parameters.bulk;
    return above * Lanes(parameters.stiffness) * ratio;
  }
  /// x that takes the pressure to p: the inverse of pressure().
  FURROW_INLINE Lanes strain(const Lanes& p) const {
    if (!parameters.porous) return (p - p_n) / Lanes(parameters.bulk);
    const Lanes exponent = logarithm(above_limit(p) / above);
    return -logarithm(Lanes(1.0) - exponent / (Lanes(parameters.stiffness) * ratio));
  }
  /// Equivalent strain sqrt(2/3 e:e) of the elastic strain e = s/(2 G) under a deviator s [Pa]: for
  /// s = s_trial - s_end the plastic one of the step.
  FURROW_INLINE Lanes equivalent_strain(const Symmetric& s) const {
    return sqrt(contract(s, s) * Lanes(1.0 / 6.0)) / shear;
  }
  /// Elastic work of the step per current volume, volumetric part, from p_n to p = pressure(x): the
  /// integral of p dx. Exact for linear elasticity; porous: dx = dp / ((p + limit) c J_el) with the
  /// mean J_el, J_el(n+1) = J_el(n) exp(-x).
  FURROW_INLINE Lanes volumetric_work(const Lanes& x, const Lanes& p) const {
    if (!parameters.porous) return Lanes(0.5) * (p_n + p) * x;
    const Lanes mean_ratio = Lanes(0.5) * ratio * (Lanes(1.0) + exponential(-x));
    return (p - p_n) / (Lanes(parameters.stiffness) * mean_ratio) - Lanes(parameters.limit) * x;
  }

 private:
  FURROW_INLINE Lanes above_limit(const Lanes& p) const {
    return max(p + parameters.limit, parameters.resolution);
  }
};

}  // namespace FURROW_ISA
}  // namespace furrow
