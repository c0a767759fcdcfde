// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Resistance of sand to a face of a body, by three-dimensional resistive force theory
/// [Agarwal2023] (theory: rft).

#include "furrow/core/types.h"

namespace furrow {

/// Stress vector per strength xi and depth on a face that moves into the sand (eqs. 1 and 2).
struct RftStress {
  Vector3 normal = Vector3::Zero();   ///< a pressure: against the outward normal
  Vector3 tangent = Vector3::Zero();  ///< along the face
};
/// @param n outward normal and @param v direction of motion, unit vectors; z is up
/// @param friction coefficient of the face and the sand
RftStress rft_stress(const Vector3& n, const Vector3& v, double friction);

/// Integrals over a triangle of depth times the linear function that is 1 at a node, over its area
/// (eq. 5). Exact; the part above the surface does not count.
/// @param depth of the nodes [m] @returns three numbers [m] whose sum is the mean depth
Vector3 depth_moments(const Vector3& depth);

}  // namespace furrow
