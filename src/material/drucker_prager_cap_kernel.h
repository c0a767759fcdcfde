#pragma once
/// Kernel of the Drucker-Prager cap law: implicit (backward Euler) return mapping in p and t. Equations (12)-(16): drucker_prager_cap.h.
///
/// Unknown is the volumetric plastic strain of the step, De, compression positive. Abbreviations:
///   pa(eps) = (pb(eps) - R d)/(1 + R tan(beta)),   Q = d + pa tan(beta),   eps = eps_n + De,   p = elastic pressure after dv - De.
/// Which surface is met is known beforehand: flow on the cap compacts and ends at p >= pa, flow on the shear line and the transition
/// loosens and ends at p <= pa, so the side of the trial pressure decides.
///
/// Cap, p = pa + R Q cos(phi), t = A Q sin(phi), u = tan(phi). Associated flow: 3 G Lambda = m(u) = 3 G R De/(A^2 Q) sqrt(1 + u^2).
///   inner:  A Q sin(phi) h(m) = t_tr                        increasing in u (h = t_tr/t, lode.h)
///   outer:  p(De) - pa - R Q cos(phi) = 0                   decreasing in De
/// Shear and transition, x = -De >= 0, D = pa - p. Flow (16): 3 G Lambda = m = 3 G x/(A^2 tan^2(beta) D).
///   t_y(p) D h(m) - t_tr D = 0, divided by -1               decreasing in x, a quadratic for K = 1 on a straight piece of the table
/// Tension cut-off, p = -cutoff: De follows from the elastic law, and t is the smaller of the trial's and the yield surface's.
/// The stress is placed on the surface that belongs to the final eps, so the yield function is zero to rounding.

#include "material/block_update.h"
#include "material/drucker_prager_cap_parameters.h"
#include "material/elasticity_kernel.h"
#include "material/hardening_kernel.h"
#include "material/lode.h"

