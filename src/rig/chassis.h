// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The sprung masses of several rigs as one rigid body: an axle, a bogie or a vehicle.

#include <vector>

#include "furrow/core/options/options.h"
#include "furrow/core/options/outputs.h"
#include "furrow/rig/sprung_body.h"
#include "furrow/rig/wheel_rig.h"

namespace furrow {

/// The suspensions of the rigs carry the body. Its mass m is the sum of their sprung masses. Its
/// centre of mass is the mean of the axles, weighted by sprung mass. It rolls if wheels are apart
/// along y and pitches if wheels are apart along x.
///
/// Besides the suspensions, three moments turn the body:
///   H (W - m a)  weight W and inertial force along the ground, at the centre of mass. It lies H
///                above the axles.
///   e E          force E with which the rigs pull and guide the body, e above the axles
///   -M           M holds spin and camber of the wheels
/// The wheels are held by the constraint forces C, so
///   E = sum C + m a,   m_x = -H (W_y - m a_y) - e E_y - M_x,   m_y = H (W_x - m a_x) + e E_x - M_y
/// W is in the axes of the ground. The acceleration a, C and M are those of the last step.
///
/// Wheels that travel freely keep their distances along x: they exchange momentum in every step.
class Chassis {
 public:
  static Schema schema(const std::string& subject);

  /// The rigs must outlive it. @throws InputError
  Chassis(const Options& options, std::vector<WheelRig*> rigs);

  /// Sets loads for the step [time, time + dt], after those of the rigs.
  void apply(double time, double dt);
  /// Gives the rigs separate sprung masses again.
  void release();

  static const Outputs<const Chassis>& outputs();
  const SprungBody& body() const { return body_; }
  void checkpoint(Checkpoint& state);

 private:
  static SprungBody make_body(const Options& options, const std::vector<WheelRig*>& rigs);
  Vector2 moment(double dt);
  void keep_distances(double dt);

  std::vector<WheelRig*> rigs_;
  std::vector<double> places_;    // of the axles along x, at the start [m]
  double height_, guide_height_;  // above the axles [m]
  SprungBody body_;
  Vector2 speed_ = Vector2::Zero();  // along x and y, of the last step [m/s]
};

}  // namespace furrow
