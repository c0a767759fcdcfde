// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The footprint of a tyre on a rigid plane.

#include "bodies/rigid_plane.h"
#include "tyre/tyre.h"

namespace furrow {

struct ContactPatch {
  double length = 0.0;  ///< [m] of the longest line along the circumference
  double width = 0.0;   ///< [m] between the outermost touching tread lines
  /// [m^2] inside the outline, gaps within included: what a print's outline encloses
  double perimeter_area = 0.0;
  /// [m^2] sum of the shares of the touching nodes in what lies on the plane: without voids, and
  /// without their walls
  double nodal_area = 0.0;
  double largest_pressure = 0.0;  ///< [Pa] of a tread node
  double mean_pressure = 0.0;     ///< [Pa] vertical force over perimeter_area
  double force = 0.0;             ///< [N] vertical, whole tyre
  /// share of the nodes inside the outline that do not touch: a buckled middle
  double lifted_share = 0.0;
};

/// The outline ends, on each line of nodes around the tread, where the gap that grows as the square
/// of the distance from the edge (a bent shell leaves the plane like that) fits the gaps of the
/// first two free nodes; between the last node that touches and the next. Valid for an upright
/// wheel. Call after plane.press_on(tyre.surface()).
ContactPatch contact_patch(const Tyre& tyre, const RigidPlane& plane);

}  // namespace furrow
