// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact of two clusters of sintered snow that crush in place.
///
/// A cluster is a lump of snow as light as the snow around it allows (its packing is dense and
/// random), so snow is compacted by crushing contacts, not by rearranging clusters. Of a contact:
/// d = Ri + Rj, overlap u, unit normal n from j to i; stiffness k = E d along and across n.
///
///   state      u_p plastic overlap; X = (u_p - u_0)/d crushing, u_0 its value when sintered;
///              A area of the bond, A0 = pi (0.2 d)^2 that of a sintered one; shear force; moments
///   crush      Fy = d^2 (Y0 exp(p X) + Y1 (exp(q X) - 1))
///   bond       Fb = min(Fy, d^2 Y0 exp(pc X)) min(1, A/A0)
///   trial      Fn = k (u - u_p), Ft and moments grow by stiffness times relative motion
///   shear      |Ft| <= C + mu max(Fn, 0), C = chi Fb
///   crushing   Fn <= Fy
///   tension    Fn < -zeta Fb breaks the bond; without one there is no tension
///   bending    stiffness k a_s^2/4, |M| <= 4/(3 pi) a (zeta Fb + max(Fn, 0))
///   torsion    stiffness k a_s^2/2, |M| <= 2/3 a (chi Fb + mu max(Fn, 0))
///              a = max(sqrt(A/pi), 0.07 d), a_s = max(a, 0.2 d); limits of a fully plastic disc
///   sintering  A grows to w pi (d/4) (u_p - u_b) where clusters are pressed into one another; u_b
///              is u_p when the last bond broke
///
/// Where the trial is beyond the crush surface, Fn and Ft shrink in one ratio: force follows
/// displacement, which keeps lateral stress low (uniform strain, kt/kn = s: K0 = (1 - s)/(3 + 2
/// s)). Beyond the shear surface Ft shrinks by a share r and Fn by r C/(C + mu Fn): a bond yields
/// along the force, a dry contact slides at constant normal force. Both are implicit: the force
/// lies on the surface of the state after the step. Plastic displacement has the direction of the
/// force taken away, so plastic work is never negative.
///
/// Dampers act on the change of the elastic force, Fd = c/k dF/dt, c = 2 damping sqrt(m k) along
/// and half of that across the normal: in elastic motion that is -c v, and steady crushing and
/// sliding are independent of the rate.
///
/// Forces, moments and history are exactly opposite when i and j swap. Shear force and bending
/// moment are carried with the contact: turned with the normal, and about it by the mean spin.
///
/// Bonds with bending and torsion [Potyondy2004]; pressure sintering [Luding2008]; new bonds that
/// carry the hardening of compressed snow [Kry1975]. The law as a whole, and its values, are
/// Furrow's own.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/types.h"
#include "grains/snow_bond_parameters.h"

namespace furrow {

/// How two clusters lie and move in a step of leapfrog: positions of its end, velocities of its
/// middle. A plane wall is half of a contact of two like clusters: twice its overlap and relative
/// velocities, d = 2 R, half of the mass; energies are then twice those of the wall.
struct SnowContact {
  double d;                     ///< [m] sum of the radii
  double mass;                  ///< [kg] effective
  double overlap;               ///< [m] > 0
  Vector3 normal;               ///< from j to i
  double normal_velocity;       ///< [m/s] of i against j along the normal: > 0 where they part
  Vector3 tangential_velocity;  ///< [m/s] of i against j where they touch, across the normal
  Vector3 rotation;             ///< [rad/s] angular velocity of i less that of j
  double spin;                  ///< [rad/s] mean angular velocity about the normal
  double dt;                    ///< [s]
  bool sinters = true;          ///< false: what it touches is not snow
};

/// What a contact remembers; all zero before the first touch.
struct SnowBondState {
  static constexpr int size = 12;  ///< values of load() and store()

  double plastic = 0.0;       ///< u_p [m]
  double at_sintering = 0.0;  ///< u_0 [m]
  double at_break = 0.0;      ///< u_b [m]
  double area = 0.0;          ///< A [m^2]
  bool bonded = false;
  Vector3 shear = Vector3::Zero();    ///< [N] elastic force on i across the normal
  Vector3 bending = Vector3::Zero();  ///< [N m] elastic moment on i across the normal
  double torsion = 0.0;               ///< [N m] along the normal

