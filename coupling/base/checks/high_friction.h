// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Coefficients of friction that are probably an angle or a percentage.

#include <string>

#include <fmt/format.h>

namespace furrow::coupling {

inline bool is_high_friction(double coefficient) { return coefficient > 1.5; }

inline std::string high_friction(const std::string& where, double coefficient) {
  return fmt::format(
      "{} is {:g}, a coefficient, neither degrees nor percent; rubber on a dry road "
      "has about 1",
      where, coefficient);
}

}  // namespace furrow::coupling
