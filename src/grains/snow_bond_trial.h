// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The elastic step of snow_bond.h.

#include <algorithm>
#include <cmath>

#include "furrow/grains/snow_bond_law.h"

namespace furrow {

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

/// Turns the stored vectors about the normal, then into the plane normal to it. Their length is
/// constant to second order in the angle and never grows by more than the fourth.
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

/// Forces of elastic motion. The dampers act on velocities, c v.
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

}  // namespace furrow
