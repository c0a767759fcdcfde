// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Spring and damper between the axle of a wheel and the mass that it carries: a quarter car.

#include "furrow/core/checkpoint.h"

namespace furrow {

/// The sprung mass m moves vertically. The heights h of the axle and s of the mass count from the
/// start. The force F presses the axle down, and the mass carries the weight W.
///   F = k (h - s) + c (h' - s'),   m s'' = F - W
/// The damper is implicit in the velocity of the mass. Velocities are half a step behind positions.
class Suspension {
 public:
  /// @param stiffness k [N/m]; @param damping c [N s/m]; @param mass m [kg]
  Suspension(double stiffness, double damping, double mass)
      : stiffness_(stiffness), damping_(damping), mass_(mass) {}

  /// Advances by one step. @param height h [m]; @param velocity h' [m/s]; @param weight W [N]
  /// @return F [N]
  double advance(double height, double velocity, double weight, double dt) {
    const double spring = stiffness_ * (height - height_);
    velocity_ = (velocity_ + dt / mass_ * (spring + damping_ * velocity - weight)) /
                (1.0 + damping_ * dt / mass_);
    force_ = spring + damping_ * (velocity - velocity_);
    height_ += dt * velocity_;
    return force_;
  }

  /// Takes the step of a body that this mass is part of. @param height s [m];
  /// @param velocity s' [m/s]; @param force F [N]
  void follow(double height, double velocity, double force) {
    height_ = height;
    velocity_ = velocity;
    force_ = force;
  }

  double stiffness() const { return stiffness_; }
  double damping() const { return damping_; }
  double mass() const { return mass_; }
  double height() const { return height_; }  ///< s [m]
  double force() const { return force_; }    ///< F of the last step [N]

  void checkpoint(Checkpoint& state) {
    state.value("sprung_height", height_);
    state.value("sprung_velocity", velocity_);
    state.value("suspension_force", force_);
  }

 private:
  double stiffness_, damping_, mass_;
  double height_ = 0.0, velocity_ = 0.0, force_ = 0.0;
};

}  // namespace furrow
