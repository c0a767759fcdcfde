// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The step of snow_bond.h in which a contact yields: returns to the surfaces of its strengths.

#include <algorithm>
#include <cmath>

#include "furrow/grains/snow_bond_trial.h"

namespace furrow {

/// A step in which a contact yields, breaks, sinters or is dry, phase by phase.
class SnowBondStep {
 public:
  SnowBondStep(const SnowBondParameters& law, const SnowContact& contact,
               const SnowBondTrial& trial, SnowBondState& state)
      : law_(law),
        contact_(contact),
        state_(state),
        trial_(trial),
        d_(contact.d),
        k_(trial.k),
        softness_(1.0 / k_),
        growth_(law, state.hardening, softness_ / d_) {}

  SnowBondResponse advance(SnowBondEnergy* energy);

 private:
  /// Strength of the contact when this normal force is left.
  SnowStrength strength(double normal) const {
    return SnowBond::strength(law_, d_, growth_.after(trial_.normal - normal));
  }
  void break_bond(SnowBondResponse& response);
  void slip_and_crush();
  void slip();
  void crush();
  void grow(SnowBondResponse& response);
  void bend();
  void damp(SnowBondResponse& response, SnowBondEnergy* energy) const;
  double plastic_work() const;
  static double share_within(double limit, double squared_size) {
    return squared_size > limit * limit ? limit / std::sqrt(squared_size) : 1.0;
  }
  struct Excess {
    double value, slope;
  };
  template <class Function>
  static double solve(double start, Excess there, Function&& excess);

  const SnowBondParameters& law_;
  const SnowContact& contact_;
  SnowBondState& state_;
  const SnowBondTrial& trial_;
  const double d_, k_;
  const double softness_;    // 1/k [m/N]
  const SnowGrowth growth_;  // by forces that are left out [N]

