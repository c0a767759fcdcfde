// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Bekker's and Janosi's parameters of a soil (theory: scm, eqs. 1 and 4).

#include <map>
#include <string>
#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/options/options.h"
#include "furrow/core/types.h"

namespace furrow {

/// Pressure p = (k_c/b + k_phi) z^n; shear stress (c + p tan(phi)) (1 - exp(-j/K)).
struct Soil {
  double k_c = 0.0;             ///< [N/m^(n+1)]
  double k_phi = 0.0;           ///< [N/m^(n+2)]
  double n = 1.0;               ///< exponent of the sinkage
  double cohesion = 0.0;        ///< [Pa]
  double friction_angle = 0.0;  ///< [rad]
  double shear_length = 0.01;   ///< K [m]
  double stiffness = 1e8;       ///< [Pa/m] pressure per elastic sinkage
  double damping = 0.0;         ///< [Pa s/m] pressure per velocity of the sinkage
  double flow = 0.0;            ///< share of the displaced volume that moves to the sides

  /// Modulus under a contact of this width [m] [Pa/m^n]. @throws StateError unless it is positive
  double modulus(double width) const;
  /// Compares all parameters with the saved ones. @throws Error
  void match(Checkpoint& state) const;
};

/// Soils side by side: each from a place on, along x or along y.
class SoilPatches {
 public:
  SoilPatches(const Soil& soil) : soils_{soil} {}  // NOLINT(google-explicit-constructor): one soil
  /// @param begin [m] on the axis, larger than those before
  void add(int axis, double begin, const Soil& soil);

  const Soil& at(const Vector2& place) const;
  const std::vector<Soil>& all() const { return soils_; }
  /// Compares all parameters and places with the saved ones. @throws Error
  void match(Checkpoint& state) const;

 private:
  int axis_ = 0;
  std::vector<double> begins_;  // of all soils but the first [m]
  std::vector<Soil> soils_;
};

/// The keys of a soil; angles in degrees.
void declare_soil(Schema& schema);
/// @param card  values by the same keys, for those that are not given
/// @throws InputError for a key that neither has, and for values that no soil has
Soil soil_from(const Options& options, const std::map<std::string, double>& card = {});
/// A soil of a card alone; stiffness, damping and flow of the line where the card has none.
Soil soil_of_card(const Options& options, const std::map<std::string, double>& card);
/// @throws InputError for values out of range @param where names the soil
void check(const Soil& soil, const std::string& where);
/// Warnings of values that are unusual for soils, a sentence each.
std::vector<std::string> plausibility_warnings(const Soil& soil);

}  // namespace furrow
