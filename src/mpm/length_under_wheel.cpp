// SPDX-License-Identifier: GPL-2.0-or-later
#include "mpm/length_under_wheel.h"

#include <algorithm>
#include <cmath>

namespace furrow {

double length_under_wheel(double radius, double depth) {
  constexpr double round_off = 1e-9;
  const double sunk = std::min(depth, radius);
  const double length = 2.0 * (std::sqrt(sunk * (2.0 * radius - sunk)) + depth);
  const double digits = std::pow(10.0, 1.0 - std::floor(std::log10(length)));
  return std::ceil(length * digits - round_off) / digits;
}

}  // namespace furrow
