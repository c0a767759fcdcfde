// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of NorSand: backward Euler, with the dilatancy D as unknown. Equations: norsand.h.
///
/// The elastic trial has P_tr and t_tr. The return of t has the stiffness k = 3 G. Flow and
/// elasticity give the pressure and the plastic shear of every D.
///   P(D) = (P_tr - K D t_tr/k)/(1 - K D eta/k),   Deps_q(D) = (t_tr - eta P)/k
/// The step hardens by u = H Deps_q (x^2/x_l - x). One equation R(D) = 0 remains.
///   R = P - x P_i (1 + u) where u >= 0.
///   R = P (1 - u) - x P_i where u < 0.
/// Its root lies between the D without flow, max(D_l, (M - t_tr/P_tr)/(1 - N)), and M/(1 - N).
///
/// If R <= 0 at D_l, the point is on the cone of the limit. If R > 0 at M/(1 - N), it is at the tip
/// of the surface, where t = 0 and P solves a linear or quadratic equation. If P(D_l) <= 0, it
/// opens. model() refuses moduli for which a denominator could vanish.
///
/// A shear band narrower than the point takes the whole dilation of the point from the peak on,
/// where P_i falls. Its voids then grow by more than those of the point, at most to the critical
/// state.

#include "furrow/material/block_update.h"
#include "furrow/material/deviatoric_return.h"
#include "furrow/material/models/norsand/norsand_parameters.h"
#include "furrow/simd/exponential.h"
#include "furrow/simd/root_solver.h"

