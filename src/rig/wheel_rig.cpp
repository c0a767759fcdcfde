// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/rig/wheel_rig.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

// Share of the load that the ground bears when a lowered wheel has come down on it.
constexpr double touching_share = 0.02;
constexpr double minimum_share = 0.05;  // least part of a growing load for it
// dt^2 k/m and dt c/m of a suspension, whose force is constant over a step
constexpr double largest_spring_step = 0.1, largest_damper_step = 0.2;

}  // namespace

RigStage WheelRig::stage(double time) const {
  const double delay = passes_.delay(time);
  if (passes_.goes_back(time - delay, passes_.index(time))) return RigStage::back;
  time -= delay;
  return time < speed_ramp_.start   ? RigStage::settle
         : time < speed_ramp_.end() ? RigStage::accelerate
                                    : RigStage::cruise;
}

Matrix3 WheelRig::tilt(double time) const {
  const double share = load_ramp_.value(time);
  return (Eigen::AngleAxisd(-side_slope_ * share, Vector3::UnitX()) *
          Eigen::AngleAxisd(slope_ * share, Vector3::UnitY()))
      .toRotationMatrix();
}

void WheelRig::apply(double time, double dt) {
  // by the middle of the step: safe against rounding of its ends
  const double middle = time + 0.5 * dt, clock = time - passes_.delay(middle);
  follow_courses(time, dt);
  switch (stage(middle)) {
    case RigStage::settle:
      drive_vertical(clock, dt);
      wheel_.hold(Coordinate::x);
      wheel_.hold(Coordinate::spin);
      if (lateral_free_) wheel_.hold(Coordinate::y);
      return;
    case RigStage::accelerate:
    case RigStage::cruise:
      drive_vertical(clock, dt);
      drive_travel(clock, dt);
      if (lateral_free_) wheel_.release(Coordinate::y);
      drive_spin(clock, dt);
      return;
    case RigStage::back:
      go_back(clock, dt);
      return;
  }
}

std::optional<double> WheelRig::travel(double from, double to) const {
  if (travel_free_ || passes_.passes() > 1) return {};
  return speed_ * (speed_ramp_.integral(to) - speed_ramp_.integral(from));
}

bool WheelRig::sets(const std::string& coordinate) const {
  if (coordinate == "y") return lateral_free_;
  if (coordinate == "yaw") return has_course("slip_angle");
  return coordinate != "camber";
}

double WheelRig::slip_angle(double time) const {
  const auto found = courses_.find("slip_angle");
  return found == courses_.end() ? slip_angle_
                                 : radians(found->second.value(time - cruise_start()));
}

double WheelRig::spin_rate_of(double slip, double slip_angle) const {
  const double speed = slip_by_total_speed_ ? speed_ : speed_ * std::cos(slip_angle);
  return rim_speed(slip_definition_, slip, speed) / slip_radius_;
}

/// Functions of time alone: the targets in the middle of the step.
void WheelRig::follow_courses(double time, double dt) {
  if (courses_.empty()) return;
  const double middle = time + 0.5 * dt, clock = middle - cruise_start();
  for (const auto& [key, course] : courses_)
    if (key == "load_force")
      load_ = course.value(clock);
    else if (key == "spin_rate")
      spin_rate_ = course.value(clock);
    else if (key == "slip")
      slip_ = course.value(clock);
    else
      wheel_.prescribe(Coordinate::yaw, (slip_angle(time + dt) - slip_angle(time)) / dt);
  if (mode_ == Mode::slip) spin_rate_ = spin_rate_of(slip_, slip_angle(middle));
}

/// Brings the wheel back for another pass. Place and support of the wheel decide each motion, so
/// that nothing else needs to be remembered.
void WheelRig::go_back(double time, double dt) {
  const Ramp lifting = passes_.lifting(), returning = passes_.returning();
  const double middle = time + 0.5 * dt;
  wheel_.set_load(Vector3::Zero());
  wheel_.set_axle_torque(0.0);
  if (middle < lifting.end()) {
    for (const Coordinate motion : {Coordinate::x, Coordinate::spin})
      wheel_.prescribe(motion, wheel_.rate(motion) * fading(lifting, time, dt));
    wheel_.prescribe(Coordinate::z,
                     approach(lifting, wheel_.position(Coordinate::z), lifted_z_, time, dt));
    return;
  }
  wheel_.hold(Coordinate::spin);
  if (middle < returning.end()) {
    wheel_.hold(Coordinate::z);
    wheel_.prescribe(Coordinate::x,
                     approach(returning, wheel_.position(Coordinate::x), first_x_, time, dt));
    return;
  }
  wheel_.hold(Coordinate::x);
  if (wheel_.ground_wrench().force.z() > touching_share * load_)
    wheel_.hold(Coordinate::z);
  else
    wheel_.prescribe(Coordinate::z, -lowering_speed_);
}

void WheelRig::drive_travel(double time, double dt) {
  if (!travel_free_) {
    wheel_.prescribe(Coordinate::x, speed_ * speed_ramp_.mean(time, time + dt));
    return;
  }
  wheel_.release(Coordinate::x);
  wheel_.set_load(wheel_.load() - Vector3(drawbar_load_ * speed_ramp_.value(time), 0.0, 0.0));
}

