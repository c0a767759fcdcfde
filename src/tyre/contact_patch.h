// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The footprint of a tyre on a rigid plane.

#include "bodies/rigid_plane.h"
#include "tyre/tyre.h"

namespace furrow {

struct ContactPatch {
  double length = 0.0;  ///< [m] of the outline, along the longest line round the tyre
  double width = 0.0;   ///< [m] of the outline
  /// [m^2] inside the outline, gaps and voids within included: what a print's outline encloses
  double perimeter_area = 0.0;
  /// [m^2] sum of the shares of the touching nodes in what lies on the plane: without voids, and
  /// without their walls
  double nodal_area = 0.0;
  double largest_pressure = 0.0;  ///< [Pa] of a tread node, as in PrintStress
  double mean_pressure = 0.0;     ///< [Pa] vertical force over perimeter_area
  double force = 0.0;             ///< [N] vertical, whole tyre
  /// share of the nodes inside the outline that do not touch: a buckled middle
  double lifted_share = 0.0;
};

/// The print node by node.
struct PrintStress {
  VectorX pressure;  ///< [Pa] vertical force of a node over its area here
  /// [m^2] a touching node's share of what lies on the plane, walls of voids left out; 0 of others
  VectorX area;
};

/// Call after plane.press_on(surface).
PrintStress print_stress(const Surface& surface, const RigidPlane& plane);

/// The outline lies between nodes that touch and the next ones, along each line of nodes around the
/// tread and beside the outermost one that touches. There it is where a gap that grows as the
/// square of the distance from the edge (a bent shell leaves the plane like that) fits those of the
/// first two free nodes, or, if that is farther out, where a surface pressed through the plane (a
/// stiff one) crosses it. It ends at the tread's last line. Valid for an upright wheel that travels
/// along x. Call after plane.press_on(tyre.surface()).
ContactPatch contact_patch(const Tyre& tyre, const RigidPlane& plane);

}  // namespace furrow
