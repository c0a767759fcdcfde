// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Contact of a ground with the material of a wheel, tyre or tool: what a material file, a soil
/// card or a bed of grains says about it.

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace furrow {

/// Friction tau = min(mu sigma, shear_limit) (1 - exp(-j/k)) of the ground with one material of a
/// body.
struct BodyContact {
  double friction = 0.0;                                         ///< mu
  double slip_length = 0.0;                                      ///< k [m]
  std::array<double, 2> friction_range = {0.0, 0.0};             ///< within which mu lies
  std::array<double, 2> slip_length_range = {0.0, 0.0};          ///< [m]
  double shear_limit = std::numeric_limits<double>::infinity();  ///< of clay: adhesion [Pa]
  std::array<double, 2> shear_limit_range = {0.0, 0.0};          ///< [Pa]
  std::string label;                                             ///< measured, estimated or assumed
  std::string source;
};

/// Contact by the name of the body's material; empty where nothing is known.
using GroundContact = std::map<std::string, BodyContact>;

/// The materials of bodies that a ground can name.
inline const std::vector<std::string>& body_materials() {
  static const std::vector<std::string> names = {"steel", "rubber"};
  return names;
}

}  // namespace furrow
