// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Soil cards: parameters of the soil contact model, as furrow-post card make writes them, as a
/// person writes them in other units, or as Chrono's SCM has them in JSON.

#include <limits>
#include <map>
#include <optional>
#include <string>

#include "furrow/material/ground_contact.h"

namespace furrow {

struct SoilCard {
  /// Values by the names k_c, k_phi, n, c, phi [degrees], K, stiffness and damping; SI units.
  std::map<std::string, double> values;
  GroundContact contact;
  std::optional<double> gravity;  ///< [m/s^2] of the tests, where alone the values hold
  // Limits of the plate tests; infinite where the card has none.
  double deepest = std::numeric_limits<double>::infinity();           ///< sinkage [m]
  double largest_pressure = std::numeric_limits<double>::infinity();  ///< [Pa]
};

/// @throws InputError naming file and line
SoilCard read_soil_card(const std::string& path);

}  // namespace furrow
