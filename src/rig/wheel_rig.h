// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The test rig: lowers a wheel onto the ground, accelerates it and holds its travel constant.

#include <optional>
#include <string>
#include <vector>

#include "furrow/bodies/wheel_hub.h"
#include "furrow/core/options/options.h"
#include "furrow/core/options/outputs.h"
#include "furrow/statistics/rig_stage.h"
#include "furrow/rig/course.h"
#include "furrow/rig/ground_losses.h"
#include "furrow/rig/pass_schedule.h"
#include "furrow/rig/ramp.h"
#include "furrow/rig/slip.h"
#include "furrow/rig/sprung_body.h"

namespace furrow {

/// The stages follow each other.
///   settle      x, y and spin are held. The rig lowers the wheel to the ground. Then the load
///               grows smoothly from 0 over load_ramp_time, or the wheel comes down to its sinkage.
///               Every run starts to roll from an unturned wheel.
///   accelerate  x follows speed x ramp. The spin is free (towed), follows the rim speed of the
///               slip times the same ramp (slip), or is driven by torque x ramp (torque). The slip
///               thus has its value from the first step.
///   cruise      Everything is constant, or follows its course. The clock of the courses starts
///               here, and their first values hold before.
/// With travel free, x is released when the acceleration begins. Spin or torque and the drawbar
/// load grow with the ramp; speed and slip result. The mass that the axle drags has inertia.
///
/// On a slope the axes stay with the ground: x points uphill along it and z is normal to it. On a
/// side slope the ground rises to the left, along y. The rig turns the load; tilt() turns the
/// weights of grains and continuum.
///
/// With several passes the wheel returns after the cruise of each pass but the last. The rig stops
/// and lifts it, brings it back to its start, and lowers it until the ground bears a small part of
/// the load. Then it settles again and rolls in its rut.
///
/// y is held until the acceleration, and then held or free. Yaw follows the slip angle, camber is
/// held. Before `start` the wheel is held in place. Travel is along +x.
///
/// The load is the whole force on level ground at rest, weight of the wheel included. The rig adds
/// the difference to the wheel's mass times gravity as a constant force at the axle, without
/// inertia.
///
/// With a suspension the part beyond the wheel's weight is a mass on spring and damper.
///
/// All stages are functions of time and of the wheel, so a rig without suspension has no state.
class WheelRig {
 public:
  enum class Mode { towed, slip, torque, spin };

  /// The keys of the rig. @param subject names the owner in errors
  static Schema schema(const std::string& subject = "wheel rig");

  /// Turns the wheel to its slip angle and camber. The wheel must outlive the rig.
  /// @param table courses that are not among the options
  /// @throws InputError for keys that contradict each other
  WheelRig(const Options& options, WheelHub& wheel, const Courses& table = {});
  /// The targets that can have a course.
  static const std::vector<std::string>& changing_targets();

  /// Sets other values of the load, the speed, the slip, the torque, the spin rate or the drawbar
  /// load, from the next step on; all other keys stay. @throws InputError, and nothing has changed
  void retarget(const Options& options);
  /// The keys that retarget() takes.
  static const std::vector<std::string>& targets();

  /// Sets loads and motions of the wheel for the step [time, time + dt]; call it before every step.
  void apply(double time, double dt);

  /// Channels of measure(), in its order; the first is the time.
  static std::vector<Channel> channels();
  /// Channels of measure(), with the slip as this rig defines it.
  std::vector<Channel> recorded_channels() const;
  /// Row of the channels: state of the wheel and the present forces on its surface. Call it when
  /// the forces of the step are known.
  std::vector<double> measure(double time, const GroundLosses& losses = {}) const;

  /// True if the rig sets a coordinate, "the load" or "the axle torque" of its wheel in every step.
  bool sets(const std::string& coordinate) const;
  bool travel_free() const { return travel_free_; }
  bool has_suspension() const { return sprung_mass_ > 0.0; }
  double sprung_mass() const { return sprung_mass_; }  ///< [kg]; 0 without suspension
  const WheelHub& wheel() const { return wheel_; }

  // Suspension that carries a part of a chassis, which computes its step after apply().
  void join() { joined_ = true; }
  void leave() { joined_ = false; }
  bool joined() const { return joined_; }
  /// True once the load has begun to grow. @param time [s] the middle of a step
  bool lowered(double time) const { return time >= load_ramp_.start; }
  /// Weight of the sprung mass in the axes of the ground [N].
  const Vector3& sprung_weight() const { return sprung_weight_; }
  /// Present strut of the suspension. Its arm is the place of the axle.
  Strut strut() const;
  void press(const Strut& strut);      ///< presses the wheel with the results
  void pull(double force);             ///< pulls the axle along x, in addition to its load [N]
  void checkpoint(Checkpoint& state);  ///< of the suspension

