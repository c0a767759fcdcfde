// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Return mapping in the deviatoric plane for a yield measure t that depends on the Lode angle (K <
/// 1) or not (K = 1).
///
///   t = q g(theta),   g(theta) = a + b cos(3 theta),   cos(3 theta) = (r/q)^3,   theta in [0,
///   pi/3] a = (1 + 1/K)/2,  b = (1/K - 1)/2
/// Every flow rule in t used here is: plastic deviatoric strain = Lambda d(t^2/2)/ds, so that with
/// m = 3 G Lambda the stress after the step is the one point where
///   q + m d(t^2/2)/dq = q_tr   (vectors in the deviatoric plane),
/// in polar components
///   (1 + m g^2) sin(theta_tr - theta) = m g g' cos(theta_tr - theta)
///   q = q_tr / |(1 + m g^2, m g g')|.
/// t^2/2 is convex for K >= 7/9, which makes it unique. K = 1: t = t_tr/(1 + m), a radial return.

#include "simd/root_solver.h"
#include "simd/tensors.h"

namespace furrow {
inline namespace FURROW_ISA {

/// What a step of length m does to the trial deviator.
struct LodeReturn {
  Lanes ratio;     ///< h = t_tr/t
  Lanes slope;     ///< dh/dm
  Lanes rotation;  ///< theta - theta_tr >= 0 (towards triaxial compression)
  Lanes shape;     ///< g(theta) = t/q
};

template <bool lode_dependent>
class DeviatoricReturn;

template <>
class DeviatoricReturn<false> {
 public:
  FURROW_INLINE DeviatoricReturn(double /*flow_ratio*/, const Symmetric& trial)
      : q_(sqrt(Lanes(1.5) * contract(trial, trial))) {}
  /// of a trial known by its measure only
  FURROW_INLINE explicit DeviatoricReturn(const Lanes& t) : q_(t) {}
  const Lanes& t() const { return q_; }  ///< of the trial
  FURROW_INLINE LodeReturn at(const Lanes& m, Lanes&, const Mask&) const {
    return {Lanes(1.0) + m, 1.0, 0.0, 1.0};
  }
  /// m at which t falls to t_tr/ratio.
  Lanes multiplier(const Lanes& ratio, Lanes&, const Mask&) const { return ratio - Lanes(1.0); }
  /// The deviator with measure t, in the direction of a return of the trial; lanes outside the mask
  /// keep the trial.
  FURROW_INLINE Symmetric stress(const Symmetric& trial, const Lanes& t, const LodeReturn&,
                                 const Mask& yielding) const {
    return trial * select(yielding && q_ > Lanes(0.0), t / q_, 1.0);
  }

 private:
  Lanes q_;
};

template <>
class DeviatoricReturn<true> {
 public:
  DeviatoricReturn(double flow_ratio, const Symmetric& trial)
      : a_(0.5 * (1.0 + 1.0 / flow_ratio)), b_(0.5 * (1.0 / flow_ratio - 1.0)) {
    q_ = sqrt(Lanes(1.5) * contract(trial, trial));
    const Symmetric unit = trial * select(q_ > Lanes(0.0), Lanes(1.0) / q_, 0.0);
    cos_3t_ = min(max(Lanes(13.5) * determinant(unit), -1.0), 1.0);
    theta_ = per_lane(cos_3t_, [](double c) { return __builtin_acos(c) / 3.0; });
    guess_ = theta_;
    t_ = q_ * shape(theta_);
  }
  const Lanes& t() const { return t_; }
  LodeReturn at(const Lanes& m, Lanes& iterations, const Mask& active) const {
    const Lanes w = m / (Lanes(1.0) + m);
    const Lanes v = Lanes(1.0) / (Lanes(1.0) + m);
    const Lanes third = 1.0471975511965977462;  // pi/3
    const Mask rotates = active && theta_ < third && m > Lanes(0.0);
    const Lanes theta = decreasing_root(
        [&](const Lanes& angle) -> ValueAndSlope {
          const Lanes g = shape(angle), g1 = shape_slope(angle), g2 = shape_curvature(angle);
          const Lanes sine = sin_of(theta_ - angle), cosine = cos_of(theta_ - angle),
                      f = v + w * g * g;
          return {f * sine - w * g * g1 * cosine,
                  w * g * g1 * sine - (f + w * (g1 * g1 + g * g2)) * cosine};
        },
        select(rotates, guess_, theta_), theta_, third, 1e-11, rotates, iterations);
    guess_ = theta;
    const Lanes g = shape(theta), g1 = shape_slope(theta), g2 = shape_curvature(theta);
    const Lanes radial = Lanes(1.0) + m * g * g, tangential = m * g * g1;
    // v^T (I + m H)^-1 v with v = (g^2, g g') and the Hessian H of t^2/2
    const Lanes vx = g * g, vy = g * g1, hyy = Lanes(1.0) + m * (g1 * g1 + g * g2 + g * g);
    const Lanes form = (vx * vx * hyy - Lanes(2.0) * vx * vy * tangential + vy * vy * radial) /
                       (radial * hyy - tangential * tangential);
    LodeReturn result;
    result.ratio = shape(theta_) / g * sqrt(radial * radial + tangential * tangential);
    result.slope = result.ratio * form / (g * g);
    result.rotation = theta - theta_;
    result.shape = g;
    return result;
  }
  Lanes multiplier(const Lanes& ratio, Lanes& iterations, const Mask& active) const {
    // h is close to 1 + m g^2 with g between 1 and 1/K
    const Lanes high = max(ratio - Lanes(1.0), 0.0) * Lanes(4.0) + Lanes(1e-300);
    return decreasing_root(
        [&](const Lanes& m) -> ValueAndSlope {
          const LodeReturn there = at(m, iterations, active);
          return {ratio - there.ratio, -there.slope};
        },
        ratio - Lanes(1.0), 0.0, high, Lanes(1e-15) * (high + Lanes(1.0)),
        active && ratio > Lanes(1.0), iterations);
  }
  Symmetric stress(const Symmetric& trial, const Lanes& t, const LodeReturn& back,
                   const Mask& yielding) const {
    // Unit deviator S (S:S = 1); dev(S^2) = (cos(3 theta) S - sin(3 theta) T)/sqrt(6) gives the
    // direction T of growing theta.
    const Lanes size = select(yielding, t / back.shape, q_);
    const Symmetric unit = trial * select(q_ > Lanes(0.0), Lanes(1.2247448713915890491) / q_, 0.0);
    const Lanes sin_3t = sqrt(max(Lanes(1.0) - cos_3t_ * cos_3t_, 0.0));
    const Mask rotates = yielding && sin_3t > Lanes(1e-12);
    const Lanes along = select(rotates, sin_of(back.rotation) / sin_3t, 0.0);
    const Symmetric perpendicular =
        commuting_product(unit, unit).deviator() * Lanes(2.4494897427831780982);
    const Lanes radial = select(rotates, cos_of(back.rotation), 1.0) + along * cos_3t_;
    return (unit * radial - perpendicular * along) * (size * Lanes(0.81649658092772603273));
  }

 private:
  static Lanes sin_of(const Lanes& angle) {
    return per_lane(angle, [](double x) { return __builtin_sin(x); });
  }
  static Lanes cos_of(const Lanes& angle) {
    return per_lane(angle, [](double x) { return __builtin_cos(x); });
  }
  Lanes shape(const Lanes& theta) const {
    return Lanes(a_) + Lanes(b_) * cos_of(Lanes(3.0) * theta);
  }
  Lanes shape_slope(const Lanes& theta) const {
    return Lanes(-3.0 * b_) * sin_of(Lanes(3.0) * theta);
  }
  Lanes shape_curvature(const Lanes& theta) const {
    return Lanes(-9.0 * b_) * cos_of(Lanes(3.0) * theta);
  }

  double a_;
  double b_;
  Lanes q_;
  Lanes cos_3t_;
  Lanes theta_;
  Lanes t_;
  mutable Lanes guess_;  ///< the last theta found, where the next search starts
};

}  // namespace FURROW_ISA
}  // namespace furrow
