// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Return of the trial deviator in a step of plastic flow, for a yield measure t = q g(c)
/// (section/section.h). Flow is associated in the deviatoric plane: the plastic deviatoric strain
/// is Lambda d(t^2/2)/ds. With m = 3 G Lambda the return is an equation of vectors in that plane:
///   q + m d(t^2/2)/dq = q_tr.
/// The angle theta runs from triaxial extension (0) to compression (pi/3), and g' is dg/dtheta. In
/// polar components the return has two parts:
///   (1 + m g^2) tan(theta_tr - theta) = m g g'.
///   q = q_tr cos(theta_tr - theta)/(1 + m g^2).
/// A round section has g = 1. It gives t = t_tr/(1 + m), and the direction stays.
///
/// Other sections are linearised at the trial, which is exact to the order of the step and needs no
/// iteration over angles:
///   t = t_tr/(1 + m (g^2 + g'^2))       a round section with another shear modulus: `stiffness`
///   tan(theta - theta_tr) = - m g g'/(1 + m (g^2 + g'^2 + g g''))     one step of Newton's method
/// t is that of the yield surface exactly; q follows from it at the new theta. The denominator is
/// positive for a convex section. Long steps are bounded so that theta does not pass triaxial
/// compression: psi = pi - 3 theta_tr remains, and sin(psi/3) >= (2/3) sin(psi/2). Because q never
/// exceeds q_tr cos(theta - theta_tr), no step releases energy.

#include "furrow/material/section/section_kernel.h"
#include "furrow/simd/tensors.h"

namespace furrow {
inline namespace FURROW_ISA {

FURROW_INLINE Lanes mises(const Symmetric& deviator) {
  return sqrt(Lanes(1.5) * contract(deviator, deviator));
}
/// cos(3 theta); 0 without a deviator
FURROW_INLINE Lanes cos_3_theta(const Symmetric& deviator, const Lanes& q) {
  const Symmetric unit = deviator * select(q > Lanes(0.0), Lanes(1.0) / q, 0.0);
  return min(max(Lanes(13.5) * determinant(unit), -1.0), 1.0);
}
/// t of a deviator
template <SectionParameters::Kind kind>
FURROW_INLINE Lanes yield_measure(const SectionParameters& section, const Symmetric& deviator) {
  const Lanes q = mises(deviator);
  if constexpr (kind == SectionParameters::Kind::round)
    return q;
  else
    return q * SectionKernel<kind>{section}.shape(cos_3_theta(deviator, q));
}

template <SectionParameters::Kind kind>
class DeviatoricReturn {
 public:
  static constexpr int numbers = 3;  ///< size of the stored state: t, c, g

  FURROW_INLINE DeviatoricReturn(const SectionParameters& section, const Symmetric& trial)
      : section_{section} {
    const Lanes q = mises(trial);
    c_ = cos_3_theta(trial, q);
    g_ = section_.shape(c_);
    t_ = q * g_;
  }
  FURROW_INLINE DeviatoricReturn(const SectionParameters& section, const Lanes* kept)
      : section_{section}, t_(kept[0]), c_(kept[1]), g_(kept[2]) {}
  FURROW_INLINE void store(Lanes* kept) const {
    kept[0] = t_;
    kept[1] = c_;
    kept[2] = g_;
  }

  const Lanes& t() const { return t_; }  ///< of the trial
  /// The shear modulus with which t returns like q of a round section.
  FURROW_INLINE Lanes stiffness(const Lanes& shear) const {
    return shear * (g_ * g_ + slope_squared(section_.first_derivative(g_)));
  }
  /// The deviator with measure t after the return of the trial; lanes outside the mask keep the
  /// trial.
  FURROW_INLINE Symmetric stress(const Symmetric& trial, const Lanes& t,
                                 const Mask& yielding) const {
    const Mask returns = yielding && t_ > Lanes(0.0);
    if (!any(returns)) return trial;
    // tan(theta - theta_tr) = r sin(3 theta_tr), with g' = -3 sin(3 theta) dg/dc
    const Lanes first = section_.first_derivative(g_), sin2 = Lanes(1.0) - c_ * c_;
    const Lanes stretch = g_ * g_ + slope_squared(first);
    const Lanes curvature =
        Lanes(9.0) * (sin2 * section_.second_derivative(g_, first) - c_ * first);
    const Lanes share = select(returns, t / t_, 1.0), gone = Lanes(1.0) - share;
    const Lanes r =
        min(Lanes(3.0) * g_ * first * gone / (stretch * share + (stretch + g_ * curvature) * gone),
            sqrt(Lanes(2.0 / 9.0) / max(Lanes(1.0) - c_, 1e-30)));
    const Lanes cosine = Lanes(1.0) / sqrt(Lanes(1.0) + sin2 * r * r), sine = r * cosine;
    const Lanes sine_square = sin2 * sine * sine;  // `sine` is without its factor sin(3 theta_tr)
    const Lanes c = min(max(c_ * cosine * (Lanes(4.0) * cosine * cosine - Lanes(3.0)) -
                                sin2 * sine * (Lanes(3.0) - Lanes(4.0) * sine_square),
                            -1.0),
                        1.0);
    const Lanes q_trial = t_ / g_;
    const Lanes q = min(t / section_.shape(c), q_trial * cosine);
    // With the trial's unit deviator S (S:S = 1), dev(S^2) = (cos(3 theta) S - sin(3 theta) T)/
    // sqrt(6) gives the direction T of growing theta.
    const Symmetric unit = trial * select(returns, Lanes(1.2247448713915890491) / q_trial, 0.0);
    const Symmetric square = commuting_product(unit, unit).deviator();
    const Lanes size = q * Lanes(0.81649658092772603273);
    const Symmetric turned = unit * (size * (cosine + sine * c_)) -
                             square * (size * sine * Lanes(2.4494897427831780982));
    return {select(returns, turned.xx, trial.xx), select(returns, turned.yy, trial.yy),
            select(returns, turned.zz, trial.zz), select(returns, turned.xy, trial.xy),
            select(returns, turned.yz, trial.yz), select(returns, turned.xz, trial.xz)};
  }

 private:
  /// g'^2
  FURROW_INLINE Lanes slope_squared(const Lanes& first) const {
    return Lanes(9.0) * (Lanes(1.0) - c_ * c_) * first * first;
  }

  SectionKernel<kind> section_;
  Lanes t_, c_, g_;
};

template <>
class DeviatoricReturn<SectionParameters::Kind::round> {
 public:
  static constexpr int numbers = 1;

  FURROW_INLINE DeviatoricReturn(const SectionParameters&, const Symmetric& trial)
      : t_(mises(trial)) {}
  FURROW_INLINE DeviatoricReturn(const SectionParameters&, const Lanes* kept) : t_(kept[0]) {}
  FURROW_INLINE void store(Lanes* kept) const { kept[0] = t_; }

  const Lanes& t() const { return t_; }
  FURROW_INLINE Lanes stiffness(const Lanes& shear) const { return shear; }
  FURROW_INLINE Symmetric stress(const Symmetric& trial, const Lanes& t,
                                 const Mask& yielding) const {
    const Mask returns = yielding && t_ > Lanes(0.0);
    if (!any(returns)) return trial;
    return trial * select(returns, t / t_, 1.0);
  }

 private:
  Lanes t_;
};

}  // namespace FURROW_ISA
}  // namespace furrow
