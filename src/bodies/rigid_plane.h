// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A rigid level floor with friction under a surface, for tests and for tyres on a road.

#include <vector>

#include "core/checkpoint.h"
#include "geometry/surface.h"

namespace furrow {

/// What the floor is like. Pressure grows with penetration: p = stiffness d + damping (-v_z), never
/// below 0.
struct RigidPlaneParameters {
  double height = 0.0;                ///< z of the floor [m]
  double stiffness = 2e9;             ///< [Pa/m]
  double damping = 0.0;               ///< [Pa s/m]
  double friction = 0.0;              ///< Coulomb's mu
  double tangential_stiffness = 1e9;  ///< [Pa/m] of sticking
};

/// Contact at the nodes of a surface, each with its share of the area of the triangles around (of
/// the shape at construction). Sticking is a tangential spring from the point of first touch,
/// dragged along when the force exceeds mu times the normal one.
class RigidPlane {
 public:
  /// @throws InputError for values out of range
  RigidPlane(const RigidPlaneParameters& parameters, const Surface& surface);

  /// Adds the floor's forces to surface.f.
  void press_on(Surface& surface);

  const VectorX& area() const { return area_; }          ///< [m^2] of each node
  const VectorX& pressure() const { return pressure_; }  ///< [Pa] normal, of the last press_on
  /// [N] on the surface, of the last press_on
  Vector3 total_force() const { return total_; }
  /// Elastic energy of penetration and sticking [J], and what friction and damping took since the
  /// start: exact for small steps.
  double stored_energy() const { return stored_; }
  void set_height(double height) { parameters_.height = height; }
  const RigidPlaneParameters& parameters() const { return parameters_; }
  void checkpoint(Checkpoint& state);                       ///< where nodes stick, and their areas
  void forget() { sticking_.assign(sticking_.size(), 0); }  ///< all nodes stick anew where they are

 private:
  RigidPlaneParameters parameters_;
  VectorX area_, pressure_;
  Eigen::Matrix2Xd anchor_;  // [m] where the spring of a sticking node is free of force
  std::vector<unsigned char> sticking_;
  Vector3 total_ = Vector3::Zero();
  double stored_ = 0.0;
};

}  // namespace furrow
