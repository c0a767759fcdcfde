// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Soil cards, as furrow-post card make writes them: parameters of the soil contact model.

#include <limits>
#include <map>
#include <string>

#include "material/ground_contact.h"

namespace furrow {

struct SoilCard {
  /// By the names k_c, k_phi, n, c, phi [degrees], K and stiffness; SI units.
  std::map<std::string, double> values;
  GroundContact contact;
  double gravity = 0.0;  ///< [m/s^2] of the tests, where alone the values hold
  // where the plates were tested; without limits where the card has none
  double deepest = std::numeric_limits<double>::infinity();           ///< sinkage [m]
  double largest_pressure = std::numeric_limits<double>::infinity();  ///< [Pa]
};

/// @throws InputError naming file and line
SoilCard read_soil_card(const std::string& path);

}  // namespace furrow
