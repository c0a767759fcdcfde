// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stiffness of a four-node shell element about its stress-free shape.

#include "furrow/shell/shell4_shape.h"
#include "furrow/shell/shell_section.h"

namespace furrow {

using Matrix24 = Eigen::Matrix<double, 24, 24>;

/// Strain energy 1/2 u^T K u of displacements and rotations u = (u_x, u_y, u_z, theta_x, theta_y,
/// theta_z) node by node:
///   membrane  bilinear, with four enhanced modes condensed: no locking in in-plane bending
///             [Simo1990]
///   bending   curvature of the directors, also of a curved reference
///   shear     MITC4: covariant shears sampled at mid-sides, no locking of thin shells
///             [Dvorkin1984]
///   drilling  at each node a spring drilling_share (D11 + D22)/2 between its rotation about axis 3
///             and the element's
/// All parts use 2 x 2 Gauss points. Only the six rigid motions have no energy, so there are no
/// hourglass modes. The drilling spring is as weak as bending, because its action between the
/// facets of a curved shell is wrong.
/// @throws StateError for an element that is folded
Matrix24 shell4_stiffness(const Shell4Shape& shape, const ShellSection& section);

constexpr double drilling_share = 0.1;

}  // namespace furrow
