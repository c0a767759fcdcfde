// SPDX-License-Identifier: GPL-2.0-or-later
// What a rig records: the channels of history.h5.

#include <cmath>

#include "rig/wheel_rig.h"

namespace furrow {

namespace {

// [m/s] below it, rim and axle both rest and the recorded slip is 0
constexpr double standstill = 1e-12;

}  // namespace

/// What a row is computed from.
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
  /// [m/s] of the axle
  double speed_in_plane() const { return wheel.velocity().dot(heading()); }
};

const Outputs<const WheelRig::Reading>& WheelRig::outputs() {
  using R = const Reading;
  static const Outputs<R> list = {
      {"time", "s", "time since the start of the run", [](R& r) { return r.time; }},
      {pass_channel, "", "number of the pass in one rut, from 1",
       [](R& r) { return static_cast<double>(r.rig.pass(r.time)); }},
      {stage_channel, "", "0 settle, 1 accelerate, 2 cruise, 3 back for another pass",
       [](R& r) { return static_cast<double>(r.rig.stage(r.time)); }},
      {axle_free_channel, "", "1 where the axle is free along x, else 0",
       [](R& r) { return r.rig.travel_free_ ? 1.0 : 0.0; }},
      {"x", "m", "axle centre, along the travel", [](R& r) { return r.wheel.centre().x(); }},
      {"y", "m", "axle centre, lateral", [](R& r) { return r.wheel.centre().y(); }},
      {"z", "m", "axle centre, upwards", [](R& r) { return r.wheel.centre().z(); }},
      {"velocity_x", "m/s", "of the axle centre, half a step before time",
       [](R& r) { return r.wheel.velocity().x(); }},
      {"velocity_y", "m/s", "of the axle centre, half a step before time",
       [](R& r) { return r.wheel.velocity().y(); }},
      {"velocity_z", "m/s", "of the axle centre, half a step before time",
       [](R& r) { return r.wheel.velocity().z(); }},
      {"spin_angle", "rad", "turn about the axle since the start, > 0 rolling forward",
       [](R& r) { return r.wheel.position(Coordinate::spin); }},
      {"spin_rate", "rad/s", "rate of spin_angle, half a step before time",
       [](R& r) { return r.wheel.rate(Coordinate::spin); }},
      {"rim_speed", "m/s", "spin_rate x radius without grousers",
       [](R& r) { return r.rim_speed(); }},
      {"slip", "",
       slip_formula(SlipDefinition::larger_speed) +
           ", v_rim = rim_speed, v = speed of the axle in the wheel plane; 0 at standstill",
       [](R& r) {
         const bool at_rest =
             std::abs(r.rim_speed()) < standstill && std::abs(r.speed_in_plane()) < standstill;
         return at_rest
                    ? 0.0
                    : furrow::slip(SlipDefinition::larger_speed, r.rim_speed(), r.speed_in_plane());
       }},
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
      {"force_x", "N", "force of the ground on the wheel", [](R& r) { return r.ground.force.x(); }},
      {"force_y", "N", "force of the ground on the wheel", [](R& r) { return r.ground.force.y(); }},
      {"force_z", "N", "force of the ground on the wheel", [](R& r) { return r.ground.force.z(); }},
      {"moment_x", "N m", "moment of the ground on the wheel about the axle centre",
       [](R& r) { return r.ground.moment.x(); }},
      {"moment_y", "N m", "moment of the ground on the wheel about the axle centre",
       [](R& r) { return r.ground.moment.y(); }},
      {"moment_z", "N m", "moment of the ground on the wheel about the axle centre",
       [](R& r) { return r.ground.moment.z(); }},
      {"lateral_force", "N", "of the ground, square to the wheel's heading, > 0 to its left",
       [](R& r) { return r.ground.force.dot(r.left()); }},
      {"overturning_moment", "N m",
       "of the ground about the heading through the axle centre, > 0 tips the top to the right",
       [](R& r) { return r.ground.moment.dot(r.heading()); }},
      {"aligning_moment", "N m",
       "of the ground about the upward axis through the axle centre, > 0 turns to the left",
       [](R& r) { return r.ground.moment.z(); }},
      {"drive_torque", "N m",
       "torque of the axle on the wheel, mean of the last step, > 0 drives forward",
       [](R& r) { return r.wheel.constraint(Coordinate::spin); }},
      {"drawbar_pull", "N",
       "force of the axle on the vehicle along x, what holds the weight on a slope included, mean "
       "of the last step, > 0 pulls it forward",
       [](R& r) { return -r.wheel.constraint(Coordinate::x) - r.wheel.load().x(); }},
      {"load", "N", "downward force on the wheel, its weight included, mean of the last step",
       [](R& r) { return -r.wheel.load().z() - r.wheel.constraint(Coordinate::z); }},
      {"kinetic_energy", "J", "of the wheel", [](R& r) { return r.budget.kinetic_energy; }},
      {"contact_work", "J", "of the ground on the wheel, since the start",
       [](R& r) { return r.budget.contact_work; }},
      {"load_work", "J", "of the load on the wheel, weight included, since the start",
       [](R& r) { return r.budget.load_work; }},
      {"drive_work", "J", "of the axle on the wheel by speed, torque and guides, since the start",
       [](R& r) { return r.budget.drive_work; }},
      {"damping_loss", "J", "taken out by the rig's vertical damping, since the start",
       [](R& r) { return r.wheel.damping_loss(); }},
      {"stored_energy", "J", "elastic, in the wheel", [](R& r) { return r.budget.stored_energy; }},
      {"wheel_loss", "J", "taken by the wheel's or tyre's own dissipation, since the start",
       [](R& r) { return r.budget.dissipated_energy - r.wheel.damping_loss(); }},
      {"friction_loss", "J", "taken by sliding between wheel and ground",
       [](R& r) { return r.losses.friction; }},
      {"continuum_work", "J", "of the wheel on the continuum, friction not included",
       [](R& r) { return r.losses.continuum; }},
      {"compaction_work", "J", "of the continuum, by pressing down, since the start",
       [](R& r) { return r.losses.compaction; }},
      {"bulldozing_work", "J",
       "of the continuum, by all other deformation and by lifting, since the start",
       [](R& r) { return r.losses.bulldozing; }},
      {"grain_press_work", "J", "of the wheel on grains, by vertical forces, since the start",
       [](R& r) { return r.losses.press; }},
      {"grain_push_work", "J",
       "of the wheel on grains, by horizontal forces and torques, since the start",
       [](R& r) { return r.losses.push; }},
      {"grains_slide_work", "J",
       "taken between grains by tangential forces, since the start; with fix grain/work, else 0",
       [](R& r) { return r.losses.grains.slide; }},
      {"grains_roll_work", "J", "taken between grains by rolling friction, since the start",
       [](R& r) { return r.losses.grains.roll; }},
      {"grains_square_work", "J", "taken between grains square to their contacts, since the start",
       [](R& r) { return r.losses.grains.square; }},
      {"grains_below_work", "J", "of these three, below the track",
       [](R& r) { return r.losses.grains.below; }},
      {"grains_ahead_work", "J", "of these three, ahead of the track, within its width",
       [](R& r) { return r.losses.grains.ahead; }},
      {"grains_aside_work", "J", "of these three, beside the track",
       [](R& r) { return r.losses.grains.aside; }},
      {"grains_walls_work", "J", "of grains on all but grains and the wheel, since the start",
       [](R& r) { return r.losses.grains.walls; }},
      {"grains_lifted_work", "J", "of grains against gravity, since the start",
       [](R& r) { return r.losses.grains.lifted; }},
      {"grains_kinetic_energy", "J", "of all grains, rotation included",
       [](R& r) { return r.losses.grains.kinetic; }},
      {"ground_kinetic_energy", "J", "of the continuum, that of dropped ground included",
       [](R& r) { return r.losses.kinetic; }},
      {"grid_loss", "J", "taken by the continuum's discretisation, since the start",
       [](R& r) { return r.losses.numerical; }},
      {"contact_damping_loss", "J",
       "taken by the damping of the contact with a continuum; by grains, square to the wheel",
       [](R& r) { return r.losses.contact_damping; }},
      {"contact_spring_loss", "J",
       "held or lost by the springs of the contact with continuum or plane; with grains, error",
       [](R& r) { return r.losses.contact_springs; }},
      {"radiated_work", "J", "through absorbing faces of the continuum, since the start",
       [](R& r) { return r.losses.radiated; }},
  };
  return list;
}

std::vector<Channel> WheelRig::channels() { return outputs().channels(); }

std::vector<double> WheelRig::measure(double time, const GroundLosses& losses) const {
  const Reading reading{*this, wheel_, time, wheel_.ground_wrench(), wheel_.energy_budget(),
                        losses};
  return outputs().values(reading);
}

}  // namespace furrow