  static SnowBondState load(const double* values);
  void store(double* values) const;
};

/// What a step of a contact does with energy [J].
struct SnowBondEnergy {
  double stored = 0.0;    ///< in the springs after the step
  double crushed = 0.0;   ///< plastic work: crushing, slip, yielding of bonds
  double damped = 0.0;    ///< taken by dampers
  double released = 0.0;  ///< lost with springs that were let go: bonds that broke or were sintered
};

struct SnowBondResponse {
  Vector3 force = Vector3::Zero();  ///< [N] on i; j has the opposite
  /// [N m] on i beside that of the force; j has the opposite
  Vector3 moment = Vector3::Zero();
  bool broken = false;  ///< in this step
  bool made = false;    ///< in this step
};

/// Crush strength and strength of a whole bond, with their growth.
struct SnowStrength {
  double Fy, dFy;  ///< [N], [N/m] by u_p
  double Fb, dFb;  ///< likewise, for A >= A0
};

/// The law. An energy that is asked for is set.
class SnowBond {
 public:
  static constexpr double bond_radius = 0.2;    ///< of a sintered bond, of d
  static constexpr double least_radius = 0.07;  ///< that resists rolling, of d
  static constexpr double bending_limit = 4.0 / (3.0 * pi);
  static constexpr double torsion_limit = 2.0 / 3.0;

  static double sintered_area(double d) { return pi * bond_radius * bond_radius * d * d; }
  static double stiffness(const SnowBondParameters& law, double d) { return law.E * d; }

  /// Strengths at the crushing X.
  static SnowStrength strength(const SnowBondParameters& law, double d, double X);
  /// At X = 0, where they are least.
  static SnowStrength least_strength(const SnowBondParameters& law, double d);
  /// The part of Fb that the area gives.
  static double bonded_share(const SnowBondState& state, double d) {
    return state.bonded ? std::min(1.0, state.area / sintered_area(d)) : 0.0;
  }

