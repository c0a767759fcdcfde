// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/geometry/meshes/wheel_circumference.h"

#include <algorithm>
#include <cmath>

namespace furrow {

namespace {

constexpr int passes = 20;  // of the iteration for width of the bars and node radius

/// Radius of the nodes that gives their polygon the area of the circle: R'^2 sum of sin(step) / 2 =
/// pi R^2.
double equal_area_radius(const std::vector<double>& angles, double radius) {
  double sines = 0.0;
  for (std::size_t i = 0; i < angles.size(); ++i)
    sines += std::sin((i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2.0 * pi) - angles[i]);
  return radius * std::sqrt(2.0 * pi / sines);
}

}  // namespace

int parts(double length, double size) {
  return std::max(1, static_cast<int>(std::ceil(length / size - 1e-9)));
}

bool WheelCircumference::under_bar(int column) const {
  return std::any_of(bars.begin(), bars.end(),
                     [&](const Bar& bar) { return column >= bar.first && column < bar.last; });
}

WheelCircumference plain_circumference(const WheelGeometry& wheel) {
  WheelCircumference around;
  for (int i = 0; i < wheel.segments; ++i) around.angles.push_back(2.0 * pi * i / wheel.segments);
  around.node_radius = equal_area_radius(around.angles, wheel.radius());
  return around;
}

// A bar is as wide as the chord between its edges, which depends on the node radius: both are found
// by a few passes.
WheelCircumference grouser_circumference(const WheelGeometry& wheel, double size) {
  const Grousers& bars = wheel.grousers;
  const double chord = bars.thickness / std::cos(bars.angle);
  const double pitch = 2.0 * pi / bars.number;
  WheelCircumference around;
  around.node_radius = wheel.radius();
  for (int pass = 0; pass < passes; ++pass) {
    const double half = std::asin(0.5 * chord / around.node_radius);
    const double gap = pitch - 2.0 * half;
    const int bar_parts = parts(chord, size);
    const int gap_parts = parts(gap * wheel.radius(), size);
    around.angles.clear();
    around.bars.clear();
    for (int bar = 0; bar < bars.number; ++bar) {
      const double centre = bar * pitch;
      const int first = around.columns();
      for (int i = 0; i < bar_parts; ++i)
        around.angles.push_back(centre - half + 2.0 * half * i / bar_parts);
      around.bars.push_back({first, around.columns(), centre});
      for (int i = 0; i < gap_parts; ++i)
        around.angles.push_back(centre + half + gap * i / gap_parts);
    }
    around.node_radius = equal_area_radius(around.angles, wheel.radius());
  }
  return around;
}

}  // namespace furrow
