// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The division of a wheel's circumference into segments, of which some carry grousers.

#include <vector>

#include "furrow/geometry/meshes/wheel_geometry.h"

namespace furrow {

/// The angles of the nodes around a ring, and which of its segments carry a bar.
struct WheelCircumference {
  /// The columns of the two edges of a bar, and the angle of its middle.
  struct Bar {
    int first = 0;
    int last = 0;         ///< columns() where a bar ends at the first column
    double centre = 0.0;  ///< [rad]
  };
  std::vector<double> angles;  ///< [rad] of the nodes, one for each column, increasing
  std::vector<Bar> bars;
  double node_radius = 0.0;  ///< [m] of the polygon with the area of the wheel's circle

  int columns() const { return static_cast<int>(angles.size()); }
  /// True if a bar stands between a column and the next.
  bool under_bar(int column) const;
};

/// wheel.segments equal ones.
WheelCircumference plain_circumference(const WheelGeometry& wheel);

/// Circumference of bars and the gaps between them, each in equal segments. @param size [m] longest
/// segment
/// @param size [m] longest segment
WheelCircumference grouser_circumference(const WheelGeometry& wheel, double size);

/// Smallest number of equal parts of a length that are no longer than size [m].
int parts(double length, double size);

}  // namespace furrow