namespace furrow {
inline namespace FURROW_ISA {

/// a^exponent for a > 0; exponents 1 and 1/2 without transcendental functions
FURROW_INLINE Lanes power(const Lanes& a, double exponent) {
  if (exponent == 1.0) return a;
  if (exponent == 0.5) return sqrt(a);
  return exponential(logarithm(a) * Lanes(exponent));
}

template <SectionParameters::Kind kind>
struct NorSandKernel {
  static constexpr int internal_variables = 4;  // in the order of NorSand's
  const NorSandParameters& parameters;

  /// P/P_i on the surface
  FURROW_INLINE Lanes ratio(const Lanes& D) const {
    const double N = parameters.N;
    return power(Lanes(1.0) + D * Lanes(N / parameters.M), (1.0 - N) / N);
  }
  /// D on the surface, bounded by that of the tip
  FURROW_INLINE Lanes dilatancy(const Lanes& x) const {
    const double N = parameters.N;
    return (power(min(x, parameters.tip), N / (1.0 - N)) - Lanes(1.0)) * Lanes(parameters.M / N);
  }
  /// D_l
  FURROW_INLINE Lanes minimum_dilatancy(const Lanes& psi) const {
    return min(max(Lanes(parameters.chi_i) * psi, -parameters.M),
               NorSandParameters::loosest * parameters.largest_D());
  }
  FURROW_INLINE Lanes stress_ratio(const Lanes& D) const {
    return Lanes(parameters.M) - Lanes(1.0 - parameters.N) * D;
  }
  /// h over its value at the reference pressure. An image pressure below pt counts as pt.
  FURROW_INLINE Lanes hardening_over_reference(const Lanes& image) const {
    if (parameters.H_exponent == 0.0) return 1.0;
    return power(Lanes(NorSandParameters::reference_pressure) / max(image, parameters.pt),
                 parameters.H_exponent);
  }

  FURROW_INLINE void step(const Symmetric& strain, Points<internal_variables>& points) const {
    const double pt = parameters.pt, largest = parameters.largest_D();
    const Lanes floor = parameters.floor, tip = parameters.tip;
    const Lanes P_n = points.stress.trace() * Lanes(-1.0 / 3.0) + Lanes(pt);
    const Lanes shear = Lanes(parameters.shear) *
                        power(max(P_n, floor) * Lanes(1.0 / NorSandParameters::reference_pressure),
                              parameters.exponent);
    const Lanes bulk = shear * Lanes(parameters.bulk_ratio);
    const Lanes dv = -strain.trace();
    const Symmetric s_old = points.stress.plus_identity(P_n - Lanes(pt));
    const Symmetric s_trial = s_old + strain.deviator() * (Lanes(2.0) * shear);
    const DeviatoricReturn<kind> deviator(parameters.section, s_trial);
    const Lanes P_tr = P_n + bulk * dv, t_tr = deviator.t();
    Lanes voids =
        points.internal[0] + (Lanes(1.0) + points.internal[0]) * exponential_minus_one(-dv);
    const Lanes image_old = points.internal[1];

    const Lanes fall = parameters.csl_exponent > 0.0
                           ? power(image_old * Lanes(1.0 / NorSandParameters::reference_pressure),
                                   parameters.csl_exponent)
                           : logarithm(image_old);
    Lanes psi = voids - Lanes(parameters.gamma) + Lanes(parameters.lambda) * fall;
    if (parameters.shear_band > 0.0) {
      const Lanes D_l = minimum_dilatancy(psi);
      const Mask softens = psi < Lanes(0.0) && P_tr > Lanes(0.0) && P_tr < ratio(D_l) * image_old &&
                           t_tr > stress_ratio(D_l) * P_tr;
      const Lanes rest =
          max(points.internal[3] * Lanes(1.0 / parameters.shear_band) - Lanes(1.0), 0.0);
      const Lanes loosening = (Lanes(1.0) + voids) * rest * max(-dv, 0.0);
      const Lanes more = select(softens, min(loosening, -psi), 0.0);
      voids = voids + more;
      psi = psi + more;
    }
    const Lanes limit = minimum_dilatancy(psi);
    const Lanes x_l = ratio(limit), lowest = min(limit, largest), x_low = min(x_l, tip);

    // The trial against the surface; the slack is rounding.
    const Lanes x_tr = max(P_tr, 0.0) / image_old;
    const Lanes D_tr = max(dilatancy(max(x_tr, 1e-290)), lowest);
    const Mask yielding = t_tr > stress_ratio(D_tr) * P_tr + Lanes(1e-13) * abs(P_tr) ||
                          x_tr > tip * Lanes(1.0 + 1e-13) || P_tr < Lanes(0.0);
    Lanes P = P_tr, t = t_tr, x = max(x_tr, x_low), D = D_tr;
    Lanes image = select(lowest >= Lanes(largest), min(image_old, P_tr / tip), image_old);
    if (any(yielding)) {
      const Lanes over_k = Lanes(1.0) / (Lanes(3.0) * deviator.stiffness(shear)), c = bulk * over_k;
      const Lanes H = max(Lanes(parameters.H) - Lanes(parameters.H_psi) * psi,
                          NorSandParameters::minimum_hardening * parameters.H) *
                      hardening_over_reference(image_old);
      const Lanes over_x_l = Lanes(1.0) / x_l;
      const auto pressure = [&](const Lanes& at) __attribute__((always_inline)) {
        return (P_tr - c * at * t_tr) / (Lanes(1.0) - c * at * stress_ratio(at));
      };
      // points with Deps_q = 0
      const Lanes no_flow = select(
          P_tr > Lanes(0.0),
          (Lanes(parameters.M) - t_tr / max(P_tr, 1e-290)) * Lanes(1.0 / (1.0 - parameters.N)),
          -1e9);
      const Mask low = yielding && no_flow <= lowest;
      Mask opens(false), on_cone(false), at_tip(false);
      if (any(low)) {
        const Lanes P_low = pressure(lowest);
        opens = low && !(P_low > Lanes(0.0));
        on_cone = low && !opens && P_low <= x_low * image_old && lowest < Lanes(largest);
        where(on_cone || opens, D) = lowest;
        where(on_cone || opens, x) = x_low;
        where(on_cone, P) = P_low;
        where(opens, P) = 0.0;
      }
      const Mask beyond = yielding && !opens && (x_tr > tip || lowest >= Lanes(largest));
      if (any(beyond)) {
        const Lanes h = tip * tip * over_x_l - tip, P_end = P_tr - c * Lanes(largest) * t_tr;
        const Lanes u = H * t_tr * over_k * h;
        const Lanes excess = select(u >= Lanes(0.0), P_end - tip * image_old * (Lanes(1.0) + u),
                                    P_end * (Lanes(1.0) - u) - tip * image_old);
        at_tip = beyond && (excess > Lanes(0.0) || lowest >= Lanes(largest));
        const Lanes r = H * h / (bulk * Lanes(largest)), start = tip * image_old;
        const Lanes hardened = start * (Lanes(1.0) + r * P_tr) / (Lanes(1.0) + r * start);
        const Lanes b = Lanes(1.0) - r * P_tr;
        const Lanes softened =
            Lanes(2.0) * start / (b + sqrt(max(b * b + Lanes(4.0) * r * start, 0.0)));
        const Lanes P_tip = select(h >= Lanes(0.0), hardened, softened);
        where(at_tip, P) = select(x_tr > tip, max(min(P_tip, P_tr), 0.0), P_tr);
        where(at_tip, D) = largest;
        where(at_tip, x) = tip;
      }
      const Mask smooth = yielding && !on_cone && !opens && !at_tip;
      if (any(smooth)) {
        const double N = parameters.N, M = parameters.M;
        const auto residual = [&](const Lanes& at) __attribute__((always_inline))->ValueAndSlope {
          const Lanes eta = stress_ratio(at);
          const Lanes over = Lanes(1.0) / (Lanes(1.0) - c * at * eta);
          const Lanes now = (P_tr - c * at * t_tr) * over;
          const Lanes dP = c * ((eta - Lanes(1.0 - N) * at) * now - t_tr) * over;
          const Lanes flow = (t_tr - eta * now) * over_k;
          const Lanes dflow = (Lanes(1.0 - N) * now - eta * dP) * over_k;
          const Lanes y = ratio(at),
                      dy = y * Lanes((1.0 - N) / M) / (Lanes(1.0) + at * Lanes(N / M));
          const Lanes h = (y * over_x_l - Lanes(1.0)) * y;
          const Lanes u = H * flow * h;
          const Lanes du = H * (dflow * h + flow * dy * (Lanes(2.0) * y * over_x_l - Lanes(1.0)));
          const Mask hardens = u >= Lanes(0.0);
          const Lanes target = y * image_old;
          return {select(hardens, now - target * (Lanes(1.0) + u), now * (Lanes(1.0) - u) - target),
                  select(hardens, dP - image_old * (dy * (Lanes(1.0) + u) + y * du),
                         dP * (Lanes(1.0) - u) - now * du - image_old * dy)};
        };
        const Lanes start = max(lowest, no_flow);
        const Lanes root = decreasing_root(residual, max(D_tr, start), start, largest,
                                           Lanes(1e-9 * largest), smooth, points.iterations);
        where(smooth, D) = root;
        where(smooth, x) = ratio(root);
        where(smooth, P) = max(pressure(root), 0.0);
      }
      where(yielding, t) = min(max(stress_ratio(D), 0.0) * P, t_tr);
      where(yielding, image) = P / x;
      if (any(on_cone)) {
        const Lanes flow = max(t_tr - t, 0.0) * over_k, share = P / (x_low * image_old);
        where(on_cone, image) =
            max(image_old / (Lanes(1.0) + H * flow * max(Lanes(1.0) - share, 0.0)), P / x_low);
      }
    }
    const Symmetric s = deviator.stress(s_trial, t, yielding);
    const Lanes p_old = P_n - Lanes(pt), p = P - Lanes(pt);
    const Lanes half_compliance = Lanes(0.5) / shear;
    const Lanes compaction = select(yielding, (P_tr - P) / bulk, 0.0);
    const Symmetric gone = s_trial - s;
    points.stored = Lanes(0.5) * (p_old + p) * (dv - compaction) +
                    contract(s + s_old, s - s_old) * half_compliance * Lanes(0.5);
    points.frozen = Lanes(-pt) * compaction;
    points.dissipated = select(yielding, P * compaction + contract(s, gone) * half_compliance, 0.0);
    points.internal[0] = voids;
    // A selection keeps NaN, which stops the run. The maximum may drop it.
    const Lanes image_floor = floor / tip;
    points.internal[1] = select(image < image_floor, image_floor, image);
    points.internal[2] =
        points.internal[2] +
        select(yielding, sqrt(contract(gone, gone) * Lanes(1.0 / 6.0)) / shear, 0.0);
    points.stress = s.plus_identity(-p);
    const Lanes surface =
        select(D > Lanes(0.0), double(Branch::cap),
               select(D > lowest, double(Branch::shear), double(Branch::transition)));
    points.branch = select(yielding, select(P > Lanes(0.0), surface, double(Branch::tension)),
                           double(Branch::elastic));
  }
};

inline BlockResult update_norsand(const NorSandParameters& parameters, double density,
                                  const PointBlock& block) {
  return for_section(parameters.section, [&](auto kind) {
    return update_points(NorSandKernel<kind.value>{parameters}, density, block);
  });
}

constexpr void fill(NorSandKernels& kernels) { kernels.update = update_norsand; }

}  // namespace FURROW_ISA
}  // namespace furrow