  RigStage stage(double time) const;
  int pass(double time) const { return passes_.index(time) + 1; }  ///< from 1
  int passes() const { return passes_.passes(); }
  /// Turns gravity at a time: up to the slopes while the load grows.
  Matrix3 tilt(double time) const;
  bool on_slope() const { return slope_ != 0.0 || side_slope_ != 0.0; }
  Mode mode() const { return mode_; }
  /// Full load, now [N]; 0 when the sinkage is prescribed.
  double load() const { return load_; }
  /// Rim speed in cruise, now [m/s]; 0 unless slip or spin is prescribed.
  double target_rim_speed() const { return spin_rate_ * wheel_.nominal_radius(); }
  /// Travel along x over a time [m]; nothing where the travel is free, or goes back.
  /// @param from, to  [s]
  std::optional<double> travel(double from, double to) const;
  double cruise_start() const { return speed_ramp_.end(); }  ///< [s]

 private:
  struct Reading;
  static const Outputs<const Reading>& outputs();
  void check_half_model(const Options& options) const;
  void check_course(const std::string& target, const std::string& where,
                    const Options& options) const;
  void check_constants(const Options& options) const;
  void check_load(const Options& options) const;
  void read_courses(const Options& options, const Courses& table);
  void read_slip(const Options& options);
  void read_load(const Options& options);
  void read_vertical(const Options& options);
  void plan_lowering(double settle_time);
  void read_travel(const Options& options);
  void read_dragged_mass(const Options& options);
  void read_drive(const Options& options);
  void read_passes(const Options& options);
  void read_suspension(const Options& options);
  void press_by_suspension(double share, double dt);
  double sprung_drop() const;  // [m] since the start; 0 without suspension
  Vector3 down() const;
  bool has_course(const std::string& key) const { return courses_.count(key) > 0; }
  double slip_angle(double time) const;
  double spin_rate_of(double slip, double slip_angle) const;
  std::string slip_meaning() const;
  void follow_courses(double time, double dt);
  void drive_vertical(double time, double dt);
  bool lower(double time, double dt);
  void go_back(double time, double dt);
  void drive_travel(double time, double dt);
  void drive_spin(double time, double dt);

  WheelHub& wheel_;
  Mode mode_ = Mode::towed;
  bool sinkage_prescribed_ = false;
  double load_ = 0.0;      // [N]
  double lowering_ = 0.0;  // [m] upwards from the first position to the prescribed sinkage
  bool travel_free_ = false, lateral_free_ = false;
  double slope_ = 0.0;                                             // [rad] along x
  double side_slope_ = 0.0;                                        // [rad] along y
  double drawbar_load_ = 0.0;                                      // [N]
  double speed_ = 0.0;                                             // [m/s]; 0 with travel free
  double spin_rate_ = 0.0;                                         // [rad/s] in cruise
  double torque_ = 0.0;                                            // [N m]
  double ground_level_ = 0.0;                                      // [m]
  Courses courses_;                                                // on the clock of the cruise
  double slip_ = 0.0;                                              // in mode slip
  double slip_angle_ = 0.0;                                        // [rad] without a course
  SlipDefinition slip_definition_ = SlipDefinition::larger_speed;  // of the prescribed slip
  double slip_radius_ = 0.0;                                       // [m] of the rim speed in slip
  bool slip_by_total_speed_ = false;
  bool lowers_ = false;      // true if the rig lowers the wheel to the ground before the load grows
  double start_ = 0.0;       // [s] of the settling; as all ramps, on the first pass's clock
  Ramp lowering_ramp_;       // begins with the settling
  double touching_z_ = 0.0;  // [m] of the axle when the wheel has come to the ground
  double creep_speed_ = 0.0;  // [m/s] of a wheel that does not touch there
  double creep_end_ = 0.0;    // [s]
  Ramp load_ramp_;            // begins when the wheel is lowered
  Ramp speed_ramp_;           // begins with the acceleration
  PassSchedule passes_;
  double sprung_mass_ = 0.0;  // [kg]; 0 without suspension
  Strut strut_;               // stiffness, damping, and the results of the last step
  bool joined_ = false;
  Vector3 sprung_weight_ = Vector3::Zero();  // [N] in the axes of the ground, of this step
  double start_height_ = 0.0;                // [m] of the axle with a suspension
  double wheel_weight_ = 0.0;                // [N] with a suspension
  double first_height_ = 0.0;                // [m] of the axle when the load begins to grow
  double first_x_ = 0.0;                     // [m] of the axle, where every pass begins
  double lifted_z_ = 0.0;                    // [m] of the axle on its way back
  double lowering_speed_ = 0.0;              // [m/s]
};

}  // namespace furrow
