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
#include "grains/two_vectors.h"

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

/// How far strengths have grown with the crushing: exp(p X) - 1, exp(q X) - 1, exp(pc X) - 1.
struct SnowHardening {
  double soft = 0.0, dense = 0.0, bond = 0.0;

  static SnowHardening at(const SnowBondParameters& law, double X);
  /// When X has grown by dX; for small dX without an exponential.
  SnowHardening after(const SnowBondParameters& law, double dX) const;
};

/// What a contact remembers; all zero before the first touch.
struct SnowBondState {
  static constexpr int size = 15;  ///< values of load() and store()

  double plastic = 0.0;       ///< u_p [m]
  double at_sintering = 0.0;  ///< u_0 [m]
  double at_break = 0.0;      ///< u_b [m]
  double area = 0.0;          ///< A [m^2]
  bool bonded = false;
  TwoVectors across = {};        ///< elastic force [N] and moment [N m] on i across the normal
  double torsion = 0.0;          ///< [N m] along the normal
  SnowHardening hardening = {};  ///< at X, which elastic steps do not change

  double crushing(double d) const { return (plastic - at_sintering) / d; }  ///< X
  static SnowBondState load(const double* values);
  void store(double* values) const;
  /// What an elastic step changes.
  void store_elastic(double* values) const;
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

struct SnowBondTrial;

/// The law. An energy that is asked for is set.
class SnowBond {
 public:
  static constexpr double bond_radius = 0.2;    ///< of a sintered bond, of d
  static constexpr double least_radius = 0.07;  ///< that resists rolling, of d
  static constexpr double bending_limit = 4.0 / (3.0 * pi);
  static constexpr double torsion_limit = 2.0 / 3.0;

  static constexpr double sintered_area(double d) { return pi * bond_radius * bond_radius * d * d; }
  static double stiffness(const SnowBondParameters& law, double d) { return law.E * d; }

  static SnowStrength strength(const SnowBondParameters& law, double d,
                               const SnowHardening& hardening);
  /// The part of Fb that the area of a bond gives, times d^2.
  static double bonded_square(const SnowBondState& state, double d) {
    return std::min(d * d, state.area * (1.0 / sintered_area(1.0)));
  }
  /// The part of Fb that the area gives.
  static double bonded_share(const SnowBondState& state, double d) {
    return state.bonded ? bonded_square(state, d) / (d * d) : 0.0;
  }