void WheelRig::drive_vertical(double time, double dt) {
  if (time + 0.5 * dt < start_) {
    wheel_.hold(Coordinate::z);
    wheel_.set_load(Vector3::Zero());
  } else if (lowers_ && lower(time, dt)) {
    return;
  } else if (sinkage_prescribed_) {
    wheel_.prescribe(Coordinate::z, lowering_ * load_ramp_.mean_rate(time, time + dt));
  } else {
    wheel_.release(Coordinate::z);
    const double share = load_ramp_.value(time);
    if (has_suspension())
      press_by_suspension(share, dt);
    else
      wheel_.set_load(load_ * share * down());
  }
}

/// Moves the wheel while it settles: a smooth way down to ground_level, then a creep until the
/// ground bears the wheel. While the load grows, the rig holds the wheel whenever the ground bears
/// more than the load, so that it does not swing. A wheel that meets no ground falls freely in the
/// end. The force on the ground shows where the wheel is, so nothing needs to be remembered. The
/// sprung mass of a suspension comes down with the wheel, and then swings freely.
/// @return whether the rig holds or moves the wheel
bool WheelRig::lower(double time, double dt) {
  const double middle = time + 0.5 * dt;
  if (middle >= speed_ramp_.start || (has_suspension() && middle >= load_ramp_.start)) return false;
  const double share = load_ramp_.value(time), force = wheel_.ground_wrench().force.z();
  const bool touches = force > touching_share * load_ * std::max(share, minimum_share);
  const bool loads = middle >= load_ramp_.start && force <= -share * load_ * down().z();
  if (touches && loads) return false;
  if (!touches && middle >= creep_end_) return false;
  wheel_.set_load(Vector3::Zero());
  if (touches)
    wheel_.hold(Coordinate::z);
  else if (middle < lowering_ramp_.end())
    wheel_.prescribe(Coordinate::z, approach(lowering_ramp_, wheel_.position(Coordinate::z),
                                             touching_z_, time, dt));
  else
    wheel_.prescribe(Coordinate::z, -creep_speed_);
  first_height_ = wheel_.position(Coordinate::z);
  return true;
}

/// Direction of gravity in the axes of the ground.
Vector3 WheelRig::down() const {
  const double across = std::sin(side_slope_), along = std::sin(slope_);
  return {-along, -across * std::cos(slope_), -std::cos(side_slope_) * std::cos(slope_)};
}

/// Weight of the wheel and force of the suspension, while a share of the weights acts. Along the
/// ground the axle carries all of the load.
void WheelRig::press_by_suspension(double share, double dt) {
  const double minimum_mass = std::min(sprung_mass_, wheel_.total_mass());
  if (dt * dt * strut_.stiffness > largest_spring_step * minimum_mass ||
      dt * strut_.damping > largest_damper_step * minimum_mass)
    throw StateError(fmt::format(
        "wheel rig: a step of {:g} s is too long for a suspension of {:g} N/m and {:g} N s/m on "
        "{:.4g} kg; write a smaller timestep",
        dt, strut_.stiffness, strut_.damping, minimum_mass));
  const double own = share * wheel_weight_;
  sprung_weight_ = (share * load_ - own) * down();
  Vector3 load = share * load_ * down();
  load.z() = own * down().z();
  wheel_.set_load(load);
  if (joined_) return;
  SprungBody body(sprung_mass_ * Vector3::UnitX(), strut_.top_height * Vector3::UnitX(),
                  strut_.top_velocity * Vector3::UnitX());
  std::vector<Strut> struts{strut()};
  body.advance(struts, Vector2::Zero(), dt);
  press(struts.front());
}

double WheelRig::sprung_drop() const {
  return has_suspension() ? start_height_ - first_height_ - strut_.top_height : 0.0;
}

Strut WheelRig::strut() const {
  Strut strut = strut_;
  strut.arm = wheel_.centre().head<2>();
  strut.height = wheel_.position(Coordinate::z) - first_height_;
  strut.velocity = wheel_.rate(Coordinate::z);
  strut.weight = -sprung_weight_.z();
  return strut;
}

void WheelRig::press(const Strut& strut) {
  strut_ = strut;
  wheel_.set_load(wheel_.load() - Vector3(0.0, 0.0, strut.force));
}

void WheelRig::pull(double force) { wheel_.set_load(wheel_.load() + Vector3(force, 0.0, 0.0)); }

void WheelRig::checkpoint(Checkpoint& state) {
  if (!has_suspension()) return;
  state.value("sprung_height", strut_.top_height);
  state.value("sprung_velocity", strut_.top_velocity);
  state.value("suspension_force", strut_.force);
  state.value("first_height", first_height_);
}

void WheelRig::drive_spin(double time, double dt) {
  switch (mode_) {
    case Mode::towed:
      wheel_.release(Coordinate::spin);
      return;
    case Mode::slip:
    case Mode::spin:
      wheel_.prescribe(Coordinate::spin, spin_rate_ * speed_ramp_.mean(time, time + dt));
      return;
    case Mode::torque:
      wheel_.release(Coordinate::spin);
      wheel_.set_axle_torque(torque_ * speed_ramp_.value(time));
      return;
  }
}

}  // namespace furrow
