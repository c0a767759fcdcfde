// SPDX-License-Identifier: GPL-2.0-or-later
#include "rig/wheel_rig.h"

#include <cmath>

namespace furrow {

namespace {

// Of the load: what the ground bears when a lowered wheel has come down on it.
constexpr double touching_share = 0.02;

}  // namespace

RigStage WheelRig::stage(double time) const {
  const double delay = passes_.delay(time);
  if (passes_.goes_back(time - delay, passes_.index(time))) return RigStage::back;
  time -= delay;
  return time < speed_ramp_.start   ? RigStage::settle
         : time < speed_ramp_.end() ? RigStage::accelerate
                                    : RigStage::cruise;
}

void WheelRig::apply(double time, double dt) {
  // by the middle of the step: safe against rounding of its ends
  const double middle = time + 0.5 * dt, clock = time - passes_.delay(middle);
  switch (stage(middle)) {
    case RigStage::settle:
      drive_vertical(clock, dt);
      wheel_.hold(Coordinate::x);
      wheel_.hold(Coordinate::spin);
      return;
    case RigStage::accelerate:
    case RigStage::cruise:
      drive_vertical(clock, dt);
      drive_travel(clock, dt);
      drive_spin(clock, dt);
      return;
    case RigStage::back:
      go_back(clock, dt);
      return;
  }
}

/// What the wheel does depends on where it is and how the ground bears it, so that nothing else
/// needs to be remembered.
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
  if (time + 0.5 * dt < load_ramp_.start) {
    wheel_.hold(Coordinate::z);
    wheel_.set_load(Vector3::Zero());
  } else if (sinkage_prescribed_) {
    wheel_.prescribe(Coordinate::z, lowering_ * load_ramp_.mean_rate(time, time + dt));
  } else {
    wheel_.release(Coordinate::z);
    wheel_.set_load(load_ * load_ramp_.value(time) *
                    Vector3(-std::sin(slope_), 0.0, -std::cos(slope_)));
  }
}

void WheelRig::drive_spin(double time, double dt) {
  switch (mode_) {
    case Mode::towed:
      wheel_.release(Coordinate::spin);
      return;
    case Mode::slip:
    case Mode::spin:
      wheel_.prescribe(Coordinate::spin,
                       rim_speed_ / wheel_.nominal_radius() * speed_ramp_.mean(time, time + dt));
      return;
    case Mode::torque:
      wheel_.release(Coordinate::spin);
      wheel_.set_axle_torque(torque_ * speed_ramp_.value(time));
      return;
  }
}

}  // namespace furrow
