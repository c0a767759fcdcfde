// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Stiffness of a four-node shell element about its stress-free shape.

#include "furrow/shell/shell4_shape.h"
#include "furrow/shell/shell_section.h"

namespace furrow {

using Matrix24 = Eigen::Matrix<double, 24, 24>;

/// Matrix K of the strain energy 1/2 u^T K u. Each node has the displacements and rotations u_x,
/// u_y, u_z, theta_x, theta_y, theta_z. The energy has four parts:
///   membrane  Bilinear strains with four enhanced modes, which are condensed. They prevent locking
///             in in-plane bending [Simo1990].
///   bending   Curvature of the directors, relative to that of a curved reference shape.
///   shear     Covariant shears that are sampled at mid-sides (MITC4). They prevent locking of thin
///             shells [Dvorkin1984].
///   drilling  A spring at each node, between its rotation about axis 3 and that of the element.
///   Its
///             stiffness is drilling_share (D11 + D22)/2.
/// All parts use 2 x 2 Gauss points. Only the six rigid motions have no energy, so there are no
/// hourglass modes. The drilling spring is as weak as bending, because its action between the
/// facets of a curved shell is wrong.
/// @throws StateError for an element that is folded
Matrix24 shell4_stiffness(const Shell4Shape& shape, const ShellSection& section);

constexpr double drilling_share = 0.1;

}  // namespace furrow