  /// One step.
  static SnowBondResponse advance(const SnowBondParameters& law, const SnowContact& contact,
                                  SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// Its two parts, for programs whose time it takes, from the trial of the state: an elastic step,
  /// which most are ... @return false: it is not elastic, and nothing is changed
  static bool advance_elastic(const SnowBondParameters& law, const SnowContact& contact,
                              const SnowBondTrial& trial, SnowBondState& state,
                              SnowBondResponse& response, SnowBondEnergy* energy);
  /// ... and one of a contact that yields, breaks, sinters or is dry.
  static SnowBondResponse advance_yielding(const SnowBondParameters& law,
                                           const SnowContact& contact, const SnowBondTrial& trial,
                                           SnowBondState& state, SnowBondEnergy* energy);
  /// Forces of a state as it is, without dampers.
  static SnowBondResponse hold(const SnowBondParameters& law, const SnowContact& contact,
                               const SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// A whole bond without stress; where there can be none, a touch without stress.
  static SnowBondResponse sinter(const SnowBondParameters& law, const SnowContact& contact,
                                 SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// In the springs [J]. @param normal  [N]
  static double stored(const SnowBondParameters& law, double d, const SnowBondState& state,
                       double normal);
  /// Of a bond, by sintering under pressure.
  static double sintering_area(const SnowBondParameters& law, double d,
                               const SnowBondState& state) {
    return law.w * 0.25 * pi * d * (state.plastic - state.at_break);
  }
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
  state.across = TwoVectors::load(values + 5);
  state.torsion = values[11];
  state.hardening = {values[12], values[13], values[14]};
  return state;
}

inline void SnowBondState::store(double* values) const {
  values[0] = plastic;
  values[1] = at_sintering;
  values[2] = at_break;
  values[3] = area;
  values[4] = bonded ? 1.0 : 0.0;
  store_elastic(values);
  values[12] = hardening.soft;
  values[13] = hardening.dense;
  values[14] = hardening.bond;
}

inline void SnowBondState::store_elastic(double* values) const {
  across.store(values + 5);
  values[11] = torsion;
}

inline SnowHardening SnowHardening::at(const SnowBondParameters& law, double X) {
  return {std::exp(law.p * X) - 1.0, std::exp(law.q * X) - 1.0, std::exp(law.pc * X) - 1.0};
}

inline SnowHardening SnowHardening::after(const SnowBondParameters& law, double dX) const {
  using Four [[gnu::vector_size(32)]] = double;
  constexpr double small = 1.0 / 32.0;  // of the exponent: the series is then right to 1e-14
  const Four value = {soft, dense, bond, bond};
  const Four x = Four{law.p, law.q, law.pc, law.pc} * dX;
  Four growth =
      x + x * x * (1.0 / 2 + x * (1.0 / 6 + x * (1.0 / 24 + x * (1.0 / 120 + x * (1.0 / 720)))));
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(x[k]) < small)) growth[k] = std::expm1(x[k]);
  const Four grown = value + (1.0 + value) * growth;
  return {grown[0], grown[1], grown[2]};
}

inline SnowStrength SnowBond::strength(const SnowBondParameters& law, double d,
                                       const SnowHardening& hardening) {
  const double soft = law.Y0 * (1.0 + hardening.soft), dense = law.Y1 * hardening.dense,
               bond = law.Y0 * (1.0 + hardening.bond);
  SnowStrength found;
  found.Fy = d * d * (soft + dense);
  found.dFy = d * (law.p * soft + law.q * (dense + law.Y1));
  const double Fb = d * d * bond;
  const bool capped = Fb > found.Fy;
  found.Fb = capped ? found.Fy : Fb;
  found.dFb = capped ? found.dFy : d * law.pc * bond;
  return found;
}

/// A contact after the motion of a step, all of it elastic.
struct SnowBondTrial {
  SnowBondTrial(const SnowBondParameters& law, const SnowContact& contact,
                const SnowBondState& state);

  /// Nothing yields, breaks or grows in the step.
  bool is_elastic(const SnowBondParameters& law, const SnowContact& contact,
                  const SnowBondState& state) const;
  /// Is it within the surfaces of these strengths? @param bond  Fb
  bool is_within(const SnowBondParameters& law, double Fy, double bond,
                 double squared_radius) const;
  SnowBondResponse response(const SnowBondParameters& law, const SnowContact& contact,
                            SnowBondEnergy* energy) const;

  double k;                      // [N/m]
  double squared_radius;         // a_s^2
  double normal_before, normal;  // [N]
  TwoVectors before, across;     // [N], [N m]
  TwoVectors rates;              // [m/s], [rad/s] across the normal
  Two squared;                   // of across
  double twist;                  // [rad/s]
  double torsion;                // [N m]

