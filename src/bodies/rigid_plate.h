// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A rigid plate, annulus or cone that is pushed into the ground at a prescribed speed: the tools
/// of bevameter and penetrometer.

#include <string>

#include "furrow/bodies/body.h"
#include "furrow/core/options/options.h"
#include "furrow/geometry/meshes/plate_mesh.h"

namespace furrow {

/// The plate moves and turns about its vertical axis, both at prescribed velocities. It has no
/// mass: the drive carries all forces, and its work is minus the work of the contact forces.
class RigidPlate : public Body {
 public:
  /// The keys of a plate. @param subject names the owner in errors
  static Schema schema(const std::string& subject = "rigid plate");
  explicit RigidPlate(const Options& options);
  /// @param centre of the lower face at the start [m] @param where names the plate in errors
  RigidPlate(const PlateGeometry& geometry, const Vector3& centre,
             const std::string& where = "rigid plate");
  /// A tool of another shape. @param geometry a plate of the area on which mean_pressure() acts
  /// @param surface about the point that starts at centre [m]
  RigidPlate(const PlateGeometry& geometry, Surface surface, const Vector3& centre);

  /// Sets the motion from the next step on. @param velocity [m/s] @param spin about z [rad/s]
  /// @throws StateError when one is not finite
  void prescribe(const Vector3& velocity, double spin = 0.0);
  /// @param velocity upwards [m/s]
  void prescribe(double velocity, double spin = 0.0) {
    prescribe(Vector3(0.0, 0.0, velocity), spin);
  }

  const PlateGeometry& geometry() const { return geometry_; }
  const Vector3& centre() const { return centre_; }  ///< [m] of the lower face
  /// Mean pressure on the lower face: vertical force on the plate over its area [Pa].
  double mean_pressure() const;
  double torque() const;                    ///< of the ground on the plate, about its axis [N m]
  double turned() const { return angle_; }  ///< about z, since the start [rad]

  double stable_time_step() const override;  ///< infinity
  void advance(double dt) override;
  using Body::surface;
  Surface& surface() override { return surface_; }
  EnergyBudget energy_budget() const override;
  void checkpoint(Checkpoint& state) override;

 private:
  void place_nodes();

  PlateGeometry geometry_;
  Surface surface_;
  Matrix3X reference_;  // nodes about the centre of the lower face
  Vector3 centre_;
  Vector3 velocity_ = Vector3::Zero();  // [m/s]
  double spin_ = 0.0;                   // [rad/s] about z
  double angle_ = 0.0;                  // [rad] about z
  double contact_work_ = 0.0;           // [J]
};

}  // namespace furrow
