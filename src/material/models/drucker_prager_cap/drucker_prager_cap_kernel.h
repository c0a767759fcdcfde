// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Kernel of the Drucker-Prager cap law: implicit (backward Euler) return mapping in p and t.
/// Equations (12)-(16): drucker_prager_cap.h.
///
/// Unknown is the volumetric plastic strain of the step, De, compression positive. Abbreviations:
///   pa(eps) = (pb(eps) - R d)/(1 + R tan(beta)),   Q = d + pa tan(beta),   eps = eps_n + De,   p =
///   elastic pressure after dv - De.
/// Which surface is met is known beforehand: flow on the cap compacts and ends at p >= pa, flow on
/// the shear line and the transition loosens and ends at p <= pa, so the side of the trial pressure
/// decides.
///
/// Cap, p = pa + R Q cos(phi), t = A Q sin(phi), u = tan(phi). Associated flow: 3 G Lambda = m(u) =
/// 3 G R De/(A^2 Q) sqrt(1 + u^2).
///   inner:  A Q sin(phi) h(m) = t_tr                        increasing in u (h = t_tr/t, lode.h)
///   outer:  p(De) - pa - R Q cos(phi) = 0                   decreasing in De
/// Shear and transition, x = -De >= 0, D = pa - p. Flow (16): 3 G Lambda = m = 3 G x/(A^2
/// tan^2(beta) D).
///   t_y(p) D h(m) - t_tr D = 0, divided by -1               decreasing in x, a quadratic for K = 1
///   on a straight piece of the table
/// For K = 1 both cap equations are first tried together by Newton's method in (De, u); points
/// where that has not converged after a few iterations go through the nested, bracketed solution,
/// which converges always. Tension cut-off, p = -cutoff: De follows from the elastic law, and t is
/// the smaller of the trial's and the yield surface's. The stress is placed on the surface that
/// belongs to the final eps, so the yield function is zero to rounding.

#include "material/block_update.h"
#include "material/models/drucker_prager_cap/drucker_prager_cap_parameters.h"
#include "material/elasticity/elasticity_kernel.h"
#include "material/hardening/hardening_kernel.h"
#include "material/lode.h"