  SnowStrength strong_;    // strength at the crushing after the step
  double share_;           // of the bond, before the step
  double torsion_before_;  // [N m]
  double normal_before_;   // [N]
  double normal_;          // [N] after the step
  // shares of the trial's that are left
  double shear_left_ = 1.0, bending_left_ = 1.0, torsion_left_ = 1.0;
};

inline SnowBondResponse SnowBondStep::advance(SnowBondEnergy* energy) {
  SnowBondResponse response;
  share_ = SnowBond::bonded_share(state_, d_);
  torsion_before_ = state_.torsion;
  normal_ = trial_.normal;
  strong_ = SnowBond::strength(law_, d_, state_.hardening);
  // not beyond the surface, where a change of parameters between runs may have left it
  normal_before_ = std::clamp(trial_.normal_before, -law_.zeta * share_ * strong_.Fb, strong_.Fy);
  if (trial_.normal <= 0.0 &&
      (!state_.bonded || -trial_.normal > law_.zeta * share_ * strong_.Fb)) {
    if (energy) energy->released = SnowBond::stored(law_, d_, state_, normal_before_);
    break_bond(response);
    return response;
  }
  slip_and_crush();
  grow(response);
  bend();
  if (energy) {
    energy->crushed = plastic_work();
    energy->stored = SnowBond::stored(law_, d_, state_, normal_);
  }
  damp(response, energy);
  return response;
}

inline void SnowBondStep::break_bond(SnowBondResponse& response) {
  response.broken = state_.bonded;
  if (state_.bonded) state_.at_break = state_.plastic;
  state_.bonded = false;
  state_.area = state_.torsion = 0.0;
  state_.across = {};
}

/// Newton's method for the root of an increasing concave function, from above. The first iterate
/// lies below the root, and no later one exceeds it. @param there the excess at the start
template <class Function>
inline double SnowBondStep::solve(double start, Excess there, Function&& excess) {
  constexpr int maximum_iterations = 60;
  constexpr double tolerance = 1e-6;  // of x; the error is of the order of its square
  double x = start - there.value / there.slope;
  for (int n = 0; n < maximum_iterations; ++n) {
    const Excess here = excess(x);
    const double change = -here.value / here.slope;
    x += change;
    if (!(std::abs(change) > tolerance * x)) break;
  }
  return x;
}

inline void SnowBondStep::slip_and_crush() {
  const double cohesion = law_.chi * share_ * strong_.Fb;
  if (trial_.normal <= 0.0) {
    shear_left_ = share_within(cohesion, trial_.squared[0]);
  } else {
    const double limit = cohesion + law_.mu * trial_.normal;
    if (trial_.squared[0] > limit * limit) slip();
    if (normal_ > strong_.Fy) crush();
    if (normal_ != trial_.normal) {
      state_.plastic += (trial_.normal - normal_) * softness_;
      state_.hardening = growth_.after(trial_.normal - normal_);
    }
  }
}

/// Returns the force to the shear surface: towards zero for the share of cohesion in the strength,
/// else across at constant normal force.
inline void SnowBondStep::slip() {
  const double size = std::sqrt(trial_.squared[0]), pressing = trial_.normal;
  const double cohesion = law_.chi * share_ * strong_.Fb;
  if (cohesion <= 0.0) {
    shear_left_ = law_.mu * pressing / size;
    return;
  }
  const double along = cohesion / (cohesion + law_.mu * pressing);
  const double slope = size - law_.mu * along * pressing;
  const auto normal_at = [&](double left) { return pressing * (1.0 - along * (1.0 - left)); };
  const auto excess = [&](double left) {
    const double weakening = law_.chi * share_ * strong_.dFb * along * pressing * softness_;
    return Excess{left * size - law_.mu * normal_at(left) - law_.chi * share_ * strong_.Fb,
                  slope + weakening};
  };
  const double found = solve(1.0, excess(1.0), [&](double left) {
    strong_ = strength(normal_at(left));
    return excess(left);
  });
  shear_left_ = std::clamp(found, 0.0, 1.0);
  normal_ = normal_at(shear_left_);
}

/// Returns the normal force to the crush surface, along the force.
inline void SnowBondStep::crush() {
  const auto excess = [&](double normal) {
    return Excess{normal - strong_.Fy, 1.0 + strong_.dFy * softness_};
  };
  const double limit = solve(normal_, excess(normal_), [&](double normal) {
    strong_ = strength(normal);
    return excess(normal);
  });
  shear_left_ *= limit / normal_;
  normal_ = limit;
}

/// Sintering under pressure.
inline void SnowBondStep::grow(SnowBondResponse& response) {
  if (!contact_.sinters) return;
  const double area = SnowBond::sintering_area(law_, d_, state_);
  if (!(area > state_.area)) return;
  state_.area = area;
  response.made = !state_.bonded;
  state_.bonded = true;
}

/// Limits bending and torsion by the present strength of the bond.
inline void SnowBondStep::bend() {
  const double radius = std::sqrt(squared_strength_radius(state_.area, d_));
  const double pressing = std::max(0.0, normal_),
               Fb = SnowBond::bonded_share(state_, d_) * strong_.Fb;
  bending_left_ = share_within(SnowBond::bending_limit * (law_.zeta * Fb + pressing) * radius,
                               trial_.squared[1]);
  torsion_left_ =
      share_within(SnowBond::torsion_limit * (law_.chi * Fb + law_.mu * pressing) * radius,
                   trial_.torsion * trial_.torsion);
  state_.across = Two{shear_left_, bending_left_} * trial_.across;
  state_.torsion = torsion_left_ * trial_.torsion;
}

/// Force after the return times plastic displacement, plus the elastic energy that a growing bond
/// loses.
inline double SnowBondStep::plastic_work() const {
  const auto lost = [](double left) { return left > 0.0 ? 1.0 / left - 1.0 : 0.0; };
  const double bending = state_.across.second().squaredNorm() / trial_.bending_stiffness(),
               torsion = state_.torsion * state_.torsion / trial_.torsion_stiffness();
  return (normal_ * (trial_.normal - normal_) +
          shear_left_ * (1.0 - shear_left_) * trial_.squared[0]) *
             softness_ +
         bending * lost(bending_left_) + torsion * lost(torsion_left_) +
         0.5 * (bending + torsion) *
             (1.0 - trial_.squared_radius / squared_stiffness_radius(state_.area, d_));
}

/// Dampers; those of a dry contact neither pull nor overcome friction.
inline void SnowBondStep::damp(SnowBondResponse& response, SnowBondEnergy* energy) const {
  const double relaxation = 2.0 * law_.damping * std::sqrt(contact_.mass * softness_) / contact_.dt;
  double normal = relaxation * (normal_ - normal_before_);
  const TwoVectors change = 0.5 * relaxation * (state_.across - trial_.before);
  Vector3 shear = change.first();
  if (!state_.bonded) {
    normal = std::max(normal, -normal_);
    const Vector3 all = state_.across.first() + shear;
    shear =
        share_within(law_.mu * (normal_ + normal), all.squaredNorm()) * all - state_.across.first();
  }
  const double torsion = 0.5 * relaxation * (state_.torsion - torsion_before_);
  const Vector3 moment = change.second() + torsion * contact_.normal;
  if (energy)
    energy->damped =
        -contact_.dt * (normal * contact_.normal_velocity +
                        shear.dot(contact_.tangential_velocity) + moment.dot(contact_.rotation));
  response.force = (normal_ + normal) * contact_.normal + state_.across.first() + shear;
  response.moment = state_.across.second() + state_.torsion * contact_.normal + moment;
}

}  // namespace furrow
