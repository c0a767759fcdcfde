// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Strengths, stiffness and operations of a contact of snow_bond.h.

#include <algorithm>

#include "furrow/grains/snow_bond_state.h"

namespace furrow {

/// Crush strength and strength of a whole bond, with their growth.
struct SnowStrength {
  double Fy, dFy;  ///< [N], [N/m] by u_p
  double Fb, dFb;  ///< likewise, for A >= A0
};

struct SnowBondTrial;

/// Law of a contact of sintered snow. Functions set the energy if its pointer is not null.
class SnowBond {
 public:
  static constexpr double bond_radius = 0.2;  ///< of a sintered bond, of d
  static constexpr double minimum_radius =
      0.07;  ///< least radius of the rolling resistance, over d
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

  /// Advances a contact by one step.
  static SnowBondResponse advance(const SnowBondParameters& law, const SnowContact& contact,
                                  SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// Advances a contact by an elastic step, from the trial of the state, as advance(): most are.
  /// @return false: the step is not elastic, and nothing is changed
  static bool advance_elastic(const SnowBondParameters& law, const SnowContact& contact,
                              const SnowBondTrial& trial, SnowBondState& state,
                              SnowBondResponse& response, SnowBondEnergy* energy);
  /// Advances a contact that yields, breaks, sinters or is dry, by a step.
  static SnowBondResponse advance_yielding(const SnowBondParameters& law,
                                           const SnowContact& contact, const SnowBondTrial& trial,
                                           SnowBondState& state, SnowBondEnergy* energy);
  /// Forces of a contact whose state stays as it is, without dampers.
  static SnowBondResponse hold(const SnowBondParameters& law, const SnowContact& contact,
                               const SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// Makes a whole bond without stress or, if the contact cannot sinter, a touch without stress.
  static SnowBondResponse sinter(const SnowBondParameters& law, const SnowContact& contact,
                                 SnowBondState& state, SnowBondEnergy* energy = nullptr);
  /// Energy in the springs of a contact [J]. @param normal  [N]
  static double stored(const SnowBondParameters& law, double d, const SnowBondState& state,
                       double normal);
  /// Area of a bond by sintering under pressure [m^2].
  static double sintering_area(const SnowBondParameters& law, double d,
                               const SnowBondState& state) {
    return law.w * 0.25 * pi * d * (state.plastic - state.at_break);
  }
  /// Resets the state after the clusters have parted. @return its energy, which is lost [J]
  static double part(const SnowBondParameters& law, double d, SnowBondState& state);
};

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

/// Square of the radius a_s that gives the bending stiffness.
inline double squared_stiffness_radius(double area, double d) {
  return std::max(area * (1.0 / pi), SnowBond::bond_radius * SnowBond::bond_radius * (d * d));
}

/// Square of the radius a that gives the bending strength.
inline double squared_strength_radius(double area, double d) {
  return std::max(area * (1.0 / pi), SnowBond::minimum_radius * SnowBond::minimum_radius * (d * d));
}

inline double SnowBond::stored(const SnowBondParameters& law, double d, const SnowBondState& state,
                               double normal) {
  const double k = stiffness(law, d), squared_radius = squared_stiffness_radius(state.area, d);
  return 0.5 / k *
         (normal * normal + state.across.first().squaredNorm() +
          (4.0 * state.across.second().squaredNorm() + 2.0 * state.torsion * state.torsion) /
              squared_radius);
}

}  // namespace furrow
