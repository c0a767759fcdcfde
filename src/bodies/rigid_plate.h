// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A flat rigid plate that is pushed into the ground at a prescribed speed: the bevameter's plate.

#include <string>

#include "bodies/body.h"
#include "core/options.h"

namespace furrow {

enum class PlateShape { circle, square };

/// A plate that lies level; its lower face meets the ground.
struct PlateGeometry {
  PlateShape shape = PlateShape::circle;
  double size = 0.0;       ///< [m] diameter or side
  double thickness = 0.0;  ///< [m]
  int elements = 20;       ///< across the plate; even for a circle

  double area() const;  ///< [m^2] of the lower face
};

/// Triangulates a plate: closed, outward; centre of the lower face at the origin, the plate above
/// it. The edge of a circle is a regular polygon of the circle's area, so mean pressures are exact.
/// @param where names the plate in errors
/// @throws InputError for a shape that cannot be, or whose elements would be slivers
Surface make_plate_mesh(const PlateGeometry& geometry, const std::string& where = "plate");

/// Moves up and down only, at the speed it is told; everything else is held. It has no mass:
/// whatever drives it takes all forces, and the work of the driver is minus the work of the contact
/// forces.
class RigidPlate : public Body {
 public:
  /// The keys of a plate. @param subject names the owner in errors
  static Schema schema(const std::string& subject = "rigid plate");
  explicit RigidPlate(const Options& options);
  /// @param centre of the lower face at the start [m] @param where names the plate in errors
  RigidPlate(const PlateGeometry& geometry, const Vector3& centre,
             const std::string& where = "rigid plate");

  /// @param velocity upwards [m/s], from the next step on @throws StateError when it is not finite
  void prescribe(double velocity);

  const PlateGeometry& geometry() const { return geometry_; }
  const Vector3& centre() const { return centre_; }  ///< [m] of the lower face
  /// Mean pressure on the lower face: vertical force on the plate over its area [Pa].
  double mean_pressure() const;

  double stable_time_step() const override;  ///< infinity
  void advance(double dt) override;
  using Body::surface;
  Surface& surface() override { return surface_; }
  EnergyBudget energy_budget() const override;
  void checkpoint(Checkpoint& state) override;

 private:
  void place_nodes();

  PlateGeometry geometry_;
  Matrix3X reference_;  // nodes about the centre of the lower face
  Surface surface_;
  Vector3 centre_;
  double velocity_ = 0.0;      // [m/s] upwards
  double contact_work_ = 0.0;  // [J]
};

}  // namespace furrow
