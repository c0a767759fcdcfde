// SPDX-License-Identifier: GPL-2.0-or-later
// Channels that a rig records in history.h5.

#include <cmath>

#include <fmt/format.h>

#include "furrow/rig/wheel_rig.h"

namespace furrow {

namespace {

// Speed [m/s] below which rim and axle both rest and the recorded slip is 0
constexpr double standstill = 1e-12;

}  // namespace

/// State of rig and wheel from which a row is computed.
struct WheelRig::Reading {
  const WheelRig& rig;
  const WheelHub& wheel;
  double time;          // [s]
  Wrench ground;        // of the ground on the wheel, moment about the axle centre
  EnergyBudget budget;  // of the wheel
  GroundLosses losses;  // of the ground

  double yaw() const { return wheel.position(Coordinate::yaw); }
  Vector3 heading() const { return {std::cos(yaw()), std::sin(yaw()), 0.0}; }
  Vector3 left() const { return {-std::sin(yaw()), std::cos(yaw()), 0.0}; }
  double rim_speed() const { return wheel.rate(Coordinate::spin) * wheel.nominal_radius(); }
  double hub_drop() const { return rig.ground_level_ - wheel.lowest_point(); }  // [m]
  /// Speed of the axle along its heading [m/s]
  double forward_speed() const { return wheel.velocity().dot(heading()); }
  /// Speed that slip compares with the rim speed [m/s]; positive forward
  double slip_speed() const {
    const double forward = forward_speed();
    return rig.slip_by_total_speed_ ? std::copysign(wheel.velocity().head<2>().norm(), forward)
                                    : forward;
  }
  double slip() const {
    const double rim = wheel.rate(Coordinate::spin) * rig.slip_radius_, speed = slip_speed();
    const bool at_rest = std::abs(rim) < standstill && std::abs(speed) < standstill;
    return at_rest ? 0.0 : furrow::slip(SlipDefinition::larger_speed, rim, speed);
  }
};

const Outputs<const WheelRig::Reading>& WheelRig::outputs() {
  using R = const Reading;
  static const Outputs<R> list = {
      {"time", "s", "time since the start of the run", [](R& r) { return r.time; }},
      {pass_channel, "", "number of the pass in one rut, from 1",
       [](R& r) { return static_cast<double>(r.rig.pass(r.time)); }},
      {stage_channel, "", "0: settle, 1: accelerate, 2: cruise, 3: return for another pass",
       [](R& r) { return static_cast<double>(r.rig.stage(r.time)); }},
      {axle_free_channel, "",
       "1: free along x; 2: free together with the wheels of its chassis; 0: not free",
       [](R& r) {
         return static_cast<double>(!r.rig.travel_free_ ? AxleTravel::held
                                    : r.rig.joined_     ? AxleTravel::shared
                                                        : AxleTravel::free);
       }},
      {"x", "m", "position of the axle centre along the travel",
       [](R& r) { return r.wheel.centre().x(); }},
      {"y", "m", "lateral position of the axle centre", [](R& r) { return r.wheel.centre().y(); }},
      {"z", "m", "height of the axle centre", [](R& r) { return r.wheel.centre().z(); }},
      {"velocity_x", "m/s", "velocity of the axle centre, half a step before `time`",
       [](R& r) { return r.wheel.velocity().x(); }},
      {"velocity_y", "m/s", "velocity of the axle centre, half a step before `time`",
       [](R& r) { return r.wheel.velocity().y(); }},
      {"velocity_z", "m/s", "velocity of the axle centre, half a step before `time`",
       [](R& r) { return r.wheel.velocity().z(); }},
      {"spin_angle", "rad", "turn about the axle since the start; positive rolls forward",
       [](R& r) { return r.wheel.position(Coordinate::spin); }},
      {grouser_channel, "", "turn about the axle in pitches of grousers; 0 for a smooth wheel",
       [](R& r) { return r.wheel.position(Coordinate::spin) * r.wheel.grousers() / (2.0 * pi); }},
      {"spin_rate", "rad/s", "rate of spin_angle, half a step before `time`",
       [](R& r) { return r.wheel.rate(Coordinate::spin); }},
      {"rim_speed", "m/s", "spin_rate times the radius without grousers",
       [](R& r) { return r.rim_speed(); }},
      {"slip", "",
       slip_formula(SlipDefinition::larger_speed) +
           ", v_rim and v by `slip_radius` and `slip_speed` of the rig; 0 at standstill",
       [](R& r) { return r.slip(); }},
      {hub_drop_channel, "m",
       "ground level minus lowest point of the unloaded wheel, without grousers",
       [](R& r) { return r.hub_drop(); }},
      {tyre_deflection_channel, "m",
       "height of the loaded tread's lowest point above that of the unloaded tread; 0 for a rigid "
       "wheel",
       [](R& r) { return r.wheel.deflection(); }},
      {rut_depth_channel, "m",
       "ground level minus lowest point of the loaded wheel: hub_drop - tyre_deflection",
       [](R& r) { return r.hub_drop() - r.wheel.deflection(); }},
      {"force_x", "N", "force of the ground on the wheel, along the travel",
       [](R& r) { return r.ground.force.x(); }},
      {"force_y", "N", "force of the ground on the wheel, to the left of the travel",
       [](R& r) { return r.ground.force.y(); }},
      {"force_z", "N", "force of the ground on the wheel, upwards",
       [](R& r) { return r.ground.force.z(); }},
      {"moment_x", "N m", "moment of the ground on the wheel about the axle centre",
       [](R& r) { return r.ground.moment.x(); }},
      {"moment_y", "N m", "moment of the ground on the wheel about the axle centre",
       [](R& r) { return r.ground.moment.y(); }},
      {"moment_z", "N m", "moment of the ground on the wheel about the axle centre",
       [](R& r) { return r.ground.moment.z(); }},
      {"tractive_force", "N",
       "force of the ground along the wheel's heading, in the wheel frame; positive forward",
       [](R& r) { return r.ground.force.dot(r.heading()); }},
      {"lateral_force", "N",
       "side force: of the ground normal to the heading, in the wheel frame; positive to the left",
       [](R& r) { return r.ground.force.dot(r.left()); }},
      {"overturning_moment", "N m",
       "moment of the ground about the heading, at the axle centre; positive tips the top to the "
       "right",
       [](R& r) { return r.ground.moment.dot(r.heading()); }},
      {"aligning_moment", "N m",
       "moment of the ground about the vertical, at the axle centre; positive turns to the left",
       [](R& r) { return r.ground.moment.z(); }},
      {"drive_torque", "N m",
       "torque of the axle on the wheel, mean of the last step; positive drives forward",
       [](R& r) { return r.wheel.constraint(Coordinate::spin); }},
      {"drawbar_pull", "N",
       "force of the axle on the vehicle along x, mean of the last step, with the slope component "
       "of the weight; positive pulls forward",
       [](R& r) { return -r.wheel.constraint(Coordinate::x) - r.wheel.load().x(); }},
      {"load", "N", "downward force on the wheel, its weight included, mean of the last step",
       [](R& r) { return -r.wheel.load().z() - r.wheel.constraint(Coordinate::z); }},
      {"sprung_drop", "m",
       "downward motion of the sprung mass since the start; 0 without suspension",
       [](R& r) { return r.rig.sprung_drop(); }},
      {"suspension_force", "N", "force of spring and damper on the axle, positive downwards",
       [](R& r) { return r.rig.strut_.force; }},
      {"kinetic_energy", "J", "kinetic energy of the wheel",
       [](R& r) { return r.budget.kinetic_energy; }},
      {"contact_work", "J", "work of the ground on the wheel",
       [](R& r) { return r.budget.contact_work; }},
      {"load_work", "J", "work of the load on the wheel, its weight included",
       [](R& r) { return r.budget.load_work; }},
      {"drive_work", "J", "work of the axle on the wheel by speed, torque and guides",
       [](R& r) { return r.budget.drive_work; }},
      {"damping_loss", "J", "energy dissipated by the rig's vertical damping",
       [](R& r) { return r.wheel.damping_loss(); }},
      {"stored_energy", "J", "elastic energy of the wheel or tyre",
       [](R& r) { return r.budget.stored_energy; }},
      {"wheel_loss", "J", "energy dissipated inside the wheel or tyre",
       [](R& r) { return r.budget.dissipated_energy - r.wheel.damping_loss(); }},
      {"friction_loss", "J", "energy dissipated by sliding between wheel and ground",
       [](R& r) { return r.losses.friction; }},
      {"continuum_work", "J", "work of the wheel on the continuum, without friction",
       [](R& r) { return r.losses.continuum; }},
      {"compaction_work", "J", "work on the continuum by vertical compression",
       [](R& r) { return r.losses.compaction; }},
      {"bulldozing_work", "J", "work on the continuum by all other deformation and by lifting",
       [](R& r) { return r.losses.bulldozing; }},
      {"grain_press_work", "J", "work of the wheel on grains by vertical forces",
       [](R& r) { return r.losses.press; }},
      {"grain_push_work", "J", "work of the wheel on grains by horizontal forces and torques",
       [](R& r) { return r.losses.push; }},
      {"grains_slide_work", "J",
       "work of tangential forces between grains, with fix grain/work; else 0",
       [](R& r) { return r.losses.grains.slide; }},
      {"grains_roll_work", "J", "work of rolling friction between grains",
       [](R& r) { return r.losses.grains.roll; }},
      {"grains_square_work", "J", "work of normal forces between grains",
       [](R& r) { return r.losses.grains.square; }},
      {"grains_below_work", "J", "part of these three at contacts below the track",
       [](R& r) { return r.losses.grains.below; }},
      {"grains_ahead_work", "J",
       "part of these three at contacts ahead of the track, within its width",
       [](R& r) { return r.losses.grains.ahead; }},
      {"grains_aside_work", "J", "part of these three at contacts at the sides of the track",
       [](R& r) { return r.losses.grains.aside; }},
      {"grains_walls_work", "J", "work of grains on everything except grains and the wheel",
       [](R& r) { return r.losses.grains.walls; }},
      {"grains_lifted_work", "J", "work of grains against gravity",
       [](R& r) { return r.losses.grains.lifted; }},
      {"grains_kinetic_energy", "J", "kinetic energy of all grains, rotation included",
       [](R& r) { return r.losses.grains.kinetic; }},
      {"ground_kinetic_energy", "J", "kinetic energy of the continuum, dropped ground included",
       [](R& r) { return r.losses.kinetic; }},
      {"grid_loss", "J", "energy dissipated by the continuum's discretisation",
       [](R& r) { return r.losses.numerical; }},
      {"contact_damping_loss", "J",
       "energy dissipated by the damping of the contact; with grains, by normal forces on the "
       "wheel",
       [](R& r) { return r.losses.contact_damping; }},
      {"contact_spring_loss", "J",
       "energy stored or lost in the contact's springs; with grains, the error of the balance",
       [](R& r) { return r.losses.contact_springs; }},
      {"radiated_work", "J", "work through absorbing faces of the continuum",
       [](R& r) { return r.losses.radiated; }},
  };
  return list;
}

std::vector<Channel> WheelRig::channels() { return outputs().channels(); }

std::string WheelRig::slip_meaning() const {
  const char* radius = slip_radius_ == wheel_.nominal_radius() ? "bare radius"
                       : slip_radius_ == wheel_.tip_radius()   ? "tip radius"
                                                               : "effective radius";
  return fmt::format("{}, v_rim = spin rate x {} {:.6g} m, v = {}; 0 at standstill",
                     slip_formula(SlipDefinition::larger_speed), radius, slip_radius_,
                     slip_by_total_speed_ ? "total horizontal speed of the axle"
                                          : "forward speed of the axle in the wheel plane");
}

std::vector<Channel> WheelRig::recorded_channels() const {
  std::vector<Channel> list = channels();
  for (Channel& channel : list)
    if (channel.name == "slip") channel.meaning = slip_meaning();
  return list;
}

std::vector<double> WheelRig::measure(double time, const GroundLosses& losses) const {
  const Reading reading{*this, wheel_, time, wheel_.ground_wrench(), wheel_.energy_budget(),
                        losses};
  return outputs().values(reading);
}

}  // namespace furrow
