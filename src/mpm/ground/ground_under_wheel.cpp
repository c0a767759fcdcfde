// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/mpm/ground/ground_under_wheel.h"

#include <algorithm>
#include <cmath>

namespace furrow {

double rounded_up(double value) {
  constexpr double round_off = 1e-9;
  const double digits = std::pow(10.0, 1.0 - std::floor(std::log10(value)));
  return std::ceil(value * digits - round_off) / digits;
}

GroundSize ground_under_wheel(double radius, double width, double depth) {
  const double sunk = std::min(depth, radius);
  const double half_chord = std::sqrt(sunk * (2.0 * radius - sunk));
  return {rounded_up(2.0 * (half_chord + depth)), rounded_up(width + 2.0 * depth),
          rounded_up(width + 0.5 * depth)};
}

}  // namespace furrow
