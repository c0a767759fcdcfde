// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Input, state and response of a contact of snow_bond.h.

#include <algorithm>
#include <cmath>

#include "furrow/core/types.h"
#include "furrow/grains/snow_bond_parameters.h"
#include "furrow/grains/two_vectors.h"

namespace furrow {

/// Positions of two clusters at the end of a leapfrog step and velocities at its middle. A plane
/// wall is half of a contact of two equal clusters: 2 times its overlap and relative velocities, d
/// = 2 R, half of the mass. Energies are then 2 times those of the wall.
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
  bool sinters = true;          ///< false for a contact with another material than snow
};

/// Growth of the strengths with the crushing: exp(p X) - 1, exp(q X) - 1, exp(pc X) - 1.
struct SnowHardening {
  double soft = 0.0, dense = 0.0, bond = 0.0;

  static SnowHardening at(const SnowBondParameters& law, double X);
  /// True if it is the hardening at X, up to rounding in the steps of its growth.
  bool is_at(const SnowBondParameters& law, double X) const;
};

/// Growth of a hardening with X; small growth needs no exponential.
class SnowGrowth {
  using Four [[gnu::vector_size(32)]] = double;  // soft, dense, bond, bond again

 public:
  /// @param unit  that X grows in
  SnowGrowth(const SnowBondParameters& law, const SnowHardening& start, double unit)
      : start_{start.soft, start.dense, start.bond, start.bond},
        exponents_(Four{law.p, law.q, law.pc, law.pc} * unit),
        largest_(std::max(std::max(law.p, law.q), law.pc) * unit) {}
  /// @param units  that X has grown by
  SnowHardening after(double units) const;

 private:
  Four start_, exponents_;
  double largest_;
};

/// State of a contact; all zero before the first touch.
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
  /// Stores only the values that an elastic step changes.
  void store_elastic(double* values) const;
};

/// Energies of a step of a contact [J].
struct SnowBondEnergy {
  double stored = 0.0;    ///< in the springs after the step
  double crushed = 0.0;   ///< plastic work: crushing, slip, yielding of bonds
  double damped = 0.0;    ///< dissipated by dampers
  double released = 0.0;  ///< lost with the springs of bonds that broke or were sintered
};

struct SnowBondResponse {
  Vector3 force = Vector3::Zero();  ///< [N] on i; j has the opposite
  /// moment on i in addition to that of the force [N m]; j has the opposite
  Vector3 moment = Vector3::Zero();
  bool broken = false;  ///< in this step
  bool made = false;    ///< in this step
};

inline SnowHardening SnowHardening::at(const SnowBondParameters& law, double X) {
  return {std::exp(law.p * X) - 1.0, std::exp(law.q * X) - 1.0, std::exp(law.pc * X) - 1.0};
}

inline bool SnowHardening::is_at(const SnowBondParameters& law, double X) const {
  constexpr double rounding = 1e-9;
  const SnowHardening exact = at(law, X);
  const auto same = [](double a, double b) { return std::abs(a - b) <= rounding * (1.0 + b); };
  return same(soft, exact.soft) && same(dense, exact.dense) && same(bond, exact.bond);
}

inline SnowHardening SnowGrowth::after(double units) const {
  constexpr double small = 1.0 / 32.0;  // of the exponent: the series is then right to 1e-14
  const Four x = exponents_ * units, square = x * x;
  Four growth = x + square * (1.0 / 2 + x * (1.0 / 6) +
                              square * (1.0 / 24 + x * (1.0 / 120) + square * (1.0 / 720)));
  if (!(std::abs(largest_ * units) < small))
    for (int k = 0; k < 3; ++k) growth[k] = std::expm1(x[k]);
  const Four grown = start_ + (1.0 + start_) * growth;
  return {grown[0], grown[1], grown[2]};
}

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

}  // namespace furrow
