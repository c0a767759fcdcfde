// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A rigid level floor with friction under a surface: a road.

#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/geometry/surface.h"

namespace furrow {

/// Parameters of the floor. Pressure grows with penetration d: p = stiffness d + damping (-v_z),
/// never below 0.
struct RigidPlaneParameters {
  double height = 0.0;                ///< z of the floor [m]
  double stiffness = 2e9;             ///< [Pa/m]
  double damping = 0.0;               ///< [Pa s/m]
  double friction = 0.0;              ///< Coulomb's mu
  double tangential_stiffness = 1e9;  ///< [Pa/m] of sticking
};

/// Contact at the nodes of a surface. Each node has its share of the area of the triangles around
/// it at construction. Sticking is a tangential spring from the point of first touch; the anchor
/// slides when the force exceeds mu times the normal force. The plane keeps no reference to the
/// surface.
class RigidPlane {
 public:
  /// @throws InputError for values out of range
  RigidPlane(const RigidPlaneParameters& parameters, const Surface& surface);

  /// Adds the floor's forces to surface.f.
  void press_on(Surface& surface);

  const VectorX& area() const { return area_; }          ///< [m^2] of every node
  const VectorX& pressure() const { return pressure_; }  ///< [Pa] normal, of the last press_on
  /// Energy dissipated by sliding friction since the start [J].
  double friction_loss() const { return friction_loss_; }
  /// Force on the surface in the last press_on [N].
  Vector3 total_force() const { return total_; }
  const RigidPlaneParameters& parameters() const { return parameters_; }
  /// Saves where nodes stick, their areas, and the results of the last press_on().
  void checkpoint(Checkpoint& state);

 private:
  RigidPlaneParameters parameters_;
  VectorX area_;             // [m^2]
  VectorX pressure_;         // [Pa]
  Eigen::Matrix2Xd anchor_;  // [m] place at which the spring of a sticking node has no force
  std::vector<unsigned char> sticking_;  // 1: the node sticks
  double friction_loss_ = 0.0;           // [J]
  Vector3 total_ = Vector3::Zero();      // [N]
};

}  // namespace furrow
