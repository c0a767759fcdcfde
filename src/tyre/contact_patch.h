// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The footprint of a tyre on a rigid plane.

#include "furrow/bodies/rigid_plane.h"
#include "furrow/tyre/tyre.h"

namespace furrow {

struct ContactPatch {
  double length = 0.0;  ///< [m] of the outline, along the longest line round the tyre
  double width = 0.0;   ///< [m] of the outline
  /// [m^2] inside the outline, voids and gaps included
  double perimeter_area = 0.0;
  /// [m^2] sum of the areas of the touching nodes: without voids and their walls
  double nodal_area = 0.0;
  double largest_pressure = 0.0;  ///< [Pa] of a tread node, as in PrintStress
  double mean_pressure = 0.0;     ///< [Pa] vertical force over perimeter_area
  double force = 0.0;             ///< [N] vertical, whole tyre
  /// share of the nodes inside the outline that do not touch, as in a buckled middle
  double lifted_share = 0.0;
};

/// The print node by node.
struct PrintStress {
  VectorX pressure;  ///< [Pa] vertical force of a node over its area here
  /// [m^2] area of a touching node without walls of voids; 0 for others
  VectorX area;
};

/// Call after plane.press_on(surface).
PrintStress print_stress(const Surface& surface, const RigidPlane& plane);

/// The outline of the print. On each line of nodes around the tread, and next to the outermost line
/// that touches, it lies between a touching node and the next free one. A bent shell leaves the
/// plane with a gap that grows as the square of the distance: the outline is the edge for which
/// this gap fits the first two free nodes. A stiff surface may be pressed through the plane farther
/// out; then it is the crossing. It ends at the last line of the tread. Valid for an upright wheel
/// that travels along x. Call after plane.press_on(tyre.surface()).
ContactPatch contact_patch(const Tyre& tyre, const RigidPlane& plane);

}  // namespace furrow
