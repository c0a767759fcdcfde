// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stress-free shape of an eight-node brick, and its stiffness and masses there.

#include <array>

#include "furrow/core/types.h"

namespace furrow {

using Matrix38 = Eigen::Matrix<double, 3, 8>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;

/// A brick in its own axes: axis 1 along the median from face 0-3-7-4 to face 1-2-6-5, axis 2
/// towards face 3-2-6-7; nodes relative to the mean of them [m].
Matrix38 in_own_axes(const Matrix38& nodes);

/// Shape functions of the trilinear brick at its 2 x 2 x 2 Gauss points. Nodes may coincide: an
/// edge that is collapsed makes a wedge.
struct Brick8Shape {
  std::array<Matrix38, 8> gradient;  ///< [1/m] at each point, one column a node
  std::array<double, 8> weight;      ///< [m^3]
  Matrix38 mean_gradient;            ///< [1/m]
  std::array<double, 8> share;       ///< [m^3] integral of each shape function
  double volume = 0.0;               ///< [m^3]

  /// @throws StateError for a brick without volume or one that is turned inside out at a point
  explicit Brick8Shape(const Matrix38& nodes);
};

/// Stiffness of the shape, mu 2 dev(eps) : dev(eps), and of the volume, K tr(mean eps)^2, about
/// the stress-free state; displacements node by node.
Matrix24 deviatoric_stiffness(const Brick8Shape& shape, double shear);
Matrix24 volumetric_stiffness(const Brick8Shape& shape, double bulk);

}  // namespace furrow