  /// One step.
  static SnowBondResponse advance(const SnowBondParameters& law, const SnowContact& contact,
                                  SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// Forces of a state as it is, without dampers.
  static SnowBondResponse hold(const SnowBondParameters& law, const SnowContact& contact,
                               const SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// A whole bond without stress; where there can be none, a touch without stress.
  static SnowBondResponse sinter(const SnowBondParameters& law, const SnowContact& contact,
                                 SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// The clusters have parted: the state begins anew. @return its energy, which is lost [J]
  static double part(const SnowBondParameters& law, double d, SnowBondState& state);
};

inline SnowBondState SnowBondState::load(const double* values) {
  SnowBondState state;
  state.plastic = values[0];
  state.at_sintering = values[1];
  state.at_break = values[2];
  state.area = values[3];
  state.bonded = values[4] != 0.0;
  state.shear = Eigen::Map<const Vector3>(values + 5);
  state.bending = Eigen::Map<const Vector3>(values + 8);
  state.torsion = values[11];
  return state;
}

inline void SnowBondState::store(double* values) const {
  values[0] = plastic;
  values[1] = at_sintering;
  values[2] = at_break;
  values[3] = area;
  values[4] = bonded ? 1.0 : 0.0;
  Eigen::Map<Vector3>(values + 5) = shear;
  Eigen::Map<Vector3>(values + 8) = bending;
  values[11] = torsion;
}

inline SnowStrength SnowBond::strength(const SnowBondParameters& law, double d, double X) {
  const double soft = law.Y0 * std::exp(law.p * X), dense = law.Y1 * std::exp(law.q * X),
               bond = law.Y0 * std::exp(law.pc * X);
  SnowStrength found;
  found.Fy = d * d * (soft + dense - law.Y1);
  found.dFy = d * (law.p * soft + law.q * dense);
  const double Fb = d * d * bond;
  const bool capped = Fb > found.Fy;
  found.Fb = capped ? found.Fy : Fb;
  found.dFb = capped ? found.dFy : d * law.pc * bond;
  return found;
}

inline SnowStrength SnowBond::least_strength(const SnowBondParameters& law, double d) {
  const double least = d * d * law.Y0;
  return {least, 0.0, least, 0.0};
}

/// One contact in one step, phase by phase.
class SnowBondStep {
 public:
  SnowBondStep(const SnowBondParameters& law, const SnowContact& contact, SnowBondState& state)
      : law_(law),
        contact_(contact),
        state_(state),
        d_(contact.d),
        k_(SnowBond::stiffness(law, d_)) {}

  SnowBondResponse advance(SnowBondEnergy* energy);
  /// In the springs [J].
  double stored(double normal) const;

 private:
  struct Stiffness {
    double bending, torsion;  // [N m/rad]
  };
  struct Elastic {
    double normal;  // [N]
    Vector3 shear;  // [N]
    Vector3 bending;
    double torsion;  // [N m]
  };

  Stiffness of_rotation() const;
  void carry(Vector3& vector) const;
  void make_trial();
  bool certainly_elastic() const;
  double crushing(double normal) const {
    return (state_.plastic + (trial_.normal - normal) / k_ - state_.at_sintering) / d_;
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
  template <class Excess>
  static double solve(double start, Excess&& excess);

  const SnowBondParameters& law_;
  const SnowContact& contact_;
  SnowBondState& state_;
  const double d_, k_;

  Elastic before_, trial_;
  Stiffness rotation_;   // before the step
  SnowStrength strong_;  // in the end at the crushing after the step
  double share_;         // of the bond, before the step
  double squared_shear_;
  double normal_;  // [N] after the step
  // shares of the trial's that are left
  double shear_left_ = 1.0, bending_left_ = 1.0, torsion_left_ = 1.0;
};

inline SnowBondResponse SnowBondStep::advance(SnowBondEnergy* energy) {
  SnowBondResponse response;
  make_trial();
  if (trial_.normal <= 0.0 &&
      (!state_.bonded || -trial_.normal > law_.zeta * share_ * strong_.Fb)) {
    if (energy) energy->released = stored(before_.normal);
    break_bond(response);
    return response;
  }
  slip_and_crush();
  grow(response);
  bend();
  if (energy) {
    energy->crushed = plastic_work();
    energy->stored = stored(normal_);
  }
  damp(response, energy);
  return response;
}

inline SnowBondStep::Stiffness SnowBondStep::of_rotation() const {
  const double squared_radius =
      std::max(state_.area / pi, SnowBond::bond_radius * SnowBond::bond_radius * d_ * d_);
  return {0.25 * k_ * squared_radius, 0.5 * k_ * squared_radius};
}

inline double SnowBondStep::stored(double normal) const {
  const Stiffness rotation = of_rotation();
  return 0.5 * ((normal * normal + state_.shear.squaredNorm()) / k_ +
                state_.bending.squaredNorm() / rotation.bending +
                state_.torsion * state_.torsion / rotation.torsion);
}

/// Turned about the normal, then into the plane across it. To second order of the angle the length
/// stays; it never grows by more than the fourth.
inline void SnowBondStep::carry(Vector3& vector) const {
  const double turn = contact_.spin * contact_.dt;
  vector = (1.0 - 0.5 * turn * turn) * vector + turn * contact_.normal.cross(vector);
  vector -= contact_.normal.dot(vector) * contact_.normal;
}

/// All motion is elastic.
inline void SnowBondStep::make_trial() {
  const double dt = contact_.dt;
  carry(state_.shear);
  carry(state_.bending);
  rotation_ = of_rotation();
  share_ = SnowBond::bonded_share(state_, d_);
  before_ = {k_ * (contact_.overlap + contact_.normal_velocity * dt - state_.plastic), state_.shear,
             state_.bending, state_.torsion};
  const double twist = contact_.rotation.dot(contact_.normal);
  trial_.normal = k_ * (contact_.overlap - state_.plastic);
  trial_.shear = state_.shear - k_ * dt * contact_.tangential_velocity;
  trial_.bending =
      state_.bending - rotation_.bending * dt * (contact_.rotation - twist * contact_.normal);
  trial_.torsion = state_.torsion - rotation_.torsion * dt * twist;
  squared_shear_ = trial_.shear.squaredNorm();
  normal_ = trial_.normal;

  strong_ = SnowBond::least_strength(law_, d_);
  if (!certainly_elastic()) strong_ = SnowBond::strength(law_, d_, crushing(trial_.normal));
  // not beyond the surface, where a change of parameters between runs may have left it
  before_.normal = std::clamp(before_.normal, -law_.zeta * share_ * strong_.Fb, strong_.Fy);
}

/// Within the least strengths: no exponential is needed.
inline bool SnowBondStep::certainly_elastic() const {
  const double tension = -law_.zeta * share_ * strong_.Fb;
  const double shear = law_.chi * share_ * strong_.Fb + law_.mu * std::max(0.0, trial_.normal);
  return trial_.normal > tension && before_.normal > tension && trial_.normal < strong_.Fy &&
         before_.normal < strong_.Fy && squared_shear_ < shear * shear;
}

inline void SnowBondStep::break_bond(SnowBondResponse& response) {
  response.broken = state_.bonded;
  if (state_.bonded) state_.at_break = state_.plastic;
  state_.bonded = false;
  state_.area = state_.torsion = 0.0;
  state_.shear.setZero();
  state_.bending.setZero();
}

/// Newton's method for the root of a growing concave function, from where it is not positive: no
/// iterate passes the root. @param excess of x gives the function and its slope
template <class Excess>
inline double SnowBondStep::solve(double start, Excess&& excess) {
  constexpr int most_iterations = 60;
  constexpr double tolerance = 1e-8;  // of x; the error is of the order of its square
  double x = start;
  for (int n = 0; n < most_iterations; ++n) {
    const auto [value, slope] = excess(x);
    const double change = -value / slope;
    x += change;
    if (!(std::abs(change) > tolerance * x)) break;
  }
  return x;
}

inline void SnowBondStep::slip_and_crush() {
  const double cohesion = law_.chi * share_ * strong_.Fb;
  if (trial_.normal <= 0.0) {
    shear_left_ = share_within(cohesion, squared_shear_);
  } else {
    const double limit = cohesion + law_.mu * trial_.normal;
    if (squared_shear_ > limit * limit) slip();
    if (normal_ > strong_.Fy) crush();
    state_.plastic += (trial_.normal - normal_) / k_;
  }
  state_.shear = shear_left_ * trial_.shear;
}

/// To the shear surface, along the force as far as the strength is cohesion.
inline void SnowBondStep::slip() {
  const double size = std::sqrt(squared_shear_), pressing = trial_.normal;
  const double cohesion = law_.chi * share_ * strong_.Fb;
  if (cohesion <= 0.0) {
    shear_left_ = law_.mu * pressing / size;
    return;
  }
  const double along = cohesion / (cohesion + law_.mu * pressing);
  const double slope = size - law_.mu * along * pressing;
  const auto normal_at = [&](double left) { return pressing * (1.0 - along * (1.0 - left)); };
  const double found =
      solve((cohesion + law_.mu * (1.0 - along) * pressing) / slope, [&](double left) {
        const double normal = normal_at(left);
        strong_ = SnowBond::strength(law_, d_, crushing(normal));
        const double growth = law_.chi * share_ * strong_.dFb * along * pressing / k_;
        return std::pair(left * size - law_.mu * normal - law_.chi * share_ * strong_.Fb,
                         slope + growth);
      });
  shear_left_ = std::min(1.0, found);
  normal_ = normal_at(shear_left_);
}

/// To the crush surface, along the force.
inline void SnowBondStep::crush() {
  const double limit = solve(strong_.Fy, [&](double normal) {
    strong_ = SnowBond::strength(law_, d_, crushing(normal));
    return std::pair(normal - strong_.Fy, 1.0 + strong_.dFy / k_);
  });
  shear_left_ *= limit / normal_;
  normal_ = limit;
}

/// Sintering under pressure.
inline void SnowBondStep::grow(SnowBondResponse& response) {
  if (!contact_.sinters) return;
  const double area = law_.w * 0.25 * pi * d_ * (state_.plastic - state_.at_break);
  if (!(area > state_.area)) return;
  state_.area = area;
  response.made = !state_.bonded;
  state_.bonded = true;
}

/// Moments, against the strength of the bond as it is now.
inline void SnowBondStep::bend() {
  const double squared_radius =
      std::max(state_.area / pi, SnowBond::least_radius * SnowBond::least_radius * d_ * d_);
  const double squared_bending = trial_.bending.squaredNorm(),
               squared_torsion = trial_.torsion * trial_.torsion;
  const auto limits = [&] {
    const double pressing = std::max(0.0, normal_);
    const double Fb = SnowBond::bonded_share(state_, d_) * strong_.Fb;
    return std::pair(SnowBond::bending_limit * (law_.zeta * Fb + pressing),
                     SnowBond::torsion_limit * (law_.chi * Fb + law_.mu * pressing));
  };
  const auto within = [&](const std::pair<double, double>& limit) {
    return squared_bending <= limit.first * limit.first * squared_radius &&
           squared_torsion <= limit.second * limit.second * squared_radius;
  };
  if (!within(limits())) {
    strong_ = SnowBond::strength(law_, d_, (state_.plastic - state_.at_sintering) / d_);
    const double radius = std::sqrt(squared_radius);
    const auto [bending, torsion] = limits();
    bending_left_ = share_within(bending * radius, squared_bending);
    torsion_left_ = share_within(torsion * radius, squared_torsion);
  }
  state_.bending = bending_left_ * trial_.bending;
  state_.torsion = torsion_left_ * trial_.torsion;
}

/// Force after the return times plastic displacement, and what a bond that grows holds less.
inline double SnowBondStep::plastic_work() const {
  const auto lost = [](double left) { return left > 0.0 ? 1.0 / left - 1.0 : 0.0; };
  const double bending = state_.bending.squaredNorm() / rotation_.bending,
               torsion = state_.torsion * state_.torsion / rotation_.torsion;
  return (normal_ * (trial_.normal - normal_) +
          shear_left_ * (1.0 - shear_left_) * squared_shear_) /
             k_ +
         bending * lost(bending_left_) + torsion * lost(torsion_left_) +
         0.5 * (bending + torsion) * (1.0 - rotation_.bending / of_rotation().bending);
}

/// Dampers; those of a dry contact neither pull nor overcome friction.
inline void SnowBondStep::damp(SnowBondResponse& response, SnowBondEnergy* energy) const {
  const double relaxation = 2.0 * law_.damping * std::sqrt(contact_.mass / k_) / contact_.dt;
  double normal = relaxation * (normal_ - before_.normal);
  Vector3 shear = 0.5 * relaxation * (state_.shear - before_.shear);
  if (!state_.bonded) {
    normal = std::max(normal, -normal_);
    const Vector3 all = state_.shear + shear;
    shear = share_within(law_.mu * (normal_ + normal), all.squaredNorm()) * all - state_.shear;
  }
  const Vector3 moment =
      0.5 * relaxation *
      (state_.bending - before_.bending + (state_.torsion - before_.torsion) * contact_.normal);
  if (energy)
    energy->damped =
        -contact_.dt * (normal * contact_.normal_velocity +
                        shear.dot(contact_.tangential_velocity) + moment.dot(contact_.rotation));
  response.force = (normal_ + normal) * contact_.normal + state_.shear + shear;
  response.moment = state_.bending + state_.torsion * contact_.normal + moment;
}

inline SnowBondResponse SnowBond::advance(const SnowBondParameters& law, const SnowContact& contact,
                                          SnowBondState& state, SnowBondEnergy* energy) {
  if (energy) *energy = {};
  return SnowBondStep(law, contact, state).advance(energy);
}

inline SnowBondResponse SnowBond::hold(const SnowBondParameters& law, const SnowContact& contact,
                                       const SnowBondState& state, SnowBondEnergy* energy) {
  double normal = stiffness(law, contact.d) * (contact.overlap - state.plastic);
  if (!state.bonded) normal = std::max(0.0, normal);
  SnowBondResponse response;
  response.force = normal * contact.normal + state.shear;
  response.moment = state.bending + state.torsion * contact.normal;
  if (energy) {
    SnowBondState same = state;
    *energy = {};
    energy->stored = SnowBondStep(law, contact, same).stored(normal);
  }
  return response;
}

inline SnowBondResponse SnowBond::sinter(const SnowBondParameters& law, const SnowContact& contact,
                                         SnowBondState& state, SnowBondEnergy* energy) {
  SnowBondResponse response;
  response.made = contact.sinters && !state.bonded;
  if (energy) {
    hold(law, contact, state, energy);
    energy->released = std::exchange(energy->stored, 0.0);
  }
  state = {};
  state.plastic = state.at_sintering = state.at_break = contact.overlap;
  state.area = contact.sinters ? sintered_area(contact.d) : 0.0;
  state.bonded = contact.sinters;
  return response;
}

inline double SnowBond::part(const SnowBondParameters& law, double d, SnowBondState& state) {
  SnowContact apart = {};
  apart.d = d;
  SnowBondEnergy energy;
  hold(law, apart, state, &energy);
  state = {};
  return energy.stored;
}

}  // namespace furrow