  double bending_stiffness() const { return 0.25 * k * squared_radius; }
  double torsion_stiffness() const { return 0.5 * k * squared_radius; }
  double stored() const {
    return 0.5 * ((normal * normal + squared[0]) / k + squared[1] / bending_stiffness() +
                  torsion * torsion / torsion_stiffness());
  }
};

/// a_s^2
inline double squared_stiffness_radius(double area, double d) {
  return std::max(area * (1.0 / pi), SnowBond::bond_radius * SnowBond::bond_radius * (d * d));
}

/// a^2
inline double squared_strength_radius(double area, double d) {
  return std::max(area * (1.0 / pi), SnowBond::least_radius * SnowBond::least_radius * (d * d));
}

/// What the state holds is turned about the normal, then into the plane across it: to second order
/// of the angle the length stays; it never grows by more than the fourth.
inline SnowBondTrial::SnowBondTrial(const SnowBondParameters& law, const SnowContact& contact,
                                    const SnowBondState& state)
    : k(SnowBond::stiffness(law, contact.d)),
      squared_radius(squared_stiffness_radius(state.area, contact.d)) {
  const Vector3& n = contact.normal;
  const double dt = contact.dt, turn = contact.spin * dt;
  before = (1.0 - 0.5 * turn * turn) * (state.across - times(dot(n, state.across), n)) +
           cross(turn * n, state.across);
  const TwoVectors all_rates = TwoVectors::of(contact.tangential_velocity, contact.rotation);
  const Two along = dot(n, all_rates);
  rates = all_rates - times(along, n);
  twist = along[1];
  across = before - Two{k * dt, bending_stiffness() * dt} * rates;
  squared = across.squared();
  torsion = state.torsion - torsion_stiffness() * dt * twist;
  normal = k * (contact.overlap - state.plastic);
  normal_before = normal + k * contact.normal_velocity * dt;
}

inline bool SnowBondTrial::is_within(const SnowBondParameters& law, double Fy, double bond,
                                     double radius_squared) const {
  constexpr double bent = SnowBond::bending_limit * SnowBond::bending_limit,
                   twisted = SnowBond::torsion_limit * SnowBond::torsion_limit;
  const double pressing = std::max(0.0, normal), tension = law.zeta * bond;
  const double shear = law.chi * bond + law.mu * pressing, shear_squared = shear * shear;
  const double bending = tension + pressing;
  return std::min(normal, normal_before) > -tension && std::max(normal, normal_before) < Fy &&
         squared[0] < shear_squared && squared[1] <= bent * radius_squared * (bending * bending) &&
         torsion * torsion <= twisted * radius_squared * shear_squared;
}

/// Most contacts are within the strengths that they had when they were sintered.
inline bool SnowBondTrial::is_elastic(const SnowBondParameters& law, const SnowContact& contact,
                                      const SnowBondState& state) const {
  if (!state.bonded) return false;
  const double d = contact.d;
  const double bonded = SnowBond::bonded_square(state, d),
               radius_squared = squared_strength_radius(state.area, d);
  if (is_within(law, law.Y0 * (d * d), law.Y0 * bonded, radius_squared)) return true;
  if (state.hardening.bond == 0.0) return false;
  const SnowStrength now = SnowBond::strength(law, d, state.hardening);
  return is_within(law, now.Fy, SnowBond::bonded_share(state, d) * now.Fb, radius_squared);
}

/// Of elastic motion: dampers are those of velocities, c v.
inline SnowBondResponse SnowBondTrial::response(const SnowBondParameters& law,
                                                const SnowContact& contact,
                                                SnowBondEnergy* energy) const {
  const double c = 2.0 * law.damping * std::sqrt(contact.mass * k);
  const Two damping = {0.5 * c, 0.125 * c * squared_radius};  // of torsion: twice that of bending
  const Two out = {normal - c * contact.normal_velocity, torsion - 2.0 * damping[1] * twist};
  const TwoVectors all = across - damping * rates + times(out, contact.normal);
  SnowBondResponse response;
  response.force = all.first();
  response.moment = all.second();
  if (energy) {
    const Two slip = damping * rates.squared();
    *energy = {};
    energy->stored = stored();
    energy->damped = contact.dt * (c * contact.normal_velocity * contact.normal_velocity + slip[0] +
                                   slip[1] + 2.0 * damping[1] * twist * twist);
  }
  return response;
}

/// A step in which a contact yields, breaks, sinters or is dry, phase by phase.
class SnowBondStep {
 public:
  SnowBondStep(const SnowBondParameters& law, const SnowContact& contact,
               const SnowBondTrial& trial, SnowBondState& state)
      : law_(law), contact_(contact), state_(state), trial_(trial), d_(contact.d), k_(trial.k) {}

  SnowBondResponse advance(SnowBondEnergy* energy);

