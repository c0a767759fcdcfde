// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The sprung masses of several rigs as one rigid body: an axle, a bogie or a vehicle.

#include <vector>

#include "core/options.h"
#include "core/outputs.h"
#include "rig/sprung_body.h"
#include "rig/wheel_rig.h"

namespace furrow {

/// The suspensions of the rigs carry the body. Its mass is the sum of their sprung masses, its
/// centre of mass the mean of the axles, by sprung mass. It rolls if wheels are apart along y and
/// pitches if wheels are apart along x.
///
/// Wheels pass horizontal forces to the body at their axles, and the moments of the constraints of
/// spin and camber. The rigs pull and guide the body at a height e above the axles. With the
/// centre of mass at the height H, the constraint forces C of the wheels and acceleration a
///   E = sum C + m a,   m_x = H (m a_y - W_y) - e E_y,   m_y = H (W_x - m a_x) + e E_x
/// less those constraint moments. W is the weight of the body in the axes of the ground.
/// Accelerations and constraints are those of the last step.
class Chassis {
 public:
  static Schema schema(const std::string& subject);

  /// The rigs must outlive it. @throws InputError
  Chassis(const Options& options, std::vector<WheelRig*> rigs);

  /// For the step [time, time + dt], after those of the rigs.
  void apply(double time, double dt);
  /// The rigs have sprung masses of their own again.
  void release();

  static const Outputs<const Chassis>& outputs();
  const SprungBody& body() const { return body_; }
  void checkpoint(Checkpoint& state);

 private:
  static SprungBody make_body(const Options& options, const std::vector<WheelRig*>& rigs);
  Vector2 moment(double dt);

  std::vector<WheelRig*> rigs_;
  double height_, guide_height_;  // above the axles [m]
  SprungBody body_;
  Vector2 speed_ = Vector2::Zero();  // along x and y, of the last step [m/s]
};

}  // namespace furrow
