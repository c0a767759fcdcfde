// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// A rigid body with heave, roll and pitch on springs and dampers.

#include <vector>

#include "furrow/core/checkpoint.h"
#include "furrow/core/types.h"

namespace furrow {

/// Spring and damper between an axle and the body. Heights count from the start.
struct Strut {
  Vector2 arm = Vector2::Zero();                ///< x and y from the centre of mass [m]
  double stiffness = 0.0, damping = 0.0;        ///< k [N/m], c [N s/m]
  double height = 0.0, velocity = 0.0;          ///< h [m], h' [m/s] of the axle
  double weight = 0.0;                          ///< W of the body's share [N]
  double top_height = 0.0, top_velocity = 0.0;  ///< result: s [m], s' [m/s] of the upper end
  double force = 0.0;                           ///< result: F on the axle, downwards [N]
};

/// The coordinates are q = (heave z, roll, pitch), with small angles. A strut at the arm (x, y) has
/// the lever b = (1, y, -x):
///   s = b . q                          height of its upper end
///   F = k (h - s) + c (h' - s')        force on the axle
///   M q'' = sum b (F - W) + (0, m_x, m_y)
/// The dampers are implicit in the velocity of the body. Velocities are half a step behind
/// positions. A body with the mass alone on one strut is a quarter car.
class SprungBody {
 public:
  /// @param inertia mass [kg], roll and pitch inertia [kg m^2]; an angle with the inertia 0 is held
  /// @param position first q [m, rad]; @param velocity first q' [m/s, rad/s]
  explicit SprungBody(const Vector3& inertia, const Vector3& position = Vector3::Zero(),
                      const Vector3& velocity = Vector3::Zero())
      : inertia_(inertia), position_(position), velocity_(velocity) {}

  /// Advances by one step. Sets the results of the struts. @param moment m_x, m_y about the centre
  /// of mass [N m]
  /// @throws StateError for a step that is too long for the springs
  void advance(std::vector<Strut>& struts, const Vector2& moment, double dt);

  const Vector3& position() const { return position_; }  ///< q [m, rad]
  /// Energies at the time at which the last step began [J]:
  /// kinetic + spring + damping_loss = weight_work + axle_work + moment_work.
  struct Energy {
    double kinetic = 0.0, spring = 0.0;
    double damping_loss = 0.0;
    double weight_work = 0.0;
    double axle_work = 0.0;  ///< of the axles' motion
    double moment_work = 0.0;
  };
  const Energy& energy() const { return energy_; }
  void checkpoint(Checkpoint& state);

 private:
  void count_energy(const std::vector<Strut>& struts);

  Vector3 inertia_;
  Vector3 position_, velocity_;
  Energy energy_;
  // struts, turn and moment of the last step
  std::vector<double> heights_, forces_, dampers_, weights_, tops_;  // [m], [N], [N], [N], [m]
  Vector3 turned_ = Vector3::Zero();                                 // change of q
  Vector2 moment_ = Vector2::Zero();
};

}  // namespace furrow
