// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stiffness of a four-node shell element about its stress-free shape.

#include "core/types.h"
#include "shell/shell_section.h"

namespace furrow {

using Matrix34 = Eigen::Matrix<double, 3, 4>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;

/// Stress-free shape in the element's own axes: origin at the mean of the nodes, axis 1 along the
/// first median (from edge 4-1 to edge 2-3), axis 3 normal to both medians, outwards when the nodes
/// run counter-clockwise seen from outside.
struct Shell4Shape {
  Matrix34 x;         ///< [m]
  Matrix34 director;  ///< unit normals of the shell at the nodes
  Vector3 fibre;      ///< direction whose projection is the section's axis 1
};

/// Strain energy 1/2 u^T K u of displacements and rotations u = (u_x, u_y, u_z, theta_x, theta_y,
/// theta_z) node by node:
///   membrane    bilinear, with the four enhanced modes of Simo & Rifai (1990) condensed: no
///   locking in plane bending; bending     curvature of the directors, also of a curved reference
///   (Dvorkin & Bathe 1984); shear       MITC4: covariant shears sampled at mid-sides (Dvorkin &
///   Bathe 1984): no locking of thin shells; drilling    a spring drilling_share (D11 + D22)/2 for
///   each node between its turn about axis 3 and the element's.
/// 2 x 2 Gauss points throughout, so that nothing but the six rigid motions is free of energy:
/// there are no hourglass modes. The drilling spring is as weak as bending, because it acts wrongly
/// between the facets of a curved shell.
/// @throws StateError for an element that is folded
Matrix24 shell4_stiffness(const Shell4Shape& shape, const ShellSection& section);

constexpr double drilling_share = 0.1;

/// Medians of a quadrilateral: a from edge 4-1 to edge 2-3, b from edge 1-2 to edge 3-4.
inline Vector3 first_median(const Matrix34& x) {
  return 0.5 * (x.col(1) + x.col(2) - x.col(0) - x.col(3));
}
inline Vector3 second_median(const Matrix34& x) {
  return 0.5 * (x.col(2) + x.col(3) - x.col(0) - x.col(1));
}

}  // namespace furrow
