// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The test rig: lowers a wheel onto the ground, accelerates it and keeps it going.

#include <string>
#include <vector>

#include "bodies/wheel_hub.h"
#include "core/options.h"
#include "core/outputs.h"
#include "statistics/rig_stage.h"
#include "rig/ground_losses.h"
#include "rig/pass_schedule.h"
#include "rig/ramp.h"
#include "rig/slip.h"

namespace furrow {

/// Stages, one after the other:
///   settle      x, y and spin held, the load grows smoothly from 0 over load_ramp_time (or the
///               wheel is lowered to its sinkage); the spin is held so that every run starts to
///               roll from the same, unturned wheel;
///   accelerate  x follows speed x ramp; the spin is free (towed), follows the rim speed of the
///               slip times the same ramp, so that the slip has its value from the first step
///               (slip), or is driven by torque x ramp (torque);
///   cruise      everything constant.
/// With travel free, x is released when the acceleration begins, and speed and slip are answers:
/// spin or torque grow with the ramp, and so does the drawbar load. What the axle drags has its
/// inertia.
///
/// On a slope the axes stay with the ground, x uphill along it and z off it, and weights are
/// turned: that of the load here, those of grains and continuum by tilt().
///
/// With several passes the wheel goes back after the cruise of each but the last: it is stopped and
/// lifted, brought back to where it began, and lowered until the ground bears a small part of the
/// load; then it settles again, and rolls in its rut.
///
/// y, yaw and camber are held throughout. Before `start` the wheel is held where it is. Travel is
/// along +x.
///
/// The load is the whole force on level ground at rest, weight of the wheel included:
/// whatever the wheel's own mass times gravity lacks or exceeds is a constant force that the rig
/// adds at the axle, without inertia.
///
/// All stages are functions of time alone: a rig restarts by being made again from the same input.
class WheelRig {
 public:
  enum class Mode { towed, slip, torque, spin };

  /// The keys of the rig. @param subject names the owner in errors
  static Schema schema(const std::string& subject = "wheel rig");

  /// Takes hold of the wheel, which must outlive the rig, and turns it to its slip angle and
  /// camber.
  /// @throws InputError for keys that contradict each other
  WheelRig(const Options& options, WheelHub& wheel);

  /// Sets loads and motions of the wheel for the step [time, time + dt]; call it before every step.
  void apply(double time, double dt);

  /// What measure() returns, in its order; the first is the time.
  static std::vector<Channel> channels();
  /// One row: state of the wheel and the forces now on its surface; call it when the forces of the
  /// step are known.
  std::vector<double> measure(double time, const GroundLosses& losses = {}) const;

  RigStage stage(double time) const;
  int pass(double time) const { return passes_.index(time) + 1; }  ///< from 1
  int passes() const { return passes_.passes(); }
  /// [rad] by which gravity is turned at a time: up to the slope while the load grows
  double tilt(double time) const { return slope_ * load_ramp_.value(time); }
  Mode mode() const { return mode_; }
  /// [N] full; 0 when the sinkage is prescribed
  double load() const { return load_; }
  /// [m/s] in cruise; 0 unless slip or spin is prescribed
  double target_rim_speed() const { return rim_speed_; }
  double cruise_start() const { return speed_ramp_.end(); }  ///< [s]

 private:
  struct Reading;
  static const Outputs<const Reading>& outputs();
  void check_load(const Options& options) const;
  void read_vertical(const Options& options);
  void read_travel(const Options& options);
  void read_drive(const Options& options);
  void read_passes(const Options& options);
  void drive_vertical(double time, double dt);
  void go_back(double time, double dt);
  void drive_travel(double time, double dt);
  void drive_spin(double time, double dt);

  WheelHub& wheel_;
  Mode mode_ = Mode::towed;
  bool sinkage_prescribed_ = false;
  double load_ = 0.0;      // [N]
  double lowering_ = 0.0;  // [m] upwards from the first position to the prescribed sinkage
  bool travel_free_ = false;
  double slope_ = 0.0;         // [rad]
  double drawbar_load_ = 0.0;  // [N]
  double speed_ = 0.0;         // [m/s]; 0 with travel free
  double plane_speed_ = 0.0;   // [m/s] its component in the wheel plane, speed cos(slip angle)
  double rim_speed_ = 0.0;     // [m/s]
  double torque_ = 0.0;        // [N m]
  double ground_level_ = 0.0;  // [m]
  Ramp load_ramp_;             // begins with the settling; as all ramps, on the first pass's clock
  Ramp speed_ramp_;            // begins with the acceleration
  PassSchedule passes_;
  double first_x_ = 0.0;         // [m] of the axle, where every pass begins
  double lifted_z_ = 0.0;        // [m] of the axle on its way back
  double lowering_speed_ = 0.0;  // [m/s]
};

}  // namespace furrow