namespace furrow {
inline namespace FURROW_ISA {

template <bool lode_dependent>
struct DruckerPragerCapKernel {
  static constexpr int internal_variables = 1;  // eps_vol_pl
  const DruckerPragerCapParameters& parameters;

  /// The surfaces at one eps_vol_pl.
  struct Surfaces {
    Lanes pa, Q;
    Lanes pa_slope;  ///< d(pa)/d(eps)
  };
  FURROW_INLINE Surfaces surfaces(Hardening& hardening, const Lanes& eps) const {
    const Hardening::Strength pb = hardening.at(eps);
    const Lanes f = 1.0 / (1.0 + parameters.R * parameters.tan_beta);
    const Lanes pa = (pb.value - Lanes(parameters.R * parameters.d)) * f;
    return {pa, Lanes(parameters.d) + pa * Lanes(parameters.tan_beta), pb.slope * f};
  }

  /// t on the shear line or the transition at p <= pa, and its derivative when p grows by dp, pa by
  /// dpa.
  FURROW_INLINE ValueAndSlope shear_strength(const Surfaces& at, const Lanes& p, const Lanes& dp,
                                             const Lanes& dpa, Mask* transition) const {
    const Lanes tan_beta = parameters.tan_beta;
    ValueAndSlope t{Lanes(parameters.d) + p * tan_beta, tan_beta * dp};
    if (parameters.alpha == 0.0) return t;
    const Lanes radius = Lanes(parameters.alpha) * at.Q, D = max(at.pa - p, 0.0);
    const Mask on_arc = D < radius * Lanes(parameters.sin_beta);
    const Lanes leg = sqrt(max(radius * radius - D * D, 0.0));
    t.value = select(on_arc, Lanes(parameters.B) * at.Q + leg, t.value);
    t.slope = select(on_arc,
                     Lanes(parameters.B) * tan_beta * dpa +
                         (Lanes(parameters.alpha) * radius * tan_beta * dpa - D * (dpa - dp)) / leg,
                     t.slope);
    if (transition) *transition = on_arc;
    return t;
  }

  using Deviator = DeviatoricReturn<lode_dependent>;

  /// The elastic trial of a step, and what it takes to correct it.
  struct Trial {
    const ElasticStep& elastic;
    const Deviator& deviator;
    Hardening& hardening;
    Lanes dv;        ///< volumetric strain of the step, compression positive
    Lanes eps;       ///< eps_vol_pl at the start of the step
    Surfaces start;  ///< at the start of the step
    Lanes p, t;      ///< of the elastic trial
    Lanes noise;     ///< strain that rounding of p and eps amounts to
  };
  FURROW_INLINE Trial make_trial(const ElasticStep& elastic, const Deviator& deviator,
                                 Hardening& hardening, const Lanes& dv, const Lanes& eps) const {
    const Surfaces start = surfaces(hardening, eps);
    const Lanes noise =
        Lanes(4e-16) * (abs(eps) + abs(dv)) +
        Lanes(8e-16) * (abs(elastic.p_n) + abs(start.pa)) / elastic.bulk(0.0, elastic.p_n);
    return {elastic,      deviator, hardening, dv, eps, start, elastic.pressure(dv),
            deviator.t(), noise};
  }
  /// The end of the step.
  struct Return {
    Lanes p, t;
    Lanes compaction = 0.0;  ///< De
    Lanes pa = 0.0;
    Lanes branch = double(Branch::elastic);
    Lanes iterations = 0.0;
    Lanes m = 0.0;  ///< 3 G Lambda of the deviatoric return
  };
  /// Which points yield, and where; a point meets one surface at most.
  struct Met {
    Mask cap, shear, tension;
  };

  FURROW_INLINE Met surfaces_met_by(const Trial& trial) const {
    // The slack is rounding: a point at rest on its surface is elastic.
    const Surfaces& old = trial.start;
    const Lanes slack = Lanes(1e-13) * old.Q, rounding = Lanes(1e-15) * abs(trial.p);
    const Mask compacts = trial.p >= old.pa;
    const Lanes cap_limit = Lanes(parameters.R) * (old.Q + slack) + rounding;
    const Mask outside_cap =
        square(trial.p - old.pa) + square(trial.t * Lanes(parameters.R / parameters.A)) >
        square(cap_limit);
    const Lanes shear_excess =
        trial.t - shear_strength(old, trial.p, 0.0, 0.0, nullptr).value - slack;
    const Mask cap = compacts && outside_cap, shear = !compacts && shear_excess > rounding;
    return {cap, shear, !cap && !shear && trial.p < Lanes(-parameters.cutoff) - rounding};
  }
  FURROW_INLINE Return correct(const Met& met, const Trial& trial) const {
    Return end;
    end.p = trial.p;
    end.t = trial.t;
    if (any(met.cap)) return_to_cap(met.cap, trial, end);
    if (any(met.shear)) return_to_shear(met.shear, trial, end);
    const Mask cut =
        (met.cap || met.shear || met.tension) && end.p < Lanes(-parameters.cutoff * (1.0 + 1e-15));
    if (any(cut)) return_to_cutoff(cut, trial, end);
    return end;
  }
  /// Energies and the new state, from the deviator s of the end of the step.
  FURROW_INLINE void conclude(const Symmetric& strain, const ElasticStep& elastic,
                              const Symmetric& s_trial, const Symmetric& s, const Return& end,
                              Points& points) const {
    const Mask yielding = end.branch > Lanes(double(Branch::elastic));
    const Symmetric s_old = points.stress.plus_identity(elastic.p_n);
    const Lanes elastic_strain = -strain.trace() - end.compaction,
                half_compliance = Lanes(0.5) / elastic.shear;
    points.stored = elastic.volumetric_work(elastic_strain, end.p) +
                    contract(s + s_old, s - s_old) * half_compliance * Lanes(0.5);
    // Plastic work p De + s:De_dev. Compaction stores pa De as frozen energy; flow always leads
    // away from (pa, 0), so the rest is >= 0.
    const Lanes back_stress =
        select(end.branch == Lanes(double(Branch::tension)), max(end.pa, end.p), end.pa);
    points.frozen = select(yielding, back_stress * end.compaction, 0.0);
    points.dissipated = select(
        yielding,
        (end.p - back_stress) * end.compaction + contract(s, s_trial - s) * half_compliance, 0.0);
    points.own[0] = points.own[0] + end.compaction;
    points.stress = s.plus_identity(-end.p);
    points.branch = end.branch;
    points.iterations = end.iterations;
    const Hardening hardening(parameters.hardening);
    points.below_data = hardening.below(points.own[0]);
    points.beyond_data = hardening.beyond(points.own[0]);
    points.stopped = hardening.stopped(points.own[0]);
  }
  FURROW_INLINE static Symmetric trial_deviator(const ElasticStep& elastic, const Symmetric& strain,
                                                const Points& points) {
    return points.stress.plus_identity(elastic.p_n) +
           strain.deviator() * (Lanes(2.0) * elastic.shear);
  }
  FURROW_INLINE static Lanes pressure_of(const Points& points) {
    return points.stress.trace() * Lanes(-1.0 / 3.0);
  }

  void step(const Symmetric& strain, Points& points) const {
    const ElasticStep elastic(parameters.elasticity, pressure_of(points));
    const Symmetric s_trial = trial_deviator(elastic, strain, points);
    const Deviator deviator(parameters.flow_ratio, s_trial);
    Hardening hardening(parameters.hardening);
    const Trial trial = make_trial(elastic, deviator, hardening, -strain.trace(), points.own[0]);
    Return end = correct(surfaces_met_by(trial), trial);
    const Mask yielding = end.branch > Lanes(double(Branch::elastic));
    const LodeReturn back = deviator.at(end.m, end.iterations, yielding);
    conclude(strain, elastic, s_trial, deviator.stress(s_trial, end.t, back, yielding), end,
             points);
  }

  // ---- in three passes (block_update.h), for K = 1, where the return mapping needs p and t only
  static constexpr int prediction_numbers = 5, return_numbers = 6, surfaces_met = 3;
  struct Prediction {
    Lanes numbers[prediction_numbers];  ///< p_n, dv, eps_n, trial p, trial t
    Mask met[surfaces_met];
  };
  struct Numbers {
    Lanes numbers[return_numbers];  ///< of a Return, without m
  };

  FURROW_INLINE static Numbers numbers_of(const Return& end) {
    return {{end.p, end.t, end.compaction, end.pa, end.branch, end.iterations}};
  }
  FURROW_INLINE Prediction predict(const Symmetric& strain, const Points& points,
                                   Numbers& end) const {
    const ElasticStep elastic(parameters.elasticity, pressure_of(points));
    const Deviator deviator(parameters.flow_ratio, trial_deviator(elastic, strain, points));
    Hardening hardening(parameters.hardening);
    const Trial trial = make_trial(elastic, deviator, hardening, -strain.trace(), points.own[0]);
    Met met = surfaces_met_by(trial);
    const Mask none(false);
    if (all(met.cap) || all(met.shear)) {
      end = numbers_of(correct(met, trial));
      met = {none, none, none};
    } else {
      end = numbers_of(correct(Met{none, none, none}, trial));
    }
    return {{elastic.p_n, trial.dv, trial.eps, trial.p, trial.t},
            {met.cap, met.shear, met.tension}};
  }
  Numbers correct(int surface, const Lanes* prediction) const {
    const ElasticStep elastic(parameters.elasticity, prediction[0]);
    const Deviator deviator(prediction[4]);
    Hardening hardening(parameters.hardening);
    const Trial trial = make_trial(elastic, deviator, hardening, prediction[1], prediction[2]);
    const Return end =
        correct(Met{Mask(surface == 0), Mask(surface == 1), Mask(surface == 2)}, trial);
    return numbers_of(end);
  }
  FURROW_INLINE void finish(const Symmetric& strain, const Lanes* prediction, const Lanes* ends,
                            Points& points) const {
    const ElasticStep elastic(parameters.elasticity, prediction[0]);
    const Symmetric s_trial = trial_deviator(elastic, strain, points);
    const Return end{ends[0], ends[1], ends[2], ends[3], ends[4], ends[5], 0.0};
    const Mask shrinks = end.branch > Lanes(double(Branch::elastic)) && prediction[4] > Lanes(0.0);
    conclude(strain, elastic, s_trial, s_trial * select(shrinks, end.t / prediction[4], 1.0), end,
             points);
  }

 private:
  /// tan(phi) is not below this: sin(phi) <= min(tan(phi), 1) in A Q sin(phi) h = t_tr with h = 1 +
  /// k sqrt(1 + u^2).
  FURROW_INLINE static Lanes min_tangent(const Lanes& t, const Lanes& top, const Lanes& k) {
    return min(max(t / (top * (k + Lanes(1.0))), (t - top) / (top * max(k, 1e-140))), 1e140);
  }
  FURROW_INLINE void finish_cap(const Mask& active, const Trial& trial, const Surfaces& now,
                                const Lanes& cosine, const Lanes& sine, const Lanes& m,
                                const Lanes& de, Return& end) const {
    stdx::where(active, end.compaction) = de;
    stdx::where(active, end.p) = now.pa + Lanes(parameters.R) * now.Q * cosine;
    stdx::where(active, end.t) = min(Lanes(parameters.A) * now.Q * sine, trial.t);
    stdx::where(active, end.m) = m;
    stdx::where(active, end.pa) = now.pa;
    stdx::where(active, end.branch) = double(Branch::cap);
  }

  FURROW_INLINE void return_to_cap(const Mask& active, const Trial& trial, Return& end) const {
    const Surfaces& old = trial.start;
    // First guess: De at constant t and size of the cap.
    const Lanes share = trial.t / (Lanes(parameters.A) * old.Q);
    const Lanes cosine = sqrt(max(Lanes(1.0) - share * share, 0.0));
    const Lanes excess = trial.p - old.pa - Lanes(parameters.R) * old.Q * cosine;
    const Lanes stiffness =
        trial.elastic.bulk(trial.dv, trial.p) +
        old.pa_slope * (Lanes(1.0) + Lanes(parameters.R * parameters.tan_beta) * cosine);
    const Lanes guess = max(excess / stiffness, 0.0);
    Mask open = active;
    if (!lode_dependent && !parameters.elasticity.porous)
      open = cap_together(active, trial, guess, end);
    if (any(open)) cap_nested(open, trial, guess, end);
  }

  /// Newton's method in (De, u) for K = 1: f = p - pa - R Q cos(phi) = 0, g = A Q sin(phi) + 3 G
  /// (R/A) De u - t_tr = 0. Returns the lanes that it has not solved.
  FURROW_INLINE Mask cap_together(const Mask& active, const Trial& trial, const Lanes& guess,
                                  Return& end) const {
    const Lanes A = parameters.A, R = parameters.R, tan_beta = parameters.tan_beta,
                bulk = parameters.elasticity.bulk;
    const Lanes b = Lanes(3.0 * parameters.R / parameters.A) * trial.elastic.shear;
    Lanes de = guess, u = min_tangent(trial.t, A * trial.start.Q, b * guess / (A * trial.start.Q));
    Surfaces now = trial.start;
    Lanes cosine = 1.0, sine = 0.0;
    Mask solved(false);
    constexpr int most = 9;
    for (int i = 0;; ++i) {
      now = surfaces(trial.hardening, trial.eps + de);
      cosine = Lanes(1.0) / sqrt(Lanes(1.0) + u * u);
      sine = u * cosine;
      const Lanes f = trial.p - bulk * de - now.pa - R * now.Q * cosine;
      const Lanes g = A * now.Q * sine + b * de * u - trial.t;
      stdx::where(active && !solved, end.iterations) += 1.0;
      const Mask balanced =
          abs(f) <= Lanes(2e-14) * trial.p + bulk * trial.noise && abs(g) <= Lanes(1e-13) * trial.t;
      solved = solved || (balanced && de >= Lanes(0.0) && u >= Lanes(0.0));
      if (i == most || all(solved || !active)) break;
      // - f = f_de dde + f_u du,  - g = g_de dde + g_u du
      const Lanes f_de = -bulk - now.pa_slope * (Lanes(1.0) + R * tan_beta * cosine),
                  f_u = R * now.Q * sine * cosine * cosine;
      const Lanes g_de = A * tan_beta * now.pa_slope * sine + b * u,
                  g_u = A * now.Q * cosine * cosine * cosine + b * de;
      const Lanes f_over = Lanes(1.0) / (f_de * g_u - f_u * g_de);
      const Lanes dde = (f_u * g - f * g_u) * f_over, du = (f * g_de - f_de * g) * f_over;
      de = select(solved, de, max(de + dde, Lanes(0.1) * de));
      u = select(solved, u, max(u + du, Lanes(0.1) * u));
    }
    finish_cap(active && solved, trial, now, cosine, sine, b * de / (A * now.Q * cosine), de, end);
    return active && !solved;
  }

  void cap_nested(const Mask& active, const Trial& trial, const Lanes& guess, Return& end) const {
    const ElasticStep& elastic = trial.elastic;
    const Lanes A = parameters.A, R = parameters.R;
    const Lanes k_factor =
        Lanes(3.0 * parameters.R / (parameters.A * parameters.A)) * elastic.shear;
    Lanes u = 0.0;
    Surfaces now = trial.start;
    struct Angle {
      Lanes cosine, sine, length, m, slope;
      LodeReturn back;
    };
    Angle angle{};
    // tan(phi) for a given De: A Q sin(phi) h(m) = t_tr. Concave in u for K = 1, so Newton's method
    // from the left is monotone.
    const auto solve_angle = [&](const Lanes& de) {
      const Lanes top = A * now.Q;
      const Lanes k = k_factor * de / now.Q;  // m = k sqrt(1 + u^2)
      const Lanes left = min_tangent(trial.t, top, k);
      Lanes low = 0.0, high = 1e150;
      u = max(u, left);
      Mask open = active;
      for (int i = 0; i < max_root_iterations; ++i) {
        const Lanes length = sqrt(Lanes(1.0) + u * u), cosine = Lanes(1.0) / length,
                    sine = u * cosine;
        const Lanes multiplier = k * length;
        const LodeReturn back = trial.deviator.at(multiplier, end.iterations, open);
        const Lanes value = top * sine * back.shrink - trial.t;
        const Lanes slope =
            top * (cosine * cosine * cosine * back.shrink + sine * back.slope * k * sine);
        angle = {cosine, sine, length, multiplier, slope, back};
        if (!any(open)) break;
        stdx::where(open, end.iterations) += 1.0;
        stdx::where(open && value > Lanes(0.0), high) = u;
        stdx::where(open && !(value > Lanes(0.0)), low) = u;
        const Lanes newton = u - value / slope;
        const Mask inside = newton >= low && newton <= high;
        const Lanes halfway =
            select(high < Lanes(1e149), Lanes(0.5) * (low + high), Lanes(2.0) * u + Lanes(1.0));
        const Lanes next =
            min(select(inside, newton,
                       select(newton < low, max(left, Lanes(0.5) * (low + u)), halfway)),
                1e140);
        const Mask done = abs(next - u) <= Lanes(1e-14) * next ||
                          high - low <= Lanes(1e-15) * high ||
                          abs(value) <= Lanes(2e-15) * trial.t;  // the rounding of t_tr
        u = select(open, next, u);
        open = open && !done;
      }
    };
    const auto budget = [&](const Lanes& de) -> ValueAndSlope {
      now = surfaces(trial.hardening, trial.eps + de);
      solve_angle(de);
      const Lanes x = trial.dv - de, pressure = elastic.pressure(x);
      const Lanes cap_pressure = now.pa + R * now.Q * angle.cosine;
      // d(cos phi)/d(De) by the implicit derivative of the inner equation
      const Lanes dQ = Lanes(parameters.tan_beta) * now.pa_slope;
      const Lanes m_slope = (k_factor * angle.length - angle.m * dQ) / now.Q;
      const Lanes inner =
          A * angle.sine * (dQ * angle.back.shrink + now.Q * angle.back.slope * m_slope);
      const Lanes dcos = angle.sine * square(angle.cosine) * inner / angle.slope;
      const Lanes slope =
          -elastic.bulk(x, pressure) - now.pa_slope - R * (dQ * angle.cosine + now.Q * dcos);
      return {pressure - cap_pressure, slope};
    };
    const Lanes floor = Lanes(-parameters.elasticity.limit) +
                        Lanes(1e-12) * (elastic.p_n + parameters.elasticity.limit);
    const Lanes high =
        trial.dv - elastic.strain(parameters.elasticity.porous ? floor : trial.start.pa);
    const Lanes de =
        decreasing_root(budget, min(guess, high), 0.0, high, Lanes(1e-13) * high + trial.noise,
                        active && high > Lanes(0.0), end.iterations);
    const Lanes solution = select(active, max(de, 0.0), 0.0);
    budget(solution);
    finish_cap(active, trial, now, angle.cosine, angle.sine, angle.m, solution, end);
  }

  void return_to_shear(const Mask& active, const Trial& trial, Return& end) const {
    const ElasticStep& elastic = trial.elastic;
    const Surfaces& old = trial.start;
    const Lanes c =
        Lanes(3.0 / (parameters.A * parameters.A * parameters.tan_beta * parameters.tan_beta)) *
        elastic.shear;
    Surfaces now = old;
    Lanes pressure = trial.p, D = 0.0, strength = 0.0, multiplier = 0.0;
    Mask transition(false);
    const auto budget = [&](const Lanes& x) __attribute__((always_inline))->ValueAndSlope {
      now = surfaces(trial.hardening, trial.eps - x);
      pressure = elastic.pressure(trial.dv + x);
      const Lanes dp = elastic.bulk(trial.dv + x, pressure), dpa = -now.pa_slope;
      const Mask before = now.pa > pressure;
      D = max(now.pa - pressure, 0.0);
      const Lanes dD = select(before, dpa - dp, 0.0);
      const ValueAndSlope yield = shear_strength(now, pressure, dp, dpa, &transition);
      strength = yield.value;
      Lanes Dh, dDh;  // D h(m) and its derivative
      if (lode_dependent) {
        multiplier = min(c * x / max(D, Lanes(1e-100)), 1e100);
        const LodeReturn back = trial.deviator.at(multiplier, end.iterations, active);
        Dh = select(before, D * back.shrink, c * x * back.slope);
        dDh = dD * back.shrink + back.slope * (c - multiplier * dD);
      } else {
        Dh = D + c * x;
        dDh = dD + c;
      }
      return {trial.t * D - strength * Dh, trial.t * dD - yield.slope * Dh - strength * dDh};
    };
    const Lanes high = elastic.strain(old.pa) - trial.dv;
    const Lanes positive = max(shear_strength(old, trial.p, 0.0, 0.0, nullptr).value,
                               Lanes(1e-3) * trial.t + Lanes(1e-290));
    const Lanes ratio = trial.t / positive - Lanes(1.0);
    const Lanes start = min(
        ratio * (old.pa - trial.p) / (c + ratio * (elastic.bulk(trial.dv, trial.p) + old.pa_slope)),
        high);
    // p and t are taken from the final x, on the surface: a last step of 1e-10 leaves the direction
    // of flow exact to that, at least.
    const Lanes x = decreasing_root(budget, start, 0.0, high, Lanes(1e-10) * high,
                                    active && high > Lanes(0.0), end.iterations);
    const Lanes solution = select(active, max(x, 0.0), 0.0);
    budget(solution);
    pressure = min(pressure, now.pa);  // it is below, but for rounding
    strength = shear_strength(now, pressure, 0.0, 0.0, nullptr).value;
    const Mask apex = strength <= Lanes(1e-12) * now.Q;
    stdx::where(active, end.compaction) = -solution;
    stdx::where(active, end.p) = pressure;
    stdx::where(active, end.t) = min(max(strength, 0.0), trial.t);
    stdx::where(active, end.m) = multiplier;
    stdx::where(active, end.pa) = now.pa;
    stdx::where(active, end.branch) =
        select(apex, double(Branch::tension),
               select(transition, double(Branch::transition), double(Branch::shear)));
  }

  void return_to_cutoff(const Mask& active, const Trial& trial, Return& end) const {
    const Lanes pressure = -parameters.cutoff;
    const Lanes de = select(active, trial.dv - trial.elastic.strain(pressure), 0.0);
    const Surfaces now = surfaces(trial.hardening, trial.eps + de);
    const Lanes D = pressure - now.pa;
    const Lanes on_cap = Lanes(parameters.A / parameters.R) *
                         sqrt(max(square(Lanes(parameters.R) * now.Q) - D * D, 0.0));
    const Lanes strength =
        max(select(D > Lanes(0.0), on_cap, shear_strength(now, pressure, 0.0, 0.0, nullptr).value),
            0.0);
    const Lanes measure = min(trial.t, strength);
    const Lanes shrink = trial.t / max(measure, Lanes(1e-100) * trial.t + Lanes(1e-300));
    const Lanes multiplier = trial.deviator.multiplier(max(shrink, 1.0), end.iterations, active);
    stdx::where(active, end.iterations) += 1.0;
    stdx::where(active, end.compaction) = de;
    stdx::where(active, end.p) = pressure;
    stdx::where(active, end.t) = measure;
    stdx::where(active, end.m) = multiplier;
    stdx::where(active, end.pa) = now.pa;
    stdx::where(active, end.branch) = double(Branch::tension);
  }
};

}  // namespace FURROW_ISA
}  // namespace furrow