 private:
  /// Where this normal force is left.
  SnowStrength strength(double normal) const {
    return SnowBond::strength(law_, d_,
                              state_.hardening.after(law_, (trial_.normal - normal) / (k_ * d_)));
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

  SnowStrength strong_;    // in the end at the crushing after the step
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

/// Newton's method for the root of a growing concave function, from above: the first step lands
/// below it, and no other passes it. @param there  the excess at the start
template <class Function>
inline double SnowBondStep::solve(double start, Excess there, Function&& excess) {
  constexpr int most_iterations = 60;
  constexpr double tolerance = 1e-6;  // of x; the error is of the order of its square
  double x = start - there.value / there.slope;
  for (int n = 0; n < most_iterations; ++n) {
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
      state_.plastic += (trial_.normal - normal_) / k_;
      state_.hardening = SnowHardening::at(law_, state_.crushing(d_));
    }
  }
}

/// To the shear surface, along the force as far as the strength is cohesion.
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
    const double weakening = law_.chi * share_ * strong_.dFb * along * pressing / k_;
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

/// To the crush surface, along the force.
inline void SnowBondStep::crush() {
  const auto excess = [&](double normal) {
    return Excess{normal - strong_.Fy, 1.0 + strong_.dFy / k_};
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

/// Moments, against the strength of the bond as it is now.
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

/// Force after the return times plastic displacement, and what a bond that grows holds less.
inline double SnowBondStep::plastic_work() const {
  const auto lost = [](double left) { return left > 0.0 ? 1.0 / left - 1.0 : 0.0; };
  const double bending = state_.across.second().squaredNorm() / trial_.bending_stiffness(),
               torsion = state_.torsion * state_.torsion / trial_.torsion_stiffness();
  return (normal_ * (trial_.normal - normal_) +
          shear_left_ * (1.0 - shear_left_) * trial_.squared[0]) /
             k_ +
         bending * lost(bending_left_) + torsion * lost(torsion_left_) +
         0.5 * (bending + torsion) *
             (1.0 - trial_.squared_radius / squared_stiffness_radius(state_.area, d_));
}

/// Dampers; those of a dry contact neither pull nor overcome friction.
inline void SnowBondStep::damp(SnowBondResponse& response, SnowBondEnergy* energy) const {
  const double relaxation = 2.0 * law_.damping * std::sqrt(contact_.mass / k_) / contact_.dt;
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

inline double SnowBond::stored(const SnowBondParameters& law, double d, const SnowBondState& state,
                               double normal) {
  const double k = stiffness(law, d), squared_radius = squared_stiffness_radius(state.area, d);
  return 0.5 / k *
         (normal * normal + state.across.first().squaredNorm() +
          (4.0 * state.across.second().squaredNorm() + 2.0 * state.torsion * state.torsion) /
              squared_radius);
}

inline bool SnowBond::advance_elastic(const SnowBondParameters& law, const SnowContact& contact,
                                      const SnowBondTrial& trial, SnowBondState& state,
                                      SnowBondResponse& response, SnowBondEnergy* energy) {
  if (!trial.is_elastic(law, contact, state)) return false;
  state.across = trial.across;
  state.torsion = trial.torsion;
  response = trial.response(law, contact, energy);
  return true;
}

inline SnowBondResponse SnowBond::advance(const SnowBondParameters& law, const SnowContact& contact,
                                          SnowBondState& state, SnowBondEnergy* energy) {
  const SnowBondTrial trial(law, contact, state);
  SnowBondResponse response;
  if (advance_elastic(law, contact, trial, state, response, energy)) return response;
  return advance_yielding(law, contact, trial, state, energy);
}

inline SnowBondResponse SnowBond::advance_yielding(const SnowBondParameters& law,
                                                   const SnowContact& contact,
                                                   const SnowBondTrial& trial, SnowBondState& state,
                                                   SnowBondEnergy* energy) {
  if (energy) *energy = {};
  return SnowBondStep(law, contact, trial, state).advance(energy);
}

inline SnowBondResponse SnowBond::hold(const SnowBondParameters& law, const SnowContact& contact,
                                       const SnowBondState& state, SnowBondEnergy* energy) {
  double normal = stiffness(law, contact.d) * (contact.overlap - state.plastic);
  if (!state.bonded) normal = std::max(0.0, normal);
  SnowBondResponse response;
  response.force = normal * contact.normal + state.across.first();
  response.moment = state.across.second() + state.torsion * contact.normal;
  if (energy) {
    *energy = {};
    energy->stored = stored(law, contact.d, state, normal);
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
