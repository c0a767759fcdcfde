// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Strength and its slope at given volumetric plastic strains (hardening.h has the equations).

#include "furrow/material/hardening/hardening_parameters.h"
#include "furrow/simd/exponential.h"

namespace furrow {
inline namespace FURROW_ISA {

/// The hardening of a few points. Remembers the segments of the table last used: a step seldom
/// leaves them.
class Hardening {
 public:
  struct Strength {
    Lanes value;  ///< [Pa]
    Lanes slope;  ///< d(value)/d(eps) [Pa]
  };

  explicit Hardening(const HardeningParameters& parameters) : h_(parameters) {}

  FURROW_INLINE Strength at(const Lanes& eps) {
    Strength result = h_.kind == HardeningParameters::Kind::exponential
                          ? by_formula(max(eps, h_.first))
                          : by_table(max(eps, h_.first));
    const Mask below = eps < Lanes(h_.first);
    if (any(below)) {  // exp(-80) is a strength below the rounding of the stiffness
      const Lanes exponent = Lanes(h_.decay) * (eps - Lanes(h_.first));
      const Lanes value = Lanes(h_.first_value) * exponential(max(exponent, -80.0));
      result.value = select(below, value, result.value);
      result.slope = select(below, select(exponent > Lanes(-80.0), value * Lanes(h_.decay), 0.0),
                            result.slope);
    }
    return result;
  }
  Mask below(const Lanes& eps) const { return eps < Lanes(h_.first); }
  Mask beyond(const Lanes& eps) const { return eps > Lanes(h_.last); }
  Mask stopped(const Lanes& eps) const {
    return (beyond(eps) && Mask(h_.stop_beyond)) || (below(eps) && Mask(h_.stop_below));
  }

 private:
  Strength by_formula(const Lanes& eps) const {
    const Lanes ratio = exponential(-eps);
    const Lanes f = Lanes(1.0) / (Lanes(h_.lambda) - Lanes(h_.kappa) * ratio);
    const Lanes value = Lanes(h_.scale) * exponential(Lanes(h_.c) * (Lanes(1.0) - ratio) * f);
    return {value - Lanes(h_.offset), value * Lanes(h_.c * (h_.lambda - h_.kappa)) * ratio * f * f};
  }
  FURROW_INLINE Strength by_table(const Lanes& eps) {
    if (!all(eps >= start_ && eps < to_)) find(eps);
    const Lanes value = base_ + slope_ * (eps - start_);
    if (h_.kind == HardeningParameters::Kind::linear_table) return {value, slope_};
    const Lanes strength = exponential(value);
    return {strength, strength * slope_};
  }
  void find(const Lanes& eps) {
    to_ = 1e300;
    start_ = h_.start[0];
    base_ = h_.base[0];
    slope_ = h_.slope[0];
    for (int k = 1; k < h_.segments; ++k) {
      const Lanes start = h_.start[k];
      const Mask in = eps >= start;
      to_ = select(in, to_, min(to_, start));
      start_ = select(in, start, start_);
      base_ = select(in, h_.base[k], base_);
      slope_ = select(in, h_.slope[k], slope_);
    }
  }

  const HardeningParameters& h_;
  Lanes start_ = 1.0;  // an empty interval: nothing remembered yet
  Lanes to_ = 0.0;
  Lanes base_ = 0.0;
  Lanes slope_ = 0.0;
};

}  // namespace FURROW_ISA
}  // namespace furrow
