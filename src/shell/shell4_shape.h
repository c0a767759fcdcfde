// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stress-free shapes of the elements of a mesh of four-node shells.

#include <array>
#include <functional>
#include <vector>

#include "furrow/core/types.h"

namespace furrow {

using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// Stress-free shape in the element's axes. The origin is the mean of the nodes, axis 1 is along
/// the first median (from edge 4-1 to edge 2-3), and axis 3 is normal to both medians. Axis 3
/// points outwards when the nodes run counter-clockwise seen from outside.
struct Shell4Shape {
  Matrix34 x;         ///< [m]
  Matrix34 director;  ///< unit normals of the shell at the nodes
  Vector3 fibre;      ///< direction whose projection is the section's axis 1
};

/// A shape and where it lies.
struct Shell4Element {
  std::array<int, 4> nodes;  ///< counter-clockwise seen from outside
  Matrix3 axes;              ///< the element's axes in space, columns
  Shell4Shape shape;
};

/// Medians of a quadrilateral: a from edge 4-1 to edge 2-3, b from edge 1-2 to edge 3-4.
inline Vector3 first_median(const Matrix34& x) {
  return 0.5 * (x.col(1) + x.col(2) - x.col(0) - x.col(3));
}
inline Vector3 second_median(const Matrix34& x) {
  return 0.5 * (x.col(2) + x.col(3) - x.col(0) - x.col(1));
}

/// @param x nodes [m], one column each
/// @param fibre direction of the section's axis 1 at a point; need not be tangent
/// @param largest_kink [rad] nodes where normals of elements differ by less share one normal: a
/// smooth shell
/// @throws StateError naming the element for one without area, or whose fibre is along its normal
std::vector<Shell4Element> shell4_elements(const Matrix3X& x,
                                           const std::vector<std::array<int, 4>>& quads,
                                           const std::function<Vector3(const Vector3&)>& fibre,
                                           double largest_kink = radians(40.0));

/// Same size and form, so that both have the same stiffness, to round-off.
bool alike(const Shell4Shape& a, const Shell4Shape& b);

}  // namespace furrow
