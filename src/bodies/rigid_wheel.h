// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A rigid wheel on an axle: six degrees of freedom, each free, held or prescribed.

#include "furrow/bodies/wheel_hub.h"
#include "furrow/core/options/options.h"
#include "furrow/geometry/meshes/wheel_geometry.h"

namespace furrow {

/// Parameters of a rigid wheel.
struct RigidWheelParameters {
  WheelGeometry geometry;
  HubParameters hub;
};

/// A hub (wheel_hub.h) with a rigid surface. Its attitude places the nodes from the reference mesh,
/// so errors do not accumulate; their velocity is that of n+1/2.
class RigidWheel : public WheelHub {
 public:
  /// The keys of a wheel. @param subject names the owner in errors
  static Schema schema(const std::string& subject = "rigid wheel");
  /// @throws InputError for values that are allowed separately and impossible together
  explicit RigidWheel(const Options& options);
  /// @param where names the wheel in errors
  explicit RigidWheel(const RigidWheelParameters& parameters,
                      const std::string& where = "rigid wheel");
  /// A wheel of another shape. parameters.geometry gives its nominal radius and width, and in
  /// grousers the part of the largest radius beyond the nominal one and the number of sectors.
  /// @param surface about the axle centre [m]
  RigidWheel(const RigidWheelParameters& parameters, Surface surface, const std::string& where);

  const RigidWheelParameters& parameters() const { return parameters_; }
  double nominal_radius() const override { return parameters_.geometry.radius(); }
  double tip_radius() const override {
    return nominal_radius() + parameters_.geometry.grousers.height;
  }
  int grousers() const override { return parameters_.geometry.grousers.number; }
  double nominal_width() const override { return parameters_.geometry.width; }
  double lowest_point() const override;  ///< of the true circle and shoulders

  double stable_time_step() const override;  ///< infinity
  void advance(double dt) override;
  using Body::surface;
  Surface& surface() override { return surface_; }
  EnergyBudget energy_budget() const override;
  void checkpoint(Checkpoint& state) override;

 private:
  void follow_placement(const Vector3&, const Matrix3&) override { place_nodes(); }
  void follow_velocity() override { place_nodes(); }
  void place_nodes();

  RigidWheelParameters parameters_;
  Matrix3X reference_;  // [m] nodes about the axle centre, at zero spin, yaw and camber
  Surface surface_;
};

}  // namespace furrow