namespace furrow {
inline namespace FURROW_ISA {

template <bool lode_dependent>
struct DruckerPragerCapKernel {
  static constexpr int own_fields = 1;  // eps_vol_pl
  const DruckerPragerCapParameters& law;

  /// The surfaces at one eps_vol_pl.
  struct Surfaces {
    Lanes pa, Q;
    Lanes pa_slope;  ///< d(pa)/d(eps)
  };
  Surfaces surfaces(Hardening& hardening, const Lanes& eps) const {
    const Hardening::Strength pb = hardening.at(eps);
    const Lanes f = 1.0 / (1.0 + law.R * law.tan_beta);
    const Lanes pa = (pb.value - Lanes(law.R * law.d)) * f;
    return {pa, Lanes(law.d) + pa * Lanes(law.tan_beta), pb.slope * f};
  }

  /// t on the shear line or the transition at p <= pa, and its derivative when p grows by dp, pa by dpa.
  ValueAndSlope shear_strength(const Surfaces& at, const Lanes& p, const Lanes& dp, const Lanes& dpa, Mask* transition) const {
    const Lanes tan_beta = law.tan_beta;
    ValueAndSlope t{Lanes(law.d) + p * tan_beta, tan_beta * dp};
    if (law.alpha == 0.0) return t;
    const Lanes radius = Lanes(law.alpha) * at.Q, D = upper(at.pa - p, 0.0);
    const Mask on_arc = D < radius * Lanes(law.sin_beta);
    const Lanes leg = root(upper(radius * radius - D * D, 0.0));
    t.value = select(on_arc, Lanes(law.B) * at.Q + leg, t.value);
    t.slope = select(on_arc, Lanes(law.B) * tan_beta * dpa + (Lanes(law.alpha) * radius * tan_beta * dpa - D * (dpa - dp)) / leg, t.slope);
    if (transition) *transition = on_arc;
    return t;
  }

  void step(const Symmetric& strain, Points& points) const {
    const ElasticStep elastic(law.elasticity, points.stress.trace() * Lanes(-1.0 / 3.0));
    const Lanes dv = -strain.trace();  // compression positive
    const Lanes p_trial = elastic.pressure(dv);
    const Symmetric s_old = points.stress.plus_identity(elastic.p_n);
    const Symmetric s_trial = s_old + strain.deviator() * (Lanes(2.0) * elastic.shear);
    const DeviatoricReturn<lode_dependent> deviator(law.flow_ratio, s_trial);
    const Lanes t_trial = deviator.t();
    const Lanes eps_old = points.own[0];
    Hardening hardening(law.hardening);
    const Surfaces old = surfaces(hardening, eps_old);

    // Which points yield, and where. The slack is rounding: a point at rest on its surface is elastic.
    const Lanes slack = Lanes(1e-13) * old.Q, rounding = Lanes(1e-15) * magnitude(p_trial);
    const Mask compacts = p_trial >= old.pa;
    const Lanes cap_excess = root(square(p_trial - old.pa) + square(t_trial * Lanes(law.R / law.A))) - Lanes(law.R) * (old.Q + slack);
    const Lanes shear_excess = t_trial - shear_strength(old, p_trial, 0.0, 0.0, nullptr).value - slack;
    const Mask on_cap = compacts && cap_excess > rounding;
    const Mask on_shear = !compacts && shear_excess > rounding;
    const Mask in_tension = p_trial < Lanes(-law.cutoff) - rounding;
    const Mask yielding = on_cap || on_shear || in_tension;

    Lanes p = p_trial, t = t_trial, m = 0.0, compaction = 0.0;  // compaction is De
    Surfaces at = old;
    if (any(yielding)) {
      const Lanes noise = Lanes(4e-16) * (magnitude(eps_old) + magnitude(dv)) +
                          Lanes(8e-16) * (magnitude(elastic.p_n) + magnitude(old.pa)) / elastic.bulk(0.0, elastic.p_n);
      if (any(on_cap)) cap(on_cap, elastic, dv, deviator, hardening, eps_old, old, p_trial, noise, points, p, t, m, compaction, at);
      if (any(on_shear)) shear(on_shear, elastic, dv, deviator, hardening, eps_old, old, p_trial, noise, points, p, t, m, compaction, at);
      const Mask cut = yielding && p < Lanes(-law.cutoff * (1.0 + 1e-15));
      if (any(cut)) tension(cut, elastic, dv, deviator, hardening, eps_old, points, p, t, m, compaction, at);
    }
    const LodeReturn back = deviator.at(m, points.iterations, yielding);
    const Symmetric s = deviator.stress(t, back, yielding);

    const Lanes elastic_strain = dv - compaction;
    const Lanes half_compliance = Lanes(0.5) / elastic.shear;
    points.stored = elastic.volumetric_work(elastic_strain, p) + contract(s + s_old, s - s_old) * half_compliance * Lanes(0.5);
    // Plastic work p De + s:De_dev. Compaction stores pa De as frozen energy; flow always leads away from (pa, 0), so the rest is >= 0.
    const Lanes back_stress = select(points.branch == Lanes(double(Branch::tension)), upper(at.pa, p), at.pa);
    points.frozen = select(yielding, back_stress * compaction, 0.0);
    points.dissipated = select(yielding, (p - back_stress) * compaction + contract(s, s_trial - s) * half_compliance, 0.0);
    points.own[0] = eps_old + compaction;
    points.stress = s.plus_identity(-p);
    points.below_data = hardening.below(points.own[0]);
    points.beyond_data = hardening.beyond(points.own[0]);
    points.stopped = hardening.stopped(points.own[0]);
  }

 private:
  using Deviator = DeviatoricReturn<lode_dependent>;

  void cap(const Mask& active, const ElasticStep& elastic, const Lanes& dv, const Deviator& deviator, Hardening& hardening,
           const Lanes& eps_old, const Surfaces& old, const Lanes& p_trial, const Lanes& noise, Points& points, Lanes& p, Lanes& t,
           Lanes& m, Lanes& compaction, Surfaces& at) const {
    const Lanes t_trial = deviator.t(), A = law.A, R = law.R;
    Lanes u = 0.0;
    Surfaces now = old;
    struct Angle {
      Lanes cosine, sine, length, m, slope;
      LodeReturn back;
    };
    Angle angle{};
    // tan(phi) for a given De: A Q sin(phi) h(m) = t_tr. Concave in u for K = 1, so Newton's method from the left is monotone.
    const auto solve_angle = [&](const Lanes& de) {
      const Lanes top = A * now.Q;
      const Lanes k = Lanes(3.0 * law.R / (law.A * law.A)) * elastic.shear * de / now.Q;  // m = k sqrt(1 + u^2)
      const Lanes left = lower(upper(t_trial / (top * (k + Lanes(1.0))), (t_trial - top) / (top * upper(k, 1e-140))), 1e140);
      Lanes low = 0.0, high = 1e150;
      u = upper(u, left);
      Mask open = active;
      for (int i = 0; i < most_root_iterations; ++i) {
        const Lanes length = root(Lanes(1.0) + u * u), cosine = Lanes(1.0) / length, sine = u * cosine;
        const Lanes multiplier = k * length;
        const LodeReturn back = deviator.at(multiplier, points.iterations, open);
        const Lanes value = top * sine * back.shrink - t_trial;
        const Lanes slope = top * (cosine * cosine * cosine * back.shrink + sine * back.slope * k * sine);
        angle = {cosine, sine, length, multiplier, slope, back};
        if (!any(open)) break;
        stdx::where(open, points.iterations) += 1.0;
        stdx::where(open && value > Lanes(0.0), high) = u;
        stdx::where(open && !(value > Lanes(0.0)), low) = u;
        const Lanes newton = u - value / slope;
        const Mask inside = newton >= low && newton <= high;
        const Lanes halfway = select(high < Lanes(1e149), Lanes(0.5) * (low + high), Lanes(2.0) * u + Lanes(1.0));
        const Lanes next = lower(select(inside, newton, select(newton < low, upper(left, Lanes(0.5) * (low + u)), halfway)), 1e140);
        const Mask done = magnitude(next - u) <= Lanes(1e-14) * next || high - low <= Lanes(1e-15) * high;
        u = select(open, next, u);
        open = open && !done;
      }
    };
    const auto balance = [&](const Lanes& de) -> ValueAndSlope {
      now = surfaces(hardening, eps_old + de);
      solve_angle(de);
      const Lanes x = dv - de, pressure = elastic.pressure(x);
      const Lanes cap_pressure = now.pa + R * now.Q * angle.cosine;
      // d(cos phi)/d(De) by the implicit derivative of the inner equation
      const Lanes dQ = Lanes(law.tan_beta) * now.pa_slope;
      const Lanes m_slope = (Lanes(3.0 * law.R / (law.A * law.A)) * elastic.shear * angle.length - angle.m * dQ) / now.Q;
      const Lanes inner = A * angle.sine * (dQ * angle.back.shrink + now.Q * angle.back.slope * m_slope);
      const Lanes dcos = angle.sine * square(angle.cosine) * inner / angle.slope;
      const Lanes slope = -elastic.bulk(x, pressure) - now.pa_slope - R * (dQ * angle.cosine + now.Q * dcos);
      return {pressure - cap_pressure, slope};
    };
    const Lanes floor = Lanes(-law.elasticity.limit) + Lanes(1e-12) * (elastic.p_n + law.elasticity.limit);
    const Lanes high = dv - elastic.strain(law.elasticity.porous ? floor : old.pa);
    const Lanes share = t_trial / (A * old.Q);
    const Lanes excess = p_trial - old.pa - R * old.Q * root(upper(Lanes(1.0) - share * share, 0.0));
    const Lanes start = lower(upper(excess / (elastic.bulk(dv, p_trial) + old.pa_slope * Lanes(1.0 + law.R * law.tan_beta)), 0.0), high);
    const Lanes de = decreasing_root(balance, start, 0.0, high, Lanes(1e-13) * high + noise, active && high > Lanes(0.0), points.iterations);
    const Lanes solution = select(active, upper(de, 0.0), 0.0);
    balance(solution);
    stdx::where(active, compaction) = solution;
    stdx::where(active, p) = now.pa + R * now.Q * angle.cosine;
    stdx::where(active, t) = lower(A * now.Q * angle.sine, t_trial);
    stdx::where(active, m) = angle.m;
    stdx::where(active, at.pa) = now.pa;
    stdx::where(active, at.Q) = now.Q;
    stdx::where(active, points.branch) = double(Branch::cap);
  }

  void shear(const Mask& active, const ElasticStep& elastic, const Lanes& dv, const Deviator& deviator, Hardening& hardening,
             const Lanes& eps_old, const Surfaces& old, const Lanes& p_trial, const Lanes& noise, Points& points, Lanes& p, Lanes& t,
             Lanes& m, Lanes& compaction, Surfaces& at) const {
    const Lanes t_trial = deviator.t();
    const Lanes c = Lanes(3.0 / (law.A * law.A * law.tan_beta * law.tan_beta)) * elastic.shear;
    Surfaces now = old;
    Lanes pressure = p_trial, D = 0.0, strength = 0.0, multiplier = 0.0;
    Mask transition(false);
    const auto balance = [&](const Lanes& x) -> ValueAndSlope {
      now = surfaces(hardening, eps_old - x);
      pressure = elastic.pressure(dv + x);
      const Lanes dp = elastic.bulk(dv + x, pressure), dpa = -now.pa_slope;
      const Mask before = now.pa > pressure;
      D = upper(now.pa - pressure, 0.0);
      const Lanes dD = select(before, dpa - dp, 0.0);
      const ValueAndSlope yield = shear_strength(now, pressure, dp, dpa, &transition);
      strength = yield.value;
      multiplier = lower(c * x / upper(D, Lanes(1e-100)), 1e100);
      Lanes Dh, dDh;  // D h(m) and its derivative
      if (lode_dependent) {
        const LodeReturn back = deviator.at(multiplier, points.iterations, active);
        Dh = select(before, D * back.shrink, c * x * back.slope);
        dDh = dD * back.shrink + back.slope * (c - multiplier * dD);
      } else {
        Dh = D + c * x;
        dDh = dD + c;
      }
      return {t_trial * D - strength * Dh, t_trial * dD - yield.slope * Dh - strength * dDh};
    };
    const Lanes high = elastic.strain(old.pa) - dv;
    const Lanes ratio = t_trial / upper(shear_strength(old, p_trial, 0.0, 0.0, nullptr).value, Lanes(1e-3) * t_trial + Lanes(1e-290)) - Lanes(1.0);
    const Lanes start = lower(ratio * (old.pa - p_trial) / (c + ratio * (elastic.bulk(dv, p_trial) + old.pa_slope)), high);
    const Lanes x = decreasing_root(balance, start, 0.0, high, Lanes(1e-13) * high + Lanes(0.01) * noise, active && high > Lanes(0.0),
                                    points.iterations);
    const Lanes solution = select(active, upper(x, 0.0), 0.0);
    balance(solution);
    pressure = lower(pressure, now.pa);  // it is below, but for rounding
    strength = shear_strength(now, pressure, 0.0, 0.0, nullptr).value;
    const Mask apex = strength <= Lanes(1e-12) * now.Q;
    stdx::where(active, compaction) = -solution;
    stdx::where(active, p) = pressure;
    stdx::where(active, t) = lower(upper(strength, 0.0), t_trial);
    stdx::where(active, m) = multiplier;
    stdx::where(active, at.pa) = now.pa;
    stdx::where(active, at.Q) = now.Q;
    stdx::where(active, points.branch) = select(apex, double(Branch::tension), select(transition, double(Branch::transition), double(Branch::shear)));
  }

  void tension(const Mask& active, const ElasticStep& elastic, const Lanes& dv, const Deviator& deviator, Hardening& hardening,
               const Lanes& eps_old, Points& points, Lanes& p, Lanes& t, Lanes& m, Lanes& compaction, Surfaces& at) const {
    const Lanes t_trial = deviator.t(), pressure = -law.cutoff;
    const Lanes de = select(active, dv - elastic.strain(pressure), 0.0);
    const Surfaces now = surfaces(hardening, eps_old + de);
    const Lanes D = pressure - now.pa;
    const Lanes on_cap = Lanes(law.A / law.R) * root(upper(square(Lanes(law.R) * now.Q) - D * D, 0.0));
    const Lanes strength = upper(select(D > Lanes(0.0), on_cap, shear_strength(now, pressure, 0.0, 0.0, nullptr).value), 0.0);
    const Lanes measure = lower(t_trial, strength);
    const Lanes shrink = t_trial / upper(measure, Lanes(1e-100) * t_trial + Lanes(1e-300));
    const Lanes multiplier = deviator.multiplier(upper(shrink, 1.0), points.iterations, active);
    stdx::where(active, points.iterations) += 1.0;
    stdx::where(active, compaction) = de;
    stdx::where(active, p) = pressure;
    stdx::where(active, t) = measure;
    stdx::where(active, m) = multiplier;
    stdx::where(active, at.pa) = now.pa;
    stdx::where(active, at.Q) = now.Q;
    stdx::where(active, points.branch) = double(Branch::tension);
  }
};

}  // namespace FURROW_ISA
}  // namespace furrow
